#include "bearing/row/ball_row.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "base/wide_vectors.h"
#include "bearing/row/ball_row_bending.h"
#include "laws/skidding.h"

// The row kernel is compiled for several kinds of machine and chosen when the program starts. AVX-512 serves for its 32 registers: the
// loop keeps eight sums.
// Sanitizers cannot see through the chooser.
namespace rotordrop {
namespace {

// Rows are filled up to whole vectors with balls too small to touch anything, so that the kernels have no remainder loop.
constexpr std::size_t vector_length = 8;
constexpr double idle = -1.;  // added to an idle ball's penetration [m]

struct KernelInput {
  const double* cosine;
  const double* sine;
  const double* added;                                 // to every delta: ball growth and waviness [n]
  std::size_t n;                                       // a multiple of vector_length
  double A, radial, axial, arm, position, K, damping;  // damping = 1.5 beta
  double cage_cosine, cage_sine;
  RingDisplacement e, v;
  Widening* bent;  // of bent rings; of rigid ones none
};

// The two kernels differ in the tilt and axial terms only; kept apart because the short one is the hot loop of every drop.
template <bool is_bent>
[[gnu::always_inline]] inline void translations(const KernelInput& in, BallRowOutput& out) {
  double fy = 0, fz = 0, fx = 0, dissipated = 0, elastic_radial = 0, elastic_axial = 0, elastic_normal = 0, cage = 0;
  double largest = 0, roots = 0;
  const double C = in.cage_cosine, S = in.cage_sine, ey = in.e.y, ez = in.e.z, vy = in.v.y, vz = in.v.z;
  const double radial = in.radial, Bx = in.axial, Bx2 = Bx * Bx, A = in.A, K = in.K, damping = in.damping;
#pragma omp simd reduction(+ : fy, fz, fx, dissipated, elastic_radial, elastic_axial, elastic_normal, cage, roots) reduction(max : largest)
  for (std::size_t j = 0; j < in.n; ++j) {
    const double c = C * in.cosine[j] - S * in.sine[j];
    const double s = S * in.cosine[j] + C * in.sine[j];
    double Br = radial + ey * c + ez * s, Br_rate = vy * c + vz * s;
    if constexpr (is_bent) {
      Br += in.bent->width[j];
      Br_rate += in.bent->rate[j];
    }
    const double distance = std::sqrt(Br * Br + Bx2);
    const double inverse = 1. / distance;
    const double cos_phi = Br * inverse;
    const double delta = std::max(distance - A + in.added[j], 0.);
    const double rate = cos_phi * Br_rate;
    const double root = std::sqrt(delta);
    const double stiffness = K * root;
    const double elastic = stiffness * delta;
    const double F = std::max(stiffness * (delta + damping * rate), 0.);
    const double F_radial = F * cos_phi;
    if constexpr (is_bent) in.bent->force[j] = F_radial;
    fy -= F_radial * c;
    fz -= F_radial * s;
    fx -= F * inverse;
    dissipated += (F - elastic) * rate;
    elastic_radial += elastic * cos_phi;
    elastic_axial += elastic * inverse;
    elastic_normal += elastic;
    double Br_turn = ez * c - ey * s;
    if constexpr (is_bent) Br_turn += in.bent->slope[j];
    cage += elastic * cos_phi * Br_turn;
    largest = std::max(largest, F);
    roots += root;
  }
  out.force_x = fx * Bx;
  out.force_y = fy;
  out.force_z = fz;
  out.moment_y = out.moment_z = 0;
  out.damping_power = dissipated;
  out.elastic_radial = elastic_radial;
  out.elastic_axial = elastic_axial * Bx;
  out.elastic_normal = elastic_normal;
  out.elastic_outer_surplus = 0;
  out.cage_power = cage;
  out.largest_load = out.largest_outer_load = largest;
  out.inner_load_roots = roots;
  out.inner_loads = out.outer_loads = elastic_normal;
  out.inertia_power = out.inertia_per_speed = 0;
}

ROTORDROP_KERNEL void sum_translations(const KernelInput& in, BallRowOutput& out) { translations<false>(in, out); }
ROTORDROP_KERNEL void sum_bent_translations(const KernelInput& in, BallRowOutput& out) { translations<true>(in, out); }

template <bool is_bent>
[[gnu::always_inline]] inline void all_motions(const KernelInput& in, BallRowOutput& out) {
  double fy = 0, fz = 0, fx = 0, my = 0, mz = 0, dissipated = 0, elastic_radial = 0, elastic_normal = 0, cage = 0;
  double elastic_axial = 0, largest = 0, roots = 0;
  const double C = in.cage_cosine, S = in.cage_sine, arm = in.arm, xr = in.position;
  const RingDisplacement e = in.e, v = in.v;
#pragma omp simd reduction(+ : fy, fz, fx, my, mz, dissipated, elastic_radial, elastic_axial, elastic_normal, cage, roots) reduction(max : largest)
  for (std::size_t j = 0; j < in.n; ++j) {
    const double c = C * in.cosine[j] - S * in.sine[j];
    const double s = S * in.cosine[j] + C * in.sine[j];
    double Br = in.radial + (e.y + xr * e.psi_z) * c + (e.z - xr * e.psi_y) * s;
    double Br_rate = (v.y + xr * v.psi_z) * c + (v.z - xr * v.psi_y) * s;
    double Br_turn = (e.z - xr * e.psi_y) * c - (e.y + xr * e.psi_z) * s;
    if constexpr (is_bent) {
      Br += in.bent->width[j];
      Br_rate += in.bent->rate[j];
      Br_turn += in.bent->slope[j];
    }
    const double Bx = in.axial + e.x + arm * (e.psi_y * s - e.psi_z * c);
    const double distance = std::sqrt(Br * Br + Bx * Bx);
    const double inverse = 1. / distance;
    const double cos_phi = Br * inverse, sin_phi = Bx * inverse;
    const double delta = std::max(distance - in.A + in.added[j], 0.);
    const double rate = cos_phi * Br_rate + sin_phi * (v.x + arm * (v.psi_y * s - v.psi_z * c));
    const double root = std::sqrt(delta);
    const double stiffness = in.K * root;
    const double elastic = stiffness * delta;
    const double F = std::max(stiffness * (delta + in.damping * rate), 0.);
    const double F_radial = F * cos_phi, F_axial = F * sin_phi;
    if constexpr (is_bent) in.bent->force[j] = F_radial;
    fy -= F_radial * c;
    fz -= F_radial * s;
    fx -= F_axial;
    my += F_radial * xr * s - F_axial * arm * s;
    mz += F_axial * arm * c - F_radial * xr * c;
    dissipated += (F - elastic) * rate;
    elastic_radial += elastic * cos_phi;
    elastic_axial += elastic * sin_phi;
    elastic_normal += elastic;
    cage += elastic * (cos_phi * Br_turn + sin_phi * arm * (e.psi_y * c + e.psi_z * s));
    largest = std::max(largest, F);
    roots += root;
  }
  out.force_x = fx;
  out.force_y = fy;
  out.force_z = fz;
  out.moment_y = my;
  out.moment_z = mz;
  out.damping_power = dissipated;
  out.elastic_radial = elastic_radial;
  out.elastic_axial = elastic_axial;
  out.elastic_normal = elastic_normal;
  out.elastic_outer_surplus = 0;
  out.cage_power = cage;
  out.largest_load = out.largest_outer_load = largest;
  out.inner_load_roots = roots;
  out.inner_loads = out.outer_loads = elastic_normal;
  out.inertia_power = out.inertia_per_speed = 0;
}

ROTORDROP_KERNEL void sum_all(const KernelInput& in, BallRowOutput& out) { all_motions<false>(in, out); }
ROTORDROP_KERNEL void sum_all_bent(const KernelInput& in, BallRowOutput& out) { all_motions<true>(in, out); }

// Raceways' edges as sum_tractions() needs them. Beyond an edge lies 1/2 - r (sine cos phi - cosine |sin phi|) / (2 a) of the length 2 a, a = factor K^(1/3) root.
struct Edge {
  double sine, cosine;  // times r / (2 factor K^(1/3))
  Edge(const RaceContact& race, double stiffness_root) : sine(1e30), cosine(-1e30) {
    if (!race.has_edge()) return;
    const double per_axis = 0.5 * race.groove_radius / (race.axis_factor * stiffness_root);
    sine = per_axis * race.edge_sine;
    cosine = per_axis * race.edge_cosine;
  }
};
struct Edges {
  Edge inner, outer;
};

// Not for every evaluation: what skidding needs. An idle ball adds F_c to the outer loads.
template <bool is_bent>
[[gnu::always_inline]] inline void tractions_of(const KernelInput& in, double F_c, double inner_share,
                                                const Edges& edges, RowTractions& out) {
  double inner = 0, outer = 0, gyroscopic = 0, largest = 0, truncation = 0;
  constexpr double nothing = 1e-100;  // [N]
  const Edge inner_edge = edges.inner, outer_edge = edges.outer;
  const double C = in.cage_cosine, S = in.cage_sine, arm = in.arm, xr = in.position;
  const RingDisplacement e = in.e, v = in.v;
#pragma omp simd reduction(+ : inner, outer, gyroscopic) reduction(max : largest, truncation)
  for (std::size_t j = 0; j < in.n; ++j) {
    const double c = C * in.cosine[j] - S * in.sine[j];
    const double s = S * in.cosine[j] + C * in.sine[j];
    double Br = in.radial + (e.y + xr * e.psi_z) * c + (e.z - xr * e.psi_y) * s;
    double Br_rate = (v.y + xr * v.psi_z) * c + (v.z - xr * v.psi_y) * s;
    if constexpr (is_bent) {
      Br += in.bent->width[j];
      Br_rate += in.bent->rate[j];
    }
    const double Bx = in.axial + e.x + arm * (e.psi_y * s - e.psi_z * c);
    const double distance = std::sqrt(Br * Br + Bx * Bx);
    const double inverse = 1. / distance;
    const double cos_phi = Br * inverse, sin_phi = Bx * inverse;
    const double delta = std::max(distance - in.A + in.added[j], 0.);
    const double rate = cos_phi * Br_rate + sin_phi * (v.x + arm * (v.psi_y * s - v.psi_z * c));
    const double F = std::max(in.K * std::sqrt(delta) * (delta + in.damping * rate), 0.);
    const OuterContact o = outer_contact(F, sin_phi, cos_phi, F_c);
    const double T_g = gyroscopic_traction(F_c, o.sine);
    inner += F;
    outer += o.load;
    gyroscopic += T_g;
    const double inner_demand = inner_share * T_g / (F + nothing), outer_demand = (1. - inner_share) * T_g * o.per_load;
    largest = std::max(largest, std::max(inner_demand, outer_demand));
    // Without damping, Q^(1/3) = K^(1/3) delta^(1/2).
    const double sine = std::fabs(sin_phi), per_root = 1. / (std::sqrt(delta) + 1e-30);
    const double inner_margin = (inner_edge.sine * cos_phi - inner_edge.cosine * sine) * per_root;
    const double outer_margin = (outer_edge.sine * cos_phi - outer_edge.cosine * sine) * per_root;
    const double margin = inner_margin < outer_margin ? inner_margin : outer_margin;
    const double beyond = delta > 0. ? 0.5 - margin : 0.;
    truncation = truncation > beyond ? truncation : beyond;
  }
  out = {inner, outer, (1. - inner_share) * gyroscopic, largest, inner_share * gyroscopic};
  out.truncation = std::min(truncation, 1.);
}
ROTORDROP_KERNEL void sum_tractions(const KernelInput& in, double F_c, double inner_share, const Edges& edges,
                                    RowTractions& out) {
  tractions_of<false>(in, F_c, inner_share, edges, out);
}
ROTORDROP_KERNEL void sum_bent_tractions(const KernelInput& in, double F_c, double inner_share, const Edges& edges,
                                         RowTractions& out) {
  tractions_of<true>(in, F_c, inner_share, edges, out);
}

}  // namespace

double RaceContact::largest_pressure(double load) const {
  if (load <= 0.) return 0.;
  const double major = axis_factor * std::cbrt(load);
  return 1.5 * load * ellipticity / (std::numbers::pi * major * major);
}

double RaceContact::edge_distance(double sine, double cosine) const {
  if (!has_edge()) return std::numeric_limits<double>::infinity();
  return groove_radius * (edge_sine * cosine - edge_cosine * std::fabs(sine));
}

double RaceContact::truncation(double load, double sine, double cosine) const {
  if (!(load > 0.) || !has_edge()) return 0.;
  const double a = axis_factor * std::cbrt(load);
  return std::clamp((a - edge_distance(sine, cosine)) / (2. * a), 0., 1.);
}

RowStrains row_strains(const BallRowGeometry& g) {
  const double c = std::cos(g.contact_angle), s = g.direction * std::sin(g.contact_angle), x = g.position;
  const double groove_i = g.inner_conformity * g.ball_diameter, groove_o = g.outer_conformity * g.ball_diameter;
  const double half = 0.5 * g.ball_diameter;
  return {{x - half * s + groove_i * s, groove_i * c, groove_i},
          {-(x + half * s) + groove_o * s, groove_o * c, groove_o}};
}

BallRow::BallRow(const BallRowGeometry& geometry, const std::vector<RaceWave>& waves)
    : geometry_(geometry), strains_(row_strains(geometry)) {
  const auto& g = geometry_;
  if (g.n_balls > max_balls) throw std::invalid_argument("a row holds at most 256 balls");
  const double A = (g.inner_conformity + g.outer_conformity - 1.) * g.ball_diameter;
  constants_.A = A;
  constants_.radial = A * std::cos(g.contact_angle) - g.radial_clearance;
  constants_.axial = g.direction * (A * std::sin(g.contact_angle) + g.preload_offset);
  constants_.arm = 0.5 * g.pitch_diameter + (g.inner_conformity - 0.5) * g.ball_diameter * std::cos(g.contact_angle);
  stiffness_root_ = std::cbrt(g.stiffness);
  inertial_ = {std::pow(g.inner.stiffness, -2. / 3.),        std::pow(g.outer.stiffness, -2. / 3.),
               (g.inner_conformity - 0.5) * g.ball_diameter, (g.outer_conformity - 0.5) * g.ball_diameter,
               g.ball_diameter / g.pitch_diameter,           g.inner_gyroscopic_share};
  if (g.has_inertia)
    starts_ = std::make_shared<InertialStarts>(inertial_, constants_.axial, constants_.radial,
                                               0.5 * g.ball_mass * g.pitch_diameter);
  const auto azimuth = [&](int j) { return g.phase + 2. * std::numbers::pi * j / g.n_balls; };
  for (int j = 0; j < g.n_balls; ++j) {
    cosine_.push_back(std::cos(azimuth(j)));
    sine_.push_back(std::sin(azimuth(j)));
  }
  n_padded_ = (cosine_.size() + vector_length - 1) / vector_length * vector_length;
  cosine_.resize(n_padded_, 1.);
  sine_.resize(n_padded_, 0.);
  for (const auto& wave : waves) {
    Wave w{wave, {}, {}};
    for (int j = 0; j < g.n_balls; ++j) {
      w.cosine.push_back(std::cos(wave.order * azimuth(j)));
      w.sine.push_back(std::sin(wave.order * azimuth(j)));
    }
    w.cosine.resize(n_padded_, 0.);
    w.sine.resize(n_padded_, 0.);
    waves_.push_back(std::move(w));
  }
  for (int n = 2; n <= g.highest_harmonic; ++n)
    for (const bool is_cosine : {true, false}) {
      for (int j = 0; j < g.n_balls; ++j)
        shapes_.push_back(is_cosine ? std::cos(n * azimuth(j)) : std::sin(n * azimuth(j)));
      shapes_.resize(shapes_.size() + n_padded_ - static_cast<std::size_t>(g.n_balls), 0.);
    }
}

// What is added to every penetration besides the races' approach: 2 eps_b and the waves. One sine and cosine per wave.
void BallRow::fill_added(const BallRowInput& in, double* added) const {
  const auto n = static_cast<std::size_t>(geometry_.n_balls);
  std::fill_n(added, n, 2. * in.ball_growth);
  std::fill_n(added + n, n_padded_ - n, idle);
  for (const auto& w : waves_) {
    const double ring = w.wave.on_inner_race ? in.ring_angle : 0.;
    const double argument = w.wave.order * (in.cage_angle - ring) + w.wave.phase;
    const double c = w.wave.amplitude * std::cos(argument), s = w.wave.amplitude * std::sin(argument);
    for (std::size_t j = 0; j < n; ++j) added[j] += w.sine[j] * c + w.cosine[j] * s;
  }
}

BallRow::Constants BallRow::grown(const BallRowInput& in) const {
  const auto& [inner, outer] = strains_;
  Constants c = constants_;
  c.A += in.inner_strain * inner.groove + in.outer_strain * outer.groove;
  c.radial += in.radial_growth + geometry_.difference_share * in.row_difference +
              (in.inner_strain * inner.radial + in.outer_strain * outer.radial);
  c.axial += in.inner_strain * inner.axial + in.outer_strain * outer.axial;
  return c;
}

std::pair<double, double> BallRow::strain_gradient(const BallRowOutput& out) const {
  const auto gradient = [&](const GrooveStrain& s, double normal) {
    return s.axial * out.elastic_axial + s.radial * out.elastic_radial - s.groove * normal;
  };
  return {gradient(strains_.inner, out.elastic_normal - out.elastic_outer_surplus),
          gradient(strains_.outer, out.elastic_normal + out.elastic_outer_surplus)};
}

double BallRow::penetration(const BallRowInput& in, const Constants& grown, int ball, double added,
                            double widening) const {
  const auto j = static_cast<std::size_t>(ball);
  const double c = in.cage_cosine * cosine_[j] - in.cage_sine * sine_[j];
  const double s = in.cage_sine * cosine_[j] + in.cage_cosine * sine_[j];
  const auto& e = in.displacement;
  const double xr = geometry_.position;
  const double Br = grown.radial + (e.y + xr * e.psi_z) * c + (e.z - xr * e.psi_y) * s + widening;
  const double Bx = grown.axial + e.x + grown.arm * (e.psi_y * s - e.psi_z * c);
  return std::sqrt(Br * Br + Bx * Bx) - grown.A + added;
}

double BallRow::waviness_power(const BallRowInput& in, const double* added, const double* widening) const {
  const Constants at = grown(in);
  double power = 0.;
  for (const auto& w : waves_) {
    const double on_ring = w.wave.on_inner_race ? 1. : 0.;
    const double argument = w.wave.order * (in.cage_angle - on_ring * in.ring_angle) + w.wave.phase;
    const double travel = w.wave.amplitude * w.wave.order * (in.cage_speed - on_ring * in.ring_speed);
    const double c = std::cos(argument), s = std::sin(argument);
    for (int j = 0; j < geometry_.n_balls; ++j) {
      const auto k = static_cast<std::size_t>(j);
      const double delta = std::max(penetration(in, at, j, added[j], widening ? widening[j] : 0.), 0.);
      power += geometry_.stiffness * delta * std::sqrt(delta) * travel * (w.cosine[k] * c - w.sine[k] * s);
    }
  }
  return power;
}

template <class Kernel>
void BallRow::run(Kernel kernel, const BallRowInput& in, BallRowOutput& out, RowTractions* tractions) const {
  const bool is_bent = !in.shape.empty();
  Widening bent;
  if (is_bent) widen(in, bent);
  std::array<double, max_balls> added;
  fill_added(in, added.data());
  const Constants at = grown(in);
  const KernelInput balls{cosine_.data(),
                          sine_.data(),
                          added.data(),
                          n_padded_,
                          at.A,
                          at.radial,
                          at.axial,
                          at.arm,
                          geometry_.position,
                          geometry_.stiffness,
                          1.5 * geometry_.damping_beta,
                          in.cage_cosine,
                          in.cage_sine,
                          in.displacement,
                          in.rate,
                          is_bent ? &bent : nullptr};
  kernel(balls, out);
  if (is_bent) press_shapes(in, bent);
  out.inner_load_roots = out.outer_load_roots = stiffness_root_ * out.inner_load_roots;
  out.cage_power *= in.cage_speed;
  out.waviness_power = waves_.empty() ? 0. : waviness_power(in, added.data(), is_bent ? bent.width.data() : nullptr);
  if (!tractions) return;
  const double F_c = centrifugal_force(in);
  const Edges edges{{geometry_.inner, stiffness_root_}, {geometry_.outer, stiffness_root_}};
  (is_bent ? sum_bent_tractions : sum_tractions)(balls, F_c, geometry_.inner_gyroscopic_share, edges, *tractions);
  tractions->centrifugal = F_c;
  tractions->outer_load -= static_cast<double>(n_padded_ - static_cast<std::size_t>(geometry_.n_balls)) * F_c;
}

double BallRow::centrifugal_force(const BallRowInput& in) const {
  return 0.5 * geometry_.ball_mass * geometry_.pitch_diameter * in.cage_speed * in.cage_speed;
}

void BallRow::evaluate_translations(const BallRowInput& in, BallRowOutput& out, RowTractions* tractions) const {
  if (const double F_0 = inertia_force(in); F_0 > 0.) return evaluate_inertial(in, F_0, out, tractions);
  run([](const KernelInput& k,
         BallRowOutput& o) { k.bent ? wide<sum_bent_translations>(k, o) : wide<sum_translations>(k, o); },
      in, out, tractions);
}

void BallRow::evaluate(const BallRowInput& in, BallRowOutput& out, RowTractions* tractions) const {
  if (const double F_0 = inertia_force(in); F_0 > 0.) return evaluate_inertial(in, F_0, out, tractions);
  run([](const KernelInput& k, BallRowOutput& o) { k.bent ? wide<sum_all_bent>(k, o) : wide<sum_all>(k, o); }, in, out,
      tractions);
}

void BallRow::ball_loads(const BallRowInput& in, std::span<double> load) const {
  if (const double F_0 = inertia_force(in); F_0 > 0.) {
    InertialBalls w;
    Widening bent;
    balance(in, F_0, w, bent);
    for (std::size_t j = 0; j < load.size(); ++j) load[j] = w.u_i[j] * w.u_i[j] * w.u_i[j];
    return;
  }
  std::array<double, max_balls> added;
  fill_added(in, added.data());
  Widening bent;
  const double *width = nullptr, *width_rate = nullptr;  // of bent rings
  if (!in.shape.empty()) {
    widen(in, bent);
    width = bent.width.data();
    width_rate = bent.rate.data();
  }
  const auto& v = in.rate;
  const auto& e = in.displacement;
  const double xr = geometry_.position, arm = constants_.arm;
  const Constants at = grown(in);
  for (int j = 0; j < geometry_.n_balls; ++j) {
    const auto k = static_cast<std::size_t>(j);
    const double c = in.cage_cosine * cosine_[k] - in.cage_sine * sine_[k];
    const double s = in.cage_sine * cosine_[k] + in.cage_cosine * sine_[k];
    const double Br = at.radial + (e.y + xr * e.psi_z) * c + (e.z - xr * e.psi_y) * s + (width ? width[k] : 0.);
    const double Br_rate = (v.y + xr * v.psi_z) * c + (v.z - xr * v.psi_y) * s + (width_rate ? width_rate[k] : 0.);
    const double Bx = at.axial + e.x + arm * (e.psi_y * s - e.psi_z * c);
    const double distance = std::sqrt(Br * Br + Bx * Bx);
    const double delta = std::max(distance - at.A + added[k], 0.);
    const double rate = (Br * Br_rate + Bx * (v.x + arm * (v.psi_y * s - v.psi_z * c))) / distance;
    load[k] = std::max(geometry_.stiffness * std::sqrt(delta) * (delta + 1.5 * geometry_.damping_beta * rate), 0.);
  }
}

double BallRow::energy(const BallRowInput& in) const {
  if (const double F_0 = inertia_force(in); F_0 > 0.) {
    InertialBalls w;
    Widening bent;
    balance(in, F_0, w, bent);
    double both = 0.;
    for (std::size_t j = 0; j < static_cast<std::size_t>(geometry_.n_balls); ++j)
      both += inertial_.c_i * std::pow(w.u_i[j], 5) + inertial_.c_o * std::pow(w.Q_o[j], 5. / 3.);
    return 0.4 * both;
  }
  std::array<double, max_balls> added;
  fill_added(in, added.data());
  const Constants at = grown(in);
  Widening bent;
  const double* width = nullptr;  // of bent rings
  if (!in.shape.empty()) {
    widen(in, bent);
    width = bent.width.data();
  }
  double sum = 0.;
  for (int j = 0; j < geometry_.n_balls; ++j) {
    const auto k = static_cast<std::size_t>(j);
    const double delta = std::max(penetration(in, at, j, added[k], width ? width[k] : 0.), 0.);
    sum += delta * delta * std::sqrt(delta);
  }
  return 0.4 * geometry_.stiffness * sum;
}

double BallRow::offset_for_axial_load(const BallRowGeometry& g, double axial_load) {
  // Z K delta^1.5 sin phi = load in the offset x: delta = sqrt(B_r^2 + (A sin phi_0 + x)^2) - A. Monotonic: bracket, then bisect
  // until the interval no longer shrinks.
  const double A = (g.inner_conformity + g.outer_conformity - 1.) * g.ball_diameter;
  const double Br = A * std::cos(g.contact_angle) - g.radial_clearance;
  const auto load_at = [&](double x) {
    const double Bx = A * std::sin(g.contact_angle) + x;
    const double distance = std::hypot(Br, Bx);
    const double delta = std::max(distance - A, 0.);
    return g.n_balls * g.stiffness * delta * std::sqrt(delta) * Bx / distance;
  };
  double low = 0., high = A;
  while (load_at(high) < axial_load) high *= 2.;
  for (int i = 0; i < 200 && low < high; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (load_at(middle) < axial_load ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace rotordrop
