#pragma once

// The keys of a study's file.
#include <optional>
#include <string>
#include <vector>

#include "base/parameters/section.h"
#include "study/many/study_file.h"

namespace rotordrop {

struct ReplicateParameters {
  int n = 1;
  double spread = 0;
};
struct CorrelationEntry {
  Node parameters;
  double rank = 0;
};
struct ChoiceEntry {
  std::string parameter, result;
  double quantile = 0;
};
struct KeepEntry {
  Node results, series;
};

/// The file as it stands, before the case is known.
struct StudyFile {
  std::string case_file;
  FailurePolicy on_failure = FailurePolicy::go_on;
  std::optional<bool> lanes;
  Node vary, limits, derived;
  DesignParameters design;
  ReplicateParameters replicates;
  std::vector<CorrelationEntry> correlations;
  std::optional<ChoiceEntry> choice;
  std::optional<MinimiseParameters> minimise;
  std::optional<FitParameters> fit;
  std::optional<SurrogateParameters> surrogate;
  KeepEntry keep;
};

Section<StudyFile> study_section();

}  // namespace rotordrop
