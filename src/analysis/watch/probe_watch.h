#pragma once
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "machine/machine.h"
#include "model/observer.h"

namespace rotordrop {

/// How near the rotor came to the stationary part at one probe.
struct ProbeScalars {
  static constexpr double never = std::numeric_limits<double>::quiet_NaN();
  double smallest_clearance = never, smallest_clearance_time = never;  ///< [m], [s]; between steps by a parabola
  double first_touch_time = never;                                     ///< clearance first passes zero [s]
  double time_touching = 0;                                            ///< [s]
  double largest_force = 0;                                            ///< of a contact, at a step [N]
  double largest_force_time = never;                                   ///< [s]
  // The last two steps.
  double time = never, clearance = never, time_before = never, clearance_before = never;
  void follow(double t, double clearance_left, double force);
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
