#pragma once
#include "base/errors.h"
#include "study/many/study_file.h"

namespace rotordrop {

/// Reads [derived] into study.derived. Values of formulas are SI, and so must their units be: a unit with a factor or another zero is a fault, and
/// so is one that cannot be that of the formula, where results of one unit tell it.
void read_derived(const Node& table, Study& study, Faults& faults);

}  // namespace rotordrop
