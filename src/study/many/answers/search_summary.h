#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "study/many/answers/limit_verdicts.h"
#include "study/many/study_table.h"

namespace rotordrop {

/// "minimise" of study.json: course of the searches and the best evaluation. docs/how-to/studies.md explains its keys.
/// @param verdicts  of the table
nlohmann::ordered_json minimise_summary(const Study& study, const Design& design, const StudyTable& table,
                                        const LimitVerdicts& verdicts);
/// Lines for the screen.
std::string minimise_text(const nlohmann::ordered_json& summary);

}  // namespace rotordrop
