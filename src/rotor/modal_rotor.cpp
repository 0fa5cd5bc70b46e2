#include "rotor/modal_rotor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "base/rotation.h"
#include "base/table_value.h"
#include "base/wide_vectors.h"
#include "rotor/modal_basis.h"
#include "rotor/modal_energy.h"

namespace rotordrop {

namespace {

double highest_frequency(const RotorSettings& settings) {
  switch (settings.representation) {
    case RotorRepresentation::rigid:
      return 0;
    case RotorRepresentation::modal:
      return settings.cut_off_frequency;
    case RotorRepresentation::full:
      break;
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace

double value_at(const TimeTable& table, double t) { return table.empty() ? 0. : table_value(table, t); }

Motion straight_line(double x1, double y1, double z1, double x2, double y2, double z2, double x) {
  const double slope_y = (y2 - y1) / (x2 - x1), slope_z = (z2 - z1) / (x2 - x1);
  Motion motion;
  motion.y = y1 + slope_y * (x - x1);
  motion.z = z1 + slope_z * (x - x1);
  motion.theta_z = slope_y;
  motion.theta_y = -slope_z;
  return motion;
}

Motion orbit(double radius, double angle, double whirl_speed) {
  Motion motion;
  motion.y = radius * std::cos(angle);
  motion.z = radius * std::sin(angle);
  motion.velocity_y = -whirl_speed * motion.z;
  motion.velocity_z = whirl_speed * motion.y;
  return motion;
}

Motion operator+(const Motion& a, const Motion& b) {
  return {a.x + b.x,
          a.y + b.y,
          a.z + b.z,
          a.theta_y + b.theta_y,
          a.theta_z + b.theta_z,
          a.velocity_x + b.velocity_x,
          a.velocity_y + b.velocity_y,
          a.velocity_z + b.velocity_z,
          a.tilt_rate_y + b.tilt_rate_y,
          a.tilt_rate_z + b.tilt_rate_z};
}

ModalRotor::ModalRotor(const RotorGeometry& geometry, const RotorSettings& settings,
                       const std::vector<int>& station_nodes)
    : n_stations_(station_nodes.size()),
      n_nodes_(geometry.node_x.size()),
      gravity_y_(settings.gravity_y),
      gravity_z_(settings.gravity_z),
      alpha_(settings.mass_proportional_alpha),
      drive_torque_(settings.drive_torque),
      windage_(settings.windage),
      axial_(settings.axial) {
  const bool has_residual = settings.residual_flexibility && settings.representation == RotorRepresentation::modal;
  const ModalBasis basis =
      free_free_modes(geometry, highest_frequency(settings), has_residual ? station_nodes : std::vector<int>{});
  const auto n = static_cast<std::size_t>(basis.n_modes());
  n_modes_ = n;
  body_ = basis.body;

  omega_squared_.resize(filled_up(n));
  damping_rate_.resize(filled_up(n));
  gyroscopic_.assign(n * filled_up(n), 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    omega_squared_[i] = basis.omega(row) * basis.omega(row);
    damping_rate_[i] = 2 * settings.modal_damping * basis.omega(row) + settings.mass_proportional_alpha;
    for (std::size_t j = 0; j < n; ++j)
      gyroscopic_[i * filled_up(n) + j] = basis.gyroscopic(row, static_cast<Eigen::Index>(j));
  }

  const auto lay_shape = [&](int node, std::size_t point, Shapes& to) {
    assert(node >= 1 && node <= geometry.n_nodes());
    for (std::size_t k = 0; k < n; ++k) {
      to.deflection(point, k) = basis.shape(2 * node - 2, static_cast<Eigen::Index>(k));
      to.slope(point, k) = basis.shape(2 * node - 1, static_cast<Eigen::Index>(k));
    }
  };
  node_shape_ = Shapes(n, n_nodes_);
  for (int node = 1; node <= geometry.n_nodes(); ++node)
    lay_shape(node, static_cast<std::size_t>(node - 1), node_shape_);
  station_shape_ = Shapes(n, n_stations_);
  force_influence_.assign(2 * n_stations_ * filled_up(n), 0.);
  for (std::size_t s = 0; s < n_stations_; ++s) {
    lay_shape(station_nodes[s], s, station_shape_);
    double* per_force = force_influence_.data() + 2 * s * filled_up(n);
    for (std::size_t k = 0; k < n; ++k) {
      per_force[k] = station_shape_.deflection(s, k) / body_.mass;
      per_force[filled_up(n) + k] = station_shape_.slope(s, k) / body_.mass;
    }
  }

  unbalance_cos_.assign(filled_up(n), 0.0);
  unbalance_sin_.assign(filled_up(n), 0.0);
  for (const auto& unbalance : settings.unbalance) {
    assert(unbalance.node >= 1 && unbalance.node <= geometry.n_nodes());
    for (std::size_t i = 0; i < n; ++i) {
      const double deflection = node_shape_.deflection(static_cast<std::size_t>(unbalance.node - 1), i);
      unbalance_cos_[i] += unbalance.me * std::cos(unbalance.angle) * deflection / body_.mass;
      unbalance_sin_[i] += unbalance.me * std::sin(unbalance.angle) * deflection / body_.mass;
    }
  }
}

std::vector<StateEntry> ModalRotor::state_entries() const {
  // Typical sizes in a drop: the rigid body moves a clearance at 0.1 m/s, impacts leave about 0.01 m/s in each flexible
  // mode.
  constexpr double clearance = 1e-4, fall_velocity = 0.1, flexible_velocity = 0.01;
  const auto frequency = mode_frequencies();
  const auto name = [&](char plane, std::size_t k) {
    const std::string kind = k == 0 ? "translation" : k == 1 ? "tilt" : fmt::format("{:.1f} Hz", frequency[k]);
    return fmt::format("{} mode {} ({})", plane, k + 1, kind);
  };
  std::vector<StateEntry> entries;
  for (const char plane : {'y', 'z'})
    for (std::size_t k = 0; k < n_modes_; ++k)
      entries.push_back({name(plane, k), "m", k < 2 ? clearance : flexible_velocity / std::sqrt(omega_squared_[k])});
  for (const char plane : {'y', 'z'})
    for (std::size_t k = 0; k < n_modes_; ++k)
      entries.push_back({name(plane, k) + " velocity", "m/s", k < 2 ? fall_velocity : flexible_velocity});
  entries.push_back({"spin angle", "rad", 1});
  entries.push_back({"spin speed", "rad/s", 1000});
  if (axial_) {
    entries.push_back({"axial position", "m", clearance});
    entries.push_back({"axial velocity", "m/s", fall_velocity});
  }
  return entries;
}

double ModalRotor::mode_shape(int node, std::size_t mode) const {
  return node_shape_.deflection(static_cast<std::size_t>(node - 1), mode);
}

std::vector<Oscillator> ModalRotor::oscillators() const {
  constexpr double least_damping = 2e-4;  // of critical
  std::vector<Oscillator> list;
  for (const std::size_t plane : {std::size_t{0}, n_modes_})
    for (std::size_t k = 2; k < n_modes_; ++k) {
      if (damping_rate_[k] < 2. * least_damping * std::sqrt(omega_squared_[k])) return {};
      list.push_back({plane + k, 2 * n_modes_ + plane + k, omega_squared_[k], damping_rate_[k]});
    }
  return list;
}

std::vector<double> ModalRotor::instants() const {
  std::vector<double> list;
  for (const auto& [t, torque] : drive_torque_) list.push_back(t);
  if (axial_)
    for (const auto& [t, force] : axial_->force) list.push_back(t);
  return list;
}

std::vector<Observable> ModalRotor::observables() const {
  if (n_modes_ <= 2) return {};
  std::vector<std::string> columns = {"translation", "tilt"};
  for (std::size_t k = 2; k < n_modes_; ++k) columns.push_back(fmt::format("bending {}", k - 1));
  std::vector<Observable> list;
  for (const char plane : {'y', 'z'})
    list.push_back({fmt::format("modal_{}", plane), "m",
                    fmt::format("coordinates of the rotor's free-free modes along {}", plane), n_modes_, columns});
  return list;
}

void ModalRotor::observe(std::span<const double> y, std::span<double> out) const {
  if (n_modes_ > 2) std::copy_n(y.begin(), 2 * n_modes_, out.begin());
}

void ModalRotor::add_axial_motion(std::span<const double> y, std::span<Motion> out) const {
  for (Motion& motion : out) {
    motion.x = y[axial_at()];
    motion.velocity_x = y[axial_at() + 1];
  }
}

void ModalRotor::add_axial_rates(double t, std::span<const double> y, std::span<const Force> force_on_station,
                                 std::span<double> dydt, RotorPower& power) const {
  const double velocity = y[axial_at() + 1], pull = value_at(axial_->force, t);
  double force = pull - alpha_ * body_.mass * velocity;
  for (const Force& on_station : force_on_station) force += on_station.x;
  dydt[axial_at()] = velocity;
  dydt[axial_at() + 1] = force / body_.mass + axial_->gravity;
  power.damping += alpha_ * body_.mass * velocity * velocity;
  power.drive_work += pull * velocity;
}

double ModalRotor::energy(std::span<const double> y) const {
  assert(y.size() == n_state());
  const std::size_t n = n_modes_;
  const double omega = y[4 * n + 1];
  double twice_per_mass = twice_energy_per_mass(y, n, omega_squared_.data(), gravity_y_, gravity_z_);
  if (axial_) twice_per_mass += y[axial_at() + 1] * y[axial_at() + 1] - 2 * axial_->gravity * y[axial_at()];
  return 0.5 * (body_.mass * twice_per_mass + body_.Ip * omega * omega);
}

void ModalRotor::initial_rigid_state(const Motion& motion_of_centre_of_gravity, const Spin& spin,
                                     std::span<double> y) const {
  assert(y.size() == n_state());
  const std::size_t n = n_modes_;
  const Motion& cg = motion_of_centre_of_gravity;
  const double radius_of_gyration = std::sqrt(body_.Id / body_.mass);
  std::fill(y.begin(), y.end(), 0.0);
  y[0] = cg.y;
  y[1] = radius_of_gyration * cg.theta_z;
  y[n] = cg.z;
  y[n + 1] = -radius_of_gyration * cg.theta_y;
  y[2 * n] = cg.velocity_y;
  y[2 * n + 1] = radius_of_gyration * cg.tilt_rate_z;
  y[3 * n] = cg.velocity_z;
  y[3 * n + 1] = -radius_of_gyration * cg.tilt_rate_y;
  y[4 * n] = spin.angle;
  y[4 * n + 1] = spin.speed;
  if (axial_) {
    y[axial_at()] = cg.x;
    y[axial_at() + 1] = cg.velocity_x;
  }
}

void ModalRotor::add_static_deflection(std::span<const Force> force_on_station, std::span<double> y) const {
  assert(y.size() == n_state() && force_on_station.size() == n_stations_);
  const std::size_t n = n_modes_;
  for (std::size_t s = 0; s < n_stations_; ++s)
    for (std::size_t i = 2; i < n; ++i) {
      const double per_force = station_shape_.deflection(s, i) / (body_.mass * omega_squared_[i]);
      y[i] += per_force * force_on_station[s].y;
      y[n + i] += per_force * force_on_station[s].z;
    }
}

std::vector<double> ModalRotor::mode_frequencies() const {
  std::vector<double> frequencies;
  for (std::size_t k = 0; k < n_modes_; ++k) frequencies.push_back(std::sqrt(omega_squared_[k]) / two_pi);
  return frequencies;
}

}  // namespace rotordrop
