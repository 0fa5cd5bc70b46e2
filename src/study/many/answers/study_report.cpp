#include "study/many/answers/study_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "io/text/parameter_keys.h"
#include "study/json_number.h"
#include "study/many/answers/fit_summary.h"
#include "study/many/answers/result_check.h"
#include "study/many/answers/study_summary.h"
#include "study/many/search/search_space.h"
#include "study/many/study_folder.h"
#include "study/report/report.h"
#include "study/report/report_template.h"
#include "study/report/rounded.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_shown = 400'000;  // numbers on the page

constexpr int digits = 6;  // more than a picture shows

Json value_of(const Node& value) {
  if (value.is_number()) return rounded(value.number(), digits);
  return value.is_text() ? value.text() : to_text(value);
}

/// Results in the order of interest: chosen, limited, derived, then the others that vary.
std::vector<const ResultColumn*> shown_results(const Study& study, const StudyTable& table) {
  std::vector<const ResultColumn*> shown;
  const auto add = [&](const ResultColumn* column) {
    if (column && std::find(shown.begin(), shown.end(), column) == shown.end()) shown.push_back(column);
  };
  if (study.minimise) add(table.find(study.minimise->result));
  if (study.choice) add(table.find(study.choice->result));
  for (const auto& limit : study.limits) add(table.find(limit.pattern));
  for (const auto& derived : study.derived) add(table.find(derived.name));
  const std::size_t n_rows = std::max<std::size_t>(table.count(PointStatus::done), 1);
  for (const auto& column : table.results) {
    double low = INFINITY, high = -INFINITY;
    for (const double v : column.values)
      if (std::isfinite(v)) {
        low = std::min(low, v);
        high = std::max(high, v);
      }
    if (low < high && shown.size() * n_rows < most_shown) add(&column);
  }
  return shown;
}

/// As study_summary(), but with the surrogates that study.json of the same drops has: they take long.
Json summary_with_kept_surrogates(const std::filesystem::path& directory, Study study, const Design& design,
                                  const StudyTable& table) {
  Json kept;
  if (std::ifstream file(directory / "study.json"); study.surrogate && file) kept = Json::parse(file, nullptr, false);
  const bool is_of_these = kept.is_object() && kept.contains("surrogate") &&
                           kept["done"] == table.count(PointStatus::done) &&
                           kept["failed"] == table.count(PointStatus::failed);
  if (is_of_these) study.surrogate.reset();
  Json summary = study_summary(study, design, table);
  if (is_of_these) summary["surrogate"] = kept["surrogate"];
  return summary;
}

}  // namespace

Json study_report_data(const std::filesystem::path& directory) {
  Study study = read_study_of(directory);
  auto content = Journal::read(directory / "study.journal");
  const Design design = design_of(study, content);
  const StudyTable table = make_table(study, design, content.records, content.layouts);
  if (table.count(PointStatus::done) == 0)
    throw InputError({directory.string(), 0, 0}, "no point of this study is done, so there is nothing to report.");
  resolve_results(study, table);
  const Json summary = summary_with_kept_surrogates(directory, study, design, table);

  Json data;
  data["title"] = "Study " + study.name;
  data["subtitle"] = fmt::format("case {}, {} design", study.base.name, name_of(design.kind));
  data["design"] = name_of(design.kind);
  data["counts"] =
      fmt::format("{} drops: {} done, {} failed, {} not run.", table.n_points, table.count(PointStatus::done),
                  table.count(PointStatus::failed), table.count(PointStatus::not_run));
  for (const auto& told : {failed_text(summary), without_contact_text(summary)})
    if (!told.empty()) data["counts"] = data["counts"].get<std::string>() + " " + told;
  data["limits"] = summary["limits"];
  for (const char* key : {"choose", "minimise", "fit", "surrogate", "indices", "morris", "indices_method"})
    if (summary.contains(key)) data[key] = summary[key];
  if (study.fit) data["overlay"] = fit_overlay(study, summary["fit"], table);
  std::vector<std::size_t> done;
  data["points"] = Json::array();
  data["failed"] = Json::array();
  for (std::size_t k = 0; k < table.n_points; ++k) {
    if (table.status[k] == PointStatus::done) {
      done.push_back(k);
      data["points"].push_back(k);
    } else if (table.status[k] == PointStatus::failed && data["failed"].size() < 200) {
      Json values = Json::array();
      for (const auto& value : point_of(study, design, k).values) values.push_back(value_of(value));
      data["failed"].push_back({{"point", k}, {"values", values}, {"reason", table.reason[k]}});
    }
  }
  data["parameters"] = Json::array();
  for (const auto& p : study.parameters)
    data["parameters"].push_back({{"name", p.name}, {"unit", p.unit()}, {"values", Json::array()}});
  for (const auto k : done) {
    const StudyPoint point = point_of(study, design, k);
    for (std::size_t i = 0; i < study.parameters.size(); ++i)
      data["parameters"][i]["values"].push_back(value_of(point.values[i]));
  }
  data["results"] = Json::array();
  for (const auto* column : shown_results(study, table)) {
    Json values = Json::array();
    for (const auto k : done) values.push_back(rounded(column->values[k], digits));
    data["results"].push_back(
        {{"name", column->name}, {"unit", column->unit}, {"long_name", column->long_name}, {"values", values}});
  }
  data["rerun"] = "rotordrop study rerun " + shell_quoted(directory.string());
  const Json header = Json::parse(content.header, nullptr, false);
  data["facts"] = {
      {"program", "rotordrop " + (header.is_discarded() ? std::string("?") : header.value("program", "?"))},
      {"case", study.base.name},
      {"design", fmt::format("{}, {} rows, seed {}, {} replicates", name_of(design.kind), design.n_rows,
                             study.design.seed, study.n_replicates)},
      {"digest of case and points", header.is_discarded() ? "?" : header.value("study", "?")},
      {"CPU time", fmt::format("{:.4g} s", table.cpu_time)},
      {"study file", study.text}};
  return data;
}

std::string study_report_page(const Json& data) {
  return html_page(data, std::string(report_css) + study_css, std::string(chart_js) + study_js);
}

}  // namespace rotordrop
