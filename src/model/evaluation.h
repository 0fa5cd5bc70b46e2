#pragma once
#include <vector>

#include "model/support.h"

namespace rotordrop {

class GrowthHistory;

/// What one evaluation of a machine finds, and what is asked of it. It belongs to the caller, so that several threads can evaluate one machine.
/// A new one can be handed to any machine, which gives all lists their sizes.
template <class Real>
struct EvaluationOf {
  // Asked:
  bool wants_step = false;                    ///< the step observables
  bool wants_details = false;                 ///< the detailed ones
  const GrowthHistory* growth_in_force = {};  ///< of a machine that takes it from outside; none: no growth so far

  // Found:
  bool is_whole = true;  ///< false: of a drop in lanes, of which time and what is wanted are all that is known
  Real time = 0;         ///< [s]
  std::vector<Real>
      rates;  ///< of the state vector with its ledgers [n_states], unless the caller gave another place for them
  std::vector<Real> step;                           ///< values of the step observables, if they are wanted
  std::vector<Real> details;                        ///< values of the detailed observables, if they are wanted
  std::vector<MotionOf<Real>> motions;              ///< of the rotor's stations
  std::vector<SupportInputOf<Real>> inputs;         ///< what each support saw
  std::vector<SupportOutputOf<Real>> outputs;       ///< what each support returned
  std::vector<ForceOf<Real>> forces;                ///< on the rotor, of each support
  std::vector<HeatInputOf<Real>> heats;             ///< into each thermal place
  std::vector<ExpansionOf<Real>> growth;            ///< fed back, of each thermal place
  std::vector<ExpansionOf<Real>> growth_rate;       ///< [m/s]
  std::vector<ExpansionOf<Real>> immediate_growth;  ///< part of it that follows heat at once; then its rate
};
using Evaluation = EvaluationOf<double>;

}  // namespace rotordrop
