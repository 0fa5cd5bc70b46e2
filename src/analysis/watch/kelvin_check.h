#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "model/observer.h"

namespace rotordrop {

/// Finds temperatures of a row of results that are not above 0 K. The mesh looks at its own nodes; what a drop has of finite elements on modes are
/// means and surfaces, which only show in its rows.
class KelvinCheck final : public RowSink {
 public:
  /// @param observables  of the row: temperatures of thermal models are looked at
  /// @param first        place of the first of them in the row
  KelvinCheck(const std::vector<Observable>& observables, std::size_t first);
  /// @throws SolverError that names the first such temperature
  void row(double time, std::span<const double> row) override;

 private:
  struct Place {
    std::size_t at = 0;
    std::string name;
  };
  std::vector<Place> places_;
};

}  // namespace rotordrop
