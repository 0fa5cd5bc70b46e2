#include "study/many/answers/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "study/many/random_bits.h"

namespace rotordrop {
namespace {

/// Percentile interval of resampled values.
void take_interval(Estimate& estimate, std::vector<double>& resampled) {
  std::erase_if(resampled, [](double v) { return !std::isfinite(v); });
  if (resampled.size() < 40) return;
  std::sort(resampled.begin(), resampled.end());
  estimate.low = quantile_of(resampled, 0.025);
  estimate.high = quantile_of(resampled, 0.975);
}

std::size_t pick(std::uint64_t seed, std::size_t resample, std::size_t k, std::size_t n) {
  return std::min(n - 1, static_cast<std::size_t>(uniform_number(seed, resample, k) * static_cast<double>(n)));
}

/// First and total index of every parameter from chosen blocks. Values are centred: that leaves the formulas and saves digits.
void indices_of(const std::vector<const double*>& blocks, std::size_t d, std::vector<double>& first,
                std::vector<double>& total) {
  const auto n = static_cast<double>(blocks.size());
  double mean = 0., variance = 0.;
  for (const double* y : blocks) mean += y[0] + y[1];
  mean /= 2. * n;
  for (const double* y : blocks) variance += (y[0] - mean) * (y[0] - mean) + (y[1] - mean) * (y[1] - mean);
  variance /= 2. * n - 1.;
  for (std::size_t j = 0; j < d; ++j) {
    double s = 0., t = 0.;
    for (const double* y : blocks) {
      s += (y[1] - mean) * (y[2 + j] - y[0]);
      t += (y[0] - y[2 + j]) * (y[0] - y[2 + j]);
    }
    first[j] = s / n / variance;
    total[j] = t / (2. * n) / variance;
  }
}

}  // namespace

SobolResult sobol_indices(const std::vector<double>& y, std::size_t d, std::uint64_t seed, std::size_t n_resamples) {
  SobolResult result;
  const std::size_t width = d + 2, n_all = y.size() / width;
  std::vector<const double*> blocks;
  for (std::size_t k = 0; k < n_all; ++k) {
    const double* block = y.data() + k * width;
    if (std::all_of(block, block + width, [](double v) { return std::isfinite(v); })) blocks.push_back(block);
  }
  result.n_blocks = blocks.size();
  result.n_left_out = n_all - blocks.size();
  if (blocks.size() < 2) return result;
  std::vector<double> first(d), total(d);
  indices_of(blocks, d, first, total);
  result.parameters.resize(d);
  for (std::size_t j = 0; j < d; ++j) result.parameters[j] = {{first[j], {}, {}}, {total[j], {}, {}}};
  std::vector<std::vector<double>> firsts(d), totals(d);
  std::vector<const double*> chosen(blocks.size());
  for (std::size_t b = 0; b < n_resamples; ++b) {
    for (std::size_t k = 0; k < blocks.size(); ++k) chosen[k] = blocks[pick(seed, b, k, blocks.size())];
    indices_of(chosen, d, first, total);
    for (std::size_t j = 0; j < d; ++j) {
      firsts[j].push_back(first[j]);
      totals[j].push_back(total[j]);
    }
  }
  for (std::size_t j = 0; j < d; ++j) {
    take_interval(result.parameters[j].first, firsts[j]);
    take_interval(result.parameters[j].total, totals[j]);
  }
  return result;
}

FirstIndices::FirstIndices(FirstBy by, std::vector<std::vector<double>> x, std::uint64_t seed, std::size_t n_halves)
    : by_(by) {
  const std::size_t n = x.empty() ? 0 : x.front().size();
  for (std::size_t j = 0; j < x.size(); ++j) {
    auto& order = orders_.emplace_back(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    // Equal values are in random order.
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return x[j][a] != x[j][b] ? x[j][a] < x[j][b] : bits_of(seed, a, j) < bits_of(seed, b, j);
    });
    auto& level = levels_.emplace_back(n);
    for (std::size_t k = 1; k < n; ++k) level[order[k]] = level[order[k - 1]] + (x[j][order[k]] != x[j][order[k - 1]]);
  }
  std::vector<std::pair<std::uint64_t, std::size_t>> drawn(n);
  for (std::size_t h = 0; h < n_halves; ++h) {
    for (std::size_t k = 0; k < n; ++k) drawn[k] = {bits_of(seed + 1, h, k), k};
    std::nth_element(drawn.begin(), drawn.begin() + static_cast<std::ptrdiff_t>(n / 2), drawn.end());
    auto& half = halves_.emplace_back(n, std::uint8_t{0});
    for (std::size_t k = 0; k < n / 2; ++k) half[drawn[k].second] = 1;
  }
}

namespace {

/// A first index, and by how much scatter may make it too large.
struct FirstIndex {
  double value = std::nan(""), excess = 0.;
};

/// Values of the points that count, in an order.
std::vector<double> counted(const std::vector<std::size_t>& order, const std::vector<double>& y,
                            const std::uint8_t* counts) {
  std::vector<double> values;
  for (const std::size_t k : order)
    if (!counts || counts[k]) values.push_back(y[k]);
  return values;
}

/// One less half the mean square of neighbours' differences over the variance.
FirstIndex rank_index(const std::vector<std::size_t>& order, const std::vector<double>& y, const std::uint8_t* counts) {
  const std::vector<double> values = counted(order, y, counts);
  if (values.size() < 3) return {};
  double squares = 0.;
  for (std::size_t k = 1; k < values.size(); ++k) squares += (values[k] - values[k - 1]) * (values[k] - values[k - 1]);
  const double s = deviation_of(values);
  return {1. - squares / (2. * static_cast<double>(values.size() - 1) * s * s)};
}

/// Of n points.
std::size_t number_of_classes(std::size_t n) {
  std::size_t classes = 1;
  while (4 * classes * classes <= n) classes *= 2;
  return classes;
}

/// Variance of the classes' means over the variance. @param level  of each point
FirstIndex class_index(const std::vector<std::size_t>& order, const std::vector<std::size_t>& level,
                       const std::vector<double>& y, const std::uint8_t* counts) {
  const std::vector<double> values = counted(order, y, counts);
  const std::size_t n = values.size();
  if (n < 8) return {};
  std::size_t n_classes = number_of_classes(n);
  std::vector<std::size_t> ends;  // of the classes among the values
  if (level[order.back()] < n_classes) {
    std::size_t k = 0, last = level.size();
    for (const std::size_t point : order) {
      if (counts && !counts[point]) continue;
      if (k > 0 && level[point] != last) ends.push_back(k);
      last = level[point];
      ++k;
    }
    ends.push_back(n);
    n_classes = ends.size();
  } else {
    for (std::size_t c = 1; c <= n_classes; ++c) ends.push_back(c * n / n_classes);
  }
  const double mean = mean_of(values);
  double squares = 0., between = 0.;
  std::size_t k = 0;
  for (const std::size_t end : ends) {
    const std::size_t first = k;
    double sum = 0.;
    for (; k < end; ++k) {
      const double value = values[k] - mean;
      squares += value * value;
      sum += value;
    }
    between += sum * sum / static_cast<double>(end - first);
  }
  const double index = between / squares;
  return {index, static_cast<double>(n_classes - 1) / static_cast<double>(n - n_classes) * (1. - index)};
}

}  // namespace

std::vector<Estimate> FirstIndices::first(const std::vector<double>& y) const {
  std::vector<Estimate> result;
  for (std::size_t j = 0; j < orders_.size(); ++j) {
    std::vector<std::size_t> order;
    for (const std::size_t k : orders_[j])
      if (std::isfinite(y[k])) order.push_back(k);
    const auto index = [&](const std::uint8_t* counts) {
      return by_ == FirstBy::ranks ? rank_index(order, y, counts) : class_index(order, levels_[j], y, counts);
    };
    const FirstIndex of_all = index(nullptr);
    Estimate estimate{of_all.value, {}, {}};
    std::vector<double> of_halves;
    if (order.size() >= 20)
      for (const auto& half : halves_) of_halves.push_back(index(half.data()).value);
    std::erase_if(of_halves, [](double v) { return !std::isfinite(v); });  // in which nothing varies
    if (of_halves.size() > 1) {
      const double width = 1.959963984540054 * deviation_of(of_halves);
      estimate.low = of_all.value - of_all.excess - width;
      estimate.high = of_all.value + std::max(width, of_all.value - mean_of(of_halves));
    }
    result.push_back(estimate);
  }
  return result;
}

std::vector<MorrisEffects> morris_effects(const std::vector<double>& unit, const std::vector<double>& y, std::size_t d,
                                          std::uint64_t seed, std::size_t n_resamples) {
  std::vector<std::vector<double>> effects(d);
  for (std::size_t row = 0; row + 1 < y.size(); ++row) {
    if (row % (d + 1) == d || !std::isfinite(y[row]) || !std::isfinite(y[row + 1])) continue;
    for (std::size_t j = 0; j < d; ++j) {
      const double step = unit[(row + 1) * d + j] - unit[row * d + j];
      if (step != 0.) effects[j].push_back((y[row + 1] - y[row]) / step);
    }
  }
  std::vector<MorrisEffects> result(d);
  for (std::size_t j = 0; j < d; ++j) {
    const auto& e = effects[j];
    auto& r = result[j];
    r.n = e.size();
    if (e.empty()) continue;
    std::vector<double> magnitudes(e.size());
    std::transform(e.begin(), e.end(), magnitudes.begin(), [](double v) { return std::abs(v); });
    r.mean = mean_of(e);
    if (e.size() > 1) r.deviation = deviation_of(e);
    r.mean_magnitude.value = mean_of(magnitudes);
    if (e.size() < 4) continue;
    std::vector<double> means;
    for (std::size_t b = 0; b < n_resamples; ++b) {
      double sum = 0.;
      for (std::size_t k = 0; k < e.size(); ++k) sum += magnitudes[pick(seed + j, b, k, e.size())];
      means.push_back(sum / static_cast<double>(e.size()));
    }
    take_interval(r.mean_magnitude, means);
  }
  return result;
}

}  // namespace rotordrop
