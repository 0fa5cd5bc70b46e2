#include "thermal/fe/heat_solver.h"

#include <deal.II/base/multithread_info.h>
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "base/errors.h"
#include "thermal/fe/vtu_output.h"

namespace rotordrop {

HeatSolver::HeatSolver(const HeatConductionProblem& problem)
    : operator_(problem),
      solver_(chosen_solver(problem.numerics.solver, operator_.size())),
      equations_(operator_, solver_),
      stepper_(equations_, operator_.problem()) {}

void HeatSolver::advance_to(double target) {
  try {
    stepper_.advance_to(target);
  } catch (const dealii::ExceptionBase& error) {
    throw SolverError(fmt::format("the finite-element solver failed at t = {:.6g} s: {}", time(), error.what()));
  }
}

SurfaceRange HeatSolver::surface(const std::vector<HeatBoundary>& boundaries) const {
  const HeatMean mean = operator_.mean_over(boundaries);
  return {value(mean), mean.lowest(stepper_.field()), mean.highest(stepper_.field())};
}

HeatStatistics HeatSolver::statistics() const {
  HeatStatistics s = stepper_.statistics();
  s.solver = solver_;
  s.unknowns = operator_.size();
  s.cells = operator_.n_cells();
  return s;
}

HeatOperator::Vector HeatSolver::temperatures() const {
  HeatOperator::Vector T;
  copy_to(stepper_.temperatures(), T);
  return T;
}

double HeatSolver::difference(const std::function<double(std::size_t, double, double)>& f) const {
  return operator_.difference(temperatures(), f);
}

// They take 0.35 kB an unknown of what is kept (256 MB). Up to here stepping by them takes half the time of stepping by the libraries, their loading not counted.
std::optional<AssembledHeat> HeatSolver::assembled() const {
  constexpr unsigned int most_unknowns = 25000;
  if (solver_ != HeatLinearSolver::direct || has_several_ranks() || operator_.size() > most_unknowns)
    return std::nullopt;
  return operator_.assembled();
}

ReducedHeat HeatSolver::reduce(const ReductionSettings& settings) {
  reduction_ = reduce_heat(operator_, settings);
  return reduction_->data;
}

void HeatSolver::lift(std::span<const double> state, std::span<const double> watts, double time) {
  const double T_start = operator_.problem().initial_temperature;
  HeatOperator::Vector T(operator_.size());
  T = T_start;
  for (std::size_t i = 0; i < state.size(); ++i) T.add(state[i] - T_start, reduction_->fields[i]);
  for (std::size_t p = 0; p < std::min(watts.size(), reduction_->residues.size()); ++p)
    T.add(watts[p], reduction_->residues[p]);
  const HeatEnergy before = energy();
  set_field({T.begin(), T.end()}, time, before.input, before.lost);
}

std::vector<double> HeatSolver::project(std::span<const double> weights) const {
  std::vector<double> shape;
  for (const auto& field : reduction_->fields)
    shape.push_back(std::inner_product(field.begin(), field.end(), weights.begin(), 0.));
  return shape;
}

void HeatSolver::write_vtu(const std::string& file) const { write_heat_vtu(operator_, temperatures(), time(), file); }

}  // namespace rotordrop

extern "C" __attribute__((visibility("default"))) rotordrop::HeatConductionSolver* rotordrop_make_heat_solver(
    const rotordrop::HeatConductionProblem& problem) {
  dealii::MultithreadInfo::set_thread_limit(1);
  return new rotordrop::HeatSolver(problem);
}
