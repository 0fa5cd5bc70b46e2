#include "bearing/statics/ring_equilibrium.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/errors.h"

namespace rotordrop {
namespace {

using Vector = Eigen::VectorXd;

/// Rows and the lengths that an inner ring may move by: y, z; of a free ring also x and its tilts times half the pitch diameter; then, of bent rings,
/// what their shapes widen the grooves by.
struct Ring {
  const std::vector<BallRow>& rows;
  bool is_free;
  double cage_angle;
  std::span<const double> shape_stiffness;
  double arm = 0.5 * rows.front().geometry().pitch_diameter;
  std::vector<double> shape_rate = std::vector<double>(shape_stiffness.size());
  mutable std::vector<double> by_balls = std::vector<double>(shape_stiffness.size());  ///< on the shapes [N]

  [[nodiscard]] Eigen::Index n_places() const { return is_free ? 5 : 2; }
  [[nodiscard]] Eigen::Index n_shapes() const { return static_cast<Eigen::Index>(shape_stiffness.size()); }

  [[nodiscard]] BallRowInput at(const Vector& place) const {
    BallRowInput in;
    in.cage_angle = cage_angle;
    in.cage_cosine = std::cos(cage_angle);
    in.cage_sine = std::sin(cage_angle);
    in.displacement.y = place[0];
    in.displacement.z = place[1];
    if (is_free) {
      in.displacement.x = place[2];
      in.displacement.psi_y = place[3] / arm;
      in.displacement.psi_z = place[4] / arm;
    }
    if (n_shapes() > 0) {
      in.shape = {place.data() + n_places(), shape_stiffness.size()};
      in.shape_rate = shape_rate;
      in.shape_force = by_balls;
    }
    return in;
  }
  /// Of the balls on the ring, and of bent rings on themselves, conjugate to the place.
  [[nodiscard]] Vector force(const Vector& place) const {
    const BallRowInput in = at(place);
    std::ranges::fill(by_balls, 0.);
    Vector sum = Vector::Zero(place.size());
    BallRowOutput out;
    for (const auto& row : rows) {
      row.evaluate(in, out);
      sum[0] += out.force_y;
      sum[1] += out.force_z;
      if (is_free) {
        sum[2] += out.force_x;
        sum[3] += out.moment_y / arm;
        sum[4] += out.moment_z / arm;
      }
    }
    for (Eigen::Index k = 0; k < n_shapes(); ++k) {
      const auto j = static_cast<std::size_t>(k);
      sum[n_places() + k] = by_balls[j] - shape_stiffness[j] * place[n_places() + k];
    }
    return sum;
  }
  [[nodiscard]] double energy(const Vector& place) const {
    const BallRowInput in = at(place);
    double sum = 0.;
    for (const auto& row : rows) sum += row.energy(in);
    for (Eigen::Index k = 0; k < n_shapes(); ++k) {
      const double a = place[n_places() + k];
      sum += 0.5 * shape_stiffness[static_cast<std::size_t>(k)] * a * a;
    }
    return sum;
  }
  /// Sum of all balls' loads, of which forces are differences [N].
  [[nodiscard]] double load_of_balls(const Vector& place) const {
    const BallRowInput in = at(place);
    double sum = 0.;
    BallRowOutput out;
    for (const auto& row : rows) {
      row.evaluate(in, out);
      sum += out.inner_loads;
    }
    return sum;
  }
};

/// On the load's own line: the balls' reaction along it grows with the displacement.
Vector along_load(const Ring& ring, const Vector& load) {
  const Vector along = load.normalized();
  const auto surplus = [&](double s) { return (ring.force(s * along) + load).dot(along); };
  double low = 0., high = 1e-6;
  while (surplus(high) > 0. && high < 1e-2) high *= 2.;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (surplus(middle) > 0. ? low : high) = middle;
  }
  return 0.5 * (low + high) * along;
}

}  // namespace

RingAtRest ring_equilibrium(const std::vector<BallRow>& rows, const Force& force, bool is_free, double cage_angle,
                            std::span<const double> shape_stiffness) {
  const Ring ring{rows, is_free, cage_angle, shape_stiffness};
  Vector load = Vector::Zero(ring.n_places() + ring.n_shapes());
  load[0] = force.y;
  load[1] = force.z;
  if (is_free) load.segment(2, 3) << force.x, force.moment_y / ring.arm, force.moment_z / ring.arm;
  // Raceways with waves push the ring without any load, too.
  Vector place = load.norm() > 0. ? along_load(ring, load) : load;

  // Then in all directions, by damped Newton steps (Levenberg's) downhill in the energy: on a single ball the ring slides sideways until it
  // meets a second one. Without a sideways force it stays.
  const double first_residual = (ring.force(place) + load).norm();
  const double roundoff = 1e-13 * ring.load_of_balls(place);
  const double enough = std::max(1e-9 * load.norm(), roundoff);
  const auto potential = [&](const Vector& at) { return ring.energy(at) - load.dot(at); };
  const auto result = [&] {
    return RingAtRest{ring.at(place).displacement, {place.data() + ring.n_places(), place.data() + place.size()}};
  };
  double damping = std::max(load.norm(), 1e-3 * first_residual) / 1e-6;  // [N/m]: a first step of about a micrometre
  for (int iteration = 0; iteration < 1000; ++iteration) {
    const Vector residual = ring.force(place) + load;
    if (residual.norm() <= enough) return result();
    Eigen::MatrixXd stiffness(load.size(), load.size());
    const double h = 1e-10;
    for (Eigen::Index i = 0; i < load.size(); ++i) {
      const Vector step = h * Vector::Unit(load.size(), i);
      stiffness.col(i) = (ring.force(place + step) - ring.force(place - step)) / (2. * h);
    }
    const Eigen::MatrixXd damped =
        damping * Eigen::MatrixXd::Identity(load.size(), load.size()) - 0.5 * (stiffness + stiffness.transpose());
    const Vector next = place + damped.ldlt().solve(residual);
    const bool is_better = potential(next) < potential(place) || (ring.force(next) + load).norm() < residual.norm();
    damping *= is_better ? 0.2 : 4.;
    if (is_better) place = next;
  }
  // Where the balls hardly resist, rounding ends the descent early.
  if ((ring.force(place) + load).norm() < std::max(1e-6 * load.norm(), 1e3 * roundoff)) return result();
  throw SolverError("no equilibrium was found for the inner ring resting on its balls under its own weight");
}

}  // namespace rotordrop
