#include "analysis/watch/fit_watch.h"

#include <fmt/format.h>

namespace rotordrop {

FitWatch::FitWatch(const std::vector<Observable>& observables, std::size_t first, bool follows, Tell tell)
    : follows_(follows), tell_(std::move(tell)) {
  for (auto& columns : columns_of(observables, Observed::housing_fit_open, first)) fits_.push_back({columns});
}

void FitWatch::row(double time, std::span<const double> row) {
  for (auto& fit : fits_) {
    const double open = row[fit.at.first];
    if (fit.is_told || !(open > 0.)) continue;
    fit.is_told = true;
    if (tell_)
      tell_(
          fmt::format("the fit of {}'s outer ring in its housing begins to open before t = {:.4g} ms: {:.0f} % of its "
                      "area{}.",
                      fit.at.place, time * 1e3, 100. * open,
                      follows_ ? ""
                               : " would have to pull. Growth stays that of a closed fit; thermal.fe.coupling = "
                                 "\"windowed\" lets it open"));
  }
}

}  // namespace rotordrop
