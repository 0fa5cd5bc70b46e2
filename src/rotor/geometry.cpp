#include "rotor/geometry.h"

#include <algorithm>

#include <numbers>

namespace rotordrop {

double shaft_diameter(const RotorGeometry& rotor, int node) {
  double diameter = 0.;
  for (const auto& element : rotor.elements)
    if (element.n1 <= node && node <= element.n2) diameter = std::max(diameter, element.od);
  return diameter;
}

RigidBody rigid_body(const RotorGeometry& geometry) {
  double mass = 0, first_moment = 0, Ip = 0, Id_about_origin = 0;
  for (const auto& element : geometry.elements) {
    const double L = geometry.length(element);
    const double middle = geometry.position(element.n1) + 0.5 * L;
    const double d_o2 = element.od * element.od, d_i2 = element.id * element.id;
    const double m = element.material.rho * std::numbers::pi / 4 * (d_o2 - d_i2) * L;
    mass += m;
    first_moment += m * middle;
    Ip += m * (d_o2 + d_i2) / 8;
    Id_about_origin += m * ((d_o2 + d_i2) / 16 + L * L / 12 + middle * middle);
  }
  for (const auto& point : geometry.mass_points) {
    const double x = geometry.position(point.node);
    mass += point.mass;
    first_moment += point.mass * x;
    Ip += point.Ip;
    Id_about_origin += point.Id + point.mass * x * x;
  }
  const double x_cg = first_moment / mass;
  return {mass, x_cg, Ip, Id_about_origin - mass * x_cg * x_cg};
}

}  // namespace rotordrop
