// A row of balls between bent rings: the shapes at the balls, and the balls' forces on the shapes. The cage's angle turns coefficients, not
// tables: cos n (beta + cage) of every ball follows from cos n beta at cage angle zero.
#include "bearing/row/ball_row_bending.h"

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

constexpr std::size_t max_harmonics = 40;  // 2 to 41

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

/// cos and sin of n times the cage's angle, n = 2, 3, ...
class Turn {
 public:
  Turn(double cosine, double sine) : c_(cosine), s_(sine), cosine_(c_ * c_ - s_ * s_), sine_(2. * s_ * c_) {}
  [[nodiscard]] double cosine() const { return cosine_; }
  [[nodiscard]] double sine() const { return sine_; }
  void next() {
    const double c = cosine_ * c_ - sine_ * s_;
    sine_ = sine_ * c_ + cosine_ * s_;
    cosine_ = c;
  }

 private:
  double c_, s_, cosine_, sine_;
};

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
  std::array<Turned, max_harmonics> turned;
  Turn turn(in.cage_cosine, in.cage_sine);
  const std::size_t n_harmonics = in.shape.size() / 2;
  for (std::size_t k = 0; k < n_harmonics; ++k, turn.next()) {
    const double C = turn.cosine(), S = turn.sine();
    const double *a = &in.shape[2 * k], *rate = &in.shape_rate[2 * k];
    const double n = 2. + static_cast<double>(k), a_n = a[0] * C + a[1] * S, b_n = a[1] * C - a[0] * S;
    turned[k] = {a_n, b_n, rate[0] * C + rate[1] * S, rate[1] * C - rate[0] * S, n * b_n, -n * a_n};
  }
  wide<add_shapes>(turned.data(), n_harmonics, shapes_.data(), n_padded_, w);
}

// Balls press the inner ring inwards.
void BallRow::press_shapes(const BallRowInput& in, Widening& w) const {
  std::array<double, 2 * max_harmonics> sums;
  const std::size_t n_harmonics = in.shape_force.size() / 2;
  forces_on_shapes(w.force.data(), shapes_by_ball_.data(), n_padded_, shapes_by_ball_.size() / n_padded_, sums.data());
  Turn turn(in.cage_cosine, in.cage_sine);
  for (std::size_t k = 0; k < n_harmonics; ++k, turn.next()) {
    const double a = sums[2 * k], b = sums[2 * k + 1];
    in.shape_force[2 * k] -= a * turn.cosine() - b * turn.sine();
    in.shape_force[2 * k + 1] -= a * turn.sine() + b * turn.cosine();
  }
}

}  // namespace rotordrop
