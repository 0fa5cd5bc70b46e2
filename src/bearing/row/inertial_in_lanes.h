#pragma once
#include <algorithm>
#include <type_traits>
#include <vector>

#include "bearing/row/inertial_sums.h"

namespace rotordrop {

/// Balls with inertia of a row of several drops side by side: rings that translate. As BallRow otherwise.
template <class Real>
class InertialRowInLanes {
 public:
  /// @param rows  alike but for their numbers
  explicit InertialRowInLanes(std::span<const BallRow* const> rows)
      : is_radial_(rows.front()->is_radial()),
        is_split_(rows.front()->geometry().inner_gyroscopic_share != 0.),
        sums_roots_(rows.front()->geometry().conducts),
        cosine_(rows.front()->cosines()),
        sine_(rows.front()->sines()) {
    for (int lane = 0; lane < n_lanes; ++lane)
      starts_.push_back(rows[std::min(static_cast<std::size_t>(lane), rows.size() - 1)]->starts());
  }
  [[nodiscard]] bool has_inertia() const { return starts_.front() != nullptr; }

  /// Where rings turn and forces of inertia: what is not turning is a row of balls without inertia, whatever stands here for it.
  struct Turning {
    Real F_0;
    MaskOf<Real> is;
    Turning(const RowNumbers<Real>& numbers, const BallRowInputOf<Real>& in)
        : F_0(numbers.inertia_force(in.ring_speed)), is(F_0 > RowNumbers<Real>::negligible_inertia_force) {}
  };

  /// @param waves_at  by ball, what waves add; @param is_wavy  whether there are any
  template <class WavesAt>
  void evaluate(const RowNumbers<Real>& numbers, const BallRowInputOf<Real>& in, const Turning& turning,
                const WavesAt& waves_at, bool is_wavy, BallRowOutputOf<Real>& out,
                RowTractionsOf<Real>* tractions) const {
    const RowPlaceOf<Real> place = row_place(numbers, in, Real(0.));
    const TractionInputOf<Real> with{numbers.centrifugal_force(in), numbers.inner_gyroscopic_share, numbers.load_edges};
    InertialSums<Real> forces;
    TractionSumsOf<Real> traction_sums;
    for_balls({numbers, in, place, turning, is_wavy, false}, waves_at,
              [&]<bool is_split>(const auto& row, std::bool_constant<is_split>, const BallInRow<Real>& ball,
                                 const BallInBalance<Real>& balanced) {
                row.template add_forces<is_split>(ball, balanced, forces);
                if (tractions) row.add_tractions(with, balanced, traction_sums);
              });
    put<false>(forces, place, out);
    out.inertia_per_speed = out.inertia_per_speed * 2. / in.ring_speed;  // F_0 goes with the square of the speed
    if (tractions) put(traction_sums, with, *tractions);
  }
  template <class WavesAt>
  [[nodiscard]] Real energy(const RowNumbers<Real>& numbers, const BallRowInputOf<Real>& in, const Turning& turning,
                            const WavesAt& waves_at, bool is_wavy) const {
    const RowPlaceOf<Real> place = row_place(numbers, in, Real(0.));
    Real sum = 0.;
    for_balls({numbers, in, place, turning, is_wavy, true}, waves_at,
              [&](const auto&, auto, const BallInRow<Real>&, const BallInBalance<Real>& balanced) {
                sum += elastic_work(numbers.inertial, balanced.ball);
              });
    return 0.4 * sum;
  }
  /// @param load, outer_load  on either race, without damping [n_balls]
  template <class WavesAt>
  void ball_loads(const RowNumbers<Real>& numbers, const BallRowInputOf<Real>& in, const Turning& turning,
                  const WavesAt& waves_at, bool is_wavy, std::span<Real> load, std::span<Real> outer_load) const {
    const RowPlaceOf<Real> place = row_place(numbers, in, Real(0.));
    std::size_t j = 0;
    for_balls({numbers, in, place, turning, is_wavy, true}, waves_at,
              [&](const auto&, auto, const BallInRow<Real>&, const BallInBalance<Real>& balanced) {
                const Real& u = balanced.ball.u;
                outer_load[j] = balanced.ball.Q_o;
                load[j++] = u * u * u;
              });
  }

 private:
  struct Instant {
    const RowNumbers<Real>& numbers;
    const BallRowInputOf<Real>& in;
    const RowPlaceOf<Real>& place;
    const Turning& turning;
    bool is_wavy;
    bool refines;  // by one step more than forces need
  };
  /// Calls act(row, whether part of the gyroscopic traction acts at the inner race, ball in its row, the same in its balance) for all balls.
  template <class WavesAt, class Act>
  void for_balls(const Instant& at, const WavesAt& waves_at, const Act& act) const {
    if (is_radial_)
      balance<GrooveMotion::in_plane, false>(at, waves_at, act);
    else if (is_split_)
      balance<GrooveMotion::translating, true>(at, waves_at, act);
    else
      balance<GrooveMotion::translating, false>(at, waves_at, act);
  }
  template <GrooveMotion motion, bool is_split, class WavesAt, class Act>
  void balance(const Instant& at, const WavesAt& waves_at, const Act& act) const {
    const Turning& turning = at.turning;
    InertialStartsOf<Real> starts;
    for (int lane = 0; lane < n_lanes; ++lane)
      starts.set(lane, turning.is[lane] ? starts_[static_cast<std::size_t>(lane)]->at(turning.F_0[lane])
                                        : InertialStarts::nowhere());
    const auto& constants = at.numbers.inertial;
    const auto added = at.numbers.added(at.in);
    const RowAtInstant<motion, false, Real> row(at.place, constants, added.inner, added.outer, at.in.cage_speed,
                                                at.is_wavy, sums_roots_);
    const Newton<BallForcesOf<motion, is_split, Real>, Real, InertialStartsOf<Real>> newton(constants, turning.F_0,
                                                                                            starts, turning.is);
    constexpr std::size_t at_a_time = 4;  // balls that a processor has in work
    BallInRow<Real> in_row[at_a_time];
    BallInBalance<Real> balanced[at_a_time];
    for (std::size_t first = 0; first < cosine_.size(); first += at_a_time) {
      const std::size_t n = std::min(at_a_time, cosine_.size() - first);
      for (std::size_t k = 0; k < n; ++k) {
        const std::size_t j = first + k;
        in_row[k] = {Real(cosine_[j]), Real(sine_[j]), {}, waves_at(j)};
        balanced[k].at = row.surroundings(in_row[k]);
        newton.start(balanced[k]);
        balanced[k].is_ball = 1.;
      }
      newton.balance(balanced, n);
      if (at.refines) newton.refine(balanced, n);
      for (std::size_t k = 0; k < n; ++k) act(row, std::bool_constant<is_split>(), in_row[k], balanced[k]);
    }
  }

  bool is_radial_, is_split_, sums_roots_;
  std::span<const double> cosine_, sine_;      // of the first row
  std::vector<const InertialStarts*> starts_;  // [n_lanes]
};

}  // namespace rotordrop
