#include "bearing/row/inertial_balls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <mutex>

#include "base/level_choice.h"
#include "bearing/row/inertial_kernels.h"
#include "laws/ball_balance.h"

namespace rotordrop {

InertialRow inertial_row(double K_i, double K_o, double l_i, double l_o, double g, double inner_gyroscopic_share,
                         double B_x, double B_r) {
  const double c_i = std::pow(K_i, -2. / 3.), c_o = std::pow(K_o, -2. / 3.), B = std::hypot(B_x, B_r);
  return {K_i,
          K_o,
          l_i,
          l_o,
          g,
          inner_gyroscopic_share,
          c_i,
          c_o,
          std::cbrt(K_i),
          std::cbrt(K_o),
          1. / (c_i + c_o),
          B_x,
          B_r,
          B_x / B_r,
          B / B_r,
          B_x != 0. ? 1. / B_x : 0.,
          1. / B};
}

const InertialKernels& inertial_kernels() {
  static const InertialKernels& chosen = ROTORDROP_OF_LEVEL(inertial_kernels)();
  return chosen;
}

InertialStarts::InertialStarts(const InertialRow& row, double force_per_speed2)
    : per_force_(1. / (force_per_speed2 * speed_step * speed_step)), places_(n_speeds * line_length) {
  // At some speeds by the balance; places go with the force, that is with the square of the speed: a cubic through four of them tells the speeds between.
  constexpr std::size_t n_known = 65, between = (n_speeds - 1) / (n_known - 1);
  static_assert(between * (n_known - 1) == n_speeds - 1);
  using Line = std::array<double, line_length>;
  std::vector<Line> known(n_known);
  InertialBalls w;
  w.n = InertialBalls::capacity;
  static_assert(n_radii % InertialBalls::capacity == 0);
  w.added_i.fill(0.);
  w.added_o.fill(0.);
  w.B_x.fill(row.B_x);
  for (std::size_t s = 0; s < n_known; ++s) {
    const double speed = std::max(speed_step * static_cast<double>(s * between), 1.);
    for (std::size_t first = 0; first < n_radii; first += w.n) {
      for (std::size_t j = 0; j < w.n; ++j) w.B_r[j] = row.B_r - reach + radius_step * static_cast<double>(first + j);
      balance_balls(row, force_per_speed2 * speed * speed, w);
      for (std::size_t j = 0; j < w.n; ++j) {
        known[s][2 * (first + j)] = w.delta_o[j];
        known[s][2 * (first + j) + 1] = w.o_x[j];
      }
    }
  }
  float* place = places_.data();
  for (std::size_t s = 0; s < n_speeds; ++s) {
    const std::size_t first = std::clamp<std::size_t>(s / between, 1, n_known - 3) - 1;
    std::array<double, 4> weights;
    for (std::size_t k = 0; k < weights.size(); ++k) {
      const auto square = [](std::size_t of) { return static_cast<double>(of * of); };
      const double node = square((first + k) * between);
      weights[k] = 1.;
      for (std::size_t other = 0; other < weights.size(); ++other) {
        const double at = square((first + other) * between);
        if (other != k) weights[k] *= (square(s) - at) / (node - at);
      }
    }
    for (std::size_t j = 0; j < line_length; ++j) {
      double sum = 0.;
      for (std::size_t k = 0; k < weights.size(); ++k) sum += weights[k] * known[first + k][j];
      *place++ = static_cast<float>(sum);
    }
  }
}

InertialStart InertialStarts::at(double F_0) const {
  const double square = F_0 * per_force_, speed = std::sqrt(square);
  if (!(speed < static_cast<double>(n_speeds - 1))) return nowhere();
  const auto slower = static_cast<std::size_t>(speed);
  const double s = static_cast<double>(slower);
  // Places go with the force, that is with the square of the speed.
  const auto part = static_cast<float>((square - s * s) / (2. * s + 1.));
  return {{&places_[slower * line_length], line_length, {1.f - part, part}}, n_radii - 1.001};
}

InertialStart InertialStarts::nowhere() {
  static constexpr std::array<float, 2 * line_length> none{};
  return {{none.data(), line_length, {}}, -std::numeric_limits<double>::infinity()};
}

std::shared_ptr<const InertialStarts> shared_starts(const InertialRow& row, double force_per_speed2) {
  using Key = std::array<double, sizeof(InertialRow) / sizeof(double) + 1>;
  static std::mutex mutex;
  static std::map<Key, std::weak_ptr<const InertialStarts>> made;
  Key key;
  std::memcpy(key.data(), &row, sizeof row);
  key.back() = force_per_speed2;
  const std::lock_guard lock(mutex);
  std::erase_if(made, [](const auto& entry) { return entry.second.expired(); });
  auto starts = made[key].lock();
  if (!starts) made[key] = starts = std::make_shared<InertialStarts>(row, force_per_speed2);
  return starts;
}

void balance_balls(const InertialRow& row, double F_0, InertialBalls& balls, const InertialStarts* starts) {
  inertial_kernels().balance(row, F_0, starts ? starts->at(F_0) : InertialStarts::nowhere(), balls);
}

CarefulPlace careful_place(const InertialRow& row, double F_0, double B_x, double B_r, double added_i, double added_o) {
  const BallContacts contacts{row.K_i, row.K_o, row.l_i - added_i,         row.l_o - added_o, 2. * F_0,
                              row.g,   1.,      row.inner_gyroscopic_share};
  const BallBalance b = ball_balance(contacts, B_x, B_r, 0., 1.);
  return {row.c_o * std::cbrt(b.load_o * b.load_o), b.sin_o, b.cos_o};
}

}  // namespace rotordrop
