#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "analysis/row_schedule.h"
#include "machine/heat/finite_elements.h"
#include "machine/machine.h"
#include "model/observer.h"
#include "thermal/thermal_parameters.h"

namespace rotordrop {

/// Puts the temperatures of sections that are in the state vector into their solvers' fields.
/// @param found  by an evaluation of y
void lift_sections(FiniteElements& elements, const Machine& machine, std::span<const double> y,
                   const Evaluation& found);

/// Takes temperature fields of sections, as their solvers hold them.
class FieldSink {
 public:
  FieldSink() = default;
  FieldSink(const FieldSink&) = delete;
  FieldSink& operator=(const FieldSink&) = delete;
  virtual ~FieldSink() = default;
  /// When a field is wanted next [s]; infinity if none is.
  [[nodiscard]] virtual double next() const = 0;
  /// Whether it is wanted at t [s] or before.
  [[nodiscard]] virtual bool is_due(double t) const = 0;
  virtual void write(double t) = 0;
};

/// How finite-element sections go along with a drop: in its state vector or following it, on few modes or on all, or beside it in windows.
class SectionCoupling : public Observer {
 public:
  /// Growth that the machine takes from outside; none: all of it is in the state vector.
  [[nodiscard]] virtual const GrowthHistory* growth_in_force() const { return nullptr; }
  /// Series of its own, besides those of the machine, and who takes their rows.
  [[nodiscard]] virtual std::vector<Observable> observables() const { return {}; }
  virtual void add(RowSink&) {}
  /// Is shown every instant of those series, whether it becomes a row or not.
  virtual void watch(RowSink&) {}
  virtual void set_fields(FieldSink& fields) = 0;
  /// Brings the sections to the end of a drop.
  virtual void finish(double, std::span<const double>) {}

  struct WindowsReport {
    WindowedSections::Report report;
    HeatEnergy energy;
  };
  [[nodiscard]] virtual std::optional<WindowsReport> windows() const { return {}; }
};

/// @param elements  those that the machine was built with, if any; its sections' solvers belong to this drop while it runs
/// @param schedule  of rows of windows
std::unique_ptr<SectionCoupling> make_section_coupling(const Machine& machine, const ThermalParameters& thermal,
                                                       FiniteElements* elements, RowSchedule schedule);

}  // namespace rotordrop
