#include "study/many/answers/surrogate_summary.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "study/json_number.h"
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

/// Each fold by a surrogate of the others; NaN where none could be made.
std::vector<double> predictions(const SurrogateParameters& keys, std::size_t n_inputs, const Rows& all,
                                std::uint64_t seed, std::string& error) {
  const auto n_folds = static_cast<std::uint64_t>(keys.folds);
  std::vector<double> predicted(all.y.size(), std::nan(""));
  for (std::uint64_t fold = 0; fold < n_folds; ++fold) {
    std::vector<std::size_t> inside, outside;
    for (std::size_t i = 0; i < all.y.size(); ++i)
      (mixed(mixed(seed) ^ all.row[i]) % n_folds == fold ? inside : outside).push_back(i);
    if (inside.empty() || outside.empty()) continue;
    const auto surrogate = made(keys, n_inputs, selected(all, n_inputs, outside), error);
    if (!surrogate) return predicted;
    const auto values = surrogate->at(selected(all, n_inputs, inside).x);
    for (std::size_t i = 0; i < inside.size(); ++i) predicted[inside[i]] = values[i];
  }
  return predicted;
}

Json summary_of(const Study& study, const Design& design, const ResultColumn& column) {
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
  Json j{{"unit", column.unit}, {"n", all.y.size()}, {"q2", nullptr}, {"rmse", nullptr}, {"reason", ""}};
  const std::size_t fewest = 2 * (d + 1);
  std::string error =
      all.y.size() < fewest ? fmt::format("{} points are too few; {} are needed at least", all.y.size(), fewest) : "";
  const auto whole = error.empty() ? made(keys, d, all, error) : nullptr;
  std::vector<double> predicted;
  if (whole) predicted = predictions(keys, d, all, static_cast<std::uint64_t>(study.design.seed), error);
  j["reason"] = error;
  if (!error.empty()) return j;
  double mean = 0., squares = 0., about_mean = 0.;
  for (const double y : all.y) mean += y / static_cast<double>(all.y.size());
  for (std::size_t i = 0; i < all.y.size(); ++i) {
    squares += std::pow(all.y[i] - predicted[i], 2);
    about_mean += std::pow(all.y[i] - mean, 2);
  }
  j["rmse"] = std::sqrt(squares / static_cast<double>(all.y.size()));
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

}  // namespace

Json surrogate_summary(const Study& study, const Design& design, const StudyTable& table) {
  const auto& keys = *study.surrogate;
  Json j{{"kind", keys.kind == SurrogateKind::kriging ? "kriging" : "polynomial-chaos"},
         {"folds", keys.folds},
         {"results", Json::object()}};
  for (const auto& name : study.surrogate_results)
    if (const auto* column = table.find(name)) j["results"][name] = summary_of(study, design, *column);
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
    text += fmt::format("  {}: explains {:.3g} % of the variance, rms error {:.4g} {}\n", name,
                        s["q2"].is_number() ? 100. * s["q2"].get<double>() : std::nan(""), s["rmse"].get<double>(),
                        s["unit"].get<std::string>());
  }
  return text;
}

}  // namespace rotordrop
