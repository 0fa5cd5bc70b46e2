#pragma once
#include <string>
#include <vector>

#include "study/many/study_file.h"
#include "study/many/study_table.h"

namespace rotordrop {

/// Unit and meaning of a result, derived ones included.
std::string unit_of_result(const Study& study, const std::string& name);
std::string long_name_of_result(const Study& study, const std::string& name);

/// Whether a study keeps a result: as asked for, derived, needed by a limit or a choice, or telling whether the rotor touched anything.
bool is_kept(const Study& study, const std::string& name);

/// Limits, choices, derived and kept results against the names of a drop's results: patterns of limits become names, limits SI.
/// @param names  with the derived ones
/// @throws InputError with all that no drop has
void resolve_results(Study& study, const std::vector<std::string>& names);
/// The same by the results that drops of the study have; without any it stays as it was read.
void resolve_results(Study& study, const StudyTable& table);

}  // namespace rotordrop
