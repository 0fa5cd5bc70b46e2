#include "analysis/facts/shoulder_report.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "bearing/row/ball_row.h"
#include "bearing/touchdown_data.h"
#include "machine/build_machine.h"
#include "rotor/geometry.h"

namespace rotordrop {
namespace {

/// The rows of a ring that moves along its axis, standing and cold.
class Rows {
 public:
  explicit Rows(const TouchdownBearingData& data) {
    for (const auto& geometry : data.rows) rows_.emplace_back(geometry, std::vector<RaceWave>{});
    energy_ = energy(0.);
  }
  /// On the ring, against its displacement [N].
  [[nodiscard]] double force(double x) const {
    double sum = 0.;
    for (const auto& row : rows_) {
      BallRowOutput out;
      row.evaluate(at(x), out);
      sum -= out.force_x;
    }
    return sum;
  }
  /// Over that of the mounted place [J].
  [[nodiscard]] double work(double x) const { return energy(x) - energy_; }

 private:
  static BallRowInput at(double x) {
    BallRowInput in;
    in.displacement.x = x;
    return in;
  }
  [[nodiscard]] double energy(double x) const {
    double sum = 0.;
    for (const auto& row : rows_) sum += row.energy(at(x));
    return sum;
  }
  std::vector<BallRow> rows_;
  double energy_ = 0;
};

/// F with thrust (gap + F/k + x) = F^2 / (2 k) + U(x), F = the rows' force at x.
double force_by_energy(const Rows& rows, double direction, double stiffness, double gap, double thrust) {
  const auto force = [&](double x) { return std::max(direction * rows.force(direction * x), 0.); };
  const auto left = [&](double x) {
    const double F = force(x);
    return thrust * (gap + F / stiffness + x) - 0.5 * F * F / stiffness - rows.work(direction * x);
  };
  double low = 0., high = 1e-6;
  while (left(high) > 0. && high < 1e-2) high *= 2.;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (left(middle) > 0. ? low : high) = middle;
  }
  return force(low);
}

}  // namespace

std::optional<ShoulderReport> shoulder_report(const MachineParameters& p, const std::string& name) {
  const auto& b = touchdown_of(p, name);
  if (!b.shoulders.any()) return std::nullopt;
  const auto around = touchdown_surroundings(p, b);
  const auto compliance = shoulder_compliance(b, around);
  ShoulderReport report;
  report.is_given = b.shoulders.stiffness.has_value();
  report.stiffness = shoulder_stiffness(b, around);
  report.rotor_stiffness = 1. / compliance.rotor;
  report.ring_stiffness = 1. / compliance.ring;
  const double mass = rigid_body(p.rotor.geometry).mass, weight = mass * p.run.gravity[0];
  double least = weight, most = weight;
  for (const auto& [t, force] : p.rotor.axial_force) {
    least = std::min(least, weight + force);
    most = std::max(most, weight + force);
  }
  auto data = touchdown_data_of(p, name, b);
  for (auto& row : data.rows) row.has_inertia = false;
  const Rows rows(data);
  for (const auto& [direction, gap, thrust] :
       {std::tuple(1., b.shoulders.gap_minus_x, most), std::tuple(-1., b.shoulders.gap_plus_x, -least)}) {
    if (!gap || !(thrust > 0.)) continue;
    ShoulderReport::Side side{direction, *gap, thrust, std::sqrt(2. * thrust * *gap / mass)};
    for (std::size_t i = 0; i < side.force.size(); ++i)
      side.force[i] = force_by_energy(rows, direction, ShoulderReport::parts[i] * report.stiffness, *gap, thrust);
    report.sides.push_back(side);
  }
  return report;
}

}  // namespace rotordrop
