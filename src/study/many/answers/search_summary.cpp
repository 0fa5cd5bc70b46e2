#include "study/many/answers/search_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "study/json_number.h"
#include "study/many/answers/result_check.h"
#include "study/many/answers/statistics.h"
#include "study/many/search/evaluation.h"
#include "study/many/search/search_space.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

/// Values of a result in the drops of one evaluation.
class StepValues {
 public:
  StepValues(const Study& study, const Design& design, const StudyTable& table)
      : table_(table), n_drops_(design.rows_per_step * static_cast<std::size_t>(study.n_replicates)) {}
  [[nodiscard]] std::size_t first(std::size_t step) const { return step * n_drops_; }
  [[nodiscard]] std::size_t last(std::size_t step) const { return first(step) + n_drops_ - 1; }
  [[nodiscard]] std::vector<double> of(std::size_t step, const std::string& result) const {
    const ResultColumn* column = table_.find(result);
    if (!column) return std::vector<double>(n_drops_, std::nan(""));
    const auto begin = column->values.begin() + static_cast<std::ptrdiff_t>(first(step));
    return {begin, begin + static_cast<std::ptrdiff_t>(n_drops_)};
  }

 private:
  const StudyTable& table_;
  std::size_t n_drops_;
};

/// 95 % interval of the mean of drops (Student's t), or of their quantile. Replicates of several rows are not independent: the mean of each row counts
/// once, and quantiles have no interval. Those of one row are a sample of what chaos leaves.
/// @param values  row after row
Estimate interval_of(const Study& study, std::vector<double> values) {
  const MinimiseParameters& minimise = *study.minimise;
  const auto n_all = static_cast<std::size_t>(study.n_replicates);
  const std::size_t n_replicates = values.size() > n_all ? n_all : 1;
  Estimate e{statistic_of(minimise, values), {}, {}};
  if (values.size() < 2 * n_replicates) return e;
  if (minimise.of == DropStatistic::quantile) {
    if (n_replicates > 1) return e;
    std::sort(values.begin(), values.end());
    return quantile_estimate(values, minimise.quantile);
  }
  for (std::size_t row = 0; row < values.size() / n_replicates; ++row) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(row * n_replicates);
    values[row] = mean_of({first, first + static_cast<std::ptrdiff_t>(n_replicates)});
  }
  values.resize(values.size() / n_replicates);
  const auto n = static_cast<double>(values.size());
  const double half =
      boost::math::quantile(boost::math::students_t(n - 1.), 0.975) * deviation_of(values) / std::sqrt(n);
  e.low = e.value - half;
  e.high = e.value + half;
  return e;
}

Json limits_of(const Study& study, const StepValues& values, const LimitVerdicts& verdicts, std::size_t step) {
  Json list = Json::array();
  for (const auto& limit : study.limits) {
    const auto all = values.of(step, limit.pattern);
    Json one{{"result", limit.pattern}, {"unit", unit_of_result(study, limit.pattern)}};
    if (limit.max) {
      one["max"] = *limit.max;
      one["value"] = json_number(statistic_of(*study.minimise, all));
    }
    if (limit.min) {
      one["min"] = *limit.min;
      one["lower_value"] = json_number(statistic_of(*study.minimise, all, true));
    }
    std::size_t n_undefined = 0;
    for (std::size_t k = values.first(step); k <= values.last(step); ++k)
      n_undefined += !verdicts.breaks(limit, k).is_broken;
    one["undefined"] = n_undefined;
    list.push_back(std::move(one));
  }
  return list;
}

/// Whether the last evaluation of a local search is better than its best allowed one, lies outside a limit, and no allowed one is near it.
/// @param course  evaluations of this search
bool ends_outside(const Study& study, const std::vector<const Json*>& course, const Json& best) {
  if (course.empty() || best.is_null()) return false;
  const Json& last = *course.back();
  if (study.minimise->method != MinimiseMethod::cobyla || last["within_limits"] == true || !last["value"].is_number() ||
      !(last["value"].get<double>() < best["value"].get<double>()))
    return false;
  const SearchSpace space(study);
  const auto place_of = [&](const Json& step) {
    std::vector<double> values;
    for (std::size_t i = 0; i < space.n_dimensions(); ++i)
      values.push_back(step["parameters"][space.parameter(i).name].get<double>());
    return space.place(values);
  };
  const auto end = place_of(last);
  return std::none_of(course.begin(), course.end(), [&](const Json* step) {
    if ((*step)["within_limits"] == false) return false;
    const auto place = place_of(*step);
    double distance = 0.;
    for (std::size_t i = 0; i < end.size(); ++i) distance = std::max(distance, std::fabs(place[i] - end[i]));
    return distance <= 2. * study.minimise->tolerance;
  });
}

/// Names of the parameters that lie nearer to an end of their range than a search tells apart.
Json at_ends(const Study& study, const Json& parameters) {
  const SearchSpace space(study);
  std::vector<double> values;
  for (std::size_t i = 0; i < space.n_dimensions(); ++i)
    values.push_back(parameters[space.parameter(i).name].get<double>());
  const auto place = space.place(values);
  Json names = Json::array();
  for (std::size_t i = 0; i < place.size(); ++i)
    if (std::min(place[i], 1. - place[i]) <= study.minimise->tolerance) names.push_back(space.parameter(i).name);
  return names;
}

}  // namespace

Json minimise_summary(const Study& study, const Design& design, const StudyTable& table,
                      const LimitVerdicts& verdicts) {
  const auto& minimise = *study.minimise;
  const StepValues values(study, design, table);
  const auto drawn = study.drawn();
  Json units = Json::object();
  for (const auto i : study.searched) units[study.parameters[drawn[i]].name] = study.parameters[drawn[i]].unit();
  Json j{{"result", minimise.result},
         {"unit", unit_of_result(study, minimise.result)},
         {"of", minimise.of == DropStatistic::mean ? "mean" : "quantile"},
         {"quantile", minimise.of == DropStatistic::mean ? Json(nullptr) : Json(minimise.quantile)},
         {"method", name_of(minimise.method)},
         {"units", std::move(units)},
         {"drops_of_evaluation", values.last(0) + 1},
         {"evaluations", design.steps.size()},
         {"searches", Json::array()},
         {"best", nullptr},
         {"start", nullptr},
         {"course", Json::array()}};
  std::vector<std::optional<std::size_t>> best_of(study.n_searches());
  std::vector<std::size_t> n_of(best_of.size());
  std::optional<std::size_t> best;
  for (std::size_t k = 0; k < design.steps.size(); ++k) {
    const SearchValue found = judged(study, [&](const std::string& result) { return values.of(k, result); });
    const bool is_allowed =
        std::isfinite(found.value) &&
        std::all_of(found.constraints.begin(), found.constraints.end(), [](double c) { return c <= 0.; });
    Json parameters = Json::object();
    for (const auto i : study.searched)
      parameters[study.parameters[drawn[i]].name] = design.value(k * design.rows_per_step, i).number();
    j["course"].push_back({{"search", design.steps[k].search},
                           {"evaluation", design.steps[k].evaluation},
                           {"points", {values.first(k), values.last(k)}},
                           {"parameters", std::move(parameters)},
                           {"value", json_number(found.value)},
                           {"within_limits", is_allowed}});
    auto& own = best_of.at(design.steps[k].search);
    ++n_of[design.steps[k].search];
    const auto is_better = [&](const std::optional<std::size_t>& than) {
      return is_allowed && (!than || found.value < j["course"][*than]["value"].get<double>());
    };
    if (is_better(own)) own = k;
    if (is_better(best)) best = k;
  }
  const auto entry = [&](std::size_t k) {
    Json one = j["course"][k];
    const Estimate e = interval_of(study, values.of(k, minimise.result));
    one["low"] = json_number(e.low);
    one["high"] = json_number(e.high);
    one["limits"] = limits_of(study, values, verdicts, k);
    one["at_end_of_range"] = at_ends(study, one["parameters"]);
    return one;
  };
  for (std::size_t s = 0; s < best_of.size(); ++s) {
    std::vector<const Json*> own;
    for (const auto& step : j["course"])
      if (step["search"] == s) own.push_back(&step);
    const Json its_best = best_of[s] ? j["course"][*best_of[s]] : Json(nullptr);
    j["searches"].push_back({{"evaluations", n_of[s]},
                             {"all_used", n_of[s] >= study.evaluations_of_search()},
                             {"ended_outside_limits", ends_outside(study, own, its_best)},
                             {"best", its_best}});
  }
  if (best) j["best"] = entry(*best);
  if (!design.steps.empty()) j["start"] = entry(0);
  return j;
}

namespace {

std::string five_digits(const Json& value, const std::string& unit = "1") {
  if (!value.is_number()) return "?";
  return fmt::format("{:.5g}{}", value.get<double>(), unit.empty() || unit == "1" ? "" : " " + unit);
}

}  // namespace

std::string minimise_text(const Json& j) {
  const std::string unit = j["unit"];
  const std::string what =
      j["of"] == "quantile"
          ? fmt::format("{:.3g} % quantile of {}", 100. * j["quantile"].get<double>(), j["result"].get<std::string>())
          : j["result"].get<std::string>();
  if (j["best"].is_null()) return fmt::format("{}: no evaluation keeps the limits\n", what);
  const Json& best = j["best"];
  std::string text = fmt::format("smallest {}: {}", what, five_digits(best["value"], unit));
  if (best["low"].is_number() || best["high"].is_number())
    text += fmt::format(" (95 % interval {} to {})", five_digits(best["low"]), five_digits(best["high"], unit));
  const Json& start = j["start"];
  text += fmt::format(", {} {}{}\n",
                      j["method"] == name_of(MinimiseMethod::direct) ? "in the middle of the ranges" : "at the start",
                      five_digits(start["value"], unit),
                      start["value"].is_number() && start["within_limits"] == false ? ", outside the limits" : "");
  const Json at_end = best.value("at_end_of_range", Json::array());
  for (const auto& [name, value] : best["parameters"].items())
    text += fmt::format("  {} = {}{}\n", name, five_digits(value, j["units"].value(name, "1")),
                        std::ranges::find(at_end, Json(name)) != at_end.end() ? "  <- end of its range" : "");
  for (const auto& limit : best["limits"]) {
    const std::string its = limit["unit"];
    if (limit.contains("max"))
      text += fmt::format("  {}: {}, at most {} allowed\n", limit["result"].get<std::string>(),
                          five_digits(limit["value"], its), five_digits(limit["max"], its));
    if (limit.contains("min"))
      text += fmt::format("  {}: {}, at least {} asked\n", limit["result"].get<std::string>(),
                          five_digits(limit["lower_value"], its), five_digits(limit["min"], its));
    if (const auto n = limit["undefined"].get<std::size_t>(); n > 0)
      text += fmt::format("  {}: {} of {} drops cannot be judged (docs/how-to/limits.md)\n",
                          limit["result"].get<std::string>(), n, j["drops_of_evaluation"].get<std::size_t>());
  }
  const auto first = best["points"][0].get<std::size_t>(), last = best["points"][1].get<std::size_t>();
  std::size_t n_all_used = 0, n_outside = 0;
  for (const auto& search : j["searches"]) {
    n_all_used += search["all_used"].get<bool>();
    n_outside += search.value("ended_outside_limits", false);
  }
  text += fmt::format("  found in {} evaluations by {}; {}\n", j["evaluations"].get<std::size_t>(),
                      j["method"].get<std::string>(),
                      first == last ? fmt::format("point {}", first) : fmt::format("points {} to {}", first, last));
  if (n_all_used > 0)
    text += fmt::format("  {} of {} searches used all their evaluations: a further one might find less\n", n_all_used,
                        j["searches"].size());
  if (n_outside > 0)
    text += fmt::format(
        "  {} of {} searches ended outside a limit, at a smaller value, with no evaluation left for steps back to the "
        "allowed side: give more evaluations\n",
        n_outside, j["searches"].size());
  return text;
}

}  // namespace rotordrop
