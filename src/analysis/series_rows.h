#pragma once
#include <array>
#include <vector>

#include "analysis/row_lanes.h"
#include "analysis/row_schedule.h"
#include "machine/machine.h"
#include "model/observer.h"

namespace rotordrop {

/// What a sink reads of the rows of step and state observables.
enum class RowNeeds {
  all,           ///< all of every row
  step,          ///< step observables, and of the state what Machine::is_held()
  now_and_then,  ///< all; of drops in lanes a row every watch_interval is enough
};

/// Rows at the times of a schedule: between steps by the integrator's own interpolation.
class ScheduledRows : public Observer {
 public:
  /// @param sink  takes every row; of rows that come side by side, sinks that take them one by one have all of them first; must outlive this
  void add(RowSink& sink, RowNeeds needs = RowNeeds::all) { sinks_.push_back({&sink, needs}); }
  void step(const Step& step) override;
  [[nodiscard]] double due() const override { return schedule_.due(); }
  void pack(PackedValues& to) const override { to[name_] = schedule_.packed(); }
  void unpack(const PackedValues& from) override { schedule_.unpack(from.at(name_)); }

 protected:
  /// @param name             in checkpoints
  /// @param growth_in_force  of a machine that takes it from outside
  ScheduledRows(const char* name, const Machine& machine, RowSchedule schedule, const GrowthHistory* growth_in_force);
  /// Whether the row at this time needs its state. Of drops one by one it always does: what interpolates for it counts among the evaluations.
  [[nodiscard]] virtual bool needs_state(double t) const = 0;
  /// The row of a state, which was not evaluated yet. @param y  anything if the row does not need it
  virtual void write(double t, std::span<const double> y) = 0;
  /// That of the step's end, which may have been.
  virtual void write_end(const Step& step) = 0;
  /// Whether a change after a long interval without any gets a row at the beginning of the step that brought it.
  [[nodiscard]] virtual bool wants_before_change() const { return false; }
  /// The state there; it stays until the next call.
  std::span<const double> state_at(const Step& step, double t) {
    step.interpolate(t, state_);
    return state_;
  }
  /// @param is_whole  the row holds all that its sinks may need
  void give(double t, std::span<const double> row, bool is_whole = true) {
    tell(t, row, is_whole);
    schedule_.written(t);
  }
  /// The same of a row that the schedule counts as written.
  void tell(double t, std::span<const double> row, bool is_whole = true);
  /// The same of several, which hold all that sinks may need. @param row  space for one
  void tell(const RowTile& rows, std::span<double> row);
  [[nodiscard]] bool is_needed(RowNeeds needs) const;
  [[nodiscard]] bool has_sinks() const { return !sinks_.empty(); }

  const Machine& machine_;
  RowSchedule schedule_;
  Evaluation found_;

 private:
  const char* name_;
  std::vector<double> state_;
  struct Reader {
    RowSink* sink;
    RowNeeds needs;
  };
  std::vector<Reader> sinks_;
};

/// Rows of step and state observables. Where the machine can, rows between steps are evaluated several at a time, and reach their sinks when there are
/// enough of them.
class SeriesRows final : public ScheduledRows {
 public:
  SeriesRows(const Machine& machine, RowSchedule schedule, const GrowthHistory* growth_in_force);

  /// Gives out the rows that are left: before a checkpoint, and at the end.
  void settle();

  /// Of drops in lanes: sinks that need a row now and then get no others, unless a sink needs all of every row.
  static constexpr double watch_interval = 1e-3;  // [s]
  void thin_out() { is_thinned_ = true; }
  /// Time of the next row whose values are read [s].
  [[nodiscard]] double due_ahead() const;

 private:
  /// Whether anybody reads every row.
  [[nodiscard]] bool are_read() const;
  [[nodiscard]] bool needs_state(double t) const override { return has_to_be_whole(t) || is_needed(RowNeeds::step); }
  void write(double t, std::span<const double> y) override;
  void write_end(const Step& step) override {
    settle();
    if (step.is_last) watched_ = -1.;
    write(step.time, state_at(step, step.time), *step.found);
  }
  [[nodiscard]] bool wants_before_change() const override { return true; }
  void write(double t, std::span<const double> y, const Evaluation& found);
  /// Whether all of the row at this time is needed, or what Machine::observe_held() gives of the state will do.
  [[nodiscard]] bool has_to_be_whole(double t) const {
    return !is_thinned_ || is_needed(RowNeeds::all) || t >= watched_ + watch_interval;
  }
  /// @param found  if the row is to be whole, with what observe_state() needs
  void fill(std::span<const double> y, const Evaluation& found, bool is_whole);

  bool evaluates_in_lanes_;
  std::unique_ptr<RowLanes> lanes_;           // made for the first row that is evaluated there
  std::array<bool, RowLanes::most> whole_{};  // of the rows in lanes_
  std::size_t n_step_;
  std::vector<double> row_;
  bool is_thinned_ = false;
  double watched_ = -1.;  // time of the last whole row
};

/// Rows of the detailed observables.
class DetailRows final : public ScheduledRows {
 public:
  DetailRows(const Machine& machine, RowSchedule schedule, const GrowthHistory* growth_in_force);

 private:
  [[nodiscard]] bool needs_state(double) const override { return true; }
  void write(double t, std::span<const double> y) override;
  void write_end(const Step& step) override;
};

}  // namespace rotordrop
