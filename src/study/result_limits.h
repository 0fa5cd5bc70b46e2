#pragma once
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "case/limits.h"
#include "study/limit_verdict.h"

// Limits on numbers of a summary: of one run ([limits] of a case), and of many (study/many).
namespace rotordrop {

/// Numbers of a summary: 1 and 0 for yes and no. What the clock says differs from run to run and
/// is left out, as are lists of words.
SummaryNumbers numbers_of(const nlohmann::ordered_json& summary);

/// Advice on a name that no result has.
std::string advice_on_result(const std::string& name, const std::vector<std::string>& names);

/// Limits with names for patterns, and bounds in SI.
/// @param unit_of  unit of a result by its name
/// @param faults   gets patterns that fit no name, and bounds of another dimension
std::vector<Limit> resolved_limits(const std::vector<Limit>& limits, const std::vector<std::string>& names,
                                   const std::function<std::string(const std::string&)>& unit_of, Faults& faults);

/// `limits` of summary.json. Of a drop without contact nothing is assessed: it has met nothing. @param limits  resolved
/// @param is_complete  of a run that was interrupted nothing is assessed: it may still exceed a limit, or come back below
nlohmann::ordered_json assessed(const std::vector<Limit>& limits, const SummaryNumbers& numbers, bool is_complete);
/// All are met: true; one is exceeded: false; else null.
nlohmann::ordered_json accepted(const nlohmann::ordered_json& limits);

/// `limits` of a summary by those of its case. @throws InputError for limits on nothing
nlohmann::ordered_json assessed(const std::vector<Limit>& limits, const nlohmann::ordered_json& summary,
                                bool is_complete);

/// Lines for the screen, from `limits` of a summary; empty without any. @param second_opinion  that of the summary, or null
/// @param n_warnings  of the run
std::string limits_text(const nlohmann::ordered_json& limits, const nlohmann::ordered_json& second_opinion,
                        std::size_t n_warnings);

}  // namespace rotordrop
