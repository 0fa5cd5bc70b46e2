#include "laws/ring_bending.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace rotordrop {
namespace {

/// Radius of the grooved surface at an axial position [m].
double grooved_radius(const RingSection& s, double x) {
  double r = s.has_grooves_outside ? s.outer_radius : s.inner_radius;
  for (const auto& g : s.grooves) {
    const double squared = g.radius * g.radius - (x - g.position) * (x - g.position);
    if (squared <= 0.) continue;
    if (s.has_grooves_outside)
      r = std::min(r, g.centre_radius - std::sqrt(squared));
    else
      r = std::max(r, g.centre_radius + std::sqrt(squared));
  }
  return r;
}

/// Axial positions of the mesh's lines: element boundaries fall on the edges of grooves.
std::vector<double> mesh_lines(const RingSection& s, int refinement) {
  const double half = 0.5 * s.width;
  const double surface = s.has_grooves_outside ? s.outer_radius : s.inner_radius;
  std::vector<double> edges = {-half, half};
  for (const auto& g : s.grooves) {
    const double squared = g.radius * g.radius - (g.centre_radius - surface) * (g.centre_radius - surface);
    if (squared <= 0.) continue;
    for (const double side : {-1., 0., 1.}) {
      const double x = g.position + side * std::sqrt(squared);
      if (std::fabs(x) < half) edges.push_back(x);
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<double> lines = {edges.front()};
  const double longest = s.width / (12. * refinement);
  for (std::size_t i = 1; i < edges.size(); ++i) {
    const double length = edges[i] - edges[i - 1];
    if (length < 1e-6 * s.width) continue;
    const int n = std::max(static_cast<int>(std::ceil(length / longest)), 1);
    for (int k = 1; k <= 2 * n; ++k) lines.push_back(edges[i - 1] + length * k / (2. * n));
  }
  return lines;
}

/// Symmetric matrix with entries near its diagonal, by rows of the lower triangle.
class BandMatrix {
 public:
  BandMatrix(std::size_t size, std::size_t band) : n_(size), w_(band + 1), a_(size * w_, 0.) {}
  double& at(std::size_t i, std::size_t j) { return a_[i * w_ + (j + w_ - 1 - i)]; }  // j <= i
  [[nodiscard]] double at(std::size_t i, std::size_t j) const { return a_[i * w_ + (j + w_ - 1 - i)]; }
  [[nodiscard]] std::size_t first(std::size_t i) const { return i < w_ ? 0 : i - w_ + 1; }
  /// Adds a multiple of one of the same size.
  void add(double factor, const BandMatrix& other) {
    for (std::size_t i = 0; i < a_.size(); ++i) a_[i] += factor * other.a_[i];
  }
  [[nodiscard]] std::vector<double> times(const std::vector<double>& x) const {
    std::vector<double> y(n_, 0.);
    for (std::size_t i = 0; i < n_; ++i)
      for (std::size_t j = first(i); j <= i; ++j) {
        y[i] += at(i, j) * x[j];
        if (j < i) y[j] += at(i, j) * x[i];
      }
    return y;
  }
  /// Cholesky's factor in place, then the solution.
  std::vector<double> solve(std::vector<double> x) {
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t j = first(i); j <= i; ++j) {
        double sum = at(i, j);
        for (std::size_t k = std::max(first(i), first(j)); k < j; ++k) sum -= at(i, k) * at(j, k);
        if (j < i)
          at(i, j) = sum / at(j, j);
        else if (sum > 0.)
          at(i, i) = std::sqrt(sum);
        else
          throw std::invalid_argument("the section of a ring has no stiffness");
      }
      for (std::size_t k = first(i); k < i; ++k) x[i] -= at(i, k) * x[k];
      x[i] /= at(i, i);
    }
    for (std::size_t i = n_; i-- > 0;) {
      x[i] /= at(i, i);
      for (std::size_t k = first(i); k < i; ++k) x[k] -= at(i, k) * x[i];
    }
    return x;
  }

 private:
  std::size_t n_, w_;
  std::vector<double> a_;
};

/// Quadratic functions of a line element, their values and slopes at s in [-1, 1].
struct Line {
  std::array<double, 3> value, slope;
  explicit Line(double s)
      : value{0.5 * s * (s - 1.), 1. - s * s, 0.5 * s * (s + 1.)}, slope{s - 0.5, -2. * s, s + 0.5} {}
};

/// Section with nine-node elements. Unknowns of a node: u_x, u_r (both times cos n theta) and u_theta (times sin n theta).
struct SectionMesh {
  std::vector<double> x, r;  // of the nodes, along r first
  std::size_t across, through;

  SectionMesh(const RingSection& s, int refinement) : across(0), through(4 * static_cast<std::size_t>(refinement) + 1) {
    const auto lines = mesh_lines(s, refinement);
    across = lines.size();
    for (const double at : lines)
      for (std::size_t j = 0; j < through; ++j) {
        const double grooved = grooved_radius(s, at);
        const double low = s.has_grooves_outside ? s.inner_radius : grooved;
        const double high = s.has_grooves_outside ? grooved : s.outer_radius;
        x.push_back(at);
        r.push_back(low + (high - low) * static_cast<double>(j) / static_cast<double>(through - 1));
      }
  }
  [[nodiscard]] std::size_t n_unknowns() const { return 3 * x.size(); }
  [[nodiscard]] std::size_t band() const { return 3 * (2 * through + 2) + 2; }
  [[nodiscard]] std::size_t node(std::size_t i, std::size_t j) const { return i * through + j; }

  /// Calls visit(nodes [9], value, slope along x, slope along r [9], radius, weight) at every point of Gauss' rule.
  template <class Visit>
  void at_points(Visit visit) const {
    const double q = std::sqrt(0.6);
    const std::array<double, 3> place = {-q, 0., q}, share = {5. / 9., 8. / 9., 5. / 9.};
    for (std::size_t i = 0; i + 2 < across; i += 2)
      for (std::size_t j = 0; j + 2 < through; j += 2)
        for (std::size_t a = 0; a < 3; ++a)
          for (std::size_t b = 0; b < 3; ++b) {
            const Line u(place[a]), v(place[b]);
            std::array<std::size_t, 9> nodes;
            std::array<double, 9> value, by_u, by_v, by_x, by_r;
            double x_u = 0, x_v = 0, r_u = 0, r_v = 0, radius = 0;
            for (std::size_t k = 0; k < 9; ++k) {
              const std::size_t c = k / 3, d = k % 3, at = nodes[k] = node(i + c, j + d);
              value[k] = u.value[c] * v.value[d];
              by_u[k] = u.slope[c] * v.value[d];
              by_v[k] = u.value[c] * v.slope[d];
              x_u += by_u[k] * x[at];
              x_v += by_v[k] * x[at];
              r_u += by_u[k] * r[at];
              r_v += by_v[k] * r[at];
              radius += value[k] * r[at];
            }
            const double area = x_u * r_v - x_v * r_u;
            for (std::size_t k = 0; k < 9; ++k) {
              by_x[k] = (by_u[k] * r_v - by_v[k] * r_u) / area;
              by_r[k] = (by_v[k] * x_u - by_u[k] * x_v) / area;
            }
            visit(nodes, value, by_x, by_r, radius, share[a] * share[b] * area);
          }
  }
};

/// Of unit angle: integrals over the circle are these times pi. Strains are linear in the number of waves, so stiffness is K_0 + n K_1 + n^2 K_2.
struct Matrices {
  std::array<BandMatrix, 3> K;
  BandMatrix M;

  [[nodiscard]] BandMatrix stiffness(int n) const {
    BandMatrix sum = K[0];
    sum.add(n, K[1]);
    sum.add(n * n, K[2]);
    return sum;
  }
};

using Strain = std::array<double, 6>;  // x, r, theta, x-r, x-theta, r-theta; stresses likewise

Matrices assemble(const RingSection& s, const SectionMesh& mesh) {
  const BandMatrix empty(mesh.n_unknowns(), mesh.band());
  Matrices m{{empty, empty, empty}, empty};
  const double G = 0.5 * s.E / (1. + s.nu), lame = s.E * s.nu / ((1. + s.nu) * (1. - 2. * s.nu));
  const auto stress_of = [&](const Strain& e) -> Strain {
    const double volume = lame * (e[0] + e[1] + e[2]);
    return {volume + 2. * G * e[0], volume + 2. * G * e[1], volume + 2. * G * e[2], G * e[3], G * e[4], G * e[5]};
  };
  const auto product = [](const Strain& a, const Strain& b) {
    double sum = 0.;
    for (std::size_t i = 0; i < 6; ++i) sum += a[i] * b[i];
    return sum;
  };
  mesh.at_points([&](const auto& nodes, const auto& N, const auto& N_x, const auto& N_r, double r, double area) {
    // Of every unknown at the point: what is there without waves, and what each wave adds.
    std::array<Strain, 27> plain, by_wave, plain_stress, stress_by_wave;
    for (std::size_t k = 0; k < 9; ++k) {
      const double over_r = N[k] / r;
      plain[3 * k] = {N_x[k], 0., 0., N_r[k], 0., 0.};
      plain[3 * k + 1] = {0., N_r[k], over_r, N_x[k], 0., 0.};
      plain[3 * k + 2] = {0., 0., 0., 0., N_x[k], N_r[k] - over_r};
      by_wave[3 * k] = {0., 0., 0., 0., -over_r, 0.};
      by_wave[3 * k + 1] = {0., 0., 0., 0., 0., -over_r};
      by_wave[3 * k + 2] = {0., 0., over_r, 0., 0., 0.};
    }
    for (std::size_t p = 0; p < 27; ++p) {
      plain_stress[p] = stress_of(plain[p]);
      stress_by_wave[p] = stress_of(by_wave[p]);
    }
    for (std::size_t p = 0; p < 27; ++p)
      for (std::size_t q = 0; q < 27; ++q) {
        const std::size_t row = 3 * nodes[p / 3] + p % 3, column = 3 * nodes[q / 3] + q % 3;
        if (column > row) continue;
        const double weight = r * area;
        m.K[0].at(row, column) += product(plain_stress[p], plain[q]) * weight;
        m.K[1].at(row, column) +=
            (product(plain_stress[p], by_wave[q]) + product(stress_by_wave[p], plain[q])) * weight;
        m.K[2].at(row, column) += product(stress_by_wave[p], by_wave[q]) * weight;
        if (p % 3 == q % 3) m.M.at(row, column) += s.rho * N[p / 3] * N[q / 3] * weight;
      }
  });
  return m;
}

}  // namespace

double RingSection::least_wall() const {
  double least = outer_radius - inner_radius;
  for (const auto& g : grooves) {
    const double bottom = has_grooves_outside ? g.centre_radius - g.radius : g.centre_radius + g.radius;
    least = std::min(least, has_grooves_outside ? bottom - inner_radius : outer_radius - bottom);
  }
  return least;
}

double RingHarmonic::frequency() const { return std::sqrt(stiffness / mass) / (2. * std::numbers::pi); }

std::vector<RingHarmonic> ring_harmonics(const RingSection& section, int highest, int refinement) {
  if (highest < 2) throw std::invalid_argument("a ring bends in harmonics 2 and above");
  if (!(section.least_wall() > 0.)) throw std::invalid_argument("a groove breaks through the wall of its ring");
  const SectionMesh mesh(section, refinement);
  const Matrices of_section = assemble(section, mesh);
  const BandMatrix& M = of_section.M;
  std::vector<double> radial(mesh.n_unknowns(), 0.);
  for (std::size_t k = 1; k < radial.size(); k += 3) radial[k] = 1.;
  std::vector<double> load = M.times(radial);
  const auto dot = [](const std::vector<double>& a, const std::vector<double>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.);
  };
  const double whole = dot(load, radial);
  for (double& f : load) f /= whole;
  std::vector<RingHarmonic> harmonics;
  for (int n = 2; n <= highest; ++n) {
    std::vector<double> shape = of_section.stiffness(n).solve(load);
    const double mean = dot(load, shape);
    for (double& u : shape) u /= mean;
    harmonics.push_back({n, std::numbers::pi / mean, std::numbers::pi * dot(shape, M.times(shape))});
  }
  return harmonics;
}

}  // namespace rotordrop
