#include "study/preload/preload_run.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "base/errors.h"
#include "base/version.h"
#include "io/checkpoint.h"
#include "io/results_folder.h"
#include "study/preload/preload_history.h"
#include "study/preload/preload_maps.h"
#include "study/preload/preload_steady.h"

namespace rotordrop {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

void check_directory(const PreloadOptions& options) {
  const fs::path& directory = options.directory;
  for (const char* name : {"preload.h5", "preload.json"})
    if (!options.force && fs::exists(directory / name))
      throw InputError({directory.string(), 0, 0}, fmt::format("the directory holds a {} already", name),
                       "Choose another with -o DIR, or replace it with --force.");
  // Parameters beside the results of a drop are that drop's.
  for (const char* name : {"results.h5", "summary.json"})
    if (fs::exists(directory / name))
      throw InputError({directory.string(), 0, 0},
                       fmt::format("the directory holds results of another kind ({})", name),
                       "Choose another with -o DIR.");
}

[[noreturn]] void refuse_without_touchdowns(const Case& c) {
  throw InputError(position_of(c.tree, "bearings"),
                   "the case has no touchdown bearing, so there is no preload to compute.");
}

}  // namespace

Json find_preload(const Case& c, const std::string& bearing, const RecordedDrop* drop,
                  std::vector<PreloadTable>& tables, const Look& look) {
  const auto bearings = chosen_touchdowns(c, bearing);
  if (bearings.empty()) refuse_without_touchdowns(c);
  Json report = {{"program", program_name()},
                 {"git_revision", git_revision()},
                 {"case", c.name},
                 {"ambient", c.parameters.run.ambient},
                 {"bearings", Json::object()}};
  for (const auto& name : bearings) {
    Json& one = report["bearings"][name];
    try {
      one["running"] = run_preload_loop(c, name, tables, look);
    } catch (const SolverError& e) {  // of this bearing; the others have results
      one["running"] = {{"verdict", "failed"}, {"message", e.what()}};
    }
    one["maps"] = make_preload_maps(c, name, tables, look);
    if (drop) one["history"] = make_preload_history(c, name, *drop, tables, look);
  }
  return report;
}

bool is_complete(const Json& report) {
  for (const auto& [name, bearing] : report["bearings"].items())
    if (bearing["running"]["verdict"] == "failed") return false;
  return true;
}

Json run_preload(const Case& c, const PreloadOptions& options) {
  if (chosen_touchdowns(c, options.bearing).empty()) refuse_without_touchdowns(c);  // before a folder is made
  std::optional<RecordedDrop> drop;
  if (!options.results.empty()) drop.emplace(options.results);
  check_directory(options);
  const ResultsFolder folder(options.directory, ResultsFolder::existing_results(false, options.force));
  std::vector<PreloadTable> tables;
  Json report = find_preload(c, options.bearing, drop ? &*drop : nullptr, tables);
  write_tables(options.directory / "preload.h5", c, tables, options.force);
  write_text_atomically(options.directory / "parameters.toml", c.resolved.text);
  write_text_atomically(options.directory / "preload.json", report.dump(2) + "\n");
  return report;
}

}  // namespace rotordrop
