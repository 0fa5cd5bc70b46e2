#pragma once
#include <cstddef>
#include <utility>
#include <vector>

namespace rotordrop {

/// Counts the cycles of a load by the rainflow method while the load goes on, and keeps no more of it than what is still open.
/// Source: ASTM E1049-85 (2017), section 5.4.4.
class Rainflow {
 public:
  /// Takes the next value of the load. Calls count(range, cycles) for each cycle that closes: cycles is 1, or 1/2 for a range that begins at the start.
  template <class Count>
  void follow(double value, Count&& count) {
    if (open_.size() < 2) {
      if (open_.empty() || value != open_.back()) open_.push_back(value);
      return;
    }
    const double last = open_.back(), before = open_[open_.size() - 2];
    if ((value - last) * (last - before) >= 0.) {
      open_.back() = value;  // no reversal yet
      return;
    }
    close(count);
    open_.push_back(value);
  }
  /// Calls count(range, 1/2) for every range that is open if the load ends here. Open ranges stay open.
  template <class Count>
  void finish(Count&& count) const {
    Rainflow rest = *this;
    rest.close(count);
    for (std::size_t k = 1; k < rest.open_.size(); ++k) count(distance(rest.open_[k - 1], rest.open_[k]), 0.5);
  }

  /// Reversals of ranges that are open, oldest first; the last one is the last value.
  [[nodiscard]] const std::vector<double>& open() const { return open_; }
  void set_open(std::vector<double> open) { open_ = std::move(open); }

 private:
  static double distance(double a, double b) { return a < b ? b - a : a - b; }

  /// The last value is a reversal.
  template <class Count>
  void close(Count&& count) {
    while (open_.size() >= 3) {
      const std::size_t n = open_.size();
      const double X = distance(open_[n - 2], open_[n - 1]), Y = distance(open_[n - 3], open_[n - 2]);
      if (X < Y) return;
      if (n == 3) {  // Y contains the start
        count(Y, 0.5);
        open_.erase(open_.begin());
      } else {
        count(Y, 1.);
        open_.erase(open_.end() - 3, open_.end() - 1);
      }
    }
  }

  std::vector<double> open_;
};

}  // namespace rotordrop
