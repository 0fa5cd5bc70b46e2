#include "rotor/windage.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "laws/windage.h"

namespace rotordrop {
namespace {

void check_windage(const WindageParameters& p, const Node& table, Faults& faults) {
  if (p.law == WindageLaw::power && !(p.torque && p.speed))
    faults.add(table.where(), "rotor.windage with law = \"power\" needs a torque and the speed at which it acts.",
               "Give both, such as { torque = \"1 N m\", speed = \"15200 rpm\" }, or law = \"geometry\".");
  if (p.law != WindageLaw::geometry) return;
  // The completed parameters of a run hold the default exponent: that one may stand.
  for (const auto& [key, is_set] : {std::pair{"torque", p.torque.has_value()}, std::pair{"speed", p.speed.has_value()},
                                    std::pair{"exponent", p.exponent != 2.}})
    if (is_set)
      faults.add(position_of(table, key),
                 std::string("rotor.windage.") + key + " belongs to law = \"power\", but the law is \"geometry\".",
                 "Remove it; rotor.windage.factor scales what the geometry gives.");
}

}  // namespace

Section<WindageParameters> windage_section() {
  using P = WindageParameters;
  Section<P> s("windage",
               "Friction of the rotor in the gas around it. It brakes the rotor; its heat goes into the gas and warms "
               "neither bearings nor shaft.");
  s.choice(
      "law", &P::law, {{"power", WindageLaw::power}, {"geometry", WindageLaw::geometry}},
      {.fallback = "power",
       .help =
           "power: torque (|spin| / speed)^exponent. geometry: smooth cylinders (Theodorsen & Regier 1944 in free gas, "
           "Bilgen & Boulos 1973 in a gap) and faces (von Karman) of the rotor's elements; mass points are ignored."});
  s.quantity("torque", &P::torque,
             {.unit = "N m",
              .range = at_least(0),
              .usual = or_zero(between(1e-6, 1e4)),
              .help = "Windage torque at `speed`, for law = \"power\"."});
  s.quantity("speed", &P::speed,
             {.unit = "rad/s", .range = positive(), .help = "Speed at which `torque` acts, for law = \"power\"."});
  s.quantity("exponent", &P::exponent,
             {.range = between(0.5, 4),
              .fallback = "2",
              .source = "turbulent flow; Re^-0.2 of smooth walls gives 1.8",
              .help = "Power of the spin speed with which the torque rises, for law = \"power\"."});
  s.quantity("density", &P::density,
             {.unit = "kg/m3",
              .range = positive(),
              .usual = between(1e-4, 300),
              .fallback = "1.2 kg/m3",
              .source = "air at 20 degC and 1013 hPa",
              .help = "Density of the gas, for law = \"geometry\"."});
  s.quantity("viscosity", &P::viscosity,
             {.unit = "m2/s",
              .range = positive(),
              .usual = between(1e-9, 10),
              .fallback = "15e-6 m2/s",
              .source = "air at 20 degC and 1013 hPa",
              .help = "Kinematic viscosity of the gas, for law = \"geometry\"."});
  s.quantity("gap", &P::gap,
             {.unit = "m",
              .range = positive(),
              .usual = between(1e-4, 0.1),
              .help = "Radial gap between all cylinders and a casing at rest, for law = \"geometry\"; free gas if not "
                      "given."});
  s.quantity(
      "factor", &P::factor,
      {.range = at_least(0),
       .usual = or_zero(between(0.1, 20)),
       .fallback = "1",
       .source = "1: smooth surfaces",
       .help = "Factor on the torque of either law: above 1 for slots, fans, rough or axially flushed surfaces."});
  s.check(check_windage);
  return s;
}

Windage::Windage(double torque, double speed, double exponent) : torque_(torque), speed_(speed), exponent_(exponent) {}

Windage::Windage(std::vector<double> speed, std::vector<double> torque) {
  for (std::size_t k = 0; k < speed.size(); ++k) {
    log_speed_.push_back(std::log(speed[k]));
    log_torque_.push_back(std::log(torque[k]));
    if (k > 0) slope_.push_back((log_torque_[k] - log_torque_[k - 1]) / (log_speed_[k] - log_speed_[k - 1]));
  }
}

double Windage::operator()(double speed) const {
  const double w = std::fabs(speed);
  if (!(w > 0.)) return 0. * speed;  // keeps NaN
  if (log_speed_.empty()) {
    const double part = w / speed_;
    return std::copysign(torque_ * (exponent_ == 2. ? part * part : std::pow(part, exponent_)), speed);
  }
  const double x = std::log(w);
  if (x <= log_speed_.front()) return speed * std::exp(log_torque_.front() - log_speed_.front());
  const auto above = std::upper_bound(log_speed_.begin() + 1, log_speed_.end() - 1, x);
  const auto k = static_cast<std::size_t>(above - log_speed_.begin()) - 1;
  return std::copysign(std::exp(log_torque_[k] + slope_[k] * (x - log_speed_[k])), speed);
}

double windage_torque(const RotorGeometry& geometry, const WindageParameters& p, double speed) {
  const auto n_spans = geometry.node_x.size() - 1;
  std::vector<double> radius(n_spans + 2, 0.);  // a span of no size before and after the rotor
  for (const auto& element : geometry.elements) {
    double& r = radius[static_cast<std::size_t>(element.n1)];
    r = std::max(r, 0.5 * element.od);
  }
  const double rho = p.density, nu = p.viscosity;
  double torque = 0.;
  for (std::size_t k = 1; k <= n_spans; ++k) {
    const double r = radius[k], length = geometry.node_x[k] - geometry.node_x[k - 1];
    const double C = p.gap ? enclosed_cylinder_coefficient(speed * r * *p.gap / nu, *p.gap / r)
                           : free_cylinder_coefficient(speed * r * r / nu);
    torque += C * std::numbers::pi * rho * speed * speed * std::pow(r, 4) * length;
  }
  const auto face = [&](double r) {
    return r > 0. ? 0.5 * disc_face_coefficient(speed * r * r / nu) * rho * speed * speed * std::pow(r, 5) : 0.;
  };
  for (std::size_t k = 0; k <= n_spans; ++k) torque += std::fabs(face(radius[k + 1]) - face(radius[k]));
  return p.factor * torque;
}

Windage windage_of(const RotorGeometry& geometry, const WindageParameters& p) {
  if (p.law == WindageLaw::power) return {p.factor * *p.torque, *p.speed, p.exponent};
  if (p.factor == 0.) return {0., 1., 1.};
  // 60 points in each decade: smooth parts are met to 2e-5, changes of slope to 4e-4; jumps of the pieces become steep rises.
  std::vector<double> speed, torque;
  for (int k = 0; k <= 360; ++k) {
    speed.push_back(0.2 * std::pow(10., k / 60.));  // to 2e5 rad/s, the highest initial speed
    torque.push_back(windage_torque(geometry, p, speed.back()));
  }
  return {std::move(speed), std::move(torque)};
}

}  // namespace rotordrop
