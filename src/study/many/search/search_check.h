#pragma once
#include "study/many/study_file.h"

namespace rotordrop {

/// Which parameters a search changes, and whether what the file asks can be searched; fills study.searched.
/// @param tree  of the study file, for the places of faults
void read_search(Study& study, const Node& tree, Faults& faults);

/// Reads what was measured into study.fit; warns of values after the latest end of the case, which are left out.
/// @param is_of_study  from the directory of a study instead of the files that it names. @throws InputError
void read_measured_series(Study& study, const Node& tree, const std::filesystem::path& folder, bool is_of_study);

}  // namespace rotordrop
