#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "analysis/row_schedule.h"
#include "analysis/run_end.h"
#include "integrate/integrator.h"
#include "machine/heat/followers.h"
#include "machine/machine.h"
#include "model/instants.h"
#include "model/observer.h"

namespace rotordrop {

/// Integrates a machine to the end of its run, or until its condition is met, and shows every step to observers.
class DropLoop {
 public:
  /// @param growth_in_force  of a machine that takes it from outside; must outlive the loop
  DropLoop(const Machine& machine, const IntegrationParameters& integration, const RunParameters& run,
           const GrowthHistory* growth_in_force = nullptr);
  ~DropLoop();
  DropLoop(const DropLoop&) = delete;
  DropLoop& operator=(const DropLoop&) = delete;

  /// They see each step in the order in which they were added, and must outlive the loop.
  void add(Observer& observer) {
    observers_.push_back(&observer);
    wants_details_ = found_.wants_details = wants_details_ || observer.wants_details();
  }
  /// From the start, or from where unpack() has put it, to the end. After an exception time() and state() are those of the last step that every
  /// observer has seen.
  /// @param is_stopped  asked after every step
  /// @returns whether the end was reached
  bool run(const std::function<bool()>& is_stopped = {});

  /// For a loop whose steps are taken together with those of others: shows the start, and from then on every step that its integrator has taken.
  /// @param integrator  stands at time() and state(), and is advanced by the caller; the caller writes what it finds at ends of steps into found()
  void start(std::unique_ptr<Integrator> integrator);
  [[nodiscard]] Evaluation& found() { return found_; }
  [[nodiscard]] const Evaluation& found() const { return found_; }
  /// After a step. @returns whether the end is reached
  bool follow_step();

  /// Whether the last step was evaluated with what observers want to see.
  [[nodiscard]] bool has_observed_last_step() const { return observed_time_ == time_; }

  [[nodiscard]] double time() const { return time_; }  ///< [s]
  [[nodiscard]] const IntegrationParameters& integration() const { return integration_; }
  [[nodiscard]] const Machine& machine() const { return machine_; }
  [[nodiscard]] double end_time() const { return end_time_; }  ///< the latest [s]
  /// At which steps end.
  [[nodiscard]] const Instants& instants() const { return instants_; }
  [[nodiscard]] std::span<const double> state() const;
  [[nodiscard]] bool is_at_end() const { return time_ >= end_time_ || end_.is_reached(); }
  [[nodiscard]] bool condition_is_met() const { return end_.is_reached(); }
  /// Over all parts of a resumed run.
  [[nodiscard]] IntegrationStatistics statistics() const;

  /// Everything but time and state, those of the observers included.
  void pack(PackedValues& to) const;
  /// @throws std::logic_error if something is missing or does not fit
  void unpack(double time, std::span<const double> state, const PackedValues& from);

 private:
  class EndedStep;
  class GrowthWatch;
  void show_start();
  void show(const Step& step);
  EndedStep ended_step();
  /// What the next evaluation is asked for besides rates.
  void ask(bool is_observed);
  void evaluate_end(double t, std::span<const double> y, bool is_observed);
  [[nodiscard]] static double often_enough(const Machine& machine);
  [[nodiscard]] bool is_to_be_observed(double t) const;

  const Machine& machine_;
  IntegrationParameters integration_;
  RunEnd end_;
  double end_time_, time_ = 0, observed_time_ = 0;
  Instants instants_;
  double last_start_ = 0;  ///< of the step that was shown last
  double mean_step_ = 1.;  ///< of the last ones [s]
  MachineSystem system_;
  Evaluation found_;  ///< at ends of steps
  Followers followers_;
  /// At the start and at the end of a step that is shown; what follows is filled in where it is asked for.
  mutable std::vector<double> state_;
  std::vector<double> after_;
  std::vector<Observer*> observers_;
  std::unique_ptr<Integrator> integrator_;
  bool wants_details_ = false;
  bool has_end_rates_ = false;  ///< the method evaluates ends of steps into found_
  std::unique_ptr<GrowthWatch> growth_;
  double often_enough_;  ///< [s]
  IntegrationStatistics earlier_;
};

}  // namespace rotordrop
