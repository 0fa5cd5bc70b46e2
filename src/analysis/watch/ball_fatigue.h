#pragma once
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "laws/fatigue/ball_life.h"
#include "laws/fatigue/rainflow.h"
#include "machine/machine.h"
#include "machine/machine_parameters.h"
#include "model/observer.h"

namespace rotordrop {

/// Contact fatigue of one bearing by the loads of its balls (laws/fatigue/ball_life.h).
struct FatigueShare {
  double share = 0;   ///< of the life L10 that was used up
  double rating = 0;  ///< C of all rows [N]
  double by_cycles = 0,
         by_rolling = 0;     ///< the same by load cycles and by rolling alone; of each row the larger counts
  double largest_cycle = 0;  ///< range on the inner race [N]
  double equivalent_cycles =
      0;                        ///< cycles of that range that do the same to its ball; of the ball with the largest sum
  double load_over_rating = 0;  ///< largest cycle on either race over the ball load under C; ISO 281 holds to 0.5
  std::vector<double> rows;     ///< share of each row's own life
};

/// Counts load cycles of one ball, and keeps the sum of their cubes.
class LoadCycles {
 public:
  void follow(double load) { open_.follow(load, *this); }
  /// As if the load ended here.
  [[nodiscard]] LoadCycles finished() const;
  [[nodiscard]] double sum_of_cubes() const { return sum_; }  ///< [N^3]
  [[nodiscard]] double largest() const { return largest_; }   ///< range [N]
  void operator()(double range, double cycles);
  [[nodiscard]] std::vector<double> packed() const;
  void unpack(const std::vector<double>& from);

 private:
  Rainflow open_;
  double sum_ = 0, largest_ = 0;
};

/// Integral of a rate over turns of the inner ring, by the trapezoidal rule.
class OverTurns {
 public:
  /// @param of_all  sum of all balls' Q^3 [N^3]; @param speed  of the inner ring [rad/s]
  void follow(double t, double of_all, double speed);
  [[nodiscard]] double integral() const { return sum_; }
  [[nodiscard]] std::vector<double> packed() const { return {sum_, rate_, time_}; }
  void unpack(const std::vector<double>& from);

 private:
  double sum_ = 0, rate_ = 0, time_ = std::numeric_limits<double>::quiet_NaN();
};

/// Follows the loads of all balls of the bearings with a dynamic load rating, at every observed step.
class BallFatigue final : public Observer {
 public:
  BallFatigue(const Machine& machine, const MachineParameters& parameters);
  void step(const Step& step) override;
  [[nodiscard]] bool wants_details() const override { return !bearings_.empty(); }
  void pack(PackedValues& to) const override;
  void unpack(const PackedValues& from) override;
  /// So far; nothing for a bearing without a rating.
  [[nodiscard]] std::optional<FatigueShare> of(const std::string& bearing) const;

 private:
  /// Loads of all balls on one race.
  struct Race {
    std::size_t column = 0;          // of the first ball among the details
    std::vector<OverTurns> rolling;  // of each row
    std::vector<LoadCycles> balls;   // of all rows
  };
  struct Bearing {
    std::string name;
    double rating = 0;
    std::size_t ring_speed = 0;  // among the step observables
    std::vector<RatedRow> rows;
    std::vector<Race> races;  // the inner one and, where their loads differ, the outer one
  };
  std::vector<Bearing> bearings_;
};

}  // namespace rotordrop
