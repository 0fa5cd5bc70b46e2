#pragma once
#include <vector>

#include "model/support.h"

namespace rotordrop {

class GrowthHistory;

/// What one evaluation of a machine finds, and what is asked of it. It belongs to the caller, so that several threads can evaluate one machine.
/// A new one can be handed to any machine, which gives all lists their sizes.
struct Evaluation {
  // Asked:
  bool wants_step = false;                    ///< the step observables
  bool wants_details = false;                 ///< the detailed ones
  const GrowthHistory* growth_in_force = {};  ///< of a machine that takes it from outside; none: no growth so far

  // Found:
  double time = 0;  ///< [s]
  std::vector<double>
      rates;  ///< of the state vector with its ledgers [n_states], unless the caller gave another place for them
  std::vector<double> step;                 ///< values of the step observables, if they are wanted
  std::vector<double> details;              ///< values of the detailed observables, if they are wanted
  std::vector<Motion> motions;              ///< of the rotor's stations
  std::vector<SupportInput> inputs;         ///< what each support saw
  std::vector<SupportOutput> outputs;       ///< what each support returned
  std::vector<Force> forces;                ///< on the rotor, of each support
  std::vector<HeatInput> heats;             ///< into each thermal place
  std::vector<Expansion> growth;            ///< fed back, of each thermal place
  std::vector<Expansion> growth_rate;       ///< [m/s]
  std::vector<Expansion> immediate_growth;  ///< part of it that follows heat at once; then its rate
};

}  // namespace rotordrop
