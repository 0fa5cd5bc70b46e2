#pragma once
#include <span>
#include <string>
#include <vector>

#include "analysis/watch/followed.h"
#include "machine/machine.h"
#include "model/observer.h"

namespace rotordrop {

/// How far an outer ring moved in its support.
struct SupportScalars {
  std::size_t support = 0;  ///< of the machine
  FollowedPeak travel;      ///< [m]
  double stored = 0;        ///< largest energy in its springs, at a step [J]
  bool has_energy = false;  ///< `stored` is known
  /// All that decides about what follows.
  [[nodiscard]] std::vector<double*> numbers();
};

/// Follows the supports of all touchdown bearings of a machine through its step observables.
class SupportWatch {
 public:
  explicit SupportWatch(const Machine& machine);
  void follow(double t, std::span<const double> step);
  /// None if the bearing has no such support.
  [[nodiscard]] const SupportScalars* of(const std::string& bearing) const;
  /// For checkpoints.
  void pack(PackedValues& to) const;
  void unpack(const PackedValues& from);

 private:
  struct Columns {
    std::string name;
    std::size_t support = 0, position = 0, energy = 0;
    bool has_energy = false;
  };
  std::vector<Columns> columns_;
  std::vector<SupportScalars> scalars_;
};

}  // namespace rotordrop
