#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "study/many/answers/summary_watch.h"
#include "study/many/study_table.h"

namespace rotordrop {

/// "surrogate" of study.json: for each result its surrogate's validation and indices. docs/how-to/studies.md explains its keys.
/// @throws SummaryStopped
nlohmann::ordered_json surrogate_summary(const Study& study, const Design& design, const StudyTable& table,
                                         const SummaryWatch& watch);
/// Lines for the screen.
std::string surrogate_text(const nlohmann::ordered_json& summary);

}  // namespace rotordrop
