#pragma once
#include "study/many/study_file.h"

namespace rotordrop {

/// Which parameters a search changes, and whether what the file asks can be searched; fills study.searched.
/// @param tree  of the study file, for the places of faults
void read_search(Study& study, const Node& tree, Faults& faults);

/// Reads what was measured. @param is_of_study  from the directory of a study instead of the files that it names. @throws InputError
void read_measured_series(Fit& fit, const Node& tree, const std::filesystem::path& folder, bool is_of_study);

}  // namespace rotordrop
