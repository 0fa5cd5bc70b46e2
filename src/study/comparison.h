#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "study/bore_history.h"
#include "study/recorded_drop.h"

// The lumped circuit beside the finite elements, and one run beside another.
namespace rotordrop {

/// Of temperatures: kelvin, or a part of a bearing's largest rise.
struct TemperatureTolerance {
  double value = 0.05;
  bool is_part = true;
};
/// "5 %" or "0.5 K". @throws InputError
TemperatureTolerance parse_temperature_tolerance(const std::string& text);
/// "10 ms, 50 ms" to seconds. @throws InputError
std::vector<double> parse_instants(const std::string& text);
/// A length above zero, such as "0.1 um". @param option  how messages call it. @throws InputError
double parse_length(const std::string& text, const std::string& option);

struct ComparisonOptions {
  TemperatureTolerance temperature;
  double growth = 0.1e-6;                 ///< tolerance of growths and clearances [m]
  std::vector<double> instants = {0.01};  ///< reported beside the first impact's peak and the end [s]
  std::optional<double>
      band_length;  ///< of the rub along the surface [m]; without it the case's thermal.rub_band_length
};

/// Temperatures of one bore, for series [K]; NaN where there is none.
struct BoreTemperatures {
  std::string bearing;
  BoreHistory history;
  std::vector<double> node, mean, local, flash, rotor_flash;  ///< [n_rows]
};

struct Comparison {
  nlohmann::ordered_json report;  ///< docs/compare.md
  std::vector<BoreTemperatures> bores;
};

/// @param against  another run, or none. If `drop` has one thermal model only, the other one is taken from there.
/// @throws InputError if there is nothing to compare
Comparison compare_models(const RecordedDrop& drop, const RecordedDrop* against, const ComparisonOptions& options);

/// Sentences for "verdict" of a report without them.
std::vector<std::string> verdict_of(const nlohmann::ordered_json& report);
/// Tables and verdict for the screen.
std::string comparison_text(const nlohmann::ordered_json& report);

/// FILE, and beside it, with the ending .h5, the bores' series. Both are replaced. @throws SolverError
void write_comparison(const Comparison& comparison, const std::filesystem::path& file);
/// Where write_comparison() puts the series.
std::filesystem::path comparison_series_file(const std::filesystem::path& file);

}  // namespace rotordrop
