#pragma once
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "analysis/watch/followed.h"
#include "machine/machine.h"
#include "model/observer.h"

namespace rotordrop {

/// How near the rotor came to the stationary part at one probe.
struct ProbeScalars {
  FollowedPeak overlap{-std::numeric_limits<double>::infinity()};  ///< clearance that is not left [m]
  double first_touch_time = never;                                 ///< clearance first passes zero [s]
  double time_touching = 0;                                        ///< [s]
  FollowedPeak contact_force;                                      ///< [N]
  double time = never, clearance = never;                          ///< of the last step
  [[nodiscard]] double smallest_clearance() const { return -overlap.value; }
  void follow(double t, double clearance_left, double force);
  /// All that decides about what follows.
  [[nodiscard]] std::vector<double*> numbers();
};

/// Follows every probe of a machine through its step observables.
class ProbeWatch {
 public:
  explicit ProbeWatch(const Machine& machine);
  void follow(double t, std::span<const double> step);
  [[nodiscard]] std::size_t size() const { return scalars_.size(); }
  [[nodiscard]] const ProbeScalars& of(std::size_t probe) const { return scalars_[probe]; }
  [[nodiscard]] const std::string& name(std::size_t probe) const { return names_[probe]; }
  /// For checkpoints.
  void pack(PackedValues& to) const;
  void unpack(const PackedValues& from);

 private:
  struct Columns {
    std::size_t clearance = 0, force = 0;
    bool has_force = false;
  };
  std::vector<std::string> names_;
  std::vector<Columns> columns_;
  std::vector<ProbeScalars> scalars_;
};

}  // namespace rotordrop
