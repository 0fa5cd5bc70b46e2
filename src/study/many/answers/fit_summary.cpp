#include "study/many/answers/fit_summary.h"

#include <fmt/format.h>

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
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

}  // namespace

Json fit_summary(const Study& study, const Design& design, const StudyTable& table) {
  const Fit& fit = *study.fit;
  const SearchSpace space(study);
  const auto cost = [&](std::size_t point) {
    const auto r = residuals_of(fit, series_of(table, point));
    return r.size() ? r.squaredNorm() : std::nan("");
  };
  const auto values = [&](std::size_t point) {
    Json j = Json::object();
    for (std::size_t i = 0; i < study.searched.size(); ++i)
      j[space.parameter(i).name] = design.value(point, study.searched[i]).number();
    return j;
  };
  const auto place = [&](std::size_t point) {
    std::vector<double> at;
    for (const auto i : study.searched) at.push_back(design.value(point, i).number());
    return space.place(at);
  };
  Json j{{"evaluations", design.steps.size()}, {"searches", Json::array()}};
  const auto searches = points_of(study, design);
  const SearchPoints* best = nullptr;
  for (const auto& search : searches) {
    const double squares = search.found ? cost(*search.found) : std::nan("");
    j["searches"].push_back({{"evaluations", search.course.size()},
                             {"sum_of_squares", json_number(squares)},
                             {"parameters", search.found ? values(*search.found) : Json(nullptr)}});
    if (std::isfinite(squares) && (!best || squares < cost(*best->found))) best = &search;
  }
  j["course"] = Json::array();
  for (const auto& search : searches)
    for (const auto k : search.course)
      j["course"].push_back({{"search", design.steps[k].search},
                             {"evaluation", design.steps[k].evaluation},
                             {"points", {k, k}},
                             {"parameters", values(k)},
                             {"value", json_number(cost(k))},
                             {"within_limits", true}});
  j["parameters"] = Json::object();
  if (!best) return j;

  const std::size_t start = best->course.front();
  const auto r = residuals_of(fit, series_of(table, *best->found));
  std::vector<std::vector<double>> places;
  std::vector<Eigen::VectorXd> around;
  for (const auto k : best->around) {
    places.push_back(place(k));
    around.push_back(residuals_of(fit, series_of(table, k)));
  }
  Eigen::MatrixXd J;
  if (around.size() == 2 * study.searched.size()) J = derivatives(places, around);
  const auto at = place(*best->found);
  const auto has_no_effect = [&](std::size_t i) {
    return J.size() > 0 && J.col(static_cast<Eigen::Index>(i)).squaredNorm() == 0.;
  };
  const auto C = covariance_of_those_with_effect(fit, r, J);
  j["point"] = *best->found;
  j["start_point"] = start;
  j["sum_of_squares"] = r.squaredNorm();
  j["start_sum_of_squares"] = json_number(cost(start));
  j["degrees_of_freedom"] = static_cast<double>(r.size()) - static_cast<double>(at.size());
  if (fit.measured.front().deviation)
    j["chi_square_per_freedom"] = r.squaredNorm() / j["degrees_of_freedom"].get<double>();
  for (std::size_t i = 0; i < at.size(); ++i) {
    const auto& p = space.parameter(i);
    Json one{{"unit", p.unit()},
             {"value", design.value(*best->found, study.searched[i]).number()},
             {"low", nullptr},
             {"high", nullptr}};
    one["no_effect"] = has_no_effect(i);
    if (C && !has_no_effect(i)) {
      const auto k = static_cast<Eigen::Index>(i);
      const double half = boost::math::quantile(boost::math::students_t(C->degrees_of_freedom), 0.975) *
                          std::sqrt(std::max(0., C->matrix(k, k)));
      auto low = at, high = at;
      low[i] -= half;
      high[i] += half;
      // Beyond an end of its range a value is not told.
      if (low[i] >= 0.) one["low"] = space.values(low)[i];
      if (high[i] <= 1.) one["high"] = space.values(high)[i];
    }
    one["start"] = design.value(start, study.searched[i]).number();
    one["at_end_of_range"] = at[i] <= 0. || at[i] >= 1.;
    j["parameters"][p.name] = std::move(one);
  }
  if (C)
    for (Eigen::Index a = 0; a < C->matrix.rows(); ++a) {
      Json row = Json::array();
      for (Eigen::Index b = 0; b < C->matrix.cols(); ++b)
        row.push_back(json_number(C->matrix(a, b) / std::sqrt(C->matrix(a, a) * C->matrix(b, b))));
      j["correlation"].push_back(std::move(row));
    }
  j["measured"] = Json::array();
  for (std::size_t k = 0; k < fit.measured.size(); ++k) {
    const auto shown = [&](std::size_t point) {
      for (const auto& s : series_of(table, point))
        if (s.path == measured_path(k)) return s.values;
      return std::vector<double>(fit.measured[k].data.values.size(), std::nan(""));
    };
    Json one = measured_difference(fit.measured[k], shown(*best->found));
    one["rms_start"] = json_number(difference_of(fit.measured[k], shown(start)).rms);
    j["measured"].push_back(std::move(one));
  }
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
