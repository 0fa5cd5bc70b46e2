#pragma once
#include <optional>

namespace rotordrop {

/// [output]: what is written, and how often.
struct OutputParameters {
  double interval = 0;         ///< of the series [s]
  double detail_interval = 0;  ///< of every ball's load [s]
  std::optional<double>
      longest_interval;            ///< without changes [s]; none: a 20000th of the latest end, at least `interval`
  double change = 0;               ///< of a quantity, over its largest magnitude so far, that calls for a row
  double checkpoint_interval = 0;  ///< of wall time [s]
};

}  // namespace rotordrop
