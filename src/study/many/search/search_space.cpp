#include "study/many/search/search_space.h"

#include <algorithm>
#include <cmath>

namespace rotordrop {
namespace {

/// Searched parameters become constants, so that a design draws the others only.
Study with_constants(Study study) {
  const auto drawn = study.drawn();
  for (const auto j : study.searched) {
    auto& d = study.parameters[drawn[j]].distribution;
    d = {};
    d.values = {Node(0.)};
  }
  return study;
}

bool is_all_searched(const Study& study) { return study.searched.size() == study.drawn().size(); }

/// Part of the range at which a value lies; the middle if it lies outside by more than rounding of units.
double place_of(const Distribution& d, double value) {
  if (!is_in_range(d, value)) return 0.5;
  value = std::clamp(value, d.lower, d.upper);
  if (d.kind == Distribution::Kind::log_uniform) return std::log(value / d.lower) / std::log(d.upper / d.lower);
  return (value - d.lower) / (d.upper - d.lower);
}

}  // namespace

bool is_in_range(const Distribution& d, double value) {
  const double rounding = 1e-12 * std::max(std::fabs(d.lower), std::fabs(d.upper));
  return value >= d.lower - rounding && value <= d.upper + rounding;
}

SearchSpace::SearchSpace(const Study& study) : study_(study), drawn_(study.drawn()) {
  if (is_all_searched(study)) {
    sample_.n_rows = 1;
    sample_.n_drawn = drawn_.size();
    sample_.cells.assign(drawn_.size(), 0.);
    sample_.nodes.resize(drawn_.size());
  } else {
    sample_ = make_design(with_constants(study));
  }
  for (const auto j : study.searched) sample_.nodes[j].clear();
  sample_.unit.clear();
  sample_.kind = DesignKind::search;
}

std::size_t SearchSpace::n_drops() const { return n_rows() * static_cast<std::size_t>(study_.n_replicates); }

const VariedParameter& SearchSpace::parameter(std::size_t dimension) const {
  return study_.parameters[drawn_[study_.searched[dimension]]];
}

std::vector<double> SearchSpace::values(const std::vector<double>& place) const {
  std::vector<double> result;
  for (std::size_t i = 0; i < place.size(); ++i) {
    const auto& d = parameter(i).distribution;
    const double u = place[i];
    result.push_back(u <= 0. ? d.lower : u >= 1. ? d.upper : std::clamp(d.quantile(u), d.lower, d.upper));
  }
  return result;
}

std::vector<double> SearchSpace::place(const std::vector<double>& values) const {
  std::vector<double> result;
  for (std::size_t i = 0; i < values.size(); ++i) result.push_back(place_of(parameter(i).distribution, values[i]));
  return result;
}

std::vector<std::vector<double>> SearchSpace::starts(std::size_t n) const {
  std::vector<std::vector<double>> result(1);
  for (std::size_t i = 0; i < n_dimensions(); ++i) {
    if (study_.minimise && !takes_start(study_.minimise->method)) {
      result.front().push_back(0.5);
      continue;
    }
    const auto& p = parameter(i);
    const auto reference = p.reference ? p.reference : own_value(study_, p.keys.front());
    result.front().push_back(reference && reference->is_number() ? place_of(p.distribution, reference->number()) : 0.5);
  }
  if (n < 2) return result;
  Study others = study_;
  others.parameters.clear();
  for (std::size_t i = 0; i < n_dimensions(); ++i) others.parameters.push_back(parameter(i));
  others.correlations.clear();
  others.design.kind = DesignKind::latin_hypercube;
  others.design.size = static_cast<int>(n) - 1;
  const Design design = make_design(others);
  for (std::size_t row = 0; row < design.n_rows; ++row) {
    const auto begin = design.unit.begin() + static_cast<std::ptrdiff_t>(row * n_dimensions());
    result.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(n_dimensions()));
  }
  return result;
}

Design SearchSpace::rows_at(const std::vector<std::vector<double>>& values) const {
  Design design = sample_;
  design.cells.clear();
  for (const auto& at : values) {
    const std::size_t first = design.cells.size();
    design.cells.insert(design.cells.end(), sample_.cells.begin(), sample_.cells.end());
    for (std::size_t row = 0; row < n_rows(); ++row)
      for (std::size_t i = 0; i < at.size(); ++i)
        design.cells[first + row * drawn_.size() + study_.searched[i]] = at[i];
  }
  design.n_rows = values.size() * n_rows();
  return design;
}

Design SearchSpace::corners() const {
  constexpr std::size_t most_corners = 64;
  const auto start = starts(1).front();
  std::vector<std::vector<double>> places{values(start)};
  if (n_dimensions() < 63)
    for (std::size_t k = 0; k < std::min(most_corners, std::size_t{1} << n_dimensions()); ++k) {
      std::vector<double> corner;
      for (std::size_t i = 0; i < n_dimensions(); ++i) corner.push_back(static_cast<double>((k >> i) & 1U));
      places.push_back(values(corner));
    }
  for (std::size_t i = 0; i < n_dimensions(); ++i)
    for (const double end : {0., 1.}) {
      auto place = start;
      place[i] = end;
      places.push_back(values(place));
    }
  return rows_at(places);
}

Design design_of_search(const Study& study, Journal::Content& content) {
  const SearchSpace space(study);
  const std::size_t n_drops = space.n_drops(), n_evaluations = study.evaluations_of_search();
  std::vector<std::vector<double>> values;
  std::vector<SearchStep> steps;
  std::map<std::size_t, PointRecord> records;
  std::size_t last = 0;
  for (auto& [point, record] : content.records) {
    const std::size_t evaluation = point / n_drops;
    if (steps.empty() || evaluation != last) {
      values.push_back(record.at);
      steps.push_back({evaluation / n_evaluations, evaluation % n_evaluations});
      last = evaluation;
    }
    record.point = (steps.size() - 1) * n_drops + point % n_drops;
    const std::size_t number = record.point;
    records.emplace(number, std::move(record));
  }
  content.records = std::move(records);
  Design design = space.rows_at(values);
  design.steps = std::move(steps);
  design.rows_per_step = space.n_rows();
  return design;
}

Design design_of(const Study& study, Journal::Content& content) {
  return study.is_search() ? design_of_search(study, content) : make_design(study);
}

}  // namespace rotordrop
