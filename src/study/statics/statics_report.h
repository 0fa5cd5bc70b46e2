#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "case/case.h"

namespace rotordrop {

/// Static equilibrium of the subject of [statics], SI; see docs/how-to/statics.md for every key.
/// @param bearing  only this touchdown bearing, by itself whatever the subject is; empty: the subject
/// @throws InputError for an unknown bearing, SolverError if no equilibrium is found
nlohmann::ordered_json find_rest(const Case& static_case, const std::string& bearing);

/// As a table for the screen.
std::string statics_text(const nlohmann::ordered_json& report);

}  // namespace rotordrop
