#pragma once
#include <span>
#include <string>

namespace rotordrop {

/// Unit and meaning of a number of summary.json; empty if it is not known here.
struct ResultMeaning {
  std::string unit, long_name;
};
/// @param name  dotted, as in summary.json: "bearings.TB1.peak_contact_force", "bearings.TB1.rows[0].truncation"
ResultMeaning meaning_of(const std::string& name);

/// "141.3 um", "7.55 kN": four digits, in SI or with a prefix that engineers use with the unit.
std::string in_words(double value, const std::string& unit);

/// A row of the report's table of the bearings.
struct ShownResult {
  const char* pointer;  ///< to the number in what summary.json has of a bearing
  const char *name, *unit;
  double per_si;  ///< number in that unit for one in SI
};
std::span<const ShownResult> shown_results();

}  // namespace rotordrop
