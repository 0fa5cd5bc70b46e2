#pragma once
#include <vector>

#include "analysis/row_schedule.h"
#include "machine/machine.h"
#include "model/observer.h"

namespace rotordrop {

/// Rows at the times of a schedule: between steps by the integrator's own interpolation.
class ScheduledRows : public Observer {
 public:
  /// @param sink  takes every row, in the order in which sinks were added; must outlive this
  void add(RowSink& sink) { sinks_.push_back(&sink); }
  void step(const Step& step) override;
  [[nodiscard]] double due() const override { return schedule_.due(); }
  void pack(PackedValues& to) const override { to[name_] = schedule_.packed(); }
  void unpack(const PackedValues& from) override { schedule_.unpack(from.at(name_)); }

 protected:
  /// @param name             in checkpoints
  /// @param growth_in_force  of a machine that takes it from outside
  ScheduledRows(const char* name, const Machine& machine, RowSchedule schedule, const GrowthHistory* growth_in_force);
  /// The row of a state, which was not evaluated yet.
  virtual void write(double t, std::span<const double> y) = 0;
  /// That of the step's end, which may have been.
  virtual void write_end(const Step& step) { write(step.time, step.after); }
  /// Whether a change after a long interval without any gets a row at the beginning of the step that brought it.
  [[nodiscard]] virtual bool wants_before_change() const { return false; }
  void give(double t, std::span<const double> row);

  const Machine& machine_;
  RowSchedule schedule_;
  Evaluation found_;

 private:
  const char* name_;
  std::vector<double> state_;
  std::vector<RowSink*> sinks_;
};

/// Rows of step and state observables.
class SeriesRows final : public ScheduledRows {
 public:
  SeriesRows(const Machine& machine, RowSchedule schedule, const GrowthHistory* growth_in_force);

 private:
  void write(double t, std::span<const double> y) override;
  void write_end(const Step& step) override { write(step.after, *step.found); }
  [[nodiscard]] bool wants_before_change() const override { return true; }
  void write(std::span<const double> y, const Evaluation& found);

  std::size_t n_step_;
  std::vector<double> row_;
};

/// Rows of the detailed observables.
class DetailRows final : public ScheduledRows {
 public:
  DetailRows(const Machine& machine, RowSchedule schedule, const GrowthHistory* growth_in_force);

 private:
  void write(double t, std::span<const double> y) override;
  void write_end(const Step& step) override;
};

}  // namespace rotordrop
