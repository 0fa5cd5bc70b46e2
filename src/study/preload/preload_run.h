#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "case/case.h"
#include "study/preload/preload_tables.h"
#include "study/recorded_drop.h"

namespace rotordrop {

struct PreloadOptions {
  std::filesystem::path directory;  ///< for preload.h5, preload.json and parameters.toml
  std::string bearing;              ///< only this touchdown bearing; empty: all
  std::filesystem::path results;    ///< directory of a drop for histories; empty: none
  bool force = false;               ///< replace what is in the directory
};

/// Maps, histories and steady running of touchdown bearings by themselves, in memory; tables are added.
/// @param bearing  only this touchdown bearing; empty: all
/// @param drop     for histories; may be null
/// @param look     called now and then; what it throws ends the computation
/// A bearing of which the steady running cannot be computed has the verdict "failed" and a message.
/// @throws InputError for an unknown bearing, SolverError for histories
nlohmann::ordered_json find_preload(const Case& preload_case, const std::string& bearing, const RecordedDrop* drop,
                                    std::vector<PreloadTable>& tables, const Look& look = {});

/// Maps, histories and steady running of touchdown bearings by themselves, into a directory; returns what preload.json has.
/// See docs/how-to/preload.md for every key and dataset.
/// @throws InputError for an unknown bearing, results that cannot be read or would be replaced; SolverError
nlohmann::ordered_json run_preload(const Case& preload_case, const PreloadOptions& options);

/// Whether the steady running of every bearing was computed.
bool is_complete(const nlohmann::ordered_json& report);

/// For the screen.
std::string preload_text(const nlohmann::ordered_json& report);

}  // namespace rotordrop
