// Laws of supports against closed forms.
//
// SOFT SLIDER (stop_operator.h), steady turn of amplitude X: from the turn at z_t the pass of 2 X is elastic over z_t + (1 - e) z_s, then
//   z_s - |z| = e z_s exp(-s / (e z_s)) over the rest; each slope is dz/dx = 1 - a. The test integrates dz/dx by small steps.
// DAMPER AND SLIDERS: the work of the force over a closed turn is the loss, whatever the law; independent of speed without damper.
// MAXWELL: driven by X sin(w t) the steady force is X (K' sin + K'' cos), K' = k_0 + sum k_j s^2/(1+s^2), K'' = c w + sum k_j s/(1+s^2), s = w tau.
// POWER LAW: K* = K_0 (i f)^p has K' = K_0 f^p cos(p pi/2), K'' = K_0 f^p sin(p pi/2): a passive material with endless relaxation times.
// SHORT SQUEEZE FILM, b = mu R L^3 / c^3, s = e/c (San Andres, notes 13; Ocvirk):
//   2 pi film: C_rr = b pi (1 + 2 s^2)/(1 - s^2)^(5/2), C_tt = b pi/(1 - s^2)^(3/2); pi film in circular motion: F_t = -b V pi/(2 (1 - s^2)^(3/2)),
//   F_r = -b V 2 s/(1 - s^2)^2.
#include "laws/support/support_laws.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "laws/support/maxwell_fit.h"
#include "laws/support/ribbon.h"

namespace rotordrop {
namespace {

constexpr double pi = std::numbers::pi;

struct Turn {
  double work = 0, loss = 0, stored_change = 0;
  std::array<double, 2> first_harmonic{};  // of -force along y: sine, cosine
};

/// Drives the law by y = X sin(w t) through turns, by the fourth-order Runge-Kutta method; reports the last one.
Turn driven(const SupportLaw& law, double X, double w, int n_turns, int n_steps, double z_share = 0.) {
  const std::size_t n = law.n_states();
  std::vector<double> q(n), k1(n), k2(n), k3(n), k4(n), at(n);
  law.settle(0., 0., q);
  const auto motion = [&](double t) {
    const double x = X * std::sin(w * t), v = X * w * std::cos(w * t);
    return SupportMotion{x, z_share * x, v, z_share * v};
  };
  const double h = 2. * pi / w / n_steps;
  Turn turn;
  for (int i = 0; i < n_turns * n_steps; ++i) {
    if (i % n_steps == 0) {
      turn = {};
      turn.stored_change = -law.energy(motion(i * h), q);
    }
    const double t = i * h;
    const auto add = [&](const std::vector<double>& k, double f) {
      for (std::size_t j = 0; j < n; ++j) at[j] = q[j] + f * h * k[j];
    };
    // Power and loss by the same method: they are quadratures.
    const auto rate = [&](double when, const std::vector<double>& state, std::vector<double>& k) {
      const auto m = motion(when);
      const auto r = law.evaluate(m, state, k);
      return std::array{-(r.y * m.vy + r.z * m.vz), r.loss, -r.y * std::sin(w * when), -r.y * std::cos(w * when)};
    };
    const auto r1 = rate(t, q, k1);
    add(k1, 0.5);
    const auto r2 = rate(t + 0.5 * h, at, k2);
    add(k2, 0.5);
    const auto r3 = rate(t + 0.5 * h, at, k3);
    add(k3, 1.);
    const auto r4 = rate(t + h, at, k4);
    const auto sum = [&](std::size_t c) { return h / 6. * (r1[c] + 2. * r2[c] + 2. * r3[c] + r4[c]); };
    turn.work += sum(0);
    turn.loss += sum(1);
    turn.first_harmonic[0] += w / pi * sum(2);
    turn.first_harmonic[1] += w / pi * sum(3);
    for (std::size_t j = 0; j < n; ++j) q[j] += h / 6. * (k1[j] + 2. * k2[j] + 2. * k3[j] + k4[j]);
  }
  turn.stored_change += law.energy(motion(n_turns * n_steps * h), q);
  return turn;
}

RibbonSupport::Axis ribbon_axis() { return {2e7, 0., {{6e7, 10e-6}, {8e6, 45e-6}}}; }

TEST(StopOperator, LosesInASteadyTurnWhatItsEquationSays) {
  for (const double amplitude : {10e-6, 25e-6, 100e-6}) {
    const StopOperator s{1e7, 20e-6};
    double z = 0., work = 0.;
    const int n = 400000;
    for (int turn = 0; turn < 4; ++turn) {
      work = 0.;
      for (int k = 0; k < n; ++k) {
        const double dx = amplitude * (std::sin(2. * pi * (k + 1) / n) - std::sin(2. * pi * k / n));
        const double middle = z + 0.5 * dx * (1. - s.yielding(z, dx)), next = z + dx * (1. - s.yielding(middle, dx));
        work += s.stiffness * 0.5 * (z + next) * dx;
        z = next;
      }
    }
    EXPECT_NEAR(work, steady_loop_loss({0., 0., {s}}, amplitude), 1e-9 * s.stiffness * amplitude * amplitude)
        << amplitude;
    const double sharp = amplitude > s.reach ? 4. * s.stiffness * s.reach * (amplitude - s.reach) : 0.;
    EXPECT_NEAR(work, sharp, 0.06 * 4. * s.stiffness * s.reach * s.reach) << "J: near the sharp slider";
  }
}

TEST(StopOperator, IsElasticBelowItsRange) {
  const StopOperator s{1e7, 20e-6};
  EXPECT_EQ(s.yielding(15.9e-6, 1.), 0.);
  EXPECT_EQ(s.yielding(19e-6, -1.), 0.) << "unloading";
  EXPECT_EQ(s.yielding(21e-6, 1.), 1.);
  EXPECT_NEAR(s.pushed(1e-3), 20e-6, 1e-12);
  for (const double x : {-70e-6, -18e-6, 3e-6, 16e-6, 17e-6, 50e-6}) {
    const double h = 1e-9;
    EXPECT_NEAR((s.pushed_energy(x + h) - s.pushed_energy(x - h)) / (2. * h), s.stiffness * s.pushed(x), 1e-3)
        << "N at " << x;
    EXPECT_NEAR((s.pushed(x + h) - s.pushed(x - h)) / (2. * h), s.pushed_slope(x), 1e-4) << x;
  }
}

TEST(RibbonSupport, LosesTheAreaOfItsLoop) {
  const RibbonSupport ribbon(ribbon_axis());
  const Turn turn = driven(ribbon, 60e-6, 2. * pi * 500., 4, 200000);
  const double expected = steady_loop_loss(ribbon_axis(), 60e-6);
  // Where sliders begin to slip their law has a kink, so that a step errs by its square: (2 pi / 200000)^2 = 1e-9.
  EXPECT_NEAR(turn.work, expected, 1e-9 * expected) << "J, area of the loop";
  EXPECT_NEAR(turn.loss, expected, 1e-9 * expected) << "J, booked";
  EXPECT_NEAR(turn.stored_change, 0., 1e-9 * expected);
  const Turn slow = driven(ribbon, 60e-6, 2. * pi * 5., 4, 200000);
  EXPECT_NEAR(slow.work, turn.work, 1e-9 * expected) << "independent of speed";
}

TEST(RibbonSupport, IsTheSameInEveryDirection) {
  const RibbonSupport ribbon(ribbon_axis());
  const std::size_t n = ribbon.n_states() / 2;
  const SupportMotion m{30e-6, -12e-6, 0.04, 0.03};
  const std::vector<double> inner = {7e-6, 20e-6, 5e-6, -38e-6};
  std::vector<double> rates(2 * n), turned(2 * n), turned_rates(2 * n);
  const auto given = ribbon.evaluate(m, inner, rates);
  const auto rest = ribbon.rest(m.y, m.z);
  for (const double angle : {0.4, 1.9, 3.5}) {
    const double c = std::cos(angle), s = std::sin(angle);
    for (std::size_t j = 0; j < n; ++j) {
      turned[j] = c * inner[j] - s * inner[n + j];
      turned[n + j] = s * inner[j] + c * inner[n + j];
    }
    const SupportMotion there{c * m.y - s * m.z, s * m.y + c * m.z, c * m.vy - s * m.vz, s * m.vy + c * m.vz};
    const auto answer = ribbon.evaluate(there, turned, turned_rates);
    EXPECT_NEAR(answer.y, c * given.y - s * given.z, 1e-9) << "N, turned by " << angle;
    EXPECT_NEAR(answer.z, s * given.y + c * given.z, 1e-9) << "N, turned by " << angle;
    EXPECT_NEAR(answer.loss, given.loss, 1e-12 * given.loss);
    EXPECT_NEAR(ribbon.energy(there, turned), ribbon.energy(m, inner), 1e-14);
    const auto rest_there = ribbon.rest(there.y, there.z);
    EXPECT_NEAR(rest_there.force_y, c * rest.force_y - s * rest.force_z, 1e-9);
    for (std::size_t j = 0; j < n; ++j) EXPECT_NEAR(turned_rates[j], c * rates[j] - s * rates[n + j], 1e-15);
  }
}

TEST(RibbonSupport, TakesItsSlipForceFromARingThatWhirls) {
  // On a circle of radius A each slider turns along at its reach, ahead of the radius by arccos(z_s / A): it takes k z_s sqrt(A^2 - z_s^2) from each radian.
  const RibbonSupport ribbon(ribbon_axis());
  const double A = 100e-6, w = 2. * pi * 300.;
  const int n = 40000;
  const double h = 2. * pi / w / n;
  std::vector<double> inner(ribbon.n_states(), 0.), middle(inner), rates(inner);
  double loss = 0.;
  for (int k = 0; k < 3 * n; ++k) {
    if (k == 2 * n) loss = 0.;
    const auto at = [&](double t) {
      return SupportMotion{A * std::cos(w * t), A * std::sin(w * t), -A * w * std::sin(w * t), A * w * std::cos(w * t)};
    };
    ribbon.evaluate(at(k * h), inner, rates);
    for (std::size_t j = 0; j < inner.size(); ++j) middle[j] = inner[j] + 0.5 * h * rates[j];
    loss += h * ribbon.evaluate(at((k + 0.5) * h), middle, rates).loss;
    for (std::size_t j = 0; j < inner.size(); ++j) inner[j] += h * rates[j];
  }
  double expected = 0.;
  for (const auto& slider : ribbon_axis().elements)
    expected += 2. * pi * slider.stiffness * slider.reach * std::sqrt(A * A - slider.reach * slider.reach);
  EXPECT_NEAR(loss, expected, 1e-6 * expected) << "J a turn";
}

TEST(RibbonFromLoop, HasTheAreaAndShapeOfTheLoop) {
  // Bilinear: 1.25e8 N/m until 20 um from each turn, then 1e7 N/m; F falls to where it began.
  const double X = 100e-6;
  const MeasuredLoop loop{{{-X, -1.9e3}, {-X + 40e-6, 1.9e3 - 160e-6 * 1e7}, {X, 1.9e3}},
                          {{-X, -1.9e3}, {X - 40e-6, -1.9e3 + 160e-6 * 1e7}, {X, 1.9e3}}};
  ASSERT_EQ(fault_of(loop), "");
  const auto axis = ribbon_from_loop(loop);
  // roundoff of 1e7 N/m
  EXPECT_NEAR(axis.stiffness, 1e7, 1e-3);
  ASSERT_EQ(axis.elements.size(), 1u);
  const double first = (1.9e3 - 1600. + 1.9e3) / 40e-6;
  EXPECT_NEAR(axis.elements[0].stiffness, first - 1e7, 1e-9 * first);
  EXPECT_NEAR(steady_loop_loss(axis, X), loop_area(loop), 1e-9 * loop_area(loop)) << "J";
  EXPECT_NEAR(loop_area(loop), 4. * (first - 1e7) * 20e-6 * (X - 20e-6), 1e-9) << "J, of a sharp bilinear loop";
}

TEST(RibbonFromLoop, HasLossAndForceWhereverTheSliderSlips) {
  // Bilinear: 1e8 N/m until a part of the travel of 2 X after each turn, then 1e7 N/m.
  const double X = 100e-6, stiff = 1e8, soft = 1e7;
  for (const double part : {0.05, 0.2, 0.35, 0.5, 0.7, 0.85, 0.9, 0.95, 0.99}) {
    const double knee = part * 2. * X, F = 0.5 * (stiff * knee + soft * (2. * X - knee));
    const MeasuredLoop loop{{{-X, -F}, {-X + knee, -F + stiff * knee}, {X, F}},
                            {{-X, -F}, {X - knee, F - stiff * knee}, {X, F}}};
    ASSERT_EQ(fault_of(loop), "");
    const auto axis = ribbon_from_loop(loop);
    EXPECT_NEAR(steady_loop_loss(axis, X), loop_area(loop), 1e-9 * loop_area(loop)) << "J, knee at " << part;
    double force = axis.stiffness * X;
    for (const auto& s : axis.elements) {
      double z = 0.;
      const int n = 4000;
      for (int pass = 0; pass < 41; ++pass) {  // to X, to -X, and so on: each turn is nearer to the steady one
        const double step = (pass % 2 == 0 ? 2. : -2.) * X / n;
        for (int k = 0; k < n; ++k) z += step - s.flow(z, step);
      }
      force += s.stiffness * z;
    }
    // A soft onset that loses as much has another force at the turn: up to 1.7 % of the slider's.
    EXPECT_NEAR(force, F, 0.018 * F) << "N, knee at " << part;
  }
}

TEST(RibbonFromLoop, RefusesLoopsThatNoRibbonHas) {
  const MeasuredLoop good{{{-1e-4, -100.}, {1e-4, 100.}}, {{-1e-4, -100.}, {0., -50.}, {1e-4, 100.}}};
  EXPECT_EQ(fault_of(good), "");
  EXPECT_NE(fault_of({good.unloading, good.loading}).find("makes energy"), std::string::npos) << "branches exchanged";
  EXPECT_NE(
      fault_of({{{-1e-4, -100.}, {0., 50.}, {0.5e-4, 40.}, {1e-4, 100.}}, good.unloading}).find("negative stiffness"),
      std::string::npos);
  EXPECT_NE(fault_of({good.loading, {{-2e-4, -100.}, {1e-4, 100.}}}).find("different displacements"),
            std::string::npos);
}

TEST(RibbonFromGeometry, FollowsItsFormulas) {
  // Numbers by hand: l = 4 mm, k = 2e11 (0.3/4)^3 0.015 / (2 0.91) = 695398 N/m.
  const RibbonGeometry g{36, 8e-3, 1e-3, 0.3e-3, 15e-3, 0.1e-3, 2e11, 0.3, 0.15, 2e-6};
  EXPECT_NEAR(wave_stiffness(g), 695398., 1.);
  const auto axis = ribbon_from_geometry(g);
  // 18 times half of the last digit by hand
  EXPECT_NEAR(axis.stiffness, 18. * 695398., 9.);
  ASSERT_EQ(axis.elements.size(), 2u);
  const double load = 69.5398, kappa = pi * pi / 32.;
  EXPECT_NEAR(axis.elements[0].stiffness * axis.elements[0].reach, 0.15 * load * kappa * 72. / pi, 1e-2) << "N, feet";
  EXPECT_NEAR(axis.elements[1].stiffness * axis.elements[1].reach, 0.15 * load * 72. / pi, 1e-2) << "N, crests";
}

TEST(MaxwellFit, MeetsTheTableOfItsOwnKind) {
  const MaxwellModel made{1e7, 50., {{3e6, 2.3e-4}, {5e6, 1.7e-3}, {2e6, 3.1e-2}}};
  for (const int n : {4, 9, 15}) {
    std::vector<DynamicStiffness> table;
    for (int k = 0; k < n; ++k) {
      const double f = std::pow(10., 1. + 2. * k / (n - 1)), w = 2. * pi * f;
      double storage = 1e7, loss = 50. * w;
      for (const auto& e : made.elements) {
        storage += e.stiffness * std::pow(w * e.time, 2) / (1. + std::pow(w * e.time, 2));
        loss += e.stiffness * w * e.time / (1. + std::pow(w * e.time, 2));
      }
      table.push_back({f, storage, loss});
    }
    EXPECT_LT(fit_maxwell(table).largest_error, 1e-6) << n << " rows";
  }
}

TEST(MaxwellFit, MeetsAPowerLaw) {
  std::vector<DynamicStiffness> table;
  for (int k = 0; k < 10; ++k) {
    const double f = std::pow(10., k / 3.), K = 1e7 * std::pow(f, 0.15);
    table.push_back({f, K * std::cos(0.15 * pi / 2.), K * std::sin(0.15 * pi / 2.)});
  }
  const auto fit = fit_maxwell(table);
  EXPECT_LT(fit.largest_error, 1e-6);
  for (const auto& e : fit.model.elements) EXPECT_GT(e.stiffness, 0.) << "passive";
}

TEST(MaxwellFit, TellsATableThatNoPassiveMaterialHas) {
  // High loss without any rise of the storage modulus (Kramers and Kronig).
  EXPECT_GT(fit_maxwell({{10., 1e7, 5e6}, {100., 1e7, 8e6}, {1000., 1e7, 5e6}}).largest_error, 0.05);
}

TEST(ElastomerSupport, AnswersInTimeAsItsTableInFrequency) {
  std::vector<DynamicStiffness> table;
  for (int k = 0; k < 5; ++k) {
    const double f = std::pow(10., 1. + 0.5 * k), K = 1e7 * std::pow(f, 0.15);
    table.push_back({f, K * std::cos(0.15 * pi / 2.), K * std::sin(0.15 * pi / 2.)});
  }
  const auto model = fit_maxwell(table).model;
  const ElastomerSupport ring({model, model});
  for (const std::size_t k : {std::size_t{1}, std::size_t{3}}) {
    // Elements slower than the turn need their time: the slowest relaxes within tens of turns.
    const Turn turn = driven(ring, 1e-5, 2. * pi * table[k].frequency, k == 1 ? 200 : 2000, 400);
    EXPECT_NEAR(turn.first_harmonic[0] / 1e-5, table[k].storage, 1e-6 * table[k].storage)
        << "N/m at " << table[k].frequency;
    EXPECT_NEAR(turn.first_harmonic[1] / 1e-5, table[k].loss, 1e-6 * table[k].storage)
        << "N/m at " << table[k].frequency;
    EXPECT_NEAR(turn.work, pi * table[k].loss * 1e-10, 1e-5 * turn.work) << "J: pi K'' X^2";
    EXPECT_NEAR(turn.loss, turn.work - turn.stored_change, 1e-8 * turn.work)
        << "J: three quadratures by steps of 1/400 turn";
  }
}

TEST(KelvinVoigt, HasTheTablesValuesAtItsFrequency) {
  const auto m = kelvin_voigt({{100., 1e7, 2e6}, {300., 2e7, 4e6}}, 200.);
  // roundoff of some 1e7 N/m
  EXPECT_NEAR(m.stiffness, 1.5e7, 1e-3);
  EXPECT_NEAR(m.damping * 2. * pi * 200., 3e6, 1e-3);
}

TEST(SqueezeFilm, HasOcvirksCoefficients) {
  const SqueezeFilm full{0.02, 0.06, 0.025, 100e-6, false}, half{0.02, 0.06, 0.025, 100e-6, true};
  const double b = 0.02 * 0.06 * std::pow(0.025, 3) / 1e-12, V = 0.01;
  for (const double s : {0., 0.3, 0.6}) {
    const double tight = s < 0.5 ? 1e-9 : 1e-5, e = s * 100e-6, r = 1. - s * s;
    EXPECT_NEAR(full.force({e, 0., V, 0.})[0], -b * V * pi * (1. + 2. * s * s) / std::pow(r, 2.5), tight * b * V) << s;
    EXPECT_NEAR(full.force({e, 0., 0., V})[1], -b * V * pi / std::pow(r, 1.5), tight * b * V) << s;
    EXPECT_NEAR(full.force({e, 0., 0., V})[0], 0., tight * b * V) << s;
    EXPECT_NEAR(half.force({e, 0., 0., V})[1], -0.5 * b * V * pi / std::pow(r, 1.5), tight * b * V) << s;
    EXPECT_NEAR(half.force({e, 0., 0., V})[0], -b * V * 2. * s / (r * r), tight * b * V) << s;
  }
  EXPECT_EQ(full.force({5e-5, 0., 0., 0.})[0], 0.);
  for (const double angle : {0.3, 2., 4.5}) {
    const auto f = half.force({60e-6, 20e-6, std::cos(angle), std::sin(angle)});
    EXPECT_LT(f[0] * std::cos(angle) + f[1] * std::sin(angle), 0.) << "takes energy whichever way the ring moves";
  }
}

TEST(StoppedSupport, GivesBackWhatItStoresWithoutDamping) {
  const auto springs = std::make_shared<SpringSupport>(std::array{1e7, 2e7}, std::array{0., 0.});
  const StoppedSupport law(springs, 40e-6, {5e8, 1., 0.});
  const Turn turn = driven(law, 55e-6, 2000., 1, 100000, 0.5);
  EXPECT_NEAR(turn.work, 0., 1e-9);
  EXPECT_EQ(turn.loss, 0.);
  const StoppedSupport damped(springs, 40e-6, {5e8, 1., 0.3});
  const Turn lossy = driven(damped, 55e-6, 2000., 1, 100000, 0.5);
  // With N = K d (1 + 1.5 l d') in a sine of radius A: loss = 1.5 l K times the integral of d d'^2 dt over two visits.
  const double A = 55e-6 * std::sqrt(1.25), w = 2000.;
  double expected = 0.;
  const int n = 1000000;
  for (int k = 0; k < n; ++k) {
    const double t = 2. * pi / w * (k + 0.5) / n, d = A * std::fabs(std::sin(w * t)) - 40e-6;
    if (d > 0.) expected += 1.5 * 0.3 * 5e8 * d * std::pow(A * w * std::cos(w * t), 2) * 2. * pi / w / n;
  }
  EXPECT_NEAR(lossy.loss, expected, 1e-6 * expected) << "J";
  EXPECT_NEAR(lossy.work, expected, 1e-6 * expected) << "J";
}

TEST(SupportLaws, ForcesOfASlowPushAreTheSlopeOfTheirEnergy) {
  const auto springs = std::make_shared<SpringSupport>(std::array{1e7, 2e7}, std::array{10., 20.});
  const auto ribbon = std::make_shared<RibbonSupport>(ribbon_axis());
  const auto elastomer =
      std::make_shared<ElastomerSupport>(std::array{MaxwellModel{1e7, 5., {{1e6, 1e-3}}}, MaxwellModel{2e7, 0., {}}});
  const SplitSupport split(ribbon, elastomer);
  const StoppedSupport stopped(ribbon, 20e-6, {3e8, 1., 0.1});
  for (const SupportLaw* law :
       {static_cast<const SupportLaw*>(springs.get()), static_cast<const SupportLaw*>(ribbon.get()),
        static_cast<const SupportLaw*>(elastomer.get()), static_cast<const SupportLaw*>(&split),
        static_cast<const SupportLaw*>(&stopped)})
    for (const auto& [y, z] : {std::pair{5e-6, -3e-6}, std::pair{30e-6, 14e-6}, std::pair{-60e-6, 70e-6}}) {
      const double h = 1e-10;
      const auto r = law->rest(y, z);
      // Central differences: their error is h^2/6 over the square of the shortest length of the laws, 2 um: 4e-10. The rest is roundoff.
      EXPECT_NEAR(-(law->rest(y + h, z).energy - law->rest(y - h, z).energy) / (2. * h), r.force_y,
                  1e-8 * std::fabs(r.force_y));
      EXPECT_NEAR(-(law->rest(y, z + h).energy - law->rest(y, z - h).energy) / (2. * h), r.force_z,
                  1e-8 * std::fabs(r.force_z));
      EXPECT_NEAR(-(law->rest(y + h, z).force_y - law->rest(y - h, z).force_y) / (2. * h), r.k_yy, 1e-8 * r.k_yy);
      EXPECT_NEAR(-(law->rest(y, z + h).force_y - law->rest(y, z - h).force_y) / (2. * h), r.k_yz, 1e-8 * r.k_yy);
      EXPECT_NEAR(-(law->rest(y, z + h).force_z - law->rest(y, z - h).force_z) / (2. * h), r.k_zz, 1e-8 * r.k_zz);
      // The settled inner states have the same energy and force at rest; what friction took of the push is not stored.
      std::vector<double> inner(law->n_states()), rates(law->n_states());
      law->settle(y, z, inner);
      EXPECT_NEAR(law->evaluate({y, z, 0., 0.}, inner, rates).y, r.force_y, 1e-9 * std::fabs(r.force_y));
      EXPECT_LE(law->energy({y, z, 0., 0.}, inner), r.energy * (1. + 1e-12));
      const auto found = resting_place(*law, -r.force_y, -r.force_z);
      EXPECT_NEAR(found.y, y, 1e-9 * std::fabs(y) + 1e-15);
      EXPECT_NEAR(found.z, z, 1e-9 * std::fabs(z) + 1e-15);
    }
}

}  // namespace
}  // namespace rotordrop
