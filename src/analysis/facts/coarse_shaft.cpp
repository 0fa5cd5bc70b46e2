#include "analysis/facts/coarse_shaft.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "rotor/modal_basis.h"

namespace rotordrop {
namespace {

constexpr double long_share = 0.125;    // of the rotor's length
constexpr double long_wave_share = 1.;  // of 1/k
constexpr Eigen::Index n_rigid_modes = 2, n_modes_always = 2;

/// Above it an element is long [m].
double longest_length(const RotorGeometry& geometry, const ShaftElement& e, double spin_speed) {
  const double share = long_share * (geometry.node_x.back() - geometry.node_x.front());
  const double omega = 2. * std::fabs(spin_speed);
  if (omega == 0.) return share;
  // Of a slender beam: k^4 = omega^2 rho A / (E I), and I / A = (od^2 + id^2) / 16.
  const double radius_of_gyration = 0.25 * std::hypot(e.od, e.id);
  const double k = std::sqrt(omega / radius_of_gyration * std::sqrt(e.material.rho / e.material.E));
  return std::min(share, long_wave_share / k);
}

/// The same shaft with every span between neighbouring nodes cut into equal pieces. @param pieces  [n_nodes] of the span that begins there
RotorGeometry cut(const RotorGeometry& geometry, const std::vector<int>& pieces) {
  RotorGeometry fine;
  std::vector<int> at(geometry.node_x.size());  // new numbers
  for (std::size_t i = 0; i < geometry.node_x.size(); ++i) {
    fine.node_x.push_back(geometry.node_x[i]);
    at[i] = fine.n_nodes();
    for (int piece = 1; piece < pieces[i]; ++piece)
      fine.node_x.push_back(geometry.node_x[i] + (geometry.node_x[i + 1] - geometry.node_x[i]) * piece / pieces[i]);
  }
  const auto number = [&](int node) { return at[static_cast<std::size_t>(node - 1)]; };
  for (ShaftElement e : geometry.elements) {
    const int first = number(e.n1), last = number(e.n2);
    for (int node = first; node < last; ++node) {
      e.n1 = node;
      e.n2 = node + 1;
      fine.elements.push_back(e);
    }
  }
  for (RotorMassPoint point : geometry.mass_points) {
    point.node = number(point.node);
    fine.mass_points.push_back(point);
  }
  return fine;
}

}  // namespace

std::optional<CoarseShaft> coarse_shaft(const RotorGeometry& geometry, double spin_speed, double largest_error) {
  constexpr int most_nodes = 300;  // their modes take some 0.3 s, twice; who has more has cut his shaft finely
  if (geometry.node_x.empty() || geometry.n_nodes() > most_nodes) return {};
  CoarseShaft shaft;
  std::vector<int> pieces(geometry.node_x.size(), 1);
  for (std::size_t i = 0; i < geometry.elements.size(); ++i) {
    const ShaftElement& e = geometry.elements[i];
    if (geometry.length(e) <= longest_length(geometry, e, spin_speed)) continue;
    shaft.elements.push_back(i);
    int& here = pieces[static_cast<std::size_t>(e.n1 - 1)];
    here = std::max(here, pieces_of(geometry, e, spin_speed));
  }
  if (shaft.elements.empty()) return {};
  const double all = std::numeric_limits<double>::infinity();
  const Eigen::VectorXd coarse = free_free_modes(geometry, all).omega,
                        fine = free_free_modes(cut(geometry, pieces), all).omega;
  double worst = largest_error;
  for (Eigen::Index k = n_rigid_modes; k < std::min(coarse.size(), fine.size()); ++k) {
    if (k >= n_rigid_modes + n_modes_always && fine(k) > 2. * std::fabs(spin_speed)) break;
    if (coarse(k) / fine(k) - 1. <= worst) continue;
    worst = coarse(k) / fine(k) - 1.;
    shaft.mode = static_cast<int>(k - n_rigid_modes) + 1;
    shaft.frequency = coarse(k) / (2. * std::numbers::pi);
    shaft.refined = fine(k) / (2. * std::numbers::pi);
  }
  if (shaft.mode == 0) return {};
  std::stable_sort(shaft.elements.begin(), shaft.elements.end(), [&](std::size_t a, std::size_t b) {
    return geometry.length(geometry.elements[a]) > geometry.length(geometry.elements[b]);
  });
  return shaft;
}

int pieces_of(const RotorGeometry& geometry, const ShaftElement& element, double spin_speed) {
  constexpr double most = 20.;  // of one element, whatever the speed
  return static_cast<int>(
      std::min(most, std::ceil(2. * geometry.length(element) / longest_length(geometry, element, spin_speed))));
}

}  // namespace rotordrop
