#pragma once
#include <optional>
#include <span>
#include <vector>

#include "model/ports.h"

namespace rotordrop {

/// Growth of every place given over time: linear between its instants, constant before the first and after the last. What is recorded,
/// or what a model outside the state vector hands over window by window.
class GrowthHistory {
 public:
  /// @param n_places  numbers of places; the growth is zero until something is appended
  explicit GrowthHistory(std::size_t n_places) : n_places_(n_places) {}
  /// @param time  [s], > those before; @param growth [n_places]
  void append(double time, std::span<const Expansion> growth);
  /// Forgets everything after a time, where the growth stays what it was.
  void cut(double time);
  /// The last two instants, each as time and growth, for checkpoints; and put back.
  [[nodiscard]] std::vector<double> packed_tail() const;
  void unpack_tail(std::span<const double> values);
  [[nodiscard]] std::size_t packed_size() const { return 2 * (1 + growth_surfaces.size() * n_places_); }
  /// The last instant [s], after which growth is held; none before anything is appended.
  [[nodiscard]] std::optional<double> last_time() const {
    return times_.empty() ? std::nullopt : std::optional(times_.back());
  }
  void at(double t, std::span<Expansion> out) const;    ///< [m]
  void rate(double t, std::span<Expansion> out) const;  ///< [m/s]; at an instant that of the interval after it

 private:
  /// First instant after t; 0 and size() outside.
  [[nodiscard]] std::size_t next(double t) const;

  std::size_t n_places_;
  std::vector<double> times_;
  std::vector<Expansion> growth_;  ///< [n_times * n_places]
};

}  // namespace rotordrop
