#pragma once
#include <vector>

#include "analysis/row_schedule.h"
#include "machine/machine.h"
#include "model/observer.h"

namespace rotordrop {

/// Rows of step and state observables at the times of a schedule: between steps by the integrator's own interpolation.
class SeriesRows final : public Observer {
 public:
  /// @param growth_in_force  of a machine that takes it from outside
  SeriesRows(const Machine& machine, RowSchedule schedule, const GrowthHistory* growth_in_force);
  /// @param sink  takes every row, in the order in which sinks were added; must outlive this
  void add(RowSink& sink) { sinks_.push_back(&sink); }
  void step(const Step& step) override;
  [[nodiscard]] double due() const override { return schedule_.due(); }
  void pack(PackedValues& to) const override { to["rows"] = schedule_.packed(); }
  void unpack(const PackedValues& from) override { schedule_.unpack(from.at("rows")); }

 private:
  void write(double t, std::span<const double> y);
  void write(std::span<const double> y, const Evaluation& found);

  const Machine& machine_;
  RowSchedule schedule_;
  Evaluation found_;
  std::size_t n_step_;
  std::vector<double> state_, row_;
  std::vector<RowSink*> sinks_;
};

/// Rows of the detailed observables.
class DetailRows final : public Observer {
 public:
  DetailRows(const Machine& machine, RowSchedule schedule, const GrowthHistory* growth_in_force);
  void add(RowSink& sink) { sinks_.push_back(&sink); }
  void step(const Step& step) override;
  [[nodiscard]] double due() const override { return schedule_.due(); }
  void pack(PackedValues& to) const override { to["detail rows"] = schedule_.packed(); }
  void unpack(const PackedValues& from) override { schedule_.unpack(from.at("detail rows")); }

 private:
  void write(double t, std::span<const double> y);

  const Machine& machine_;
  RowSchedule schedule_;
  Evaluation found_;
  std::vector<double> state_;
  std::vector<RowSink*> sinks_;
};

}  // namespace rotordrop
