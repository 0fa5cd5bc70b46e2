#pragma once
// What tests of searches share: a study run over a replaced drop, interrupted at will, and its files.
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "../../unit/studies/study_inputs.h"
#include "study/many/search/search_run.h"
#include "study/many/search/search_space.h"

namespace rotordrop::test {

class SearchTest : public ::testing::Test {
 protected:
  /// Goes on with what is in the folder. @param probe  tells which results there are
  /// @return study.json; nothing if the search was interrupted
  nlohmann::json search(const std::string& text, const Evaluator& probe, const Evaluator& evaluate,
                        const std::string& output, unsigned n_workers) {
    Study study = folder_.read(text);
    probe_results(study, SearchSpace(study).corners(), probe);
    StudyOptions options;
    options.directory = folder_.path() / output;
    options.n_workers = n_workers;
    options.evaluate = evaluate;
    options.resume = true;
    options.stop = &stop_;
    const StudyOutcome outcome = run_search(study, options);
    is_complete_ = outcome.is_complete;
    notes_ = outcome.notes;
    if (!is_complete_) return {};
    std::ifstream file(options.directory / "study.json");
    return nlohmann::json::parse(file);
  }
  [[nodiscard]] std::string bytes(const std::string& output) const {
    std::ostringstream all;
    for (const char* name : {"study.h5", "study.csv"})
      all << std::ifstream(folder_.path() / output / name, std::ios::binary).rdbuf();
    return all.str();
  }

  StudyFolder folder_;
  volatile std::sig_atomic_t stop_ = 0;
  bool is_complete_ = false;
  std::vector<std::string> notes_;
};

}  // namespace rotordrop::test
