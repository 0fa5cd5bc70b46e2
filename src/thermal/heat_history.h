#pragma once
#include <vector>

/// Heat flux over time as steps, the form in which conduction takes it.
namespace rotordrop {

/// values[i] [W/m2] holds from times[i] [s] until the next; nothing before the first, the last one for ever.
struct FluxSteps {
  std::vector<double> times, values;
};

/// Equal pulses at equal distances.
struct PulseTrain {
  double height = 0;  ///< [W/m2]
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

}  // namespace rotordrop
