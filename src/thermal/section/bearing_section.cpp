#include "thermal/section/bearing_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>

#include "thermal/section/section_builder.h"
#include "thermal/section/shaft_section.h"

namespace rotordrop {
namespace {

// A steeper groove edge would leave needle-like cells, and no ball could be put in.
constexpr double steepest_edge = 75. * std::numbers::pi / 180.;

std::string mm(double metres) { return fmt::format("{:.6g} mm", metres * 1e3); }

/// One groove of a ring, with angles measured about its centre from its bottom, positive towards +x.
struct Groove {
  double x = 0, r = 0, radius = 0;  // centre, f d [m]
  double left = 0, right = 0;       // angles of its edges
  double contact = 0;               // angle of the contact point
  double strip_left = 0, strip_right = 0;
  double land_left = 0, land_right = 0;  // radii of the lands beside it [m]
};

/// Inner or outer ring: the side with the grooves, and the plain side.
struct Ring {
  bool is_inner = true;
  std::vector<Groove> grooves;
  double plain = 0, shoulder = 0;  // radii [m]
  // Radius of a groove's surface at an angle: the inner ring's grooves open outwards.
  [[nodiscard]] double surface(const Groove& g, double angle) const {
    return is_inner ? g.r - g.radius * std::cos(angle) : g.r + g.radius * std::cos(angle);
  }
  [[nodiscard]] double wall(const Groove& g) const { return std::fabs(surface(g, 0.) - plain); }
};

Ring make_ring(const BearingSectionData& d, bool is_inner) {
  Ring ring;
  ring.is_inner = is_inner;
  ring.plain = 0.5 * (is_inner ? d.inner_bore : d.outer_outside);
  ring.shoulder = 0.5 * (is_inner ? d.inner_shoulder : d.outer_shoulder);
  for (const auto& row : d.rows) {
    Groove g;
    g.radius = d.conformity[is_inner ? 0 : 1] * d.ball_diameter;
    const double lean = row.direction * d.contact_angle, towards = is_inner ? 1. : -1.;
    g.x = row.x + towards * (g.radius - 0.5 * d.ball_diameter) * std::sin(lean);
    g.r = 0.5 * d.pitch_diameter + towards * (g.radius - 0.5 * d.ball_diameter) * std::cos(lean);
    g.contact = -towards * lean;
    const double depth = g.radius - towards * (g.r - ring.shoulder);
    const double relief = d.contact_angle > 0. ? (is_inner ? d.inner_relief : d.outer_relief) : 1.;
    const auto edge = [&](double part) { return std::acos(std::clamp(1. - part * depth / g.radius, -1., 1.)); };
    const auto land = [&](double part) { return ring.surface(g, 0.) + towards * part * depth; };
    g.left = -edge(g.contact > 0. ? relief : 1.);
    g.right = edge(g.contact < 0. ? relief : 1.);
    g.land_left = land(g.contact > 0. ? relief : 1.);
    g.land_right = land(g.contact < 0. ? relief : 1.);
    g.strip_left = std::max(g.left, g.contact - d.strip_half_width / g.radius);
    g.strip_right = std::min(g.right, g.contact + d.strip_half_width / g.radius);
    ring.grooves.push_back(g);
  }
  return ring;
}

void check_ring(const BearingSectionData& d, bool is_inner, std::vector<SectionFault>& faults) {
  const std::string name = is_inner ? "inner" : "outer", key = name + "_ring_diameters",
                    shoulder_key = name + "_shoulder_diameter";
  const Ring ring = make_ring(d, is_inner);
  const double towards = is_inner ? 1. : -1.;
  for (std::size_t i = 0; i < ring.grooves.size(); ++i) {
    const Groove& g = ring.grooves[i];
    const double bottom = ring.surface(g, 0.);
    if (towards * (bottom - ring.plain) <= 0.) {
      faults.push_back({key,
                        fmt::format("the groove of the {} ring, with its bottom at a diameter of {}, cuts through the "
                                    "wall at {}",
                                    name, mm(2. * bottom), mm(2. * ring.plain)),
                        "Check pitch_diameter, ball_diameter and " + key + "."});
      return;
    }
    if (towards * (ring.shoulder - bottom) <= 0.) {
      faults.push_back({shoulder_key,
                        fmt::format("the {} ring's shoulder diameter of {} leaves no groove, whose bottom is at {}",
                                    name, mm(2. * ring.shoulder), mm(2. * bottom)),
                        fmt::format("Where {} holds a mean diameter of the lumped circuit, give the shoulder's as {}.",
                                    key, shoulder_key)});
      return;
    }
    if (std::max(-g.left, g.right) > steepest_edge || towards * (g.r - ring.shoulder) < 0.) {
      faults.push_back({shoulder_key,
                        fmt::format("the {} ring's shoulder diameter of {} makes a groove so deep that it encloses the "
                                    "balls",
                                    name, mm(2. * ring.shoulder)),
                        fmt::format("Check {}, {} and pitch_diameter.", key, shoulder_key)});
      return;
    }
    if (g.contact <= g.left || g.contact >= g.right) {
      faults.push_back({"contact_angle",
                        fmt::format("the balls touch the {} ring at {:.4g} deg, beyond its shoulder at {:.4g} deg",
                                    name, std::fabs(g.contact) * 180. / std::numbers::pi,
                                    (g.contact < 0. ? -g.left : g.right) * 180. / std::numbers::pi),
                        fmt::format("Check contact_angle, {} and {}.", key, shoulder_key)});
      return;
    }
    const double left = g.x + g.radius * std::sin(g.left), right = g.x + g.radius * std::sin(g.right);
    const double from = i == 0
                            ? -0.5 * d.width
                            : ring.grooves[i - 1].x + ring.grooves[i - 1].radius * std::sin(ring.grooves[i - 1].right);
    if (left <= from + same_place || (i + 1 == ring.grooves.size() && right >= 0.5 * d.width - same_place)) {
      faults.push_back({"width",
                        i == 0 || right >= 0.5 * d.width - same_place
                            ? fmt::format("a groove {} wide reaches over the {} ring's face", mm(right - left), name)
                            : fmt::format("grooves {} wide of neighbouring rows overlap", mm(right - left)),
                        "Check width, row_spacing, ball_diameter and " + key + "."});
      return;
    }
  }
}

/// The grooved side of a ring, cut into columns.
struct Profile {
  struct Column {
    double length = 0;  // along the surface [m]
    HeatSide side = HeatSide::raceway;
    int row = 0, arc = -1;
  };
  std::vector<double> x, r;  // [n_columns + 1]
  std::vector<Column> columns;
  std::vector<Division> divisions;
};

Profile make_profile(const BearingSectionData& d, const Ring& ring, const std::vector<double>& cuts,
                     SectionBuilder& builder) {
  Profile p;
  const HeatSide land = ring.is_inner ? HeatSide::outer : HeatSide::inner;
  p.x = {-0.5 * d.width};
  p.r = {ring.grooves.front().land_left};
  const auto cuts_between = [&](double a, double b) {
    std::vector<double> inside;
    for (const double cut : cuts)
      if (cut > a + same_place && cut < b - same_place) inside.push_back(cut);
    return inside;
  };
  // A land is straight from edge to edge: conical between grooves of a tandem, which have lands of two heights.
  const auto land_to = [&](double x, double r) {
    const double x_0 = p.x.back(), r_0 = p.r.back();
    auto ends = cuts_between(x_0, x);
    ends.push_back(x);
    for (const double end : ends) {
      const double part = (end - x_0) / (x - x_0), r_end = end == x ? r : r_0 + part * (r - r_0);
      p.columns.push_back({std::hypot(end - p.x.back(), r_end - p.r.back()), land, 0, -1});
      p.x.push_back(end);
      p.r.push_back(r_end);
    }
  };
  for (std::size_t i = 0; i < ring.grooves.size(); ++i) {
    const Groove& g = ring.grooves[i];
    const double left = g.x + g.radius * std::sin(g.left);
    if (i > 0) {  // halfway between two grooves columns end, so that cells are largest there
      const double middle = 0.5 * (p.x.back() + left);
      land_to(middle, 0.5 * (p.r.back() + g.land_left));
    }
    land_to(left, g.land_left);
    builder.plan.arcs.push_back({g.x, g.r, g.radius});
    const int arc = static_cast<int>(builder.plan.arcs.size()) - 1;
    const auto arc_to = [&](double from, double to, HeatSide side) {
      if ((to - from) * g.radius <= same_place) return;
      auto ends = cuts_between(g.x + g.radius * std::sin(from), g.x + g.radius * std::sin(to));
      for (double& end : ends) end = std::asin((end - g.x) / g.radius);
      ends.push_back(to);
      for (const double end : ends) {
        p.columns.push_back({(end - from) * g.radius, side, static_cast<int>(i), arc});
        p.x.push_back(g.x + g.radius * std::sin(end));
        p.r.push_back(ring.surface(g, end));
        from = end;
      }
    };
    arc_to(g.left, g.strip_left, HeatSide::raceway);
    arc_to(g.strip_left, g.strip_right, HeatSide::strip);
    arc_to(g.strip_right, g.right, HeatSide::raceway);
  }
  land_to(0.5 * d.width, ring.grooves.back().land_right);
  return p;
}

/// Along x: even on the strips, growing away from them.
class SizeAlong {
 public:
  SizeAlong(double strip, double growth, double largest)
      : strip_(strip), slope_(2. * (growth - 1.) / (growth + 1.)), largest_(largest) {}

  void divide(Profile& p) const {
    const auto size = [&](double x) {
      double s = largest_;
      for (std::size_t i = 0; i < p.columns.size(); ++i)
        if (p.columns[i].side == HeatSide::strip)
          s = std::min(s, strip_ + slope_ * std::max({p.x[i] - x, x - p.x[i + 1], 0.}));
      return s;
    };
    for (std::size_t i = 0; i < p.columns.size(); ++i) {
      const double length = p.columns[i].length;
      if (p.columns[i].side == HeatSide::strip)
        p.divisions.push_back({std::max(1, static_cast<int>(std::ceil(length / strip_ - 1e-6))), 1.});
      else
        p.divisions.push_back(between_sizes(length, size(p.x[i]), size(p.x[i + 1])));
    }
  }

 private:
  double strip_, slope_, largest_;
};

/// The columns of a profile between -half and half, continued where that is wider.
Columns columns_over(const Profile& p, double half, const CellSizes& sizes) {
  Columns c;
  const double ring_half = p.x.back();
  const bool is_wider = half > ring_half + same_place;
  if (is_wider) {
    Division d = graded(half - ring_half, first_cell(p.columns.front().length, p.divisions.front()), sizes.growth,
                        sizes.largest);
    c.x.push_back(-half);
    c.divisions.push_back(reversed(d));
  }
  for (std::size_t i = 0; i < p.columns.size(); ++i) {
    if (p.x[i] < -half - same_place || p.x[i + 1] > half + same_place) continue;
    if (c.x.empty() || c.x.back() < p.x[i]) c.x.push_back(p.x[i]);
    c.divisions.push_back(p.divisions[i]);
    c.x.push_back(p.x[i + 1]);
  }
  if (is_wider) {
    c.divisions.push_back(
        graded(half - ring_half, last_cell(p.columns.back().length, p.divisions.back()), sizes.growth, sizes.largest));
    c.x.push_back(half);
  }
  return c;
}

/// Range of the wall's thickness above a plain side over the ends of strips, and over all.
struct Wall {
  double least = 1e300, most_at_strips = 0;
};
Wall wall_of(const Profile& p, const Ring& ring) {
  Wall w;
  for (const auto& g : ring.grooves) w.least = std::min(w.least, ring.wall(g));
  for (std::size_t i = 0; i < p.columns.size(); ++i)
    if (p.columns[i].side == HeatSide::strip)
      for (const std::size_t end : {i, i + 1})
        w.most_at_strips = std::max(w.most_at_strips, std::fabs(p.r[end] - ring.plain));
  return w;
}

std::vector<std::size_t> profile_points(const Profile& p, SectionBuilder& builder) {
  std::vector<std::size_t> points;
  for (std::size_t i = 0; i < p.x.size(); ++i) points.push_back(builder.point(p.x[i], p.r[i]));
  return points;
}
std::vector<std::size_t> profile_curves(const Profile& p, const std::vector<std::size_t>& points, std::size_t body,
                                        SectionBuilder& builder) {
  std::vector<std::size_t> curves;
  for (std::size_t i = 0; i < p.columns.size(); ++i)
    curves.push_back(builder.curve(points[i], points[i + 1], p.divisions[i],
                                   HeatBoundary{body, p.columns[i].side, p.columns[i].row}, p.columns[i].arc));
  return curves;
}

/// Two layers of blocks: fine on the bore, and fine on the raceways.
void add_inner_ring(const Ring& ring, const Profile& p, const CellSizes& sizes, SectionBuilder& builder) {
  const std::size_t body = builder.body("inner_ring");
  const Wall wall = wall_of(p, ring);
  const double middle = ring.plain + 0.5 * wall.least;
  const auto low = builder.points(p.x, ring.plain), mid = builder.points(p.x, middle);
  const auto high = profile_points(p, builder);
  const Division from_bore = graded(0.5 * wall.least, sizes.surface, sizes.growth, sizes.largest);
  const Division from_strip =
      graded(wall.most_at_strips - 0.5 * wall.least, sizes.surface, sizes.growth, sizes.largest);
  const auto low_curves = builder.along(low, p.divisions, HeatBoundary{body, HeatSide::inner, 0});
  const auto mid_curves = builder.along(mid, p.divisions);
  const auto high_curves = profile_curves(p, high, body, builder);
  builder.blocks(low_curves, mid_curves, builder.uprights(low, mid, from_bore, body), body);
  builder.blocks(mid_curves, high_curves, builder.uprights(mid, high, {from_strip.cells, 1. / from_strip.ratio}, body),
                 body);
}

/// @return thickness of the cells at the fit [m]
double add_outer_ring(const Ring& ring, const Profile& p, const CellSizes& sizes, SectionBuilder& builder) {
  const std::size_t body = builder.body("outer_ring");
  const double wall = wall_of(p, ring).most_at_strips;
  const Division from_strip = graded(wall, sizes.surface, sizes.growth, sizes.largest);
  const auto low = profile_points(p, builder), high = builder.points(p.x, ring.plain);
  const auto low_curves = profile_curves(p, low, body, builder);
  const auto high_curves = builder.along(high, p.divisions, HeatBoundary{body, HeatSide::outer, 0});
  builder.blocks(low_curves, high_curves, builder.uprights(low, high, from_strip, body), body);
  return sizes.surface * std::pow(from_strip.ratio, from_strip.cells - 1);
}

}  // namespace

std::vector<SectionFault> faults_of_section(const BearingSectionData& d) {
  std::vector<SectionFault> faults;
  if (d.housing_outside <= d.outer_outside)
    faults.push_back({"housing_diameters",
                      fmt::format("the housing's outside diameter of {} is not larger than the outer ring's of {}",
                                  mm(d.housing_outside), mm(d.outer_outside)),
                      "Check housing_diameters and outer_ring_diameters."});
  check_ring(d, true, faults);
  check_ring(d, false, faults);
  return faults;
}

SectionPlan plan_bearing_section(const BearingSectionData& d, const SectionSizes& wanted) {
  if (const auto faults = faults_of_section(d); !faults.empty())
    throw std::invalid_argument(faults.front().message + ". " + faults.front().advice);
  CellSizes sizes{};
  sizes.surface = wanted.surface_cell / wanted.refinement;
  sizes.largest = wanted.largest_cell / wanted.refinement;
  sizes.growth = std::pow(wanted.growth, 1. / wanted.refinement);
  // Half a strip at least, and a quarter of the largest cell for wide ones.
  sizes.strip = std::min(d.strip_half_width / wanted.refinement, 0.25 * sizes.largest);
  const SizeAlong size_along(sizes.strip, sizes.growth, sizes.largest);

  SectionBuilder builder;
  const Ring inner = make_ring(d, true), outer = make_ring(d, false);
  const bool has_shaft = d.shaft_radius > 0.;
  const double half_shaft = 0.5 * d.shaft_length, half_housing = 0.5 * d.housing_length;
  Profile inner_profile =
      make_profile(d, inner, has_shaft ? std::vector<double>{-half_shaft, half_shaft} : std::vector<double>{}, builder);
  Profile outer_profile = make_profile(d, outer, {-half_housing, half_housing}, builder);
  size_along.divide(inner_profile);
  size_along.divide(outer_profile);

  add_inner_ring(inner, inner_profile, sizes, builder);
  const double at_fit = add_outer_ring(outer, outer_profile, sizes, builder);
  const double housing_wall = 0.5 * (d.housing_outside - d.outer_outside);
  add_rectangle(
      "housing", columns_over(outer_profile, half_housing, sizes),
      {{0.5 * d.outer_outside, 0.5 * d.housing_outside, graded(housing_wall, at_fit, sizes.growth, sizes.largest)}},
      builder);
  if (has_shaft)
    add_shaft(d.shaft_bore_radius, d.shaft_radius, columns_over(inner_profile, half_shaft, sizes), d.shaft_steps, sizes,
              builder);
  return std::move(builder.plan);
}

}  // namespace rotordrop
