#pragma once
#include <chrono>
#include <functional>
#include <vector>

#include "analysis/drop.h"

namespace rotordrop {

/// Where a run stands; for the moving line.
struct Progress {
  double time = 0, end_time = 0;      ///< [s]
  double wall_time = 0;               ///< since the start of this program's part of the run [s]
  double wall_time_left = 0;          ///< estimate [s]
  double rotor_speed = 0;             ///< [rad/s]
  double largest_contact_force = 0;   ///< so far [N]
  double inner_ring_temperature = 0;  ///< the warmest inner ring of any thermal model [K]; NaN if there is none
};

/// Tells a few times a second where a drop stands.
class DropProgress final : public Observer {
 public:
  using Report = std::function<void(const Progress&)>;
  /// @param report  none: it tells nobody
  DropProgress(const Machine& machine, const Drop& drop, const GrowthHistory* growth_in_force, Report report);
  /// The drop begins, or resumes, now at this time.
  void begin(double time);
  void step(const Step& step) override;
  /// At once.
  void tell(double time, std::span<const double> y);

 private:
  using Clock = std::chrono::steady_clock;
  const Machine& machine_;
  const Drop& drop_;
  Report report_;
  Evaluation found_;
  std::vector<double> observed_, state_;
  std::vector<ObservedColumns> inner_rings_;
  Clock::time_point begin_ = Clock::now(), last_ = begin_;
  double start_time_ = 0;
  long counter_ = 0;
};

}  // namespace rotordrop
