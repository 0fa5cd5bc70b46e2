#pragma once
#include <filesystem>
#include <limits>
#include <span>
#include <vector>

#include "io/field_series.h"
#include "machine/finite_elements.h"
#include "machine/machine.h"
#include "thermal/fe_parameters.h"

namespace rotordrop {

/// Puts the temperatures of sections that are in the state vector into their solvers' fields.
/// @param found  by an evaluation of y
void lift_sections(FiniteElements& elements, const Machine& machine, std::span<const double> y,
                   const Evaluation& found);

/// Temperature fields of a drop's sections: DIRECTORY/fields/BEARING.pvd.
class DropFields {
 public:
  /// @param start  of the run [s]; above 0 the series there is gone on with
  DropFields(const std::filesystem::path& directory, FiniteElements& elements, const FeParameters& parameters,
             const Machine& machine, double start);

  /// Time of the next requested field [s]; infinity if there is none.
  [[nodiscard]] double next() const { return next_; }
  /// Whether it is wanted at t [s] or before.
  [[nodiscard]] bool is_due(double t) const;
  /// Writes the fields of sections that are in the state vector. @param found  by an evaluation of y
  void write_reduced(std::span<const double> y, const Evaluation& found);
  /// Writes the fields of sections that run in windows, in their solvers' current state.
  void write_windowed(double t);

 private:
  void write(std::size_t section, double t);

  FiniteElements& elements_;
  const Machine& machine_;
  const FieldTimes times_;
  std::vector<FieldSeries> series_;
  double next_ = std::numeric_limits<double>::infinity();
};

}  // namespace rotordrop
