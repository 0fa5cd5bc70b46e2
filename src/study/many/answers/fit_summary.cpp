#include "study/many/answers/fit_summary.h"

#include <fmt/format.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "study/compare/measured_report.h"
#include "study/json_number.h"
#include "study/many/search/fit_evaluation.h"
#include "study/many/search/least_squares.h"
#include "study/many/search/search_space.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

const std::vector<PointSeries>& series_of(const StudyTable& table, std::size_t point) {
  static const std::vector<PointSeries> none;
  const auto found = table.series.find(point);
  return found == table.series.end() ? none : found->second;
}

/// Where the evaluations of a search stand among the points (each has one drop).
struct SearchPoints {
  std::vector<std::size_t> course;   ///< of the search itself
  std::optional<std::size_t> found;  ///< drop at the values that it found
  std::vector<std::size_t> around;   ///< drops for derivatives there
};

std::vector<SearchPoints> points_of(const Study& study, const Design& design) {
  std::vector<SearchPoints> searches(study.n_searches());
  const auto last = static_cast<std::size_t>(study.fit->keys.evaluations);
  for (std::size_t k = 0; k < design.steps.size(); ++k) {
    auto& own = searches.at(design.steps[k].search);
    if (design.steps[k].evaluation < last)
      own.course.push_back(k);
    else if (design.steps[k].evaluation == last)
      own.found = k;
    else
      own.around.push_back(k);
  }
  return searches;
}

/// Covariance of the places [parameters, parameters].
struct Covariance {
  Eigen::MatrixXd matrix;
  double degrees_of_freedom = 0;
};

/// From the derivatives at the end. Noise of a known deviation: (J'J)^-1. Else each series tells its own noise by what differs, and the covariance is
/// (J'J)^-1 (sum of s_k^2 J_k'J_k) (J'J)^-1.
std::optional<Covariance> covariance(const Fit& fit, const Eigen::VectorXd& r, const Eigen::MatrixXd& J) {
  const auto n = static_cast<double>(r.size()), p = static_cast<double>(J.cols());
  if (J.size() == 0 || n <= p) return {};
  const Eigen::MatrixXd A = J.transpose() * J;
  const Eigen::LLT<Eigen::MatrixXd> factor(A);
  if (factor.info() != Eigen::Success) return {};
  const Eigen::MatrixXd inverse = factor.solve(Eigen::MatrixXd::Identity(J.cols(), J.cols()));
  if (!inverse.allFinite()) return {};
  if (fit.measured.front().deviation) return Covariance{inverse, n - p};
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(J.cols(), J.cols());
  Eigen::Index first = 0;
  for (const auto& m : fit.measured) {
    const auto n_k = static_cast<Eigen::Index>(m.data.values.size());
    const auto J_k = J.middleRows(first, n_k);
    const double freedom = static_cast<double>(n_k) * (1. - p / n);
    B += r.segment(first, n_k).squaredNorm() / freedom * (J_k.transpose() * J_k);
    first += n_k;
  }
  return Covariance{inverse * B * inverse, n - p};
}

/// What no measured value depends on has no variance, NaN, and leaves that of the others alone.
std::optional<Covariance> covariance_of_those_with_effect(const Fit& fit, const Eigen::VectorXd& r,
                                                          const Eigen::MatrixXd& J) {
  std::vector<Eigen::Index> with_effect;
  for (Eigen::Index i = 0; i < J.cols(); ++i)
    if (J.size() > 0 && J.col(i).squaredNorm() > 0.) with_effect.push_back(i);
  if (with_effect.empty()) return {};
  const auto some = covariance(fit, r, J(Eigen::all, with_effect));
  if (!some) return {};
  Covariance all{Eigen::MatrixXd::Constant(J.cols(), J.cols(), std::nan("")), some->degrees_of_freedom};
  all.matrix(with_effect, with_effect) = some->matrix;
  return all;
}

/// Drops of a fit by their points: parameters, place between the ends of their ranges, what differs from the measured.
class FitPoints {
 public:
  FitPoints(const Study& study, const Design& design, const StudyTable& table)
      : study_(study), design_(design), table_(table), space_(study) {}

  [[nodiscard]] const SearchSpace& space() const { return space_; }
  /// Value of a searched parameter, in its unit.
  [[nodiscard]] double value(std::size_t point, std::size_t searched) const {
    return design_.value(point, study_.searched[searched]).number();
  }
  [[nodiscard]] std::vector<double> place(std::size_t point) const {
    std::vector<double> values;
    for (std::size_t i = 0; i < study_.searched.size(); ++i) values.push_back(value(point, i));
    return space_.place(values);
  }
  [[nodiscard]] Json parameters(std::size_t point) const {
    Json j = Json::object();
    for (std::size_t i = 0; i < study_.searched.size(); ++i) j[space_.parameter(i).name] = value(point, i);
    return j;
  }
  [[nodiscard]] Eigen::VectorXd residuals(std::size_t point) const {
    return residuals_of(*study_.fit, series_of(table_, point));
  }
  /// NaN where the drop failed.
  [[nodiscard]] double sum_of_squares(std::size_t point) const {
    const auto r = residuals(point);
    return r.size() ? r.squaredNorm() : std::nan("");
  }
  /// Computed values of a measured series, NaN where the drop failed.
  [[nodiscard]] std::vector<double> computed(std::size_t point, std::size_t measured) const {
    for (const auto& s : series_of(table_, point))
      if (s.path == measured_path(measured)) return s.values;
    return std::vector<double>(study_.fit->measured[measured].data.values.size(), std::nan(""));
  }
  /// By the drops around what a search found [values, parameters]; empty where one of them is missing.
  [[nodiscard]] Eigen::MatrixXd derivatives_around(const SearchPoints& search) const {
    std::vector<std::vector<double>> places;
    std::vector<Eigen::VectorXd> around;
    for (const auto k : search.around) {
      places.push_back(place(k));
      around.push_back(residuals(k));
    }
    return around.size() == 2 * study_.searched.size() ? derivatives(places, around) : Eigen::MatrixXd();
  }

 private:
  const Study& study_;
  const Design& design_;
  const StudyTable& table_;
  const SearchSpace space_;
};

Json searches_json(const FitPoints& points, const std::vector<SearchPoints>& searches) {
  Json list = Json::array();
  for (const auto& search : searches)
    list.push_back({{"evaluations", search.course.size()},
                    {"sum_of_squares", json_number(search.found ? points.sum_of_squares(*search.found) : std::nan(""))},
                    {"parameters", search.found ? points.parameters(*search.found) : Json(nullptr)}});
  return list;
}

Json course_json(const FitPoints& points, const Design& design, const std::vector<SearchPoints>& searches) {
  Json list = Json::array();
  for (const auto& search : searches)
    for (const auto k : search.course)
      list.push_back({{"search", design.steps[k].search},
                      {"evaluation", design.steps[k].evaluation},
                      {"points", {k, k}},
                      {"parameters", points.parameters(k)},
                      {"value", json_number(points.sum_of_squares(k))},
                      {"within_limits", true}});
  return list;
}

/// The search with the least sum of squares; none if every one failed.
const SearchPoints* best_of(const FitPoints& points, const std::vector<SearchPoints>& searches) {
  const SearchPoints* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& search : searches) {
    const double squares = search.found ? points.sum_of_squares(*search.found) : std::nan("");
    if (squares < least) {
      least = squares;
      best = &search;
    }
  }
  return best;
}

/// Fitted values with their 95 % intervals by Student's t.
Json parameters_json(const FitPoints& points, const SearchPoints& best, const Eigen::MatrixXd& J,
                     const std::optional<Covariance>& C) {
  const SearchSpace& space = points.space();
  const auto at = points.place(*best.found);
  Json all = Json::object();
  for (std::size_t i = 0; i < at.size(); ++i) {
    const auto& p = space.parameter(i);
    const auto k = static_cast<Eigen::Index>(i);
    const bool has_no_effect = J.size() > 0 && J.col(k).squaredNorm() == 0.;
    Json one{{"unit", p.unit()}, {"value", points.value(*best.found, i)}, {"low", nullptr}, {"high", nullptr}};
    one["no_effect"] = has_no_effect;
    if (C && !has_no_effect) {
      const double half = boost::math::quantile(boost::math::students_t(C->degrees_of_freedom), 0.975) *
                          std::sqrt(std::max(0., C->matrix(k, k)));
      auto low = at, high = at;
      low[i] -= half;
      high[i] += half;
      // Beyond an end of its range a value is not told.
      if (low[i] >= 0.) one["low"] = space.values(low)[i];
      if (high[i] <= 1.) one["high"] = space.values(high)[i];
    }
    one["start"] = points.value(best.course.front(), i);
    one["at_end_of_range"] = at[i] <= 0. || at[i] >= 1.;
    all[p.name] = std::move(one);
  }
  return all;
}

Json correlation_json(const Eigen::MatrixXd& covariance) {
  Json matrix = Json::array();
  for (Eigen::Index a = 0; a < covariance.rows(); ++a) {
    Json row = Json::array();
    for (Eigen::Index b = 0; b < covariance.cols(); ++b)
      row.push_back(json_number(covariance(a, b) / std::sqrt(covariance(a, a) * covariance(b, b))));
    matrix.push_back(std::move(row));
  }
  return matrix;
}

Json measured_json(const Fit& fit, const FitPoints& points, const SearchPoints& best) {
  Json list = Json::array();
  for (std::size_t k = 0; k < fit.measured.size(); ++k) {
    Json one = measured_difference(fit.measured[k], points.computed(*best.found, k));
    one["rms_start"] = json_number(difference_of(fit.measured[k], points.computed(best.course.front(), k)).rms);
    list.push_back(std::move(one));
  }
  return list;
}

/// Why intervals by a given noise are void; empty if what differs is about as large. @param chi_square  per degree of freedom
std::string doubt_of_noise(double chi_square, double freedom) {
  constexpr double factor = 2.;        // of the deviation: intervals are off by as much
  constexpr double improbable = 1e-4;  // of true noise of that deviation, so few values are no reason
  const double sum = chi_square * freedom, ratio = std::sqrt(chi_square);
  if (!(freedom > 0.) || !std::isfinite(sum)) return {};
  const boost::math::chi_squared noise(freedom);
  if (ratio < 1. / factor && cdf(noise, sum) < improbable)
    return fmt::format(
        "what differs is {:.3g} times the given deviation only, so the intervals are too wide: check the unit of "
        "deviation",
        ratio);
  if (ratio > factor && cdf(complement(noise, sum)) < improbable)
    return fmt::format(
        "what differs is {:.3g} times the given deviation, so the intervals are too narrow: the model does not follow "
        "the measurement, the search ended too early, or deviation is too small (check its unit)",
        ratio);
  return {};
}

}  // namespace

Json fit_summary(const Study& study, const Design& design, const StudyTable& table) {
  const Fit& fit = *study.fit;
  const FitPoints points(study, design, table);
  const auto searches = points_of(study, design);
  Json j{{"evaluations", design.steps.size()}, {"searches", searches_json(points, searches)}};
  j["course"] = course_json(points, design, searches);
  j["parameters"] = Json::object();
  const SearchPoints* best = best_of(points, searches);
  if (!best) return j;

  const std::size_t start = best->course.front();
  const auto r = points.residuals(*best->found);
  const auto J = points.derivatives_around(*best);
  const auto C = covariance_of_those_with_effect(fit, r, J);
  const double freedom = static_cast<double>(r.size()) - static_cast<double>(study.searched.size());
  j["point"] = *best->found;
  j["start_point"] = start;
  j["sum_of_squares"] = r.squaredNorm();
  j["start_sum_of_squares"] = json_number(points.sum_of_squares(start));
  j["degrees_of_freedom"] = freedom;
  if (fit.measured.front().deviation) {
    const double chi_square = r.squaredNorm() / freedom;
    j["chi_square_per_freedom"] = chi_square;
    if (const std::string doubt = doubt_of_noise(chi_square, freedom); !doubt.empty()) j["noise_doubt"] = doubt;
  }
  j["parameters"] = parameters_json(points, *best, J, C);
  if (C) j["correlation"] = correlation_json(C->matrix);
  j["measured"] = measured_json(fit, points, *best);
  return j;
}

std::string fit_text(const Json& j) {
  if (j["parameters"].empty()) return "the fit found no values: every drop failed, or the search was interrupted\n";
  std::string text = "Fitted values with their 95 % intervals:\n";
  const auto number = [](const Json& value) {
    return value.is_number() ? fmt::format("{:.6g}", value.get<double>()) : std::string("?");
  };
  for (const auto& [name, p] : j["parameters"].items()) {
    const std::string unit = p["unit"] == "1" ? "" : " " + p["unit"].get<std::string>();
    if (p.value("no_effect", false)) {
      text += fmt::format("  {} = {}{}, which tells nothing: no measured value depends on it\n", name,
                          number(p["value"]), unit);
      continue;
    }
    text += fmt::format("  {} = {}{} ({} to {}), from {}{}\n", name, number(p["value"]), unit, number(p["low"]),
                        number(p["high"]), number(p["start"]),
                        p["at_end_of_range"].get<bool>() ? "  <- end of its range" : "");
  }
  text += measured_text(j["measured"]);
  if (j.contains("chi_square_per_freedom"))
    text +=
        fmt::format("  chi-square per degree of freedom {:.3g}: about 1 if the model and the given noise are right\n",
                    j["chi_square_per_freedom"].get<double>());
  if (j.contains("noise_doubt")) text += fmt::format("  warning: {}\n", j["noise_doubt"].get<std::string>());
  return text;
}

Json fit_overlay(const Study& study, const Json& summary, const StudyTable& table) {
  Json list = Json::array();
  if (!summary.contains("point")) return list;
  for (std::size_t k = 0; k < study.fit->measured.size(); ++k) {
    const Measured& m = study.fit->measured[k];
    std::vector<std::pair<std::string, TimeSeries>> curves;
    for (const auto& [name, key] : {std::pair{"at the start", "start_point"}, std::pair{"fitted", "point"}})
      for (const auto& s : series_of(table, summary[key].get<std::size_t>()))
        if (s.path == measured_path(k)) curves.emplace_back(name, TimeSeries{s.time, s.values});
    list.push_back(measured_overlay(m, curves));
  }
  return list;
}

}  // namespace rotordrop
