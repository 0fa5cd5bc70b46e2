#include "study/finished_run.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <system_error>

#include "base/errors.h"
#include "io/own_files.h"
#include "io/text/parameter_keys.h"
#include "study/compare/comparison.h"
#include "study/report/report.h"

namespace rotordrop {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> write_comparison_of_models(const fs::path& directory, const RecordedDrop& drop) {
  if (drop.bearings().empty() || drop.models().size() < 2) return {};
  Comparison comparison;
  try {
    comparison = compare_models(drop, nullptr, {});
  } catch (const InputError& error) {
    // The input was good: what came of it is not.
    throw SolverError(std::string("the run is complete, but its thermal models cannot be compared.\n") + error.what());
  }
  write_comparison(comparison, directory / "comparison.json");
  return comparison.report["in_short"].get<std::vector<std::string>>();
}

/// Whether a page was made before the run came to its end. A run that is not resumed writes parameters.toml first of all; an older page is of
/// other results, and somebody keeps it.
bool shows_unfinished_run(const fs::path& page, bool resumed) {
  if (!is_own_page(page)) return false;
  std::error_code error;
  return resumed ||
         fs::last_write_time(page, error) >= fs::last_write_time(page.parent_path() / "parameters.toml", error);
}

}  // namespace

FilesOfFinishedRun write_files_of_finished_run(const fs::path& directory, const RecordedDrop& drop, bool resumed,
                                               const std::function<void(const std::string&)>& tell) {
  FilesOfFinishedRun files;
  files.comparison = write_comparison_of_models(directory, drop);
  if (const fs::path page = directory / "report.html"; shows_unfinished_run(page, resumed)) {
    write_page(page, report_page(report_data(RecordedDrop(directory))));
    files.page = page;
  }
  // The measured values are elsewhere.
  if (const fs::path page = directory / "measured.html"; shows_unfinished_run(page, resumed))
    tell(fmt::format(
        "{} and measured.json are of the interrupted run; make them again with rotordrop compare {} --measured FILE",
        page.string(), shell_quoted(directory.string())));
  return files;
}

}  // namespace rotordrop
