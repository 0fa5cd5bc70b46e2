#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "study/many/study_table.h"

namespace rotordrop {

/// "fit" of study.json: values with their confidence, what differs, course of the searches. docs/how-to/studies.md explains its keys.
nlohmann::ordered_json fit_summary(const Study& study, const Design& design, const StudyTable& table);
/// Lines for the screen.
std::string fit_text(const nlohmann::ordered_json& summary);
/// Measured and computed series of the report's overlay, thinned.
nlohmann::ordered_json fit_overlay(const Study& study, const nlohmann::ordered_json& summary, const StudyTable& table);

}  // namespace rotordrop
