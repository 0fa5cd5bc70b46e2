#pragma once
#include <span>
#include <vector>

namespace rotordrop {

/// Known times at which the rates of a system jump or bend: a step of its integration ends there, and the next one begins anew.
/// Times closer than 1e-13 s, or than rounding can tell, are one.
class Instants {
 public:
  Instants() = default;
  /// @param times  in any order; those outside (0, end] are left out [s]; @param end  of the run [s]
  Instants(std::span<const double> times, double end);

  [[nodiscard]] bool empty() const { return instants_.empty(); }
  /// Where a step that begins at t has to end: the next of them, or the end of the run.
  [[nodiscard]] double next(double t) const;
  /// The last of them up to t; 0: there is none.
  [[nodiscard]] double last(double t) const;
  /// Whether a step that ends at t ends at one of them.
  [[nodiscard]] bool contains(double t) const;
  /// Time at which the rates at the end t of a step are evaluated: just before t at one of them, else t.
  [[nodiscard]] double before(double t) const;
  /// Latest time at which rates within a step that ends at t are evaluated, whatever rounding does: the same, or without bound.
  [[nodiscard]] double latest(double t) const;

 private:
  struct Instant {
    double first, time;  ///< of those that are one: steps see times before the first, and end at the last
  };
  std::vector<Instant> instants_;
  double end_ = 0;
};

}  // namespace rotordrop
