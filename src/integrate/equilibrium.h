#pragma once
#include <span>

#include "model/equilibrium_system.h"

namespace rotordrop {

/// How an equilibrium was found.
struct EquilibriumResult {
  bool found = false;
  double residual = 0;         ///< largest force that is left over, of the system's force scale
  long newton_steps = 0;       ///< of KINSOL, in all attempts
  long descent_steps = 0;      ///< downhill in the potential, where Newton's method alone did not arrive
  int continuation_steps = 0;  ///< raising the circulatory forces, where they could not be applied at once
};

struct EquilibriumOptions {
  double tolerance = 1e-10;  ///< of the force scale, for the largest left-over force
  double accepted = 1e-8;    ///< what rounding may leave of it at the end
  long max_newton_steps = 60;
  long max_descent_steps = 2000;
};

/// Rest of a system, by KINSOL's Newton method with line search and the system's own stiffness. Where that does not arrive (all balls
/// unloaded: no stiffness at all), damped Newton steps go downhill in the potential first, which always ends in a convex one. Never
/// throws for want of convergence: `found` tells.
/// @param x  start in, rest out [size]
EquilibriumResult find_equilibrium(EquilibriumSystem& system, std::span<double> x,
                                   const EquilibriumOptions& options = {});

}  // namespace rotordrop
