// Rows whose balls have inertia: the forces of BallRow from each ball's own balance.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/wide_vectors.h"
#include "bearing/row/ball_row.h"
#include "bearing/row/ball_row_bending.h"
#include "bearing/row/inertial_kernels.h"

namespace rotordrop {
namespace {

/// Ones for the balls, zeros for what fills up the row.
const double* ones_for_balls(int n_balls) {
  static constexpr auto list = [] {
    std::array<double, BallRow::max_balls + vector_length> values{};
    std::fill_n(values.begin(), BallRow::max_balls, 1.);
    return values;
  }();
  return list.data() + (BallRow::max_balls - n_balls);
}

}  // namespace

double BallRow::inertia_force(const BallRowInput& in) const {
  if (!geometry_.has_inertia) return 0.;
  const double F_0 = numbers_.inertia_force(in.ring_speed);
  return F_0 > numbers_.negligible_inertia_force ? F_0 : 0.;
}

InertialInput BallRow::inertial_input(const BallRowInput& in, double F_0, bool tilts, WavesAtBalls& waves,
                                      Widening& bent) const {
  const bool is_bent = !in.shape.empty();
  if (is_bent) widen(in, bent);
  if (!waves_.empty()) waves_.at_balls(in, waves);
  const auto& e = in.displacement;
  const bool has_one_axial = !tilts || (e.x == 0. && e.psi_y == 0. && e.psi_z == 0.);
  const auto added = numbers_.added(in);
  return {row_place(numbers_, in, 0.),
          &numbers_.inertial,
          F_0,
          added.inner,
          added.outer,
          in.cage_speed,
          has_one_axial ? starts_->at(F_0) : InertialStarts::nowhere(),
          cosine_.data(),
          sine_.data(),
          ones_for_balls(geometry_.n_balls),
          n_padded_,
          waves_.empty() ? nullptr : &waves,
          is_bent ? &bent : nullptr,
          geometry_.conducts};
}

void BallRow::evaluate_inertial(const BallRowInput& in, double F_0, bool tilts, BallRowOutput& out,
                                RowTractions* tractions) const {
  Widening bent;
  WavesAtBalls waves;
  const InertialInput balls = inertial_input(in, F_0, tilts, waves, bent);
  const auto& kernels = inertial_kernels();
  const TractionInput with{numbers_.centrifugal_force(in), geometry_.inner_gyroscopic_share, numbers_.load_edges};
  const auto sum = tilts ? kernels.sum_all_motions : is_radial() ? kernels.sum_in_plane : kernels.sum_translations;
  sum(balls, out, tractions ? &with : nullptr, tractions);
  if (balls.bent) press_shapes(in, bent);
  out.inertia_per_speed *= 2. / in.ring_speed;  // F_0 goes with the square of the speed
}

void BallRow::inertial_loads(const BallRowInput& in, double F_0, std::span<double> inner,
                             std::span<double> outer) const {
  Widening bent;
  WavesAtBalls waves;
  alignas(64) std::array<double, max_balls> Q_i, Q_o;
  inertial_kernels().loads(inertial_input(in, F_0, true, waves, bent), Q_i.data(), Q_o.data());
  std::copy_n(Q_i.begin(), inner.size(), inner.begin());
  std::copy_n(Q_o.begin(), outer.size(), outer.begin());
}

double BallRow::inertial_energy(const BallRowInput& in, double F_0) const {
  Widening bent;
  WavesAtBalls waves;
  return inertial_kernels().energy(inertial_input(in, F_0, true, waves, bent));
}

}  // namespace rotordrop
