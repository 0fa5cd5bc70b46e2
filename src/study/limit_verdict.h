#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "case/limits.h"

// What a drop's numbers say of a limit, and why they may say nothing: of one run, and of many (study/many).
namespace rotordrop {

/// Why a bearing's results are not those of a drop on it.
inline constexpr const char *untouched = "the rotor did not touch the bearing",
                            *in_first_contact = "the run ends in the first contact with the bearing";

/// Numbers of a summary by their dotted names; NaN for what did not happen.
using SummaryNumbers = std::vector<std::pair<std::string, double>>;

/// Whether a result tells of contact: when a bearing was touched first, how hard a contact at a probe.
bool tells_contact(const std::string& name);
/// Whether a drop ended before the rotor touched anything, a bearing or a contact at a probe, by those of its numbers that tell; no if none does.
bool is_without_contact(const SummaryNumbers& numbers);
/// Whether a verdict on a limit may need a result: what tells how far a bearing's contact came, where ellipses leave the raceway, what rubs.
/// @param limited  name or pattern of a limit
bool is_needed_for_verdict(const std::string& name, const std::string& limited);

/// Whether a drop keeps a bound; nothing where that cannot be told, for a reason.
struct LimitVerdict {
  std::optional<bool> is_kept;
  std::string why;  ///< it is not known; empty if it is
};
/// @param limit   resolved, with this bound
/// @param is_max  of its bounds
/// @param value   NaN: did not happen
/// @param told    the drop's numbers, at least those that the verdict may need
LimitVerdict verdict_on(const Limit& limit, bool is_max, double value, const SummaryNumbers& told);

}  // namespace rotordrop
