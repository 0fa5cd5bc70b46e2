#include "laws/support/support_laws.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace rotordrop {
namespace {

constexpr std::array<const char*, 2> axis_names = {"y", "z"};

std::array<double, 2> place_of(const SupportMotion& m) { return {m.y, m.z}; }
std::array<double, 2> velocity_of(const SupportMotion& m) { return {m.vy, m.vz}; }

}  // namespace

SupportPlace resting_place(const SupportLaw& law, double force_y, double force_z) {
  // Newton's method on a convex energy, halved where it would rise; near the minimum, where rounding hides that, where the force left would.
  SupportPlace at;
  const auto rises = [&](const SupportRest& here, double d_y, double d_z) {
    const SupportRest there = law.rest(at.y + d_y, at.z + d_z);
    const auto left = [&](const SupportRest& r) { return std::hypot(r.force_y + force_y, r.force_z + force_z); };
    return there.energy - here.energy > force_y * d_y + force_z * d_z && left(there) > left(here);
  };
  for (int step = 0; step < 200; ++step) {
    const SupportRest r = law.rest(at.y, at.z);
    const double f_y = r.force_y + force_y, f_z = r.force_z + force_z;
    const double determinant = r.k_yy * r.k_zz - r.k_yz * r.k_zy;
    if (!(determinant > 0.)) break;
    double d_y = (r.k_zz * f_y - r.k_yz * f_z) / determinant, d_z = (r.k_yy * f_z - r.k_zy * f_y) / determinant;
    for (int half = 0; half < 60 && rises(r, d_y, d_z); ++half) {
      d_y *= 0.5;
      d_z *= 0.5;
    }
    at.y += d_y;
    at.z += d_z;
    if (std::hypot(d_y, d_z) <= 1e-15 * (1e-6 + std::hypot(at.y, at.z))) break;
  }
  return at;
}

// ---------------------------------------------------------------------------------------------- springs

SupportAnswer SpringSupport::evaluate(const SupportMotion& m, std::span<const double>, std::span<double>) const {
  const double damper_y = C_[0] * m.vy, damper_z = C_[1] * m.vz;
  return {-K_[0] * m.y - damper_y, -K_[1] * m.z - damper_z, damper_y * m.vy + damper_z * m.vz};
}

double SpringSupport::energy(const SupportMotion& m, std::span<const double>) const {
  return 0.5 * (K_[0] * m.y * m.y + K_[1] * m.z * m.z);
}

SupportRest SpringSupport::rest(double y, double z) const {
  return {-K_[0] * y, -K_[1] * z, K_[0], 0., 0., K_[1], 0.5 * (K_[0] * y * y + K_[1] * z * z)};
}

// ---------------------------------------------------------------------------------------------- ribbon

// Deflections of the sliders: all along y, then all along z.
std::vector<SupportLaw::State> RibbonSupport::states() const {
  std::vector<State> all;
  for (const char* axis : axis_names)
    for (std::size_t j = 0; j < axis_.elements.size(); ++j)
      all.push_back({"slider " + std::to_string(j + 1) + " " + axis, "m", axis_.elements[j].reach});
  return all;
}

void RibbonSupport::settle(double y, double z, std::span<double> inner) const {
  const std::size_t n = axis_.elements.size();
  const double length = std::hypot(y, z);
  for (std::size_t j = 0; j < n; ++j) {
    const double part = length > 0. ? axis_.elements[j].pushed(length) / length : 1.;
    inner[j] = part * y;
    inner[n + j] = part * z;
  }
}

SupportAnswer RibbonSupport::evaluate(const SupportMotion& m, std::span<const double> inner,
                                      std::span<double> rates) const {
  const std::size_t n = axis_.elements.size();
  double f_y = axis_.stiffness * m.y + axis_.damping * m.vy, f_z = axis_.stiffness * m.z + axis_.damping * m.vz;
  double loss = axis_.damping * (m.vy * m.vy + m.vz * m.vz);
  for (std::size_t j = 0; j < n; ++j) {
    const StopOperator& slider = axis_.elements[j];
    const double z_y = inner[j], z_z = inner[n + j], length = std::sqrt(z_y * z_y + z_z * z_z);
    const double per_length = length > 0. ? 1. / length : 0., e_y = z_y * per_length, e_z = z_z * per_length;
    const double flow = slider.flow(length, m.vy * e_y + m.vz * e_z);
    f_y += slider.stiffness * z_y;
    f_z += slider.stiffness * z_z;
    loss += slider.stiffness * length * flow;
    rates[j] = m.vy - flow * e_y;
    rates[n + j] = m.vz - flow * e_z;
  }
  return {-f_y, -f_z, loss};
}

double RibbonSupport::energy(const SupportMotion& m, std::span<const double> inner) const {
  const std::size_t n = axis_.elements.size();
  double U = 0.5 * axis_.stiffness * (m.y * m.y + m.z * m.z);
  for (std::size_t j = 0; j < n; ++j)
    U += 0.5 * axis_.elements[j].stiffness * (inner[j] * inner[j] + inner[n + j] * inner[n + j]);
  return U;
}

SupportRest RibbonSupport::rest(double y, double z) const {
  const double length = std::hypot(y, z);
  double along = axis_.stiffness, across = axis_.stiffness, U = 0.5 * axis_.stiffness * length * length;
  for (const StopOperator& slider : axis_.elements) {
    along += slider.stiffness * slider.pushed_slope(length);
    across += slider.stiffness * (length > 0. ? slider.pushed(length) / length : 1.);
    U += slider.pushed_energy(length);
  }
  const double n_y = length > 0. ? y / length : 1., n_z = length > 0. ? z / length : 0.;
  const double mixed = (along - across) * n_y * n_z;
  return {-across * y,
          -across * z,
          along * n_y * n_y + across * n_z * n_z,
          mixed,
          mixed,
          along * n_z * n_z + across * n_y * n_y,
          U};
}

// ---------------------------------------------------------------------------------------------- elastomer

std::vector<SupportLaw::State> ElastomerSupport::states() const {
  constexpr double usual = 1e-5;  // [m]
  std::vector<State> all;
  for (std::size_t axis = 0; axis < 2; ++axis)
    for (std::size_t j = 0; j < axes_[axis].elements.size(); ++j)
      all.push_back({"Maxwell element " + std::to_string(j + 1) + " " + axis_names[axis], "m", usual});
  return all;
}

void ElastomerSupport::settle(double, double, std::span<double> inner) const {
  std::fill(inner.begin(), inner.end(), 0.);
}

SupportAnswer ElastomerSupport::evaluate(const SupportMotion& m, std::span<const double> inner,
                                         std::span<double> rates) const {
  const auto x = place_of(m), v = velocity_of(m);
  std::array<double, 2> force{};
  double loss = 0.;
  std::size_t at = 0;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const MaxwellModel& a = axes_[axis];
    double f = a.stiffness * x[axis] + a.damping * v[axis];
    loss += a.damping * v[axis] * v[axis];
    for (const auto& e : a.elements) {
      const double q = inner[at], flow = q / e.time;
      f += e.stiffness * q;
      loss += e.stiffness * q * flow;
      rates[at++] = v[axis] - flow;
    }
    force[axis] = -f;
  }
  return {force[0], force[1], loss};
}

double ElastomerSupport::energy(const SupportMotion& m, std::span<const double> inner) const {
  const auto x = place_of(m);
  double U = 0.;
  std::size_t at = 0;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    U += 0.5 * axes_[axis].stiffness * x[axis] * x[axis];
    for (const auto& e : axes_[axis].elements) {
      U += 0.5 * e.stiffness * inner[at] * inner[at];
      ++at;
    }
  }
  return U;
}

SupportRest ElastomerSupport::rest(double y, double z) const {
  const double k_y = axes_[0].stiffness, k_z = axes_[1].stiffness;
  return {-k_y * y, -k_z * z, k_y, 0., 0., k_z, 0.5 * (k_y * y * y + k_z * z * z)};
}

std::array<double, 2> MaxwellModel::dynamic_stiffness(double w) const {
  double storage = stiffness, loss = damping * w;
  for (const auto& e : elements) {
    const double s = w * e.time;
    storage += e.stiffness * s * s / (1. + s * s);
    loss += e.stiffness * s / (1. + s * s);
  }
  return {storage, loss};
}

// ---------------------------------------------------------------------------------------------- squeeze film

std::array<double, 2> SqueezeFilm::force(const SupportMotion& m) const {
  const double speed = std::hypot(m.vy, m.vz);
  if (speed == 0.) return {0., 0.};
  // Gauss-Legendre on the half circle about the direction of motion, where the film closes; the film opens on the other half.
  constexpr std::size_t n_half = 12;
  static constexpr std::array<double, n_half> nodes = {0.0640568928626056, 0.1911188674736163, 0.3150426796961634,
                                                       0.4337935076260451, 0.5454214713888396, 0.6480936519369755,
                                                       0.7401241915785544, 0.8200019859739029, 0.8864155270044011,
                                                       0.9382745520027328, 0.9747285559713095, 0.9951872199970213};
  static constexpr std::array<double, n_half> weights = {0.1279381953467522, 0.1258374563468283, 0.1216704729278034,
                                                         0.1155056680537256, 0.1074442701159656, 0.0976186521041139,
                                                         0.0861901615319533, 0.0733464814110803, 0.0592985849154368,
                                                         0.0442774388174198, 0.0285313886289337, 0.0123412297999872};
  const double u_y = m.vy / speed, u_z = m.vz / speed;
  const double scale = viscosity * radius * length * length * length * 0.5 * std::numbers::pi;
  double f_y = 0., f_z = 0.;
  for (const double half : {1., -1.}) {
    if (half < 0. && cavitates) break;
    for (std::size_t i = 0; i < 2 * n_half; ++i) {
      const double x = i < n_half ? nodes[i] : -nodes[i - n_half], w = weights[i % n_half];
      const double angle = 0.5 * std::numbers::pi * x;
      const double c = half * std::cos(angle), s = half * std::sin(angle);
      const double n_y = c * u_y - s * u_z, n_z = c * u_z + s * u_y;
      const double h = std::max(clearance - m.y * n_y - m.z * n_z, thinnest * clearance);
      const double q = w * scale * speed * c / (h * h * h);  // closing speed of the film there: speed * c
      f_y -= q * n_y;
      f_z -= q * n_z;
    }
  }
  return {f_y, f_z};
}

SupportAnswer SqueezeFilmSupport::evaluate(const SupportMotion& m, std::span<const double> inner,
                                           std::span<double> rates) const {
  SupportAnswer r = carried_->evaluate(m, inner, rates);
  const auto film = film_.force(m);
  r.y += film[0];
  r.z += film[1];
  r.loss -= film[0] * m.vy + film[1] * m.vz;
  return r;
}

// ---------------------------------------------------------------------------------------------- round stop

SupportAnswer StoppedSupport::evaluate(const SupportMotion& m, std::span<const double> inner,
                                       std::span<double> rates) const {
  SupportAnswer r = carried_->evaluate(m, inner, rates);
  const double travel = std::sqrt(m.y * m.y + m.z * m.z), delta = travel - gap_;
  if (delta > 0.) {
    const double n_y = m.y / travel, n_z = m.z / travel, rate = m.vy * n_y + m.vz * n_z;
    const double elastic = contact_.elastic(delta), normal = contact_.total(elastic, rate);
    r.y -= normal * n_y;
    r.z -= normal * n_z;
    r.loss += (normal - elastic) * rate;
  }
  return r;
}

double StoppedSupport::energy(const SupportMotion& m, std::span<const double> inner) const {
  return carried_->energy(m, inner) + contact_.energy(std::sqrt(m.y * m.y + m.z * m.z) - gap_);
}

SupportRest StoppedSupport::rest(double y, double z) const {
  SupportRest r = carried_->rest(y, z);
  const double travel = std::sqrt(y * y + z * z), delta = travel - gap_;
  if (delta > 0.) {
    const double n_y = y / travel, n_z = z / travel, N = contact_.elastic(delta);
    const double along = contact_.n * N / delta, across = N / travel;
    r.force_y -= N * n_y;
    r.force_z -= N * n_z;
    r.k_yy += along * n_y * n_y + across * n_z * n_z;
    r.k_zz += along * n_z * n_z + across * n_y * n_y;
    r.k_yz += (along - across) * n_y * n_z;
    r.k_zy += (along - across) * n_y * n_z;
    r.energy += contact_.energy(delta);
  }
  return r;
}

// ---------------------------------------------------------------------------------------------- two laws

std::vector<SupportLaw::State> SplitSupport::states() const {
  auto all = y_->states();
  for (auto& state : all) state.name += " (law of y)";
  for (auto state : z_->states()) {
    state.name += " (law of z)";
    all.push_back(std::move(state));
  }
  return all;
}

void SplitSupport::settle(double y, double z, std::span<double> inner) const {
  y_->settle(y, 0., inner.first(n_y_));
  z_->settle(0., z, inner.subspan(n_y_));
}

SupportAnswer SplitSupport::evaluate(const SupportMotion& m, std::span<const double> inner,
                                     std::span<double> rates) const {
  const auto a = y_->evaluate({m.y, 0., m.vy, 0.}, inner.first(n_y_), rates.first(n_y_));
  const auto b = z_->evaluate({0., m.z, 0., m.vz}, inner.subspan(n_y_), rates.subspan(n_y_));
  return {a.y, b.z, a.loss + b.loss};
}

double SplitSupport::energy(const SupportMotion& m, std::span<const double> inner) const {
  return y_->energy({m.y, 0., m.vy, 0.}, inner.first(n_y_)) + z_->energy({0., m.z, 0., m.vz}, inner.subspan(n_y_));
}

SupportRest SplitSupport::rest(double y, double z) const {
  const SupportRest a = y_->rest(y, 0.), b = z_->rest(0., z);
  return {a.force_y, b.force_z, a.k_yy, 0., 0., b.k_zz, a.energy + b.energy};
}

}  // namespace rotordrop
