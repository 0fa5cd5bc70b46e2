#pragma once
#include <span>
#include <string>
#include <vector>

#include "analysis/watch/followed.h"
#include "machine/machine.h"
#include "model/observer.h"

namespace rotordrop {

/// How near the rotor came to the stationary part at one probe.
struct ProbeScalars {
  double smallest_clearance = never, smallest_clearance_time = never;  ///< [m], [s]; between steps by a parabola
  double first_touch_time = never;                                     ///< clearance first passes zero [s]
  double time_touching = 0;                                            ///< [s]
  FollowedPeak contact_force;                                          ///< [N]
  // The last two steps.
  double time = never, clearance = never, time_before = never, clearance_before = never;
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
