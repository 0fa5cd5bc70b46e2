// A row of balls between bent rings: the shapes at the balls, and the balls' forces on the shapes. The cage's angle turns coefficients, not
// tables: cos n (beta + cage) of every ball follows from cos n beta at cage angle zero.
#include "bearing/ball_row_bending.h"

#include <algorithm>

#include "base/wide_vectors.h"

namespace rotordrop {
namespace {

/// Per harmonic: coefficients of the shape, of its rate and of its slope, in the cage's frame.
struct Turned {
  double a, b, a_rate, b_rate, n;
};

ROTORDROP_WIDE_VECTORS
void add_shape(const Turned& t, const double* cosine, const double* sine, std::size_t n, double* width, double* rate,
               double* slope) {
  const double a = t.a, b = t.b, a_rate = t.a_rate, b_rate = t.b_rate, a_slope = t.n * t.b, b_slope = -t.n * t.a;
#pragma omp simd
  for (std::size_t j = 0; j < n; ++j) {
    width[j] += a * cosine[j] + b * sine[j];
    rate[j] += a_rate * cosine[j] + b_rate * sine[j];
    slope[j] += a_slope * cosine[j] + b_slope * sine[j];
  }
}

ROTORDROP_WIDE_VECTORS
void project(const double* force, const double* cosine, const double* sine, std::size_t n, double& a, double& b) {
  double sum_a = 0., sum_b = 0.;
#pragma omp simd reduction(+ : sum_a, sum_b)
  for (std::size_t j = 0; j < n; ++j) {
    sum_a += force[j] * cosine[j];
    sum_b += force[j] * sine[j];
  }
  a = sum_a;
  b = sum_b;
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

void BallRow::widen(const BallRowInput& in, Widening& w) const {
  for (auto* array : {&w.width, &w.rate, &w.slope}) std::fill_n(array->begin(), n_padded_, 0.);
  Turn turn(in.cage_cosine, in.cage_sine);
  for (std::size_t k = 0; k + 1 < in.shape.size(); k += 2, turn.next()) {
    const double C = turn.cosine(), S = turn.sine();
    const double *a = &in.shape[k], *rate = &in.shape_rate[k];
    const Turned turned{a[0] * C + a[1] * S, a[1] * C - a[0] * S, rate[0] * C + rate[1] * S, rate[1] * C - rate[0] * S,
                        2. + 0.5 * static_cast<double>(k)};
    const double* table = &shapes_[k * n_padded_];
    add_shape(turned, table, table + n_padded_, n_padded_, w.width.data(), w.rate.data(), w.slope.data());
  }
}

// Balls press the inner ring inwards.
void BallRow::press_shapes(const BallRowInput& in, Widening& w) const {
  Turn turn(in.cage_cosine, in.cage_sine);
  for (std::size_t k = 0; k + 1 < in.shape_force.size(); k += 2, turn.next()) {
    const double* table = &shapes_[k * n_padded_];
    double a, b;
    project(w.force.data(), table, table + n_padded_, n_padded_, a, b);
    in.shape_force[k] -= a * turn.cosine() - b * turn.sine();
    in.shape_force[k + 1] -= a * turn.sine() + b * turn.cosine();
  }
}

}  // namespace rotordrop
