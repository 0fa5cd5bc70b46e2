#pragma once
// Quantities followed from step to step, of one drop (Real = double) or of eight in lanes. `told` says of which lanes a step is told; the others keep all
// that they have.
#include <array>
#include <cmath>
#include <limits>

#include "base/real.h"

namespace rotordrop {

/// What has not happened.
inline constexpr double never = std::numeric_limits<double>::quiet_NaN();
template <class Real>
[[nodiscard]] MaskOf<Real> is_never(const Real& value) {
  return value != value;
}
/// to = value in these lanes.
template <class Real>
void put(const MaskOf<Real>& where, Real& to, const Real& value) {
  to = select(where, value, to);
}

/// Largest value of a quantity known at steps; between them by the parabola through three steps.
template <class Real>
struct FollowedPeakOf {
  FollowedPeakOf() = default;
  /// @param least  what it has to rise above
  explicit FollowedPeakOf(const Real& least) : value(least) {}
  Real value = 0.;    ///< 0 if it never rose above
  Real time = never;  ///< [s]
  void follow(const MaskOf<Real>& told, const Real& t, const Real& f) {
    const MaskOf<Real> rises = told & (f > value);
    if (any(rises)) {  // the last step of a run may be the highest
      put(rises, value, f);
      put(rises, time, t);
    }
    // Over steps of like length a parabola rises by a quarter of this at most.
    const Real over_neighbours = last_ - smaller(before_, f);
    const MaskOf<Real> may_be_top = told & (last_ > before_) & (last_ >= f) & (last_ + over_neighbours > value);
    if (any(may_be_top)) take_top(may_be_top, over_neighbours, t, f);
    put(told, time_before_, last_time_);
    put(told, before_, last_);
    put(told, last_time_, t);
    put(told, last_, f);
  }
  /// All that decides about what follows.
  [[nodiscard]] auto numbers() { return std::array{&value, &time, &last_time_, &last_, &time_before_, &before_}; }

 private:
  /// Top of the parabola through the last three points, whose middle one is the highest; a lower one may have a higher top than one before.
  void take_top(const MaskOf<Real>& where, const Real& most, const Real& t, const Real& f) {
    const Real left = (last_ - before_) / (last_time_ - time_before_), right = (f - last_) / (t - last_time_);
    const Real curvature = (right - left) / (t - time_before_);
    const Real slope = left + curvature * (last_time_ - time_before_);  // at the middle point
    const Real shift = -slope / (2. * curvature), top = last_ + smaller(0.5 * slope * shift, most);
    const MaskOf<Real> is_higher = where & (curvature < 0.) & (top > value);
    put(is_higher, value, top);
    put(is_higher, time, last_time_ + shift);
  }

  Real last_time_ = never, last_ = 0., time_before_ = never, before_ = 0.;
};

/// A quantity's values at steps, from first to last. NaN until followed.
template <class Real>
struct FollowedRangeOf {
  Real first = never, last = never;
  Real smallest = never, smallest_time = never, largest = never, largest_time = never;
  void follow(const MaskOf<Real>& told, const Real& t, const Real& f) {
    const MaskOf<Real> falls = told & (!(smallest <= f)), rises = told & (!(largest >= f));
    if (any(falls)) {
      put(falls & is_never(first), first, f);
      put(falls, smallest, f);
      put(falls, smallest_time, t);
    }
    if (any(rises)) {
      put(rises, largest, f);
      put(rises, largest_time, t);
    }
    put(told, last, f);
  }
  /// All that decides about what follows.
  [[nodiscard]] auto numbers() { return std::array{&first, &last, &smallest, &smallest_time, &largest, &largest_time}; }
};

/// Balls that cannot follow changes of the ring's speed matter from this part of all its changes on; less happens in flight, when bare drag
/// slows unloaded rings down.
inline constexpr double relevant_speed_share = 0.05;
/// And from this part of the rotor's speed on: a ring that has hardly turned leaves nothing to slip, 1 mm/s for each m/s of the rotor's surface (estimate).
inline constexpr double least_speed_share = 1e-3;
/// Whether balls that cannot follow matter. @param beyond, all  changes of the ring's speed meanwhile and in all; @param rotor_speed  at the start [rad/s]
[[nodiscard]] inline bool is_skidding_relevant(double beyond, double all, double rotor_speed) {
  return beyond > relevant_speed_share * all && beyond > least_speed_share * std::fabs(rotor_speed);
}

/// How long a demand is above 1, by straight lines between steps, and what a ring's speed does meanwhile.
template <class Real>
struct FollowedDemandOf {
  Real largest = 0.;              ///< at a step
  Real largest_time = never;      ///< [s]; never: nothing was asked
  Real time_beyond = 0.;          ///< [s]
  Real longest_beyond = 0.;       ///< at one stretch [s]
  Real speed_change = 0.;         ///< sum of all the ring's changes of speed, up and down [rad/s]
  Real speed_change_beyond = 0.;  ///< those meanwhile: so much at most can rolling be left behind [rad/s]
  void follow(const MaskOf<Real>& told, const Real& t, const Real& demand, const Real& speed) {
    const MaskOf<Real> rises = told & (demand > largest), goes_on = told & (!is_never(last_time_));
    if (any(rises)) {
      put(rises, largest, demand);
      put(rises, largest_time, t);
    }
    put(goes_on, speed_change, speed_change + abs(speed - last_speed_));
    const Real high = larger(demand, last_), low = smaller(demand, last_);
    const MaskOf<Real> is_beyond = goes_on & (high > 1.);
    if (any(is_beyond)) {
      const Real share = select(low >= 1., Real(1.), (high - 1.) / (high - low)), beyond = share * (t - last_time_);
      put(is_beyond, time_beyond, time_beyond + beyond);
      put(is_beyond, speed_change_beyond, speed_change_beyond + share * abs(speed - last_speed_));
      put(is_beyond, stretch_, select(last_ > 1., stretch_ + beyond, beyond));
      put(is_beyond, longest_beyond, larger(longest_beyond, stretch_));
    }
    put(told, last_time_, t);
    put(told, last_, demand);
    put(told, last_speed_, speed);
  }
  /// All that decides about what follows.
  [[nodiscard]] auto numbers() {
    return std::array{&largest,    &largest_time, &time_beyond, &longest_beyond, &speed_change, &speed_change_beyond,
                      &last_time_, &last_,        &last_speed_, &stretch_};
  }

 private:
  Real last_time_ = never, last_ = 0., last_speed_ = 0., stretch_ = 0.;
};

/// Part of a row's contact ellipses beyond the raceway's edge.
template <class Real>
struct FollowedTruncationOf {
  Real largest = 0.;          ///< of the ellipse's length
  Real largest_time = never;  ///< [s]
  Real time_truncated = 0.;   ///< [s]
  void follow(const MaskOf<Real>& told, const Real& t, const Real& truncation) {
    const MaskOf<Real> rises = told & (truncation > largest);
    if (any(rises)) {
      put(rises, largest, truncation);
      put(rises, largest_time, t);
    }
    const MaskOf<Real> stays = told & (!is_never(last_time_)) & (truncation > 0.) & (last_ > 0.);
    if (any(stays)) put(stays, time_truncated, time_truncated + (t - last_time_));
    put(told, last_time_, t);
    put(told, last_, truncation);
  }
  /// All that decides about what follows.
  [[nodiscard]] auto numbers() { return std::array{&largest, &largest_time, &time_truncated, &last_time_, &last_}; }

 private:
  Real last_time_ = never, last_ = 0.;
};

/// Centrifugal force of a ball over the load of the row's most loaded one, in the mean over time, weighted by the square of the load: moments without
/// load, when centrifugal forces always exceed it, do not count.
template <class Real>
struct FollowedLoadOf {
  Real largest = 0.;  ///< centrifugal force [N]
  void follow(const MaskOf<Real>& told, const Real& t, const Real& force, const Real& load) {
    put(told, largest, larger(largest, force));
    const MaskOf<Real> goes_on = told & (!is_never(last_time_));
    const Real half = 0.5 * (t - last_time_);
    put(goes_on, product_, product_ + half * (force * load + last_force_ * last_load_));
    put(goes_on, load_squared_, load_squared_ + half * (load * load + last_load_ * last_load_));
    put(goes_on, time_, time_ + 2. * half);
    put(goes_on & (load > 0.) & (last_load_ > 0.), time_loaded_, time_loaded_ + 2. * half);
    put(told, last_time_, t);
    put(told, last_force_, force);
    put(told, last_load_, load);
  }
  /// All that decides about what follows.
  [[nodiscard]] auto numbers() {
    return std::array{&largest,  &last_time_,    &last_force_, &last_load_,
                      &product_, &load_squared_, &time_,       &time_loaded_};
  }
  [[nodiscard]] Real over_load() const { return select(load_squared_ > 0., product_ / load_squared_, Real(0.)); }
  /// Part of the time in which the row carries a load.
  [[nodiscard]] Real loaded_share() const { return select(time_ > 0., time_loaded_ / time_, Real(0.)); }

 private:
  Real last_time_ = never, last_force_ = 0., last_load_ = 0., product_ = 0., load_squared_ = 0., time_ = 0.,
       time_loaded_ = 0.;
};

using FollowedPeak = FollowedPeakOf<double>;
using FollowedRange = FollowedRangeOf<double>;
using FollowedDemand = FollowedDemandOf<double>;

}  // namespace rotordrop
