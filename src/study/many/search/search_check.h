#pragma once
#include "study/many/study_file.h"

namespace rotordrop {

/// Which parameters a search changes, and whether what the file asks can be searched; fills study.searched.
/// @param tree  of the study file, for the places of faults
void read_search(Study& study, const Node& tree, Faults& faults);

}  // namespace rotordrop
