#include "study/many/answers/surrogate_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "study/json_number.h"
#include "study/many/answers/statistics.h"
#include "study/many/answers/study_summary.h"
#include "study/many/random_bits.h"
#include "study/many/surrogate/surrogate.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

/// Rows of a sample with their values.
struct Rows {
  std::vector<std::size_t> row;
  std::vector<double> x, y;
};

Rows selected(const Rows& all, std::size_t n_inputs, const std::vector<std::size_t>& which) {
  Rows some;
  for (const auto i : which) {
    some.row.push_back(all.row[i]);
    some.x.insert(some.x.end(), all.x.begin() + static_cast<std::ptrdiff_t>(i * n_inputs),
                  all.x.begin() + static_cast<std::ptrdiff_t>((i + 1) * n_inputs));
    some.y.push_back(all.y[i]);
  }
  return some;
}

std::unique_ptr<Surrogate> made(const SurrogateParameters& keys, std::size_t n_inputs, const Rows& rows,
                                std::string& error) {
  return std::unique_ptr<Surrogate>(surrogate_maker()(
      {keys.kind == SurrogateKind::kriging, static_cast<std::size_t>(keys.degree), n_inputs, rows.x, rows.y}, error));
}

/// Part of each row, of equal size, by chance. Rows of a block of Saltelli's design, which share coordinates, are of the same part: a point that
/// differs in a parameter without influence would tell its neighbour's value.
std::vector<std::size_t> folds_of(const Study& study, const Design& design, const Rows& all) {
  const std::size_t per_block = design.n_blocks > 0 ? design.n_rows / design.n_blocks : 1;
  const auto seed = static_cast<std::uint64_t>(study.design.seed);
  std::set<std::pair<std::uint64_t, std::size_t>> blocks;  // in an order by chance
  for (const std::size_t row : all.row) blocks.emplace(mixed(mixed(seed) ^ (row / per_block)), row / per_block);
  std::map<std::size_t, std::size_t> fold;
  for (const auto& [number, block] : blocks)
    fold.emplace(block, fold.size() % static_cast<std::size_t>(study.surrogate->folds));
  std::vector<std::size_t> folds;
  for (const std::size_t row : all.row) folds.push_back(fold[row / per_block]);
  return folds;
}

/// Each fold by a surrogate of the others; NaN where none could be made.
std::vector<double> predictions(const SurrogateParameters& keys, std::size_t n_inputs, const Rows& all,
                                const std::vector<std::size_t>& folds, const SummaryWatch& watch, std::string& error) {
  std::vector<double> predicted(all.y.size(), std::nan(""));
  for (std::size_t fold = 0; fold < static_cast<std::size_t>(keys.folds); ++fold) {
    std::vector<std::size_t> inside, outside;
    for (std::size_t i = 0; i < all.y.size(); ++i) (folds[i] == fold ? inside : outside).push_back(i);
    if (inside.empty() || outside.empty()) continue;
    const Rows known = selected(all, n_inputs, outside);
    std::vector<double> values(inside.size(), known.y.front());
    if (varies(known.y)) {
      watch.begins(fmt::format("validation {} of {}", fold + 1, keys.folds));
      const auto surrogate = made(keys, n_inputs, known, error);
      if (!surrogate) return predicted;
      values = surrogate->at(selected(all, n_inputs, inside).x);
    }
    for (std::size_t i = 0; i < inside.size(); ++i) predicted[inside[i]] = values[i];
  }
  return predicted;
}

/// Why no surrogate is made of a sample; empty: one is.
std::string why_none(const SurrogateParameters& keys, std::size_t n_inputs, const Rows& all) {
  constexpr std::size_t most_of_kriging = 1000;  // its time goes with the cube: 7 s there, of 3 parameters on a Zen 5
  const std::size_t n = all.y.size(), fewest = 2 * (n_inputs + 1);
  if (n < fewest) return fmt::format("{} points are too few; {} are needed at least", n, fewest);
  if (!varies(all.y)) return "it does not vary";
  if (keys.kind == SurrogateKind::kriging && n > most_of_kriging)
    return fmt::format("kriging takes up to {} points, and there are {}", most_of_kriging, n);
  return {};
}

/// What stands of a result whether it has a surrogate or not.
Json summary_without(const std::string& unit, std::size_t n, const Design& design, const std::string& reason) {
  return {{"unit", unit}, {"n", n}, {"points", design.n_rows}, {"q2", nullptr}, {"rmse", nullptr}, {"reason", reason}};
}

Json summary_of(const Study& study, const Design& design, const ResultColumn& column, const SummaryWatch& watch) {
  const auto& keys = *study.surrogate;
  const auto means = row_means(study, design, column);
  const std::size_t d = design.n_drawn;
  Rows all;
  for (std::size_t row = 0; row < design.n_rows; ++row) {
    if (!std::isfinite(means[row])) continue;
    all.row.push_back(row);
    all.x.insert(all.x.end(), design.unit.begin() + static_cast<std::ptrdiff_t>(row * d),
                 design.unit.begin() + static_cast<std::ptrdiff_t>((row + 1) * d));
    all.y.push_back(means[row]);
  }
  Json j = summary_without(column.unit, all.y.size(), design, "");
  std::string error = why_none(keys, d, all);
  if (error.empty()) watch.begins("all points");
  const auto whole = error.empty() ? made(keys, d, all, error) : nullptr;
  std::vector<double> predicted;
  if (whole) predicted = predictions(keys, d, all, folds_of(study, design, all), watch, error);
  if (error.empty() && !std::all_of(predicted.begin(), predicted.end(), [](double y) { return std::isfinite(y); }))
    error = "points that it has not seen could not be predicted";
  j["reason"] = error;
  if (!error.empty()) return j;
  double mean = 0., squares = 0., about_mean = 0.;
  for (const double y : all.y) mean += y / static_cast<double>(all.y.size());
  for (std::size_t i = 0; i < all.y.size(); ++i) {
    squares += std::pow(all.y[i] - predicted[i], 2);
    about_mean += std::pow(all.y[i] - mean, 2);
  }
  j["rmse"] = json_number(std::sqrt(squares / static_cast<double>(all.y.size())));
  j["q2"] = json_number(about_mean > 0. ? 1. - squares / about_mean : std::nan(""));
  j["terms"] = whole->n_terms();
  if (keys.kind == SurrogateKind::polynomial_chaos) {
    const auto drawn = study.drawn();
    for (std::size_t i = 0; i < d; ++i)
      j["indices"][study.parameters[drawn[i]].name] = {{"first", json_number(whole->first_index(i))},
                                                       {"total", json_number(whole->total_index(i))}};
  }
  j["computed"] = all.y;
  j["predicted"] = predicted;
  return j;
}

std::string explained(const Json& q2) {
  if (!q2.is_number()) return "an unknown part";
  return q2.get<double>() > 0. ? fmt::format("{:.3g} %", 100. * q2.get<double>()) : "nothing";
}

}  // namespace

Json surrogate_summary(const Study& study, const Design& design, const StudyTable& table, const SummaryWatch& watch) {
  const auto& keys = *study.surrogate;
  Json j{{"kind", keys.kind == SurrogateKind::kriging ? "kriging" : "polynomial-chaos"},
         {"folds", keys.folds},
         {"results", Json::object()}};
  const std::size_t n = study.surrogate_results.size();
  for (std::size_t i = 0; i < n; ++i) {
    const auto& name = study.surrogate_results[i];
    const auto* column = table.find(name);
    const SummaryWatch of_this{watch.stop, [&](const std::string& part) {
                                 if (watch.tell)
                                   watch.tell(fmt::format("surrogate {} of {}, {}: {}", i + 1, n, name, part));
                               }};
    j["results"][name] =
        column ? summary_of(study, design, *column, of_this) : summary_without("", 0, design, "no drop has it");
  }
  return j;
}

std::string surrogate_text(const Json& j) {
  std::string text =
      fmt::format("Surrogates ({}), validated on points that they have not seen:\n", j["kind"].get<std::string>());
  for (const auto& [name, s] : j["results"].items()) {
    if (!s["reason"].get<std::string>().empty()) {
      text += fmt::format("  {}: none; {}\n", name, s["reason"].get<std::string>());
      continue;
    }
    const auto n = s["n"].get<std::size_t>(), points = s["points"].get<std::size_t>();
    text += fmt::format("  {}: explains {} of the variance, rms error {:.4g} {}{}\n", name, explained(s["q2"]),
                        s["rmse"].is_number() ? s["rmse"].get<double>() : std::nan(""), s["unit"].get<std::string>(),
                        n < points ? fmt::format("; from {} of {} points, the others have none", n, points) : "");
  }
  return text;
}

}  // namespace rotordrop
