#include "bearing/row/ball_row.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "base/level_choice.h"
#include "bearing/row/ball_row_bending.h"
#include "bearing/row/ball_row_kernels.h"

namespace rotordrop {
namespace {

/// Added to the penetrations of a row: nothing, but idle_penetration behind its balls.
const double* only_idle(int n_balls) {
  static constexpr auto list = [] {
    std::array<double, BallRow::max_balls + vector_length> values{};
    std::fill_n(values.end() - vector_length, vector_length, idle_penetration);
    return values;
  }();
  return list.data() + (BallRow::max_balls - n_balls);
}

}  // namespace

template <>
double RaceContact::edge_distance(double sine, double cosine) const {
  if (!has_edge()) return std::numeric_limits<double>::infinity();
  return groove_radius * (edge_sine * cosine - edge_cosine * std::fabs(sine));
}

template <>
double RaceContact::truncation(double load, double sine, double cosine) const {
  if (!(load > 0.) || !has_edge()) return 0.;
  const double a = axis_factor * std::cbrt(load);
  return std::clamp((a - edge_distance(sine, cosine)) / (2. * a), 0., 1.);
}

const RowKernels& row_kernels() {
  static const RowKernels& chosen = ROTORDROP_OF_LEVEL(row_kernels)();
  return chosen;
}

GroovesOf<double> groove_centres(const BallRowGeometry& g) {
  const double A = (g.inner_conformity + g.outer_conformity - 1.) * g.ball_diameter;
  return {A, A * std::cos(g.contact_angle) - g.radial_clearance,
          g.direction * (A * std::sin(g.contact_angle) + g.preload_offset),
          0.5 * g.pitch_diameter + (g.inner_conformity - 0.5) * g.ball_diameter * std::cos(g.contact_angle)};
}

RowStrains row_strains(const BallRowGeometry& g) {
  const double c = std::cos(g.contact_angle), s = g.direction * std::sin(g.contact_angle), x = g.position;
  const double groove_i = g.inner_conformity * g.ball_diameter, groove_o = g.outer_conformity * g.ball_diameter;
  const double half = 0.5 * g.ball_diameter;
  return {{x - half * s + groove_i * s, groove_i * c, groove_i},
          {-(x + half * s) + groove_o * s, groove_o * c, groove_o}};
}

BallRow::BallRow(const BallRowGeometry& geometry, const std::vector<RaceWave>& waves) : geometry_(geometry) {
  const auto& g = geometry_;
  if (g.n_balls > max_balls) throw std::invalid_argument("a row holds at most 256 balls");
  numbers_.grooves = groove_centres(g);
  numbers_.strains = row_strains(g);
  numbers_.position = numbers_.strains.inner.axial;
  numbers_.difference_share = g.difference_share;
  numbers_.stiffness = g.stiffness;
  numbers_.damping = 1.5 * g.damping_beta;
  numbers_.stiffness_root = std::cbrt(g.stiffness);
  numbers_.ball_mass = g.ball_mass;
  numbers_.pitch_diameter = g.pitch_diameter;
  numbers_.inner_gyroscopic_share = g.inner_gyroscopic_share;
  numbers_.inner = g.inner;
  numbers_.outer = g.outer;
  numbers_.edges = {{g.inner, numbers_.stiffness_root}, {g.outer, numbers_.stiffness_root}};
  numbers_.inertial = inertial_row(g.inner.stiffness, g.outer.stiffness, (g.inner_conformity - 0.5) * g.ball_diameter,
                                   (g.outer_conformity - 0.5) * g.ball_diameter, g.ball_diameter / g.pitch_diameter,
                                   g.inner_gyroscopic_share, numbers_.grooves.axial, numbers_.grooves.radial);
  numbers_.load_edges = {{g.inner, 1.}, {g.outer, 1.}};
  if (g.has_inertia) starts_ = shared_starts(numbers_.inertial, centrifugal_force(g.ball_mass, g.pitch_diameter, 1.));
  const auto azimuth = [&](int j) { return g.phase + 2. * std::numbers::pi * j / g.n_balls; };
  std::vector<double> azimuths;
  for (int j = 0; j < g.n_balls; ++j) {
    azimuths.push_back(azimuth(j));
    cosine_.push_back(std::cos(azimuth(j)));
    sine_.push_back(std::sin(azimuth(j)));
  }
  n_padded_ = filled_up(cosine_.size());
  cosine_.resize(n_padded_, 1.);
  sine_.resize(n_padded_, 0.);
  waves_ = {waves, azimuths};
  if (g.highest_harmonic > 0) tabulate_shapes(azimuths);
}

KernelInput BallRow::smooth_input(const BallRowInput& in) const {
  // Growth of the ball's radius, eq. (25) of Neisi 2019, counts on both sides of it.
  return {row_place(numbers_, in, 2. * in.ball_growth),
          numbers_.stiffness_root,
          cosine_.data(),
          sine_.data(),
          only_idle(geometry_.n_balls),
          n_padded_,
          nullptr,
          nullptr};
}

KernelInput BallRow::kernel_input(const BallRowInput& in, WavesAtBalls& waves, Widening& bent) const {
  KernelInput balls = smooth_input(in);
  if (!waves_.empty()) {
    waves_.at_balls(in, waves);
    balls.waves = &waves;
  }
  if (!in.shape.empty()) {
    widen(in, bent);
    balls.bent = &bent;
  }
  return balls;
}

template <class Kernel>
void BallRow::press(Kernel kernel, const KernelInput& balls, const BallRowInput& in, BallRowOutput& out,
                    RowTractions* tractions) const {
  if (tractions) {
    const double F_c = numbers_.centrifugal_force(in);
    const TractionInput with{F_c, geometry_.inner_gyroscopic_share, numbers_.edges};
    kernel(balls, out, &with, tractions);
    tractions->outer_load -= static_cast<double>(n_padded_ - static_cast<std::size_t>(geometry_.n_balls)) * F_c;
  } else {
    kernel(balls, out, nullptr, nullptr);
  }
}

/// Apart from run(), lest a smooth row between rigid rings pays for the space.
template <class Kernel>
[[gnu::noinline]] void BallRow::run_with_space(Kernel kernel, const BallRowInput& in, BallRowOutput& out,
                                               RowTractions* tractions) const {
  Widening bent;
  WavesAtBalls waves;
  const KernelInput balls = kernel_input(in, waves, bent);
  press(kernel, balls, in, out, tractions);
  if (balls.bent) press_shapes(in, bent);
}

template <class Kernel>
void BallRow::run(Kernel kernel, const BallRowInput& in, BallRowOutput& out, RowTractions* tractions) const {
  if (waves_.empty() && in.shape.empty())
    press(kernel, smooth_input(in), in, out, tractions);
  else
    run_with_space(kernel, in, out, tractions);
}

void BallRow::evaluate_translations(const BallRowInput& in, BallRowOutput& out, RowTractions* tractions) const {
  if (const double F_0 = inertia_force(in); F_0 > 0.) return evaluate_inertial(in, F_0, false, out, tractions);
  run(is_radial() ? row_kernels().sum_in_plane : row_kernels().sum_translations, in, out, tractions);
}

void BallRow::evaluate(const BallRowInput& in, BallRowOutput& out, RowTractions* tractions) const {
  if (const double F_0 = inertia_force(in); F_0 > 0.) return evaluate_inertial(in, F_0, true, out, tractions);
  run(row_kernels().sum_all_motions, in, out, tractions);
}

void BallRow::ball_loads(const BallRowInput& in, std::span<double> load, std::span<double> outer_load) const {
  if (const double F_0 = inertia_force(in); F_0 > 0.) return inertial_loads(in, F_0, load, outer_load);
  Widening bent;
  WavesAtBalls waves;
  const KernelInput balls = kernel_input(in, waves, bent);
  for (std::size_t k = 0; k < n_balls(); ++k) {
    BallWidening<double> bent_here{};
    if (balls.bent) bent_here = {bent.width[k], bent.rate[k], 0.};
    const double added = balls.waves ? waves.inner[k] + waves.outer[k] : 0.;
    BallTerms<double> b =
        ball_penetration<GrooveMotion::all, true>(balls.place, cosine_[k], sine_[k], added, bent_here);
    press_ball(balls.place, b);
    load[k] = b.F;
  }
  std::copy_n(load.begin(), outer_load.size(), outer_load.begin());
}

double BallRow::energy(const BallRowInput& in) const {
  if (const double F_0 = inertia_force(in); F_0 > 0.) return inertial_energy(in, F_0);
  Widening bent;
  WavesAtBalls waves;
  return 0.4 * geometry_.stiffness * row_kernels().sum_deflections(kernel_input(in, waves, bent));
}

double BallRow::offset_for_axial_load(const BallRowGeometry& g, double axial_load) {
  // Z K delta^1.5 sin phi = load in the offset x: delta = sqrt(B_r^2 + (A sin phi_0 + x)^2) - A. Monotonic: bracket, then bisect
  // until the interval no longer shrinks.
  const GroovesOf<double> grooves = groove_centres(g);
  const double A = grooves.A, Br = grooves.radial;
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
