#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "study/json_number.h"
#include "study/report/checks/checks.h"

// Loads of a bearing against its ratings.
namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

/// A pressure and where it comes from.
struct LargestPressure {
  double value = 0;   ///< [Pa]
  std::string words;  ///< ", in row 2": of which row, and whether only recorded rows are known
};

/// Of every step of the integration, as the summary has it.
LargestPressure pressure_in_summary(const Json& summary, const std::string& name) {
  const std::string key = "/bearings/" + name;
  const double value = number_at(summary, key + "/largest_contact_pressure");
  if (!std::isfinite(value)) return {};
  const Json::json_pointer rows(key + "/rows");
  if (summary.contains(rows) && summary.at(rows).size() > 1)
    for (std::size_t row = 0; row < summary.at(rows).size(); ++row)
      if (number_at(summary.at(rows)[row], "/largest_contact_pressure") == value)
        return {value, fmt::format(", in row {}", row + 1)};
  return {value, ""};
}

LargestPressure recorded_pressure(const RecordedDrop& drop, const std::string& name) {
  LargestPressure largest;
  for (const auto& path : drop.pressure_paths(name)) {
    const auto columns = drop.meaning(path).columns;
    for (std::size_t column = 0; column < drop.table(path).n_columns; ++column) {
      const double value = largest_of(drop.series(path, column)).value;
      if (value > largest.value)
        largest = {value, (columns.size() > 1 ? ", in " + columns[column] : "") + ", in the recorded samples"};
    }
  }
  return largest;
}

}  // namespace

void check_load(Checks& checks, const RecordedDrop& drop, const std::string& name, const TouchdownParameters& b) {
  const std::string force = "/bearings/" + name + "/bearing_force";
  if (drop.has(force) && b.C0 > 0.) {
    const TimeSeries y = drop.series(force, 0), z = drop.series(force, 1);
    double largest = 0.;
    for (std::size_t k = 0; k < y.values.size(); ++k) largest = std::max(largest, std::hypot(y.values[k], z.values[k]));
    const std::string path = "/bearings/" + name + "/axial_force", title = name + ": static load rating";
    const auto magnitudes = drop.has(path) ? drop.series(path).values : std::vector<double>{};
    double axial = 0.;
    for (const double value : magnitudes) axial = std::max(axial, std::fabs(value));
    if (std::max(axial, largest) < 1e-9 * b.C0)  // roundoff
      checks.add(title, true, fmt::format("no load in the recorded samples; C0 = {:.4g} kN", b.C0 * 1e-3));
    else if (axial > largest && largest < b.C0)
      checks.unknown(title, fmt::format("not assessed: C0 = {:.4g} kN is a radial rating, and the axial load of up to "
                                        "{:.4g} kN is larger than the radial one of up to {:.4g} kN. static_safety, "
                                        "that of the worst ball, has both",
                                        b.C0 * 1e-3, axial * 1e-3, largest * 1e-3));
    else
      checks.add(
          title, largest < b.C0,
          fmt::format("largest radial load of the recorded samples {:.4g} kN, C0 = {:.4g} kN; their ratio is {}.{} "
                      "static_safety is that of the worst ball at every step, whose load the row does not share evenly",
                      largest * 1e-3, b.C0 * 1e-3,
                      largest > 1e-6 * b.C0 ? fmt::format("{:.3g}", b.C0 / largest) : std::string("above 1e+06"),
                      axial > 0. ? fmt::format(" The axial load, up to {:.4g} kN, is not in it.", axial * 1e-3) : ""));
  }
}

void check_pressure(Checks& checks, const RecordedDrop& drop, const Json& summary, const std::string& name,
                    const TouchdownParameters& b) {
  const LargestPressure peak = pressure_in_summary(summary, name), recorded = recorded_pressure(drop, name);
  // Pressures of a bearing's own models are recorded only.
  const LargestPressure& largest = recorded.value > peak.value * (1. + 1e-6) ? recorded : peak;
  if (!(largest.value > 0.)) return;
  checks.add(name + ": contact pressure", largest.value < static_pressure_limit,
             fmt::format("largest {:.3g} GPa{}; limit {:.1f} GPa (ISO 76){}", largest.value * 1e-9, largest.words,
                         static_pressure_limit * 1e-9,
                         b.ring_bending == RingBendingModel::none ? "; rigid rings understate it" : ""));
}

}  // namespace rotordrop
