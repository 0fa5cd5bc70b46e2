#pragma once
#include <string>

namespace rotordrop {

/// Unit and meaning of a number of summary.json; empty if it is not known here.
struct ResultMeaning {
  std::string unit, long_name;
};
/// @param name  dotted, as in summary.json: "bearings.TB1.peak_contact_force", "bearings.TB1.rows[0].truncation"
ResultMeaning meaning_of(const std::string& name);

}  // namespace rotordrop
