#pragma once
#include "base/errors.h"
#include "study/many/study_file.h"

namespace rotordrop {

/// Names that a study gives to parameters and derived results: they become columns of study.csv and datasets of study.h5.
/// @param faults  gets those that cannot, and what is named twice
void check_names(const Study& study, const Node& tree, Faults& faults);

}  // namespace rotordrop
