#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "case/case.h"
#include "study/drop/drop_run.h"

// A recorded drop once more: the same program, input and machine give the same bits.
namespace rotordrop {

/// The case of a result file, and what else decided about its bits.
struct RecordedInput {
  std::filesystem::path file;
  Case drop_case;
  std::string program, revision, processor, instruction_set;  ///< "unknown" in files from before they were recorded
  bool in_lanes = false;                                      ///< as `study rerun` repeats a point of a study in lanes
};
/// @param path  a results.h5, or the directory that holds one
/// @throws InputError if it holds no drop, or a file that its case names has changed
[[nodiscard]] RecordedInput read_recorded_input(const std::filesystem::path& path);

/// The summary of a directory whose run of this case is finished; null if it is not, or is that of another case.
/// @throws InputError if a file that the case names has changed since
[[nodiscard]] nlohmann::ordered_json finished_summary(const std::filesystem::path& directory, const Case& drop_case);

/// How the datasets of two drops differ.
struct BitComparison {
  std::size_t n_datasets = 0, n_rows = 0;  ///< compared; rows of /time
  bool is_part = false;                    ///< the first one ends earlier: it was interrupted
  struct Difference {
    std::string dataset;
    std::string what;  ///< "largest difference 1e-12 N, first at 7.3 ms"
  };
  std::vector<Difference> differences;
};
[[nodiscard]] BitComparison compare_bits(const std::filesystem::path& first, const std::filesystem::path& second);

/// Lines for the screen: whether the bits are the same, and what is otherwise than it was if they are not.
[[nodiscard]] std::string rerun_text(const RecordedInput& input, const BitComparison& comparison);

}  // namespace rotordrop
