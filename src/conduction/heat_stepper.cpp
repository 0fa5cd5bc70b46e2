#include "conduction/heat_stepper.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.h"

namespace rotordrop {
namespace {

// ARK4(3)6L[2]SA, implicit part: Kennedy & Carpenter, Applied Numerical Mathematics 44 (2003) 139-181, appendix.
constexpr double sdirk_gamma = 0.25;
constexpr double c[6] = {0., 1. / 2., 83. / 250., 31. / 50., 17. / 20., 1.};
constexpr double a[6][6] = {{0., 0., 0., 0., 0., 0.},
                            {1. / 4., sdirk_gamma, 0., 0., 0., 0.},
                            {8611. / 62500., -1743. / 31250., sdirk_gamma, 0., 0., 0.},
                            {5012029. / 34652500., -654441. / 2922500., 174375. / 388108., sdirk_gamma, 0., 0.},
                            {15267082809. / 155376265600., -71443401. / 120774400., 730878875. / 902184768.,
                             2285395. / 8070912., sdirk_gamma, 0.},
                            {82889. / 524892., 0., 15625. / 83664., 69875. / 102672., -2260. / 8211., sdirk_gamma}};
constexpr const double (&b)[6] = a[5];
constexpr double b_embedded[6] = {4586570599. / 29645900160., 0.,
                                  178811875. / 945068544.,    814220225. / 1159782912.,
                                  -3700637. / 11593932.,      61727. / 225920.};

constexpr double safety = 0.9, largest_growth = 4., worth_a_factorisation = 1.7;
constexpr int most_iterations = 12, most_window_iterations = 25;
constexpr std::size_t most_window_factors = 16;  // kept at a time: some MB each
constexpr double window_accuracy = 1e-10;        // [K] of Newton's iteration
constexpr double roundoff = 1e-11;               // [K] of an error estimate
constexpr double rounding =
    4. * std::numeric_limits<double>::epsilon();  // of a temperature: Newton's changes get no smaller

double largest(const Eigen::VectorXd& v) { return v.cwiseAbs().maxCoeff<Eigen::PropagateNaN>(); }

}  // namespace

HeatStepper::HeatStepper(HeatEquations& equations, const HeatConductionProblem& problem)
    : equations_(equations),
      numerics_(problem.numerics),
      T_0_(equations.initial_temperature()),
      kind_(equations.is_symmetric() ? HeatMatrix::exact : HeatMatrix::symmetric) {
  for (const auto& flux : problem.fluxes) changes_.insert(changes_.end(), flux.times.begin(), flux.times.end());
  std::sort(changes_.begin(), changes_.end());
  for (const auto& law : problem.convections)
    if (law.coefficient > 0.)
      smallest_scale_ = std::max(smallest_scale_, 1e-3 * std::fabs(problem.initial_temperature - law.ambient));
  smallest_scale_ = std::max({smallest_scale_, 1e-6, T_0_.maxCoeff() - T_0_.minCoeff()});
  T_ = T_0_;
  for (auto* family : {&stage_, &flow_})
    for (auto& v : *family) v = Vector::Zero(T_.size());
  known_ = residual_ = difference_ = Vector::Zero(T_.size());
  jump_to_held_temperatures();
  inverse_ = equations_.make_inverse();
}

void HeatStepper::clear_held(Vector& residual) const {
  for (const auto& held : equations_.held())
    for (const auto i : held.unknowns) residual[i] = 0.;
}

double HeatStepper::next_change() const {
  const auto next = std::upper_bound(changes_.begin(), changes_.end(), time_);
  return next == changes_.end() ? std::numeric_limits<double>::infinity() : *next;
}

void HeatStepper::advance_to(double target) {
  while (time_ < target) {
    equations_.hold_fluxes_of(time_);
    if (must_restart_ || std::binary_search(changes_.begin(), changes_.end(), time_)) {
      const double first = 0.2 * equations_.shortest_time();
      step_ = step_ > 0. ? std::min(step_, first) : first;
      must_restart_ = false;
    }
    const double stop = std::min(target, next_change());
    // Times that differ by the rounding of their decimals are one.
    if (stop - time_ <= 1e-13 * stop) {
      time_ = stop;
      continue;
    }
    if (numerics_.fixed_step > 0.)
      integrate_fixed(stop);
    else
      integrate_to(stop);
    time_ = stop;
  }
}

void HeatStepper::integrate_fixed(double stop) {
  const double start = time_;
  const long n = std::max(1L, std::lround((stop - start) / numerics_.fixed_step));
  const double step = (stop - start) / static_cast<double>(n);
  scale_ = std::max(smallest_scale_, equations_.expected_rise(stop - start));
  for (long i = 0; i < n; ++i) {
    time_ = start + static_cast<double>(i) * step;
    if (ask_) ask_();
    if (!compute_stages(step))
      throw SolverError(fmt::format(
          "Newton's iteration does not converge at t = {:.6g} s with the fixed step {:.3g} s.", time_, step));
    accept(step);
  }
}

// Steps divide what remains until the stop evenly, so that the stop is met exactly and one factorisation serves many steps.
void HeatStepper::integrate_to(double stop) {
  const double expected = equations_.expected_rise(stop - time_);
  while (time_ < stop) {
    const double remaining = stop - time_;
    const double n = std::max(1., std::ceil(remaining / step_ - 1e-6));
    const double step = remaining / n;
    if (step < 1e-13 * time_ || step < 1e-16)
      throw SolverError(fmt::format("heat conduction needs steps below {:.3g} s at t = {:.6g} s.", step, time_));
    scale_ = std::max({smallest_scale_, expected, largest(T_ - T_0_)});

    for (double left = n; left > 0.; --left) {
      if (ask_) ask_();
      const double error =
          compute_stages(step) ? estimate_error(step) / std::max(numerics_.tolerance * scale_, roundoff) : 1e9;
      const double factor = std::clamp(safety * std::pow(std::max(error, 1e-12), -0.25), 0.2, largest_growth);
      if (!(error <= 1.)) {
        ++statistics_.rejected_steps;
        is_stale_ = true;
        step_ = step * std::min(factor, 0.7);
        break;
      }
      accept(step);
      time_ = left > 1. ? time_ + step : stop;
      step_ = factor > worth_a_factorisation ? step * factor : step;
      if (left > 1. && step_ > step) break;
    }
  }
}

bool HeatStepper::compute_stages(double step) {
  stage_[0] = T_;
  equations_.heat_flow(T_, time_, flow_[0]);
  for (std::size_t i = 1; i < n_stages; ++i)
    if (!solve_stage(i, step)) return false;
  return true;
}

bool HeatStepper::solve_stage(std::size_t i, double step) {
  known_.setZero();
  for (std::size_t j = 0; j < i; ++j)
    if (a[i][j] != 0.) known_ += step * a[i][j] * flow_[j];
  Vector& T = stage_[i];
  T = stage_[i - 1];
  const double t = time_ + c[i] * step, tolerance = std::max({1e-12 * scale_, 4e-13, rounding * largest(T_)});
  const bool is_linear = equations_.is_linear(), is_steady = equations_.is_steady();
  if (std::fabs(factorised_step_ - step) > 1e-12 * step || (is_stale_ && !is_linear)) factorise(step, T);

  bool is_fresh = false;
  double last = 0.;
  for (int k = 0; k < most_iterations; ++k) {
    // residual = known + step gamma F(T) - enthalpy difference
    if (k == 0 && is_steady)
      flow_[i] = flow_[i - 1];
    else
      equations_.heat_flow(T, t, flow_[i]);
    equations_.enthalpy_difference(T, T_, residual_);
    residual_ = known_ + step * sdirk_gamma * flow_[i] - residual_;
    clear_held(residual_);
    inverse_->solve(residual_);
    ++statistics_.solves;
    T += residual_;
    const double change = largest(residual_);
    if (!std::isfinite(change)) return false;
    const double rate = k > 0 ? change / last : 0.;
    // Long steps near a steady state: what large flows leave of each other by rounding keeps changes from becoming smaller.
    const bool is_rounding = rate > 0.5 && change <= 1e-3 * numerics_.tolerance * scale_;
    if (is_linear || change <= tolerance || is_rounding ||
        (k > 0 && rate < 0.5 && change * rate / (1. - rate) <= tolerance)) {
      is_stale_ = is_stale_ || (rate > 0.2 && !is_rounding);
      equations_.heat_flow(T, t, flow_[i]);
      return true;
    }
    if (k > 0 && is_slow(rate)) {
      if (!has_better_matrix(rate, is_fresh)) return false;
      factorise(step, T);
      is_fresh = true;
    }
    last = change;
  }
  return false;
}

bool HeatStepper::has_better_matrix(double rate, bool is_fresh) {
  if (!is_fresh) return true;
  if (kind_ == HeatMatrix::exact) return rate <= 2.;
  kind_ = HeatMatrix::exact;
  return true;
}

void HeatStepper::factorise(double step, const Vector& T) {
  inverse_->set_matrix(T, step * sdirk_gamma, kind_);
  factorised_step_ = step;
  is_stale_ = false;
  ++statistics_.factorisations;
}

// The difference of both formulas, in kelvin and freed from stiff parts by the matrix at hand (Shampine's filter).
double HeatStepper::estimate_error(double step) {
  residual_.setZero();
  for (std::size_t i = 0; i < n_stages; ++i)
    if (b[i] != b_embedded[i]) residual_ += step * (b[i] - b_embedded[i]) * flow_[i];
  clear_held(residual_);
  inverse_->solve(residual_);
  ++statistics_.solves;
  return largest(residual_);
}

void HeatStepper::require_above_zero(const Vector& T, double time) const {
  Eigen::Index coldest = 0;
  if (const double lowest = T.minCoeff<Eigen::PropagateNaN>(&coldest); lowest > 0.) return;
  const auto where = static_cast<std::size_t>(coldest);
  throw SolverError(fmt::format("{} is cooled below 0 K at t = {:.6g} s: its temperature would be {:.4g} K. {}",
                                equations_.part_of(where), time, T[coldest],
                                equations_.strongest_cooling(where, time)));
}

void HeatStepper::accept(double step) {
  require_above_zero(stage_[n_stages - 1], time_ + step);
  for (std::size_t i = 0; i < n_stages; ++i) {
    if (b[i] == 0.) continue;
    input_ += step * b[i] * equations_.input_power(time_ + c[i] * step);
    lost_ += step * b[i] * equations_.lost_power(stage_[i]);
  }
  if (!equations_.held().empty()) {
    known_.setZero();
    for (std::size_t i = 0; i < n_stages; ++i) known_ += step * b[i] * flow_[i];
    book_held_boundaries(T_, stage_[n_stages - 1], known_);
  }
  T_ = stage_[n_stages - 1];
  ++statistics_.steps;
}

// The jump's heat comes in at once.
void HeatStepper::jump_to_held_temperatures() {
  for (const auto& held : equations_.held()) {
    Vector& after = stage_[0];
    after = T_;
    for (const auto i : held.unknowns) after[i] = held.temperature;
    equations_.enthalpy_difference(after, T_, residual_);
    book(residual_.sum());  // also of neighbours' rows, which reach into the cells along the boundary
    T_ = after;
  }
}

void HeatStepper::book(double joules_through_boundary) {
  (joules_through_boundary > 0. ? input_ : lost_) += std::fabs(joules_through_boundary);
}

// What is stored in a held row beyond what conduction, fluxes and films brought there came through the boundary.
void HeatStepper::book_held_boundaries(const Vector& before, const Vector& after, const Vector& flow_joules) {
  equations_.enthalpy_difference(after, before, residual_);
  residual_ -= flow_joules;
  for (const auto& held : equations_.held()) {
    double joules = 0.;
    for (const auto i : held.unknowns) joules += residual_[i];
    book(joules);
  }
}

// ------------------------------------------------------------------------------------------------------------------- windows

void HeatStepper::set_port_heat(std::span<const double> watts, std::span<const double> rates) {
  equations_.hold_port_heat(watts, rates, time_);
  must_restart_ = true;
}

void HeatStepper::advance_window(double step) { advance_parts_of_window(step, 64); }

// Steep tables may need shorter steps than the window for Newton's iteration.
void HeatStepper::advance_parts_of_window(double step, int most_parts) {
  if (step_window(step)) return;
  if (most_parts <= 1)
    throw SolverError(fmt::format("Newton's iteration does not converge in the window after t = {:.6g} s.", time_));
  advance_parts_of_window(0.5 * step, most_parts / 2);
  advance_parts_of_window(0.5 * step, most_parts / 2);
}

// Alexander (1977): two stages of order 2, L-stable; the second one is the new state.
bool HeatStepper::step_window(double step) {
  static const double g = 1. - 1. / std::sqrt(2.);
  Vector &first = stage_[1], &second = stage_[2];
  const double t_1 = time_ + g * step, t_2 = time_ + step;
  known_.setZero();
  difference_.setZero();
  first = T_;
  equations_.heat_flow(first, t_1, flow_[1]);
  if (!solve_window_stage(step, t_1, first, flow_[1])) return false;
  equations_.enthalpy_difference(first, T_, difference_);
  if (equations_.is_linear() && equations_.held().empty())
    flow_[1] = difference_ / (step * g);  // what the stage solved for
  else
    equations_.heat_flow(first, t_1, flow_[1]);
  known_ = step * (1. - g) * flow_[1];
  second = first;
  flow_[2] = flow_[1];
  if (!equations_.is_steady()) equations_.heat_flow(second, t_2, flow_[2]);
  if (!solve_window_stage(step, t_2, second, flow_[2])) return false;
  require_above_zero(second, t_2);
  const double weights[2] = {1. - g, g};
  for (std::size_t i = 0; i < 2; ++i) {
    input_ += step * weights[i] * equations_.input_power(time_);
    lost_ += step * weights[i] * equations_.lost_power(stage_[i + 1]);
  }
  if (!equations_.held().empty()) {
    equations_.heat_flow(second, t_2, flow_[2]);
    known_ += step * g * flow_[2];
    book_held_boundaries(T_, second, known_);
  }
  T_ = second;
  time_ += step;
  ++statistics_.steps;
  return true;
}

bool HeatStepper::solve_window_stage(double step, double t, Vector& T, Vector& flow) {
  static const double g = 1. - 1. / std::sqrt(2.);
  const bool is_linear = equations_.is_linear();
  auto found = window_inverse_.find(step);
  const auto factorise_at = [&](const Vector& at) {
    found = window_inverse_.insert_or_assign(step, equations_.make_inverse()).first;
    found->second->set_matrix(at, step * g, kind_);
    ++statistics_.factorisations;
  };
  if (found == window_inverse_.end()) {
    if (window_inverse_.size() >= most_window_factors) window_inverse_.clear();
    factorise_at(T);
  }
  double last = 0.;
  bool is_fresh = false;
  for (int k = 0; k < most_window_iterations; ++k) {
    if (k > 0) {
      equations_.heat_flow(T, t, flow);
      equations_.enthalpy_difference(T, T_, difference_);
    }
    residual_ = known_ + step * g * flow - difference_;
    clear_held(residual_);
    found->second->solve(residual_);
    ++statistics_.solves;
    T += residual_;
    const double change = largest(residual_);
    if (is_linear || change <= window_accuracy) return true;
    if (!std::isfinite(change)) break;
    const double rate = k > 0 ? change / last : 0.;
    // What is still missing, if changes go on to shrink as they do.
    if (k > 0 && rate < 0.3 && change * rate / (1. - rate) <= window_accuracy) return true;
    if (k > 0 && is_slow(rate)) {
      if (!has_better_matrix(rate, is_fresh)) break;
      factorise_at(T);
      is_fresh = true;
    }
    last = change;
  }
  return false;
}

void HeatStepper::set_field(std::span<const double> temperatures, double time, double input, double lost) {
  std::copy(temperatures.begin(), temperatures.end(), T_.data());
  time_ = time;
  input_ = input;
  lost_ = lost;
  must_restart_ = true;
}

}  // namespace rotordrop
