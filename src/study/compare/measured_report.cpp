#include "study/compare/measured_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/parameters/suggestion.h"
#include "base/version.h"
#include "study/json_number.h"
#include "study/report/decimation.h"
#include "study/report/report.h"
#include "study/report/report_template.h"
#include "study/report/rounded.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;
constexpr std::size_t n_buckets = 700;  // as many as a figure has dots across

Json curve(const std::string& name, const TimeSeries& series) {
  const TimeSeries thin = decimated(series, n_buckets);
  return {{"name", name}, {"times", rounded(thin.times, 1., 7)}, {"values", rounded(thin.values, 1., 6)}};
}

/// What the sensor shows of all that was computed, between the measured times and beyond them, too.
TimeSeries whole(const TimeSeries& quantity, Measured by) {
  by.data.times = quantity.times;
  return {quantity.times, sensed(quantity, by)};
}

}  // namespace

Json measured_difference(const Measured& m, const std::vector<double>& computed) {
  const MeasuredDifference d = difference_of(m, computed);
  return {{"series", m.name},
          {"file", m.keys.file},
          {"unit", m.unit},
          {"n", d.n},
          {"after_end", m.after_end.times.size()},
          {"deviation", json_number(m.deviation)},
          {"rms", json_number(d.rms)},
          {"mean", json_number(d.mean)},
          {"largest", json_number(d.largest)},
          {"largest_time", json_number(d.largest_time)},
          {"share", json_number(d.share)}};
}

Json measured_overlay(const Measured& m, const std::vector<std::pair<std::string, TimeSeries>>& curves) {
  Json j{{"name", m.name},
         {"unit", m.unit},
         {"file", m.keys.file},
         {"measured", curve("measured", m.data)},
         {"curves", Json::array()}};
  for (const auto& [name, series] : curves) j["curves"].push_back(curve(name, series));
  return j;
}

std::string measured_text(const Json& differences) {
  std::string text = "Measured less computed:\n";
  for (const auto& d : differences) {
    const std::string unit = d["unit"];
    const auto number = [&](const char* key) {
      return d[key].is_number() ? fmt::format("{:.4g} {}", d[key].get<double>(), unit) : std::string("?");
    };
    text += fmt::format(
        "  {}: {} values{}, rms {}{}, mean {}, largest {} at {:.6g} s; {}\n", d["series"].get<std::string>(),
        d["n"].get<std::size_t>(),
        d["after_end"] == 0 ? "" : fmt::format(" ({} after the end of the drop left out)", d["after_end"].get<int>()),
        number("rms"), d.contains("rms_start") ? " (at the start " + number("rms_start") + ")" : "", number("mean"),
        number("largest"), d["largest_time"].get<double>(),
        d["share"].is_number() ? fmt::format("{:.4g} % of the variance explained", 100. * d["share"].get<double>())
                               : std::string("the measured values do not vary"));
  }
  return text;
}

MeasuredComparison compare_with_measured(const RecordedDrop& drop, const std::vector<Measured>& measured) {
  MeasuredComparison made;
  Json figures = Json::array();
  made.report = {{"program", program_name()}, {"case", drop.case_name()}, {"measured", Json::array()}};
  for (const auto& m : measured) {
    if (!drop.has(m.keys.series))
      throw InputError({m.keys.file, 0, 0}, fmt::format("the drop has no series {}.", m.keys.series),
                       suggestion(m.keys.series, drop.datasets(), "docs/reference/results.md lists them."));
    const std::string unit = drop.meaning(m.keys.series).unit;
    if (!m.unit.empty() && !is_same_unit(m.unit, unit))
      throw InputError({m.keys.file, 0, 0},
                       fmt::format("{} is in {}, but the measured values are in {}.", m.keys.series, unit, m.unit));
    const auto column = static_cast<std::size_t>(m.keys.component);
    if (const std::size_t n_columns = drop.table(m.keys.series).n_columns; column >= n_columns)
      throw InputError(
          {m.keys.file, 0, 0},
          fmt::format("component {}: {} has {} column{}.", column, m.keys.series, n_columns, n_columns == 1 ? "" : "s"),
          "Columns count from 0.");
    Measured own = m;
    own.unit = unit;
    const TimeSeries quantity = drop.series(m.keys.series, column);
    leave_out_after(own, quantity.times.back(), {m.keys.file, 0, 0});
    const auto computed = sensed(quantity, own);
    made.report["measured"].push_back(measured_difference(own, computed));
    figures.push_back(measured_overlay(own, {{"computed", whole(quantity, own)}}));
  }
  const Json data{{"title", "Measured and computed: " + drop.case_name()},
                  {"overlay", std::move(figures)},
                  {"measured", made.report["measured"]}};
  made.page = html_page(data, std::string(report_css) + study_css, std::string(chart_js) + measured_js);
  return made;
}

}  // namespace rotordrop
