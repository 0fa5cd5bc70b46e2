#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "study/compare/comparison_options.h"
#include "study/recorded_drop.h"
#include "study/rub/bore_report.h"

// The lumped circuit beside the finite elements, and one run beside another.
namespace rotordrop {

struct Comparison {
  nlohmann::ordered_json report;  ///< docs/how-to/compare.md
  std::vector<BoreTemperatures> bores;
};

/// @param against  another run, or none. If `drop` has one thermal model only, the other one is taken from there.
/// @throws InputError if there is nothing to compare
Comparison compare_models(const RecordedDrop& drop, const RecordedDrop* against, const ComparisonOptions& options);

/// Series that compare_models() reads of a drop with more than one thermal model: their paths, or beginnings of paths. Those of series_of_rub() are read, too.
std::vector<std::string> series_of_comparison(const CaseParameters& parameters);

/// Sentences for "in_short" and "verdict" of a report without them.
std::vector<std::string> short_verdict_of(const nlohmann::ordered_json& report);
std::vector<std::string> verdict_of(const nlohmann::ordered_json& report);
/// Tables and verdict for the screen.
std::string comparison_text(const nlohmann::ordered_json& report);

/// FILE, and beside it, with the ending .h5, the bores' series. Both are replaced. @throws SolverError
void write_comparison(const Comparison& comparison, const std::filesystem::path& file);
/// Where write_comparison() puts the series.
std::filesystem::path comparison_series_file(const std::filesystem::path& file);

}  // namespace rotordrop
