#include "thermal/section/section_builder.h"

#include <algorithm>
#include <cmath>

namespace rotordrop {
namespace {

/// Ratio of a geometric series of n cells with the given first one on a length.
double ratio_for(double length, double first, int n) {
  double low = 1e-3, high = 1e3;
  for (int i = 0; i < 200; ++i) {
    const double q = std::sqrt(low * high);
    double sum = 0., cell = first;
    for (int k = 0; k < n; ++k, cell *= q) sum += cell;
    (sum < length ? low : high) = q;
  }
  return std::sqrt(low * high);
}

}  // namespace

Division graded(double length, double first, double growth, double largest) {
  if (length <= first) return {1, 1.};
  // Fewer cells than this are too large, whatever their ratio.
  const double least = length / std::max(first, largest);
  if (least > 1e4) return {static_cast<int>(std::min(least, 1e9)), 1.};  // section_plan refuses it
  for (int n = std::max(2, static_cast<int>(least));; ++n) {
    const double q = ratio_for(length, first, n);
    if (q <= 1.) {  // `first` is close to `largest`
      const int even = std::max(1, static_cast<int>(std::ceil(length / std::max(first, largest) - 1e-9)));
      return {std::max(even, n - 1), 1.};
    }
    if (q <= growth && first * std::pow(q, n - 1) <= largest) return {n, q};
  }
}

Division between_sizes(double length, double at_start, double at_end) {
  const double mean =
      std::fabs(at_end - at_start) < 1e-9 * at_start ? at_start : (at_end - at_start) / std::log(at_end / at_start);
  const int n = std::max(1, static_cast<int>(std::lround(length / mean)));
  return {n, n > 1 ? std::pow(at_end / at_start, 1. / n) : 1.};
}

double first_cell(double length, Division d) {
  double sum = 0.;
  for (int k = 0; k < d.cells; ++k) sum += std::pow(d.ratio, k);
  return length / sum;
}

std::size_t SectionBuilder::body(const std::string& name) {
  plan.bodies.push_back(name);
  return plan.bodies.size() - 1;
}

std::size_t SectionBuilder::point(double x, double r) {
  plan.points.push_back({x, r});
  return plan.points.size() - 1;
}

std::vector<std::size_t> SectionBuilder::points(const std::vector<double>& x, double r) {
  std::vector<std::size_t> made;
  for (const double at : x) made.push_back(point(at, r));
  return made;
}

std::size_t SectionBuilder::curve(std::size_t from, std::size_t to, Division d, std::optional<HeatBoundary> boundary,
                                  int arc) {
  plan.curves.push_back({from, to, d.cells, d.ratio, arc, boundary});
  return plan.curves.size() - 1;
}

std::vector<std::size_t> SectionBuilder::uprights(const std::vector<std::size_t>& low,
                                                  const std::vector<std::size_t>& high, Division d, std::size_t body) {
  std::vector<std::size_t> made;
  for (std::size_t i = 0; i < low.size(); ++i) {
    std::optional<HeatBoundary> face;
    if (i == 0) face = HeatBoundary{body, HeatSide::left, 0};
    if (i + 1 == low.size()) face = HeatBoundary{body, HeatSide::right, 0};
    made.push_back(curve(low[i], high[i], d, face));
  }
  return made;
}

std::vector<std::size_t> SectionBuilder::along(const std::vector<std::size_t>& row, const std::vector<Division>& d,
                                               std::optional<HeatBoundary> boundary) {
  std::vector<std::size_t> made;
  for (std::size_t i = 0; i + 1 < row.size(); ++i) made.push_back(curve(row[i], row[i + 1], d[i], boundary));
  return made;
}

void SectionBuilder::blocks(const std::vector<std::size_t>& low, const std::vector<std::size_t>& high,
                            const std::vector<std::size_t>& uprights, std::size_t body) {
  for (std::size_t i = 0; i < low.size(); ++i) {
    const auto &a = plan.curves[low[i]], &b = plan.curves[high[i]];
    plan.blocks.push_back({{low[i], uprights[i + 1], high[i], uprights[i]}, {a.from, a.to, b.to, b.from}, body});
  }
}

void add_rectangle(const std::string& name, const Columns& columns, const std::vector<Layer>& layers,
                   SectionBuilder& builder) {
  const std::size_t body = builder.body(name);
  auto low = builder.points(columns.x, layers.front().from);
  auto low_curves = builder.along(low, columns.divisions, HeatBoundary{body, HeatSide::inner, 0});
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const bool is_last = k + 1 == layers.size();
    const auto high = builder.points(columns.x, layers[k].to);
    const auto outside = is_last ? std::optional(HeatBoundary{body, HeatSide::outer, 0}) : std::nullopt;
    const auto high_curves = builder.along(high, columns.divisions, outside);
    builder.blocks(low_curves, high_curves, builder.uprights(low, high, layers[k].upwards, body), body);
    low = high;
    low_curves = high_curves;
  }
}

}  // namespace rotordrop
