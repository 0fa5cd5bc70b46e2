#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "study/recorded_drop.h"

// A run as one HTML page that needs nothing else: no network, no other file.
namespace rotordrop {

/// Everything that the page shows: texts, tables, checks, and decimated series in the units of their axes. docs/how-to/report.md says what is in it.
/// @throws InputError if the directory holds no run, or one without a recorded row
nlohmann::ordered_json report_data(const RecordedDrop& drop);

/// The page: template, style and script are part of the program, `data` stands in it as JSON.
std::string report_page(const nlohmann::ordered_json& data);
/// A page with the title data["title"], drawn by a script from `data`.
std::string html_page(const nlohmann::ordered_json& data, std::string_view css, std::string_view js);

/// "22.7 °C". @param temperature [K]
std::string in_celsius(double temperature);

// Pieces of report_data().
/// summary.json, comparison.json: null if the file is not there. @throws InputError if it is no JSON
nlohmann::ordered_json read_json_of(const RecordedDrop& drop, const std::string& name);
/// Figures of time series, one after the other, each with its section. Lines have every sample as long as all of them stay below some two megabytes
/// (packed(), with `axis`, the number of their times in `axes`), otherwise the smallest and largest of equal spans of time (`x`, `y`).
/// @param axes  gets times that lines share
nlohmann::ordered_json report_charts(const RecordedDrop& drop, nlohmann::ordered_json& axes);
/// Adds to figures the limits that they show: of the case's parts and of its [limits]; and degrees Celsius beside rises. @param summary  may be null
void add_limits(const RecordedDrop& drop, const nlohmann::ordered_json& summary, nlohmann::ordered_json& charts);
/// Spectra of orbits and forces (spectrum.h), as figures and as pictures over time.
struct ReportSpectra {
  nlohmann::ordered_json charts, waterfalls;
  std::string note;  ///< why there are none
};
ReportSpectra report_spectra(const RecordedDrop& drop);
/// The machine from the side [mm]: elements of the shaft, masses, unbalances, probes, supports, centre of gravity.
nlohmann::ordered_json report_machine(const RecordedDrop& drop);
/// Mode shapes at the initial speed, on the linear supports and magnets of the case; null for a rigid rotor.
nlohmann::ordered_json report_modes(const RecordedDrop& drop);
/// Campbell diagram and critical-speed map as figures; none for a rigid rotor or one that starts at rest.
nlohmann::ordered_json report_critical_speeds(const RecordedDrop& drop);
/// Modal coordinates over the drop, with their shapes; null for a rigid rotor.
nlohmann::ordered_json report_bending(const RecordedDrop& drop);
/// Positions of rotor and ring in each touchdown bearing, at even steps.
nlohmann::ordered_json report_animation(const RecordedDrop& drop);
/// Load of every ball of each touchdown bearing, the largest in each of up to 400 spans of time [ball][span].
nlohmann::ordered_json report_ball_loads(const RecordedDrop& drop);
/// Temperature fields of each touchdown bearing, as pictures: those nearest to the first impact's peak, to the middle of the run and to its end.
/// @throws InputError if a file of fields is damaged
nlohmann::ordered_json report_fields(const RecordedDrop& drop);
/// Limits of the case with verdicts in words: `verdict`, and rows of result, value, limit, usage, state. @param summary  with `limits`
nlohmann::ordered_json report_acceptance(const nlohmann::ordered_json& summary);
/// Rows like these of what one drop does to each bearing, and of how many drops it may take; the basis under `key`.
nlohmann::ordered_json report_damage(const nlohmann::ordered_json& summary);
/// Rows of the table of main numbers, texts of figures with their units.
nlohmann::ordered_json report_numbers(const RecordedDrop& drop, const nlohmann::ordered_json& summary);
/// Checks made for warnings, and their results: name, state ("ok", "warning", "uncertain", "unknown": not assessed), text.
nlohmann::ordered_json report_checks(const RecordedDrop& drop, const nlohmann::ordered_json& summary);
/// The case in sentences; what it assumes.
nlohmann::ordered_json report_words(const RecordedDrop& drop);
nlohmann::ordered_json report_assumptions(const RecordedDrop& drop);
nlohmann::ordered_json report_provenance(const RecordedDrop& drop);

}  // namespace rotordrop
