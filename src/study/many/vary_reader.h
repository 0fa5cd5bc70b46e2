#pragma once
#include "case/keys/dotted_names.h"
#include "study/many/study_file.h"

namespace rotordrop {

/// Reads [vary] into study.parameters; study.base must be read.
void read_vary(const Node& table, Study& study, Faults& faults);

}  // namespace rotordrop
