#include "machine/heat/growth_history.h"

#include <algorithm>

namespace rotordrop {
void GrowthHistory::append(double time, std::span<const Expansion> growth) {
  times_.push_back(time);
  growth_.insert(growth_.end(), growth.begin(), growth.end());
}

void GrowthHistory::cut(double time) {
  if (times_.empty() || times_.back() <= time) return;
  std::vector<Expansion> now(n_places_);
  at(time, now);
  const std::size_t kept =
      static_cast<std::size_t>(std::lower_bound(times_.begin(), times_.end(), time) - times_.begin());
  times_.resize(kept);
  growth_.resize(kept * n_places_);
  append(time, now);
}

std::vector<double> GrowthHistory::packed_tail() const {
  std::vector<double> values;
  for (std::size_t k = times_.size() < 2 ? 0 : times_.size() - 2; k < times_.size(); ++k) {
    values.push_back(times_[k]);
    for (std::size_t p = 0; p < n_places_; ++p) {
      const auto surfaces = growth_values(growth_[k * n_places_ + p]);
      values.insert(values.end(), surfaces.begin(), surfaces.end());
    }
  }
  values.resize(packed_size(), -1.);  // fewer instants: times below zero
  return values;
}

void GrowthHistory::unpack_tail(std::span<const double> values) {
  times_.clear();
  growth_.clear();
  std::vector<Expansion> growth(n_places_);
  for (std::size_t at = 0; at < values.size(); at += packed_size() / 2) {
    if (values[at] < 0.) continue;
    for (std::size_t p = 0; p < n_places_; ++p)
      growth[p] = expansion_of(values.subspan(at + 1 + growth_surfaces.size() * p, growth_surfaces.size()));
    append(values[at], growth);
  }
}

std::size_t GrowthHistory::next(double t) const {
  // The last interval is asked for again and again.
  if (times_.empty() || t >= times_.back()) return times_.size();
  if (times_.size() > 1 && t >= times_[times_.size() - 2]) return times_.size() - 1;
  return static_cast<std::size_t>(std::upper_bound(times_.begin(), times_.end(), t) - times_.begin());
}

void GrowthHistory::at(double t, std::span<Expansion> out) const {
  if (times_.empty()) {
    std::fill(out.begin(), out.end(), Expansion{});
    return;
  }
  const std::size_t b = next(t);
  if (b == 0 || b == times_.size()) {
    const std::size_t row = b == 0 ? 0 : b - 1;
    std::copy_n(growth_.begin() + static_cast<std::ptrdiff_t>(row * n_places_), n_places_, out.begin());
    return;
  }
  const double weight = (t - times_[b - 1]) / (times_[b] - times_[b - 1]);
  for (std::size_t p = 0; p < n_places_; ++p)
    out[p] = combined(1. - weight, growth_[(b - 1) * n_places_ + p], weight, growth_[b * n_places_ + p]);
}

void GrowthHistory::rate(double t, std::span<Expansion> out) const {
  const std::size_t b = next(t);
  if (b == 0 || b == times_.size()) {
    std::fill(out.begin(), out.end(), Expansion{});
    return;
  }
  const double per_second = 1. / (times_[b] - times_[b - 1]);
  for (std::size_t p = 0; p < n_places_; ++p)
    out[p] = combined(-per_second, growth_[(b - 1) * n_places_ + p], per_second, growth_[b * n_places_ + p]);
}

}  // namespace rotordrop
