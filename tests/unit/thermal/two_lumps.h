#pragma once
#include <cmath>
#include <utility>
#include <vector>

#include "thermal/section/reduced_sections.h"

namespace rotordrop::testing {

/// Inner ring of 30 J/K and the rest, 70 J/K, joined by 2 W/K or another conductance G: the uniform mode, and (0.7, -0.3)/sqrt(0.21) with a rate of G/30 + G/70.
inline ReducedSection two_lumps(double conductance = 2.) {
  const double root = std::sqrt(0.21);
  const std::vector<double> inner = {1., 0.7 / root}, rest = {1., -0.3 / root};
  ReducedHeat h;
  h.capacity = 100.;
  h.rate = {0., conductance / 30. + conductance / 70.};
  const auto port = [](const char* name, const std::vector<double>& shape, double area) {
    return ReducedHeat::Output{name, shape, 0., area, shape, 0., {0.}};
  };
  h.ports = {port("bore", inner, 0.01),         port("shaft", rest, 0.01),         port("inner_raceway", inner, 0.01),
             port("outer_raceway", rest, 0.01), port("housing_surface", rest, 0.), port("ball", rest, 0.)};
  h.ports[bore_port].at_once = 0.5;
  h.ports[bore_port].points_at_once = {0.25};
  h.bodies = {{"inner_ring", inner, 30.}, {"outer_ring", rest, 20.}, {"housing", rest, 20.}};
  h.nodes = {{"ball", rest, 10.}, {"shaft", rest, 20.}};
  h.loss = {0., 0.};
  ReducedSection section;
  section.name = "TB";
  section.heat = h;
  section.growth = {.bore = 1e-6, .inner_race = 2e-6, .outer_race = 3e-6, .shaft = 4e-6, .ball = 5e-6};
  return section;
}

inline std::vector<ReducedSection> one(ReducedSection section) {
  std::vector<ReducedSection> list;
  list.push_back(std::move(section));
  return list;
}

}  // namespace rotordrop::testing
