#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "model/ports.h"

/// Heat over time: steps, the form in which conduction takes a flux, and what the heat ports of a bearing get.
namespace rotordrop {

/// values[i] [W/m2], or [W], holds from times[i] [s] until the next; nothing before the first, the last one for ever.
struct FluxSteps {
  std::vector<double> times, values;
};

/// Equal pulses at equal distances.
struct PulseTrain {
  double height = 0;  ///< [W/m2], or [W]
  double width = 0;   ///< of each [s], > 0
  double period = 0;  ///< from the beginning of one to that of the next [s], >= width; not used if there is one only
  double start = 0;   ///< of the first [s]
  int count = 1;      ///< >= 1
};
FluxSteps steps_of(const PulseTrain& train);

/// Heat given since some beginning, at rising times.
struct RecordedHeat {
  std::vector<double> times;   ///< [s]
  std::vector<double> joules;  ///< [J], of the same length
};
/// The flux whose integral over time and area meets share * joules wherever a step ends. Nothing after the last time. Rows between which the flux is the
/// same (to 1e-9 of the largest) become one step.
/// @param area      [m2], > 0
/// @param share     of the heat that goes here [1]
/// @param interval  [s]; steps are at least so long, the last one excepted: rows on the way are left out. 0: all rows
FluxSteps steps_of(const RecordedHeat& heat, double area, double share, double interval = 0.);

/// Where heat enters a touchdown bearing that is heated without a machine.
enum class HeatedPort : std::size_t { ring, shaft, inner, outer };  ///< rub heat into ring and shaft; races
inline constexpr std::size_t n_heated_ports = 4;

/// Heat into the ports of one bearing over time: a sum of parts, each linear from one of its times to the next.
class BearingHeatHistory {
 public:
  /// @param steps  [W]; times >= 0
  void add(HeatedPort port, FluxSteps steps, double factor = 1.);
  /// Linear between times[i], values[i] [W]: nothing before the first, the last one for ever.
  void add_linear(HeatedPort port, const FluxSteps& points, double factor = 1.);

  /// When any part begins or changes its course [s], rising.
  [[nodiscard]] std::vector<double> changes() const;
  /// Heat right after a time [W]; the rotor touches the ring while rub heat flows.
  [[nodiscard]] HeatInput heat(double t) const;
  /// How it goes on changing until the next change [W/s].
  [[nodiscard]] HeatInput rate(double t) const;
  /// Into a port from 0 to a time [J].
  [[nodiscard]] double joules(HeatedPort port, double until) const;
  /// Of heat into and out of all ports, without their signs [J].
  [[nodiscard]] double turnover(double until) const;

 private:
  struct Part {
    HeatedPort port;
    std::vector<double> times, values, slopes;
    [[nodiscard]] double integral(double until, bool is_unsigned) const;
  };
  [[nodiscard]] std::array<double, n_heated_ports> sums(double t, bool of_slopes) const;
  std::vector<Part> parts_;
};

}  // namespace rotordrop
