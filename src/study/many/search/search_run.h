#pragma once
#include "study/many/study_run.h"

namespace rotordrop {

/// Runs the search of a study into a directory, as run_study() does the points of a design: study.journal, then study.h5, study.csv, study.json.
/// Repeated with the same journal it comes to where it stood, and goes on.
/// @throws InputError if the directory holds something else or no drop at the start can be computed, SolverError if it cannot be written
StudyOutcome run_search(const Study& study, const StudyOptions& options);

}  // namespace rotordrop
