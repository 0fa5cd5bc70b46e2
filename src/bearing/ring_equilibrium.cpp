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

  // Then in the plane, by Newton steps of least norm: a direction without stiffness is left alone.
  const double enough = 1e-9 * force.norm();
  for (int iteration = 0; iteration < 100; ++iteration) {
    const Vector residual = ball_force(rows, place) + force;
    if (residual.norm() < enough) return {0., place[0], place[1], 0., 0.};
    Eigen::Matrix2d stiffness;
    const double h = 1e-10;
    for (int i = 0; i < 2; ++i) {
      const Vector step = h * Vector::Unit(i);
      stiffness.col(i) = (ball_force(rows, place + step) - ball_force(rows, place - step)) / (2. * h);
    }
    Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix2d> factors(stiffness);
    factors.setThreshold(1e-9);
    Vector step = -factors.solve(residual);
    for (int halving = 0; halving < 40; ++halving, step *= 0.5)
      if ((ball_force(rows, place + step) + force).norm() < residual.norm()) break;
    place += step;
  }
  throw SolverError("the inner ring finds no equilibrium in its balls under its own weight");
}

}  // namespace rotordrop
