#pragma once
#include <csignal>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "base/errors.h"
#include "thermal/heating/heat_parameters.h"

namespace rotordrop {

/// A case of heat conduction alone, as read, checked and completed.
struct HeatCase {
  std::filesystem::path file;
  std::string name;  ///< the file's name without its ending
  HeatStudy study;
  std::string resolved;         ///< complete TOML that reads back to the same values
  std::vector<Fault> warnings;  ///< what is allowed but unusual, most often a slip
};
/// @throws InputError with all faults; also about recorded heat that is not there
HeatCase read_heat_case(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// Whether a case file is one of heat alone: it has [heat]; or [section] or output_times, and no [rotor]. @throws InputError if it cannot be read
bool is_heat_case(const std::filesystem::path& file);

/// The declarations of such a case, for defaults, schema and resolved parameters.
std::vector<ErasedSection> heat_sections();

/// Thrown between steps where a computation is stopped from outside: what stands so far is written.
struct HeatStopped {};

struct HeatRunOptions {
  std::filesystem::path directory;
  bool force = false;                                ///< replace results that are there
  const volatile std::sig_atomic_t* stop = nullptr;  ///< nonzero: end after the step under way
};
/// Computes a case into a directory: results.h5, summary.json, parameters.toml, fields. Under mpirun every rank computes, and only the first
/// one writes. @return the summary
nlohmann::ordered_json run_heat(const HeatCase& heat_case, const HeatRunOptions& options);

/// Whether this process is alone or the first of those that mpirun started: the one that writes.
bool is_first_rank();

/// Describes a case in a few lines.
std::string heat_case_text(const HeatCase& heat_case);
/// A few lines for the screen.
std::string heat_summary_text(const nlohmann::ordered_json& summary);

}  // namespace rotordrop
