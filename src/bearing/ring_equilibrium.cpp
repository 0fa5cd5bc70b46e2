#include "bearing/ring_equilibrium.h"

#include <Eigen/Dense>
#include <cmath>

#include "base/errors.h"

namespace rotordrop {
namespace {

using Vector = Eigen::Vector2d;

Vector ball_force(const std::vector<BallRow>& rows, const Vector& place) {
  BallRowInput in;
  in.displacement.y = place[0];
  in.displacement.z = place[1];
  Vector sum = Vector::Zero();
  BallRowOutput out;
  for (const auto& row : rows) {
    row.evaluate_translations(in, out);
    sum += Vector(out.force_y, out.force_z);
  }
  return sum;
}

double elastic_energy(const std::vector<BallRow>& rows, const Vector& place) {
  BallRowInput in;
  in.displacement.y = place[0];
  in.displacement.z = place[1];
  double sum = 0.;
  for (const auto& row : rows) sum += row.energy(in);
  return sum;
}

}  // namespace

RingDisplacement ring_equilibrium(const std::vector<BallRow>& rows, double force_y, double force_z) {
  const Vector force(force_y, force_z);
  if (force.norm() == 0.) return {};
  const Vector along = force.normalized();

  // First on the force's own line: the balls' reaction along it grows with the displacement.
  const auto surplus = [&](double s) { return (ball_force(rows, s * along) + force).dot(along); };
  double low = 0., high = 1e-6;
  while (surplus(high) > 0. && high < 1e-2) high *= 2.;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (surplus(middle) > 0. ? low : high) = middle;
  }
  Vector place = 0.5 * (low + high) * along;

  // Then in the plane, by damped Newton steps (Levenberg's) downhill in the energy: on a single ball the ring slides sideways until it
  // meets a second one. Without a sideways force it stays.
  const double enough = 1e-9 * force.norm();
  const auto potential = [&](const Vector& at) { return elastic_energy(rows, at) - force.dot(at); };
  double damping = force.norm() / 1e-6;  // [N/m]: a first step of a micrometre
  for (int iteration = 0; iteration < 1000; ++iteration) {
    const Vector residual = ball_force(rows, place) + force;
    if (residual.norm() < enough) return {0., place[0], place[1], 0., 0.};
    Eigen::Matrix2d stiffness;
    const double h = 1e-10;
    for (int i = 0; i < 2; ++i) {
      const Vector step = h * Vector::Unit(i);
      stiffness.col(i) = (ball_force(rows, place + step) - ball_force(rows, place - step)) / (2. * h);
    }
    const Eigen::Matrix2d damped = damping * Eigen::Matrix2d::Identity() - 0.5 * (stiffness + stiffness.transpose());
    const Vector next = place + damped.ldlt().solve(residual);
    const bool is_better =
        potential(next) < potential(place) || (ball_force(rows, next) + force).norm() < residual.norm();
    damping *= is_better ? 0.2 : 4.;
    if (is_better) place = next;
  }
  // Where the balls hardly resist, rounding ends the descent early.
  if ((ball_force(rows, place) + force).norm() < 1e-6 * force.norm()) return {0., place[0], place[1], 0., 0.};
  throw SolverError("the inner ring finds no equilibrium in its balls under its own weight");
}

}  // namespace rotordrop
