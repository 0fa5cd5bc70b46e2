#include "study/many/search/local_search.h"

#include <nlopt.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <memory>

#include "base/errors.h"
#include "study/many/random_bits.h"

namespace rotordrop {
namespace {

using Evaluate = std::function<SearchValue(const std::vector<double>&)>;

/// Answers about known places in a row after which a search ends. Methods that still move ask for a new place long before.
constexpr std::size_t most_back = 10000;

nlopt_algorithm algorithm_of(MinimiseMethod method) {
  switch (method) {
    case MinimiseMethod::cobyla:
      return NLOPT_LN_COBYLA;
    case MinimiseMethod::bobyqa:
      return NLOPT_LN_BOBYQA;
    case MinimiseMethod::subplex:
      return NLOPT_LN_SBPLX;
    case MinimiseMethod::crs:
      return NLOPT_GN_CRS2_LM;
    case MinimiseMethod::isres:
      return NLOPT_GN_ISRES;
    case MinimiseMethod::direct:
      return NLOPT_GN_DIRECT_L;
  }
  return NLOPT_LN_COBYLA;
}

/// Evaluations of one search. NLopt asks for value and limits one after the other, and some methods come back to a place.
class Evaluations {
 public:
  Evaluations(nlopt_opt optimiser, std::size_t n_constraints, std::size_t most, const Evaluate& evaluate,
              const std::function<void()>& between)
      : optimiser_(optimiser), n_constraints_(n_constraints), most_(most), evaluate_(evaluate), between_(between) {}

  const SearchValue& at(unsigned n, const double* x) {
    const std::vector<double> place(x, x + n);
    if (const auto known = known_.find(place); known != known_.end()) {
      come_back();
      return known->second;
    }
    n_back_ = 0;
    SearchValue found{worst_, std::vector<double>(n_constraints_, 0.)};
    if (!error_ && known_.size() < most_) {
      try {
        found = evaluate_(place);
        if (found.constraints.empty()) found.constraints.assign(n_constraints_, 0.);
      } catch (...) {
        error_ = std::current_exception();
      }
    }
    if (std::isfinite(found.value)) {
      const auto& limits = found.constraints;
      if (std::all_of(limits.begin(), limits.end(), [](double c) { return c <= 0.; }))
        allowed_.emplace(place, found.value);
      worst_ = n_good_ ? std::max(worst_, found.value) : found.value;
      best_ = n_good_++ ? std::min(best_, found.value) : found.value;
    } else {
      // A failed evaluation is worse than all others, by as much as these differ, but no infinity, which no model of a method bears.
      found.value = worst_ + std::max(worst_ - best_, std::fabs(worst_));
      std::fill(found.constraints.begin(), found.constraints.end(), 0.);
    }
    const auto stored = known_.emplace(place, std::move(found)).first;
    if (error_ || known_.size() >= most_) nlopt_force_stop(optimiser_);
    return stored->second;
  }
  /// Values of the order of 1, so that they compare with the limits, which are relative.
  [[nodiscard]] double scale() const { return best_ != 0. ? std::fabs(best_) : 1.; }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }
  /// A method may end a hair outside a limit, where the best allowed place can be an early one: halving the way between the two finds the edge.
  void step_back(const std::vector<double>& end, double tolerance) {
    const auto last = known_.find(end);
    if (last == known_.end() || allowed_.empty() || allowed_.contains(end)) return;
    const auto best = std::min_element(allowed_.begin(), allowed_.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    if (!(last->second.value < best->second)) return;
    std::vector<double> inside = best->first, outside = end;
    const auto distance = [&] {
      double largest = 0.;
      for (std::size_t i = 0; i < inside.size(); ++i) largest = std::max(largest, std::fabs(inside[i] - outside[i]));
      return largest;
    };
    while (!error_ && known_.size() < most_ && distance() > tolerance) {
      std::vector<double> middle = inside;
      for (std::size_t i = 0; i < middle.size(); ++i) middle[i] = 0.5 * (inside[i] + outside[i]);
      at(static_cast<unsigned>(middle.size()), middle.data());
      (allowed_.contains(middle) ? inside : outside) = std::move(middle);
    }
  }
  /// Whether a method came back to known places for so long that it would not end.
  [[nodiscard]] bool is_going_round() const { return n_back_ >= most_back; }

 private:
  /// A known place costs nothing and counts as no evaluation. A method whose points have all met in one place, such as a corner of the box,
  /// would ask for it for ever.
  void come_back() {
    try {
      if (!error_ && between_) between_();
    } catch (...) {
      error_ = std::current_exception();
    }
    if (error_ || ++n_back_ >= most_back) nlopt_force_stop(optimiser_);
  }

  nlopt_opt optimiser_;
  std::size_t n_constraints_, most_;
  const Evaluate& evaluate_;
  const std::function<void()>& between_;
  std::map<std::vector<double>, SearchValue> known_;
  std::map<std::vector<double>, double> allowed_;  ///< values of those that keep all limits
  std::exception_ptr error_;
  double worst_ = 0, best_ = 0;
  std::size_t n_good_ = 0, n_back_ = 0;
};

struct Asked {
  Evaluations& evaluations;
  double scale = 0;  ///< of the first value
};

double value_at(unsigned n, const double* x, double* /*gradient*/, void* data) {
  auto& asked = *static_cast<Asked*>(data);
  const double value = asked.evaluations.at(n, x).value;
  if (asked.scale == 0.) asked.scale = asked.evaluations.scale();
  return value / asked.scale;
}

void limits_at(unsigned m, double* result, unsigned n, const double* x, double* /*gradient*/, void* data) {
  const auto& found = static_cast<Asked*>(data)->evaluations.at(n, x);
  std::copy_n(found.constraints.begin(), m, result);
}

void require(nlopt_result result, const char* what) {
  if (result < 0) throw SolverError(std::string("NLopt refuses ") + what);
}

}  // namespace

bool search_minimum(const MinimiseParameters& settings, const std::vector<double>& start, std::size_t n_constraints,
                    std::uint64_t seed, const Evaluate& evaluate, const std::function<void()>& between) {
  const auto n = static_cast<unsigned>(start.size());
  const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> optimiser(nlopt_create(algorithm_of(settings.method), n),
                                                                    nlopt_destroy);
  if (!optimiser) throw SolverError("NLopt refuses method " + name_of(settings.method));
  Evaluations evaluations(optimiser.get(), n_constraints, static_cast<std::size_t>(settings.evaluations), evaluate,
                          between);
  Asked asked{evaluations};
  require(nlopt_set_lower_bounds1(optimiser.get(), 0.), "the bounds");
  require(nlopt_set_upper_bounds1(optimiser.get(), 1.), "the bounds");
  require(nlopt_set_min_objective(optimiser.get(), value_at, &asked), "the result");
  if (n_constraints > 0)
    require(nlopt_add_inequality_mconstraint(optimiser.get(), static_cast<unsigned>(n_constraints), limits_at, &asked,
                                             nullptr),
            "the limits");
  require(nlopt_set_initial_step1(optimiser.get(), settings.first_step), "first_step");
  require(nlopt_set_xtol_abs1(optimiser.get(), settings.tolerance), "tolerance");
  // Its generator belongs to the thread, and every search has a thread of its own.
  nlopt_srand(static_cast<unsigned long>(mixed(seed) >> 33U));
  std::vector<double> x = start;
  double smallest = 0.;
  const nlopt_result result = nlopt_optimize(optimiser.get(), x.data(), &smallest);
  if (n_constraints > 0) evaluations.step_back(x, settings.tolerance);
  evaluations.rethrow();
  if (result == NLOPT_OUT_OF_MEMORY || result == NLOPT_INVALID_ARGS)
    throw SolverError("NLopt's " + name_of(settings.method) + " cannot search here: " +
                      (nlopt_get_errmsg(optimiser.get()) ? nlopt_get_errmsg(optimiser.get()) : "it gives no reason"));
  return !evaluations.is_going_round();
}

}  // namespace rotordrop
