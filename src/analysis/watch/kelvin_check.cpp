#include "analysis/watch/kelvin_check.h"

#include <fmt/format.h>

#include <cmath>

#include "base/errors.h"

namespace rotordrop {

KelvinCheck::KelvinCheck(const std::vector<Observable>& observables, std::size_t first) {
  for (const auto& o : observables) {
    const bool is_temperature = o.kind == Observed::temperature || o.kind == Observed::inner_ring_temperature;
    for (std::size_t i = 0; is_temperature && i < o.size; ++i)
      places_.push_back({first + i, o.columns.empty() ? o.name : o.name + " (" + o.columns[i] + ")"});
    first += o.size;
  }
}

void KelvinCheck::row(double time, std::span<const double> row) {
  for (const auto& place : places_) {
    if (std::isnan(row[place.at]))
      throw SolverError(fmt::format("the temperature of {} is not a number at t = {:.6g} s.", place.name, time));
    if (!(row[place.at] > 0.))
      throw SolverError(fmt::format(
          "{} is cooled below 0 K at t = {:.6g} s: it would be {:.4g} K. Nothing can give off "
          "so much heat.\n       Often the step is too long for the stiffest contact; else check run.ambient, "
          "and the heat and resistances of that bearing.",
          place.name, time, row[place.at]));
  }
}

}  // namespace rotordrop
