#pragma once
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/watch/probe_watch.h"
#include "analysis/watch/support_watch.h"
#include "bearing/touchdown_parameters.h"
#include "machine/machine.h"
#include "model/observer.h"

namespace rotordrop {

/// Largest value of a quantity known at steps; between them by the parabola through three steps.
struct FollowedPeak {
  double value = 0;                                        ///< 0 if it never rose above
  double time = std::numeric_limits<double>::quiet_NaN();  ///< [s]
  void follow(double t, double f);
  /// All that decides about what follows.
  [[nodiscard]] auto numbers() { return std::array{&value, &time, &last_time_, &last_, &time_before_, &before_}; }

 private:
  double last_time_ = std::numeric_limits<double>::quiet_NaN(), last_ = 0, time_before_ = last_time_, before_ = 0;
};

/// A quantity's values at steps, from first to last. NaN until followed.
struct FollowedRange {
  static constexpr double never = std::numeric_limits<double>::quiet_NaN();
  double first = never, last = never;
  double smallest = never, smallest_time = never, largest = never, largest_time = never;
  void follow(double t, double f);
  /// All that decides about what follows.
  [[nodiscard]] auto numbers() { return std::array{&first, &last, &smallest, &smallest_time, &largest, &largest_time}; }
};

/// Balls that cannot follow changes of the ring's speed matter from this part of all its changes on; less happens in flight, when bare drag
/// slows unloaded rings down.
inline constexpr double relevant_speed_share = 0.05;

/// How long a demand is above 1, by straight lines between steps, and what a ring's speed does meanwhile.
struct FollowedDemand {
  double largest = 0;                                              ///< at a step
  double largest_time = std::numeric_limits<double>::quiet_NaN();  ///< [s]; never: nothing was asked
  double time_beyond = 0;                                          ///< [s]
  double longest_beyond = 0;                                       ///< at one stretch [s]
  double speed_change = 0;         ///< sum of all the ring's changes of speed, up and down [rad/s]
  double speed_change_beyond = 0;  ///< those meanwhile: so much at most can rolling be left behind [rad/s]
  void follow(double t, double demand, double speed);
  /// All that decides about what follows.
  [[nodiscard]] auto numbers() {
    return std::array{&largest,    &largest_time, &time_beyond, &longest_beyond, &speed_change, &speed_change_beyond,
                      &last_time_, &last_,        &last_speed_, &stretch_};
  }

 private:
  double last_time_ = std::numeric_limits<double>::quiet_NaN(), last_ = 0, last_speed_ = 0, stretch_ = 0;
};

/// Part of a row's contact ellipses beyond the raceway's edge.
struct FollowedTruncation {
  double largest = 0;                                              ///< of the ellipse's length
  double largest_time = std::numeric_limits<double>::quiet_NaN();  ///< [s]
  double time_truncated = 0;                                       ///< [s]
  void follow(double t, double truncation);
  /// All that decides about what follows.
  [[nodiscard]] auto numbers() { return std::array{&largest, &largest_time, &time_truncated, &last_time_, &last_}; }

 private:
  double last_time_ = std::numeric_limits<double>::quiet_NaN(), last_ = 0;
};

/// Centrifugal force of a ball over the load of the row's most loaded one, in the mean over time, weighted by the square of the load: moments without
/// load, when centrifugal forces always exceed it, do not count.
struct FollowedLoad {
  double largest = 0;  ///< centrifugal force [N]
  void follow(double t, double force, double load);
  /// All that decides about what follows.
  [[nodiscard]] auto numbers() {
    return std::array{&largest,  &last_time_,    &last_force_, &last_load_,
                      &product_, &load_squared_, &time_,       &time_loaded_};
  }
  [[nodiscard]] double over_load() const { return load_squared_ > 0. ? product_ / load_squared_ : 0.; }
  /// Part of the time in which the row carries a load.
  [[nodiscard]] double loaded_share() const { return time_ > 0. ? time_loaded_ / time_ : 0.; }

 private:
  double last_time_ = std::numeric_limits<double>::quiet_NaN(), last_force_ = 0, last_load_ = 0, product_ = 0,
         load_squared_ = 0, time_ = 0, time_loaded_ = 0;
};

/// Scalars of one touchdown bearing, followed from step to step. NaN where something has not happened.
struct BearingScalars {
  static constexpr double never = std::numeric_limits<double>::quiet_NaN();
  double first_contact_time = never;              ///< penetration first passes zero [s]
  double first_contact_end = never;               ///< and first falls below it [s]
  double second_contact_time = never;             ///< [s]
  FollowedPeak contact_force;                     ///< [N]
  double first_bounce_apex = never;               ///< highest y of the rotor between first and second contact [m]
  FollowedPeak friction_heat_rate;                ///< [W]
  double catch_up_time = never;                   ///< spin lag first below 1 % [s]
  FollowedPeak load_torque, spin_torque;          ///< [N m]
  FollowedPeak inner_heat_rate, outer_heat_rate;  ///< [W]
  FollowedPeak ball_force;                        ///< of the most loaded ball [N]
  FollowedPeak contact_pressure;                  ///< of balls and races [Pa]
  std::array<FollowedPeak, TouchdownBearing::max_rows> row_pressure;  ///< the same of each row [Pa]
  std::array<FollowedTruncation, TouchdownBearing::max_rows> row_truncation;
  std::array<FollowedLoad, TouchdownBearing::max_rows> row_centrifugal;
  FollowedRange clearance;                                   ///< radial air gap [m]
  std::array<FollowedRange, growth_surfaces.size()> growth;  ///< of growth_surfaces [m]
  FollowedRange preload;                                     ///< of opposed rows [N]
  FollowedDemand skid, gyroscopic;                           ///< of the row that asks for most
  std::array<FollowedDemand, TouchdownBearing::max_rows> row_skid;
  FollowedRange axial_force, axial_position;  ///< of rotor on ring [N], of the rotor [m]; of a free ring
  double ring_speed_end = never;              ///< [rad/s]
  // The last step, for crossings.
  double time = never, penetration = never, spin_lag = never;

  /// Calls f(name, numbers) for everything above; numbers: an array of pointers.
  template <class F>
  void each(F&& f) {
    f("first contact time", std::array{&first_contact_time});
    f("first contact end", std::array{&first_contact_end});
    f("second contact time", std::array{&second_contact_time});
    f("first bounce apex", std::array{&first_bounce_apex});
    f("catch-up time", std::array{&catch_up_time});
    f("ring speed end", std::array{&ring_speed_end});
    f("last step", std::array{&time, &penetration, &spin_lag});
    f("contact force", contact_force.numbers());
    f("friction heat rate", friction_heat_rate.numbers());
    f("load torque", load_torque.numbers());
    f("spin torque", spin_torque.numbers());
    f("inner heat rate", inner_heat_rate.numbers());
    f("outer heat rate", outer_heat_rate.numbers());
    f("ball force", ball_force.numbers());
    f("contact pressure", contact_pressure.numbers());
    f("clearance", clearance.numbers());
    f("preload", preload.numbers());
    f("skid", skid.numbers());
    f("gyroscopic", gyroscopic.numbers());
    f("axial force", axial_force.numbers());
    f("axial position", axial_position.numbers());
    for (std::size_t k = 0; k < growth.size(); ++k)
      f(std::string("growth of ") + growth_surface_names[k], growth[k].numbers());
    for (std::size_t row = 0; row < row_pressure.size(); ++row) {
      const std::string of_row = " of row " + std::to_string(row + 1);
      f("pressure" + of_row, row_pressure[row].numbers());
      f("truncation" + of_row, row_truncation[row].numbers());
      f("centrifugal load" + of_row, row_centrifugal[row].numbers());
      f("skid" + of_row, row_skid[row].numbers());
    }
  }
};

/// Rows that carry a load in less than this part of the time cannot be kept rolling, and need not: they are no reason to warn.
inline constexpr double relevant_loaded_share = 0.1;

/// What a warning of skidding is about.
struct SkidVerdict {
  FollowedDemand demand;           ///< of the rows that carry loads together; of the worst one if others carry none
  std::optional<std::size_t> row;  ///< the one with most of it, from 0; none if no row carries a load
};
[[nodiscard]] SkidVerdict skid_verdict(const BearingScalars& bearing, std::size_t n_rows);

/// Follows every touchdown bearing of a machine through its step observables.
class DropScalars final : public Observer {
 public:
  explicit DropScalars(const Machine& machine);
  void step(const Step& step) override;
  /// @param step values of machine.step_observables() at t, at every observed step
  void follow(double t, std::span<const double> step);
  void pack(PackedValues& to) const override;
  void unpack(const PackedValues& from) override;
  [[nodiscard]] std::size_t size() const { return scalars_.size(); }
  [[nodiscard]] const BearingScalars& of(std::size_t bearing) const { return scalars_[bearing]; }
  /// Index of a bearing among the machine's supports.
  [[nodiscard]] std::size_t support(std::size_t bearing) const { return columns_[bearing].support; }
  [[nodiscard]] double largest_contact_force() const;
  /// Whether a bearing's inner ring takes axial loads from the rotor.
  [[nodiscard]] bool is_free(std::size_t bearing) const { return columns_[bearing].axial_force.has_value(); }
  [[nodiscard]] std::size_t n_rows(std::size_t bearing) const { return columns_[bearing].n_rows; }
  [[nodiscard]] const std::string& name(std::size_t bearing) const { return names_[bearing]; }
  [[nodiscard]] const ProbeWatch& probes() const { return probes_; }
  [[nodiscard]] const SupportWatch& supports() const { return supports_; }

 private:
  struct Columns {
    std::size_t support, orbit, penetration, contact_force, rub_heat_rate, spin_lag, load_torque, spin_torque,
        inner_heat_rate, outer_heat_rate, ring_speed, ball_force, contact_pressure, n_rows, clearance, growth, preload,
        skid_demand, gyroscopic_demand, centrifugal_force, ellipse_truncation;
    std::optional<std::size_t> axial_force, axial_position;
  };
  std::vector<std::string> names_;
  std::vector<Columns> columns_;
  std::vector<BearingScalars> scalars_;
  ProbeWatch probes_;
  SupportWatch supports_;
};

}  // namespace rotordrop
