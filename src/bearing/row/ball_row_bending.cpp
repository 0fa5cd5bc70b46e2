// A row of balls between bent rings: the shapes at the balls, and the balls' forces on the shapes. The cage's angle turns coefficients, not
// tables: cos n (beta + cage) of every ball follows from cos n beta at cage angle zero.
#include "bearing/row/ball_row_bending.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/wide_vectors.h"
#include "bearing/forces_on_shapes.h"

namespace rotordrop {
namespace {

/// Per harmonic: coefficients of the shape, of its rate and of its slope by azimuth, in the cage's frame.
struct Turned {
  double a, b, a_rate, b_rate, a_slope, b_slope;
};

/// At some vectors of balls, from the first of them on. @param table  cos, sin of every harmonic at all balls: [2 n_harmonics][n]
template <std::size_t vectors>
ROTORDROP_KERNEL void add_shapes_at(const Turned* turned, std::size_t n_harmonics, const double* table, std::size_t n,
                                    std::size_t first, Widening& w) {
  std::array<Octet, vectors> width{}, rate{}, slope{};
  for (std::size_t k = 0; k < n_harmonics; ++k, table += 2 * n) {
    const Turned t = turned[k];
    for (std::size_t v = 0; v < vectors; ++v) {
      const double *cosine = table + first + v * vector_length, *sine = cosine + n;
      add_product(width[v], t.a, cosine);
      add_product(width[v], t.b, sine);
      add_product(rate[v], t.a_rate, cosine);
      add_product(rate[v], t.b_rate, sine);
      add_product(slope[v], t.a_slope, cosine);
      add_product(slope[v], t.b_slope, sine);
    }
  }
  for (std::size_t v = 0; v < vectors; ++v)
#pragma omp simd
    for (std::size_t i = 0; i < vector_length; ++i) {
      const std::size_t j = first + v * vector_length + i;
      w.width[j] = width[v][i];
      w.rate[j] = rate[v][i];
      w.slope[j] = slope[v][i];
    }
}

/// Two vectors at a time share the coefficients; more would not leave them registers.
ROTORDROP_KERNEL void add_shapes(const Turned* turned, std::size_t n_harmonics, const double* table, std::size_t n,
                                 Widening& w) {
  std::size_t j = 0;
  for (; j + 2 * vector_length <= n; j += 2 * vector_length) add_shapes_at<2>(turned, n_harmonics, table, n, j, w);
  if (j < n) add_shapes_at<1>(turned, n_harmonics, table, n, j, w);
}

/// cos and sin of n times the cage's angle, n = 2, 3, ...: of n + m those of n turned by m times the angle, for twice as many n each time.
void turn(double cosine, double sine, std::size_t n_harmonics, CageTurns& t) {
  const auto turned = [&](std::size_t to, double c_n, double s_n, double c_m, double s_m) {
    t.cosine[to] = c_n * c_m - s_n * s_m;
    t.sine[to] = s_n * c_m + c_n * s_m;
  };
  turned(0, cosine, sine, cosine, sine);
  turned(1, t.cosine[0], t.sine[0], cosine, sine);
  for (std::size_t m = 2; m < n_harmonics; m *= 2) {
    const double c_m = t.cosine[m - 2], s_m = t.sine[m - 2];
    const std::size_t n_more = std::min(m, n_harmonics - m);
    for (std::size_t k = 0; k < n_more; ++k) turned(m + k, t.cosine[k], t.sine[k], c_m, s_m);
  }
}

}  // namespace

void BallRow::tabulate_shapes(const std::vector<double>& azimuth) {
  for (int n = 2; n <= geometry_.highest_harmonic; ++n)
    for (const bool is_cosine : {true, false}) {
      for (const double b : azimuth) shapes_.push_back(is_cosine ? std::cos(n * b) : std::sin(n * b));
      shapes_.resize(shapes_.size() + n_padded_ - azimuth.size(), 0.);
    }
  const std::size_t n_shapes = shapes_.size() / n_padded_, row = filled_up(n_shapes);
  shapes_by_ball_.assign(n_padded_ * row, 0.);
  for (std::size_t j = 0; j < n_padded_; ++j)
    for (std::size_t k = 0; k < n_shapes; ++k) shapes_by_ball_[j * row + k] = shapes_[k * n_padded_ + j];
}

void BallRow::widen(const BallRowInput& in, Widening& w) const {
  std::array<Turned, max_ball_harmonics> turned;
  const std::size_t n_harmonics = in.shape.size() / 2;
  turn(in.cage_cosine, in.cage_sine, n_harmonics, w.turns);
  for (std::size_t k = 0; k < n_harmonics; ++k) {
    const double C = w.turns.cosine[k], S = w.turns.sine[k];
    const double *a = &in.shape[2 * k], *rate = &in.shape_rate[2 * k];
    const double n = 2. + static_cast<double>(k), a_n = a[0] * C + a[1] * S, b_n = a[1] * C - a[0] * S;
    turned[k] = {a_n, b_n, rate[0] * C + rate[1] * S, rate[1] * C - rate[0] * S, n * b_n, -n * a_n};
  }
  wide<add_shapes>(turned.data(), n_harmonics, shapes_.data(), n_padded_, w);
}

// Balls press the inner ring inwards.
void BallRow::press_shapes(const BallRowInput& in, Widening& w) const {
  std::array<double, 2 * max_ball_harmonics> sums;
  forces_on_shapes(w.force.data(), shapes_by_ball_.data(), n_padded_, shapes_by_ball_.size() / n_padded_, sums.data());
  for (std::size_t k = 0; 2 * k < in.shape_force.size(); ++k) {
    const double a = sums[2 * k], b = sums[2 * k + 1], C = w.turns.cosine[k], S = w.turns.sine[k];
    in.shape_force[2 * k] -= a * C - b * S;
    in.shape_force[2 * k + 1] -= a * S + b * C;
  }
}

}  // namespace rotordrop
