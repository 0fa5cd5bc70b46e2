#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/watch/contact_impulse.h"
#include "base/rotation.h"
#include "study/drop/damage_summary.h"
#include "study/json_number.h"
#include "study/report/directions.h"
#include "study/report/report.h"
#include "study/report/time_words.h"
#include "study/result_names.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

/// One row: what, unit, and a text for each bearing. Rows that only some bearings have stand where these set them.
class Rows {
 public:
  explicit Rows(std::size_t n_columns) : n_columns_(n_columns) {}
  void set(std::size_t column, const std::string& name, const std::string& unit, const std::string& text) {
    if (column != column_) next_ = 0;
    column_ = column;
    const auto same = [&](const Json& row) { return row["name"] == name; };
    auto found = std::find_if(rows_.begin(), rows_.end(), same);
    if (found == rows_.end()) {
      const Json row{{"name", name}, {"unit", unit}, {"values", std::vector<std::string>(n_columns_)}};
      found = rows_.insert(rows_.begin() + next_, row);
    }
    next_ = found - rows_.begin() + 1;
    (*found)["values"][column] = text;
  }
  [[nodiscard]] Json take() { return std::move(rows_); }

 private:
  std::size_t n_columns_, column_ = 0;
  std::ptrdiff_t next_ = 0;  // behind the row that this column has set last
  Json rows_ = Json::array();
};

/// What the table calls a result. @param end  of the run [s]
std::string name_in_run(const ShownResult& r, double end) {
  const bool is_whole = r.pointer == std::string("/mean_contact_force_end") && end < averaging_time;
  return is_whole ? "mean contact force in the bore, whole run" : r.name;
}

/// @param ambient  [K]
/// @param end      of the run [s]
void add_summary(Rows& rows, std::size_t column, const Json& b, double ambient, double end) {
  for (const ShownResult& r : shown_results()) {
    const Json::json_pointer pointer(r.pointer);
    if (!b.contains(pointer)) continue;
    const Json& value = b.at(pointer);
    std::string text = "—";
    if (value.is_number()) {
      constexpr double largest_count = 1e6;
      const double shown = value.get<double>() * r.per_si;
      const bool is_count = *r.unit == 0 && shown < largest_count;  // of drops: what is left of one is none
      text = is_count ? fmt::format("{:.0f}", std::floor(shown * (1. + 1e-12)))
                      : fmt::format("{:.{}g}", shown, r.unit == std::string("rpm") ? 5 : 4);
      if (r.unit == std::string("K")) text += fmt::format(" ({})", in_celsius(ambient + value.get<double>()));
    }
    rows.set(column, name_in_run(r, end), r.unit, text);
  }
  if (b.contains("whirl")) {
    rows.set(column, "direction of longest whirl", "", b.at("whirl").at("direction").get<std::string>());
    rows.set(column, "full backward rub", "", b.at("whirl").at("full_rub").get<std::string>());
  }
}

void add_range(Rows& rows, std::size_t column, const TimeSeries& s, const std::string& name) {
  const auto [low, high] = std::minmax_element(s.values.begin(), s.values.end());
  rows.set(column, name + ", peak-to-peak", "um", fmt::format("{:.4g}", (*high - *low) * 1e6));
}

}  // namespace

Json report_acceptance(const Json& summary) {
  const Json& all = summary.at("accepted");
  Json rows = Json::array();
  for (const auto& l : summary.at("limits")) {
    const std::string unit = l.at("unit").get<std::string>();
    const ResultMeaning meaning = meaning_of(l.at("key").get<std::string>());
    const auto number = [&](const Json& value) {
      return value.is_number() ? in_words(value.get<double>(), unit) : std::string("—");
    };
    rows.push_back(
        {{"key", l.at("key")},
         {"meaning", meaning.long_name},
         {"value", (l.at("value").is_null() && l.at("accepted") == true ? "no limit found" : number(l.at("value"))) +
                       (l.contains("low")
                            ? fmt::format(" ({:.4g} to {:.4g})", l.at("low").get<double>(), l.at("high").get<double>())
                            : "")},
         {"limit", fmt::format("{} {}", l.at("kind") == "max" ? "≤" : "≥", number(l.at("limit")))},
         {"why", l.value("why", Json(nullptr))},
         {"usage", l.at("usage").is_number() ? fmt::format("{:.3g} %", 100. * l.at("usage").get<double>()) : "—"},
         {"state", l.at("accepted") == true    ? "ok"
                   : l.at("accepted") == false ? "warning"
                                               : "unknown"}});
  }
  const std::size_t n_warnings = summary.value("warnings", Json::array()).size();
  const std::string besides =
      n_warnings == 0 ? "" : fmt::format(" Warnings of the run, which are no limits: {}.", n_warnings);
  return {{"verdict", all == true    ? "Accepted: all limits are met in this drop." + besides
                      : all == false ? "Rejected: a limit is exceeded in this drop."
                                     : "Not accepted: not all limits could be assessed."},
          {"state", all == true    ? "ok"
                    : all == false ? "warning"
                                   : "unknown"},
          {"rows", rows}};
}

Json report_damage(const Json& summary) {
  Json rows = Json::array();
  for (const auto& [name, b] : summary.at("bearings").items()) {
    if (!b.contains("damage")) continue;
    const Json& d = b.at("damage");
    // What has no end allows any number of drops, and what did not happen none that anybody knows.
    const double without_value = is_assessed(d) ? 0. : std::nan("");
    const auto add = [&, bearing = name](const std::string& meaning, const char* value, const std::string& limit,
                                         double usage, const Json& basis) {
      const double number = number_at(d, value);
      const bool is_known = std::isfinite(usage);
      rows.push_back({{"key", basis.is_null() ? Json("the least of what was assessed above") : basis},
                      {"basis", basis.is_null() ? Json(nullptr) : Json(bearing + ", " + basis.get<std::string>())},
                      {"meaning", bearing + ": " + meaning},
                      {"value", std::isfinite(number) ? fmt::format("{:.4g}", number) : std::string("—")},
                      {"limit", limit},
                      {"usage", is_known ? fmt::format("{:.3g} %", 100. * usage) : std::string("—")},
                      {"state", !is_known     ? "unknown"
                                : usage <= 1. ? "ok"
                                              : "warning"}});
    };
    const auto basis = [&](std::size_t k) { return d.at("basis")[k].get<std::string>(); };
    const double required = number_at(d, "/required_static_safety"), safety = number_at(d, "/static_safety"),
                 drops = number_at(d, "/allowed_drops");
    add("static safety of the worst ball", "/static_safety", fmt::format("≥ {:.4g}", required),
        std::isfinite(safety) ? required / safety : without_value, basis(0));
    if (is_pressure_void(d) && safety >= required) rows.back()["state"] = "unknown";
    add("contact fatigue per drop, share of the life L10", "/fatigue/share", "≤ 1", number_at(d, "/fatigue/share"),
        basis(1));
    if (is_pressure_void(d) && number_at(d, "/fatigue/share") <= 1.) rows.back()["state"] = "unknown";
    add("wear per drop, share of the permitted depth", "/wear_share", "≤ 1", number_at(d, "/wear_share"), basis(2));
    const bool is_whole = !d.at("fatigue").is_null() && !d.at("wear_share").is_null() && !is_pressure_void(d);
    const std::string governed =
        d.at("governed_by") == "nothing" ? "" : ", by " + d.at("governed_by").get<std::string>();
    add("allowed number of such drops" + governed, "/allowed_drops", "≥ 1",
        std::isnan(drops) ? (is_whole ? without_value : std::nan(""))
        : drops > 0.      ? 1. / drops
                          : std::nan(""),
        nullptr);
    if (drops == 0.)
      rows.back()["state"] = "warning";
    else if (!is_whole)
      rows.back()["state"] = "unknown";
  }
  return rows;
}

Json report_numbers(const RecordedDrop& drop, const Json& summary) {
  const auto bearings = drop.bearings();
  Rows rows(bearings.size());
  Json names = Json::array();
  for (std::size_t i = 0; i < bearings.size(); ++i) {
    const std::string& name = bearings[i].first;
    names.push_back(name);
    if (!summary.is_null() && summary.contains("bearings") && summary.at("bearings").contains(name))
      add_summary(rows, i, summary.at("bearings")[name], drop.parameters().run.ambient,
                  number_at(summary, "/run/end_time"));
    for (const std::size_t axis : {1u, 2u})
      add_range(rows, i, drop.series("/bearings/" + name + "/orbit", axis - 1),
                displacement_along(drop.parameters().run.gravity, axis));
  }
  Json whole = Json::array();
  if (!summary.is_null()) {
    const auto fact = [&](const char* name, const Json& value, const char* unit, double scale) {
      if (value.is_number()) whole.push_back({name, fmt::format("{:.5g} {}", value.get<double>() * scale, unit)});
    };
    fact("rotor speed at the end", summary.at("rotor_speed_end"), "rpm", to_rpm);
    const Json& e = summary.at("energy");
    fact("mechanical energy dissipated", e.at("dissipated"), "J", 1.);
    fact("heat input to each thermal model", e.at("heat_deposited"), "J", 1.);
    fact("mechanical energy residual", e.at("residual"), "J", 1.);
    if (const double end = number_at(summary, "/run/end_time"); std::isfinite(end))
      whole.push_back({"simulated time", in_time(end)});
    fact("computing time", summary.at("run").at("wall_time"), "s", 1.);
  }
  return {{"bearings", names}, {"rows", rows.take()}, {"whole", whole}};
}

}  // namespace rotordrop
