#include "study/many/answers/study_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/version.h"
#include "io/checkpoint.h"
#include "study/json_number.h"
#include "study/many/answers/fit_summary.h"
#include "study/many/answers/limit_verdicts.h"
#include "study/many/answers/search_summary.h"
#include "study/many/answers/sensitivity.h"
#include "study/many/answers/surrogate_summary.h"
#include "study/many/study_folder.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

constexpr double told_quantiles[] = {0.05, 0.25, 0.5, 0.75, 0.95};

Json to_json(const Estimate& e) {
  return {{"value", json_number(e.value)}, {"low", json_number(e.low)}, {"high", json_number(e.high)}};
}

Json to_json(const Node& node) {
  if (node.is_number()) return node.number();
  if (node.is(Node::Kind::boolean)) return node.boolean();
  return node.is_text() ? node.text() : to_text(node);
}

std::vector<double> finite_of(const ResultColumn& column, const std::vector<std::size_t>& points) {
  std::vector<double> values;
  for (const auto k : points)
    if (std::isfinite(column.values[k])) values.push_back(column.values[k]);
  return values;
}

std::vector<std::size_t> all_points(const StudyTable& table) {
  std::vector<std::size_t> points(table.n_points);
  for (std::size_t k = 0; k < points.size(); ++k) points[k] = k;
  return points;
}

/// Part of a result's variance that lies between starts next to each other.
std::optional<double> replicate_share(const Study& study, const Design& design, const ResultColumn& column) {
  const auto n = static_cast<std::size_t>(study.n_replicates);
  std::vector<std::vector<double>> rows(design.n_rows);
  for (std::size_t k = 0; k < design.n_rows * n; ++k)
    if (std::isfinite(column.values[k])) rows[k / n].push_back(column.values[k]);
  return share_within(rows);
}

/// @param n_failed  of the points
Json result_summary(const Study& study, const Design& design, const ResultColumn& column,
                    const std::vector<std::size_t>& points, std::size_t n_failed) {
  auto values = finite_of(column, points);
  Json j{{"unit", column.unit}, {"long_name", column.long_name}, {"n", values.size()}, {"failed", n_failed}};
  if (values.empty()) {
    j["mean"] = nullptr;
    return j;
  }
  std::sort(values.begin(), values.end());
  j["mean"] = mean_of(values);
  j["standard_deviation"] = values.size() > 1 ? Json(deviation_of(values)) : Json(nullptr);
  j["smallest"] = values.front();
  j["largest"] = values.back();
  const bool is_sample = !sample_points(study, design).empty();
  for (const double p : told_quantiles) {
    const auto q = quantile_estimate(values, p);
    const std::string name = fmt::format("{:.2f}", p);
    j["quantiles"][name] = q.value;
    if (!is_sample || study.n_replicates > 1) continue;
    j["quantiles_low"][name] = json_number(q.low);
    j["quantiles_high"][name] = json_number(q.high);
  }
  if (study.n_replicates > 1) j["replicate_share"] = json_number(replicate_share(study, design, column));
  return j;
}

Json limit_summary(const Study& study, const Design& design, const StudyTable& table, const LimitVerdicts& verdicts,
                   const Limit& limit) {
  Json j{{"result", limit.pattern}, {"max", json_number(limit.max)}, {"min", json_number(limit.min)}};
  const ResultColumn* column = table.find(limit.pattern);
  auto points = sample_points(study, design);
  const bool is_sample = !points.empty();
  if (!is_sample) points = all_points(table);
  const auto n_replicates = static_cast<std::size_t>(study.n_replicates);
  double rows = 0., hits = 0.;
  std::size_t n = 0, broken = 0, n_undefined = 0;
  Json undefined = Json::object();
  std::map<std::size_t, std::pair<double, double>> of_row;
  for (const auto k : points) {
    if (table.status[k] == PointStatus::not_run) continue;
    const auto [is_broken, why] = verdicts.breaks(limit, k);
    if (!is_broken) {
      ++n_undefined;
      undefined[why] = undefined.value(why, std::size_t{0}) + 1;
      continue;
    }
    ++n;
    broken += *is_broken;
    auto& row = of_row[k / n_replicates];
    row.first += *is_broken;
    row.second += 1.;
  }
  for (const auto& [row, counts] : of_row) {
    rows += 1.;
    hits += counts.first / counts.second;
  }
  j["unit"] = column ? column->unit : "";
  j["n"] = n;
  j["broken"] = broken;
  j["undefined"] = n_undefined;
  j["undefined_because"] = undefined;
  if (rows == 0.) {
    j["probability"] = nullptr;
    return j;
  }
  // Replicates of a row are not independent: the interval counts each row once.
  const Estimate p = probability_estimate(hits, rows);
  j["probability"] = p.value;
  j["low"] = is_sample ? json_number(p.low) : Json(nullptr);
  j["high"] = is_sample ? json_number(p.high) : Json(nullptr);
  j["interval"] =
      is_sample ? "Clopper-Pearson, 95 %" : "none: the design is not a sample, so this is a share of its points";
  return j;
}

Json choice_summary(const Study& study, const Design& design, const StudyTable& table) {
  const Choice& choice = *study.choice;
  std::size_t index = 0;
  while (study.parameters[index].name != choice.parameter) ++index;
  const ResultColumn* column = table.find(choice.result);
  struct Level {
    Json value;
    std::vector<double> results;
    std::size_t n_without = 0, n_failed = 0, n_not_run = 0;
  };
  std::vector<Level> levels;
  // A small sample may leave out values of a list, by weights or by chance.
  for (const auto& node : study.parameters[index].distribution.values)
    if (const Json value = to_json(node);
        std::none_of(levels.begin(), levels.end(), [&](const Level& l) { return l.value == value; }))
      levels.push_back({value, {}});
  auto points = sample_points(study, design);
  // Replicates of a row are not independent, and a grid is no sample.
  const bool has_intervals = !points.empty() && study.n_replicates == 1;
  if (points.empty()) points = all_points(table);
  for (const std::size_t k : points) {
    const Json value = to_json(point_of(study, design, k).values[index]);
    auto level = std::find_if(levels.begin(), levels.end(), [&](const Level& l) { return l.value == value; });
    if (level == levels.end()) level = levels.insert(levels.end(), {value, {}});
    if (column && std::isfinite(column->values[k]))
      level->results.push_back(column->values[k]);
    else if (table.status[k] == PointStatus::not_run)
      ++level->n_not_run;
    else {
      ++level->n_without;
      level->n_failed += table.status[k] == PointStatus::failed;
    }
  }
  std::stable_sort(levels.begin(), levels.end(), [](const Level& a, const Level& b) {
    return a.value.is_number() && b.value.is_number() && a.value.get<double>() < b.value.get<double>();
  });
  Json j{{"parameter", choice.parameter}, {"unit", study.parameters[index].unit()},
         {"result", choice.result},       {"result_unit", column ? column->unit : ""},
         {"quantile", choice.quantile},   {"levels", Json::array()}};
  std::optional<std::size_t> best;
  bool is_all_drawn = true;
  for (auto& level : levels) {
    Json one{{"value", level.value},
             {"n", level.results.size()},
             {"without_result", level.n_without},
             {"failed", level.n_failed},
             {"not_run", level.n_not_run}};
    if (level.results.size() + level.n_without + level.n_not_run == 0) {
      one["not_drawn"] = true;
      is_all_drawn = false;
    }
    if (!level.results.empty()) {
      std::sort(level.results.begin(), level.results.end());
      const Estimate q = quantile_estimate(level.results, choice.quantile);
      one["quantile"] = q.value;
      one["low"] = has_intervals ? json_number(q.low) : Json(nullptr);
      one["high"] = has_intervals ? json_number(q.high) : Json(nullptr);
      one["mean"] = mean_of(level.results);
      one["smallest"] = level.results.front();
      one["largest"] = level.results.back();
      // Of drops without the result nobody knows whether they would be better or worse.
      if (level.n_without + level.n_not_run == 0 && (!best || q.value < j["levels"][*best]["quantile"].get<double>()))
        best = j["levels"].size();
    }
    j["levels"].push_back(std::move(one));
  }
  j["best"] = best ? j["levels"][*best] : Json(nullptr);
  j["all_drawn"] = is_all_drawn;
  return j;
}

std::vector<std::vector<double>> drawn_columns(const Study& study, const Design& design) {
  const auto drawn = study.drawn();
  std::vector<std::vector<double>> x(drawn.size(), std::vector<double>(design.n_rows));
  for (std::size_t row = 0; row < design.n_rows; ++row)
    for (std::size_t j = 0; j < drawn.size(); ++j) x[j][row] = design.cells[row * drawn.size() + j];
  return x;
}

bool has_enough(const std::vector<double>& y) {
  return std::ranges::count_if(y, [](double v) { return std::isfinite(v); }) >= 8;
}

void add_indices(Json& j, const Study& study, const Design& design, const StudyTable& table) {
  const auto drawn = study.drawn();
  const auto seed = static_cast<std::uint64_t>(study.design.seed);
  const auto name = [&](std::size_t i) { return study.parameters[drawn[i]].name; };
  const bool is_saltelli = design.kind == DesignKind::saltelli, is_morris = design.kind == DesignKind::morris;
  const bool is_sample = !is_saltelli && !sample_points(study, design).empty();
  if (!is_saltelli && !is_morris && !is_sample) return;
  const FirstBy by = design.kind == DesignKind::sobol_sequence ? FirstBy::classes : FirstBy::ranks;
  j["indices_method"] =
      is_saltelli ? "Sobol indices: first by Saltelli et al. 2010, total by Jansen 1999; bootstrap of blocks, 95 %"
      : is_morris ? "elementary effects per range (Morris 1991); bootstrap of effects, 95 %"
      : by == FirstBy::classes ? "first indices by classes (Plischke et al. 2013); delete-half jackknife, 95 %"
                               : "first indices by differences of neighbours (Rice 1984); delete-half jackknife, 95 %";
  std::optional<FirstIndices> sample;
  if (is_sample) sample.emplace(by, drawn_columns(study, design), seed);
  Json& to = j[is_morris ? "morris" : "indices"];
  to = Json::object();
  for (const auto& column : table.results) {
    const auto y = row_means(study, design, column);
    if (!has_enough(y) || !varies(y)) continue;
    Json of_result = Json::object();
    if (is_saltelli) {
      const auto sobol = sobol_indices(y, drawn.size(), seed);
      for (std::size_t i = 0; i < sobol.parameters.size(); ++i)
        of_result[name(i)] = {{"first", to_json(sobol.parameters[i].first)},
                              {"total", to_json(sobol.parameters[i].total)}};
      j["blocks_left_out"][column.name] = sobol.n_left_out;
    } else if (is_morris) {
      const auto effects = morris_effects(design.unit, y, drawn.size(), seed);
      for (std::size_t i = 0; i < effects.size(); ++i)
        of_result[name(i)] = {{"mean", json_number(effects[i].mean)},
                              {"mean_magnitude", to_json(effects[i].mean_magnitude)},
                              {"deviation", json_number(effects[i].deviation)},
                              {"n", effects[i].n}};
    } else {
      const auto first = sample->first(y);
      for (std::size_t i = 0; i < first.size(); ++i) of_result[name(i)] = {{"first", to_json(first[i])}};
    }
    if (!of_result.empty()) to[column.name] = std::move(of_result);
  }
}

Json parameter_summary(const VariedParameter& p) {
  Json j{{"unit", p.unit()}, {"keys", Json::array()}};
  for (const auto& key : p.keys) j["keys"].push_back(key.name);
  if (p.formula) {
    j["formula"] = p.formula->text();
    return j;
  }
  const auto& d = p.distribution;
  j["distribution"] = name_of(d.kind);
  using K = Distribution::Kind;
  if (d.kind == K::values)
    for (const auto& value : d.values) j["values"].push_back(to_json(value));
  if (!d.weights.empty()) j["weights"] = d.weights;
  if (d.kind != K::values && d.kind != K::normal) {
    j["lower"] = d.lower;
    j["upper"] = d.upper;
  }
  if (d.kind == K::normal || d.kind == K::truncated_normal) {
    j["mean"] = d.mean;
    j["deviation"] = d.deviation;
  }
  if (d.kind == K::triangular) j["mode"] = d.mode;
  return j;
}

}  // namespace

std::vector<double> row_means(const Study& study, const Design& design, const ResultColumn& column) {
  const auto n = static_cast<std::size_t>(study.n_replicates);
  std::vector<double> means(design.n_rows, std::nan(""));
  for (std::size_t row = 0; row < design.n_rows; ++row) {
    double sum = 0., count = 0.;
    for (std::size_t r = 0; r < n; ++r)
      if (const double v = column.values[row * n + r]; std::isfinite(v)) {
        sum += v;
        count += 1.;
      }
    if (count > 0.) means[row] = sum / count;
  }
  return means;
}

std::vector<std::size_t> sample_points(const Study& study, const Design& design) {
  std::vector<std::size_t> points;
  const auto n = static_cast<std::size_t>(study.n_replicates);
  const bool is_saltelli = design.kind == DesignKind::saltelli;
  if (!is_saltelli && design.kind != DesignKind::latin_hypercube && design.kind != DesignKind::sobol_sequence &&
      design.kind != DesignKind::monte_carlo)
    return points;
  for (std::size_t row = 0; row < design.n_rows; ++row) {
    if (is_saltelli && row % (design.n_drawn + 2) > 1) continue;  // A and B are samples
    for (std::size_t r = 0; r < n; ++r) points.push_back(row * n + r);
  }
  return points;
}

Json study_summary(const Study& study, const Design& design, const StudyTable& table, const SummaryWatch& watch) {
  Json j{{"program", program_name()},
         {"study", study.name},
         {"case", study.base.name},
         {"points", table.n_points},
         {"done", table.count(PointStatus::done)},
         {"failed", table.count(PointStatus::failed)},
         {"not_run", table.count(PointStatus::not_run)},
         {"cpu_time", table.cpu_time}};
  j["design"] = {{"kind", name_of(design.kind)},
                 {"rows", design.n_rows},
                 {"replicates", study.n_replicates},
                 {"seed", study.design.seed}};
  if (study.design.size) j["design"]["size"] = *study.design.size;
  j["parameters"] = Json::object();
  for (const auto& p : study.parameters) j["parameters"][p.name] = parameter_summary(p);
  const LimitVerdicts verdicts(table, study.limits);
  j["without_contact"] = verdicts.n_without_contact();
  j["limits"] = Json::array();
  for (const auto& limit : study.limits) j["limits"].push_back(limit_summary(study, design, table, verdicts, limit));
  if (study.fit) j["fit"] = fit_summary(study, design, table);
  if (study.minimise) j["minimise"] = minimise_summary(study, design, table, verdicts);
  if (study.choice) j["choose"] = choice_summary(study, design, table);
  auto points = sample_points(study, design);
  if (points.empty()) points = all_points(table);
  j["results"] = Json::object();
  const auto n_failed = static_cast<std::size_t>(
      std::ranges::count_if(points, [&](std::size_t k) { return table.status[k] == PointStatus::failed; }));
  for (const auto& column : table.results)
    j["results"][column.name] = result_summary(study, design, column, points, n_failed);
  add_indices(j, study, design, table);
  if (study.surrogate) j["surrogate"] = surrogate_summary(study, design, table, watch);
  return j;
}

void write_results(const std::filesystem::path& directory, const Study& study, const Design& design,
                   const StudyTable& table, const std::string& digest, const SummaryWatch& watch,
                   const std::vector<ShardFile>& shards) {
  const Json summary = study_summary(study, design, table, watch);
  write_study_hdf5(directory / "study.h5", study, design, table, digest, shards);
  write_study_csv(directory / "study.csv", study, design, table);
  write_text_atomically(directory / "study.json", summary.dump(2) + "\n");
}

}  // namespace rotordrop
