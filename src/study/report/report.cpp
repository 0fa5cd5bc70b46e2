#include "study/report/report.h"

#include <fmt/format.h>

#include <fstream>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "base/errors.h"
#include "base/trimmed.h"
#include "study/opinion/second_opinion.h"
#include "study/report/directions.h"
#include "study/report/report_template.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

/// The template with its marks replaced, each once; what is put in is not searched again, for a case may be called "@DATA@".
std::string filled(std::string_view page, std::initializer_list<std::pair<std::string_view, std::string_view>> parts) {
  std::string result;
  for (const auto& [mark, text] : parts) {
    const auto at = page.find(mark);
    if (at == std::string_view::npos) throw std::logic_error(fmt::format("the report's template lacks {}", mark));
    result.append(page.substr(0, at)).append(text);
    page.remove_prefix(at + mark.size());
  }
  return result.append(page);
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else
      result += c;
  }
  return result;
}

/// JSON that cannot end the script element it stands in.
std::string embedded(const Json& data) {
  std::string result;
  for (const char c : data.dump(-1, ' ', false, Json::error_handler_t::replace))
    if (c == '<')
      result += "\\u003c";
    else
      result += c;
  return result;
}

}  // namespace

std::string in_celsius(double temperature) { return fmt::format("{:.4g} °C", temperature - 273.15); }

Json read_json_of(const RecordedDrop& drop, const std::string& name) {
  const auto path = drop.directory() / name;
  if (!std::filesystem::exists(path)) return nullptr;
  std::ifstream file(path);
  try {
    return Json::parse(file);
  } catch (const Json::exception&) {
    throw InputError({path.string(), 0, 0}, "the file is not valid JSON", "Run the case again, or remove the file.");
  }
}

namespace {

/// The lines of the screen.
Json report_second_opinion(const Json& summary) {
  Json lines = Json::array();
  std::istringstream text(second_opinion_text(summary["second_opinion"]));
  for (std::string line; std::getline(text, line);) lines.push_back(trimmed(line));
  return lines;
}

Json data_of(const RecordedDrop& drop, const Json& summary, const Json& comparison) {
  Json data;
  const auto& p = drop.parameters();
  data["title"] = (p.title ? "Case " : "Drop ") + drop.case_name();
  if (p.title) data["user_title"] = *p.title;
  if (p.note) data["note"] = *p.note;
  data["words"] = report_words(drop);
  if (!summary.is_null() && summary.contains("limits")) data["acceptance"] = report_acceptance(summary);
  if (!summary.is_null()) data["damage"] = report_damage(summary);
  if (!summary.is_null() && summary.contains("second_opinion")) data["second_opinion"] = report_second_opinion(summary);
  data["numbers"] = report_numbers(drop, summary);
  data["checks"] = report_checks(drop, summary);
  for (const auto& [axis, number] : {std::pair{"y", 1u}, std::pair{"z", 2u}})
    data["directions"][axis] = axis_name(p.run.gravity, number);
  data["machine"] = report_machine(drop);
  data["modes"] = report_modes(drop);
  data["bending"] = report_bending(drop);
  data["animation"] = report_animation(drop);
  Json axes = Json::array();
  data["charts"] = report_charts(drop, axes);
  data["axes"] = std::move(axes);
  add_limits(drop, summary, data["charts"]);
  for (Json& chart : report_critical_speeds(drop)) data["charts"].push_back(std::move(chart));
  ReportSpectra spectra = report_spectra(drop);
  for (Json& chart : spectra.charts) data["charts"].push_back(std::move(chart));
  data["waterfalls"] = std::move(spectra.waterfalls);
  if (!spectra.note.empty()) data["spectra_note"] = spectra.note;
  data["fields"] = report_fields(drop);
  data["ball_loads"] = report_ball_loads(drop);
  if (!comparison.is_null())
    data["comparison"] = {{"in_short", comparison.value("in_short", Json::array())},
                          {"verdict", comparison.value("verdict", Json::array())}};
  data["assumptions"] = report_assumptions(drop);
  data["provenance"] = report_provenance(drop);
  return data;
}

}  // namespace

Json report_data(const RecordedDrop& drop) {
  const Json summary = read_json_of(drop, "summary.json"), comparison = read_json_of(drop, "comparison.json");
  try {
    return data_of(drop, summary, comparison);
  } catch (const Json::exception& error) {
    throw InputError({(drop.directory() / "summary.json").string(), 0, 0},
                     fmt::format("this file or comparison.json is not what the program wrote: {}.", error.what()),
                     "Remove the file, or run the case again.");
  }
}

std::string html_page(const Json& data, std::string_view css, std::string_view js) {
  const std::string title = escaped(data["title"].get<std::string>()), numbers = embedded(data);
  const std::string script = page_js + std::string(js);
  return filled(report_html, {{"@TITLE@", title}, {"@CSS@", css}, {"@DATA@", numbers}, {"@JS@", script}});
}

std::string report_page(const Json& data) {
  return html_page(data, report_css, std::string(figures_js) + drop_js + machine_js + waterfall_js + report_js);
}

}  // namespace rotordrop
