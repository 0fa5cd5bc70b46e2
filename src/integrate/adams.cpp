#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "integrate/methods.h"
#include "integrate/multistep.h"

namespace rotordrop {
namespace {

/// Adams-Moulton, corrected by functional iteration: no Jacobian.
class Adams final : public Multistep {
 public:
  Adams(const OdeSystem& system, const IntegrationParameters& parameters, double start_time,
        std::span<const double> state, double end_time)
      : Multistep(CV_ADAMS, system, parameters.tolerance, start_time, state, end_time) {
    solver_ = SUNNonlinSol_FixedPoint(problem_.state(), 0, problem_.context());
    check(solver_ ? 0 : -1);
    check(CVodeSetNonlinearSolver(memory_, solver_));
    bound_steps(step_or_bound(parameters), shortest_step);
    require_good("the Adams integrator");
  }
  ~Adams() override {
    free_memory();
    SUNNonlinSolFree(solver_);
  }

 private:
  SUNNonlinearSolver solver_ = nullptr;
};

}  // namespace

std::unique_ptr<Integrator> make_adams(const OdeSystem& system, const IntegrationParameters& parameters,
                                       double start_time, std::span<const double> state, double end_time) {
  return std::make_unique<Adams>(system, parameters, start_time, state, end_time);
}

}  // namespace rotordrop
