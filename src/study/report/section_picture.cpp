#include "study/report/section_picture.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace rotordrop {
namespace {

struct Corner {
  double x, r, rise;
};

/// Points of a picture within a triangle take its linear interpolation.
void fill(SectionPicture& picture, const Corner& a, const Corner& b, const Corner& c) {
  const double area = (b.x - a.x) * (c.r - a.r) - (c.x - a.x) * (b.r - a.r);
  if (area == 0.) return;
  const double step_x = (picture.x_high - picture.x_low) / static_cast<double>(picture.columns),
               step_r = (picture.r_high - picture.r_low) / static_cast<double>(picture.rows);
  const double span = picture.high - picture.low;
  const auto range = [](double from, double to, double low, double step, std::size_t n) {
    const auto index = [&](double at) { return static_cast<std::size_t>(std::clamp(at, 0., static_cast<double>(n))); };
    return std::pair{index(std::ceil((from - low) / step - 0.5)), index(std::floor((to - low) / step - 0.5) + 1.)};
  };
  const auto columns =
      range(std::min({a.x, b.x, c.x}), std::max({a.x, b.x, c.x}), picture.x_low, step_x, picture.columns);
  const auto rows = range(std::min({a.r, b.r, c.r}), std::max({a.r, b.r, c.r}), picture.r_low, step_r, picture.rows);
  constexpr double rounding = 1e-9;  // no gap between triangles
  for (std::size_t row = rows.first; row < rows.second; ++row)
    for (std::size_t column = columns.first; column < columns.second; ++column) {
      const double x = picture.x_low + (static_cast<double>(column) + 0.5) * step_x,
                   r = picture.r_low + (static_cast<double>(row) + 0.5) * step_r;
      const double to_b = ((x - a.x) * (c.r - a.r) - (c.x - a.x) * (r - a.r)) / area,
                   to_c = ((b.x - a.x) * (r - a.r) - (x - a.x) * (b.r - a.r)) / area;
      if (to_b < -rounding || to_c < -rounding || to_b + to_c > 1. + rounding) continue;
      const double rise = a.rise + to_b * (b.rise - a.rise) + to_c * (c.rise - a.rise);
      const double part = span > 0. ? std::clamp((rise - picture.low) / span, 0., 1.) : 0.;
      picture.levels[(picture.rows - 1 - row) * picture.columns + column] =
          static_cast<std::uint8_t>(1. + std::round(254. * std::sqrt(part)));
    }
}

}  // namespace

SectionPicture picture_of(const TemperatureField& field, std::size_t n_points) {
  SectionPicture picture;
  const auto ends = [](const std::vector<double>& values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return std::pair{*low, *high};
  };
  std::tie(picture.x_low, picture.x_high) = ends(field.x);
  std::tie(picture.r_low, picture.r_high) = ends(field.r);
  std::tie(picture.low, picture.high) = ends(field.rise);
  const double width = picture.x_high - picture.x_low, height = picture.r_high - picture.r_low;
  const double step = std::sqrt(width * height / static_cast<double>(n_points));
  const auto count = [step](double length) {
    return std::max<std::size_t>(1, static_cast<std::size_t>(length / step));
  };
  picture.columns = count(width);
  picture.rows = count(height);
  picture.levels.assign(picture.columns * picture.rows, 0);
  for (const auto& cell : field.cells) {
    // As four triangles around the middle: no diagonal is preferred.
    Corner middle{0., 0., 0.};
    std::array<Corner, 4> corners{};
    for (std::size_t k = 0; k < 4; ++k) {
      corners[k] = {field.x[cell[k]], field.r[cell[k]], field.rise[cell[k]]};
      middle.x += 0.25 * corners[k].x;
      middle.r += 0.25 * corners[k].r;
      middle.rise += 0.25 * corners[k].rise;
    }
    for (std::size_t k = 0; k < 4; ++k) fill(picture, corners[k], corners[(k + 1) % 4], middle);
  }
  return picture;
}

std::vector<std::array<double, 4>> body_edges(const TemperatureField& field) {
  using Place = std::pair<long, long>;  // in nm: neighbours' points differ by roundoff
  const auto place = [&](std::uint32_t i) {
    return Place{std::lround(field.x[i] * 1e9), std::lround(field.r[i] * 1e9)};
  };
  struct Edge {
    std::array<double, 4> ends{};
    int body = 0, n_cells = 0;
    bool is_between = false;
  };
  std::map<std::pair<Place, Place>, Edge> edges;
  for (std::size_t c = 0; c < field.cells.size(); ++c)
    for (std::size_t k = 0; k < 4; ++k) {
      const auto i = field.cells[c][k], j = field.cells[c][(k + 1) % 4];
      const Place a = place(i), b = place(j);
      if (a == b) continue;
      Edge& edge = edges[std::minmax(a, b)];
      edge.is_between = edge.is_between || (edge.n_cells > 0 && edge.body != field.body[c]);
      edge.body = field.body[c];
      edge.ends = {field.x[i], field.r[i], field.x[j], field.r[j]};
      ++edge.n_cells;
    }
  std::vector<std::array<double, 4>> list;
  std::vector<Edge> alone;
  for (const auto& [ends, edge] : edges)
    if (edge.n_cells == 1)
      alone.push_back(edge);
    else if (edge.is_between)
      list.push_back(edge.ends);
  // Cells beside a curved surface are drawn with curved edges, and their neighbours with straight ones: of such a pair, which is within a body,
  // one end is common and the others are a bit apart. Roundoff may part both ends.
  const auto are_one = [](const Edge& a, const Edge& b) {
    constexpr double near = 0.05, roundoff = 1e-7;  // of their length; [m]
    const auto &p = a.ends, &q = b.ends;
    const double apart = 0.5 * std::hypot(p[0] + p[2] - q[0] - q[2], p[1] + p[3] - q[1] - q[3]);
    const auto meet = [&](std::size_t i, std::size_t k) {
      return std::hypot(p[i] - q[k], p[i + 1] - q[k + 1]) < roundoff;
    };
    const bool has_common_end = meet(0, 0) || meet(0, 2) || meet(2, 0) || meet(2, 2);
    return a.body == b.body &&
           (apart < roundoff || (has_common_end && apart < near * std::hypot(p[2] - p[0], p[3] - p[1])));
  };
  for (const auto& edge : alone)
    if (std::count_if(alone.begin(), alone.end(), [&](const Edge& other) { return are_one(edge, other); }) == 1)
      list.push_back(edge.ends);
  return list;
}

}  // namespace rotordrop
