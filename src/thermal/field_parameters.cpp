#include "thermal/field_parameters.h"

#include <fmt/format.h>

namespace rotordrop {

void check_number_of_fields(const std::string& key, double interval, double end, const SourcePosition& where,
                            Faults& faults) {
  constexpr double most_fields = 1e5;
  if (interval <= 0. || end / interval <= most_fields) return;
  faults.add(where,
             fmt::format("{} = {:.4g} s and an end at {:.6g} s make {:.3g} fields of each section; at most {:.0e} are "
                         "written.",
                         key, interval, end, end / interval, most_fields),
             "Make the interval longer or the run shorter; field_times names single times.");
}

}  // namespace rotordrop
