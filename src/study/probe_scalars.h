#pragma once
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "machine/machine.h"

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
  /// For checkpoints.
  [[nodiscard]] std::size_t packed_size() const;
  void pack(std::vector<double>& to) const;
  void unpack(std::span<const double> values);

 private:
  struct Columns {
    std::size_t clearance = 0, force = 0;
    bool has_force = false;
  };
  std::vector<Columns> columns_;
  std::vector<ProbeScalars> scalars_;
};

/// `probes` of summary.json.
[[nodiscard]] nlohmann::ordered_json probe_summary(const Machine& machine, const ProbeWatch& watch,
                                                   std::span<const double> y);
/// Lines for the screen, from `probes` of a summary.
[[nodiscard]] std::string probe_text(const nlohmann::ordered_json& probes);

}  // namespace rotordrop
