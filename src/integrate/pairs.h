#pragma once
// Our own embedded methods and the control of their step: what the methods for one drop and for drops in lanes share.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/errors.h"
#include "integrate/embedded_tableau.h"
#include "integrate/methods.h"
#include "integrate/two_step.h"

namespace rotordrop {

/// Order 5(4). Source: Tsitouras, Computers and Mathematics with Applications 62 (2011) 770-775; interpolant of order 4 from the same.
inline constexpr EmbeddedTableau tsitouras = {
    .n_stages = 7,
    .order = 5,
    .powers = 4,
    .c = {0., 0.161, 0.327, 0.9, 0.9800255409045097, 1., 1.},
    .a = {{{},
           {0.161},
           {-0.008480655492356989, 0.335480655492357},
           {2.8971530571054935, -6.359448489975075, 4.3622954328695815},
           {5.325864828439257, -11.748883564062828, 7.4955393428898365, -0.09249506636175525},
           {5.86145544294642, -12.92096931784711, 8.159367898576159, -0.071584973281401, -0.028269050394068383},
           {0.09646076681806523, 0.01, 0.4798896504144996, 1.379008574103742, -3.290069515436081, 2.324710524099774}}},
    .e = {-0.00178001105222577714, -0.0008164344596567469, 0.007880878010261995, -0.1447110071732629,
          0.5823571654525552, -0.45808210592918697, 1. / 66.},
    .polynomial = {{{1., -2.763706197274826, 2.9132554618219126, -1.0530884977290216},
                    {0., 0.1317, -0.2234, 0.1017},
                    {0., 3.9302962368947516, -5.941033872131505, 2.490627285651253},
                    {0., -12.411077166933676, 30.33818863028232, -16.548102889244902},
                    {0., 37.50931341651104, -88.1789048947664, 47.37952196281928},
                    {0., -27.896526289197286, 65.09189467479366, -34.87065786149661},
                    {0., 1.5, -4., 2.5}}},
    .fitted = {0, 0b1, 0b11, 0b11, 0b11, 0b11, 0b111101}};

/// Order 3(2), with Hermite's cubic. Source: Bogacki & Shampine, Applied Mathematics Letters 2 (1989) 321-325.
inline constexpr EmbeddedTableau bogacki_shampine = {.n_stages = 4,
                                                     .order = 3,
                                                     .powers = 0,
                                                     .c = {0., 0.5, 0.75, 1.},
                                                     .a = {{{}, {0.5}, {0., 0.75}, {2. / 9., 1. / 3., 4. / 9.}}},
                                                     .e = {-5. / 72., 1. / 12., 1. / 9., -1. / 8.},
                                                     .fitted = {0, 0b1, 0b1, 0b111}};

/// Order 4(3), with Hermite's cubic. Source: Sofroniou & Spaletta, Journal of Computational and Applied Mathematics 164-165 (2004) 675-682
/// ("ARKODE_SOFRONIOU_SPALETTA_5_3_4" of SUNDIALS); the weights are those of Kutta's 3/8 family with nodes 2/5 and 3/5.
inline constexpr EmbeddedTableau sofroniou_spaletta = {
    .n_stages = 5,
    .order = 4,
    .powers = 0,
    .c = {0., 0.4, 0.6, 1., 1.},
    .a = {{{}, {0.4}, {-0.15, 0.75}, {19. / 44., -15. / 44., 10. / 11.}, {11. / 72., 25. / 72., 25. / 72., 11. / 72.}}},
    .e = {119041. / 8970912., -595205. / 8970912., 595205. / 8970912., 1309451. / 8970912., -119041. / 747576.},
    .fitted = {0, 0b1, 0b1, 0b1, 0b1111}};

struct OwnPair {
  IntegrationMethod method;
  const EmbeddedTableau* tableau;
};
inline constexpr std::array own_pairs{OwnPair{IntegrationMethod::tsitouras, &tsitouras},
                                      OwnPair{IntegrationMethod::bogacki_shampine, &bogacki_shampine},
                                      OwnPair{IntegrationMethod::sofroniou_spaletta, &sofroniou_spaletta},
                                      OwnPair{IntegrationMethod::two_step_runge_kutta, &two_step_runge_kutta}};

/// Whether a method is one of these.
[[nodiscard]] constexpr bool is_own_pair(IntegrationMethod method) {
  return std::ranges::find(own_pairs, method, &OwnPair::method) != own_pairs.end();
}

/// @param method  is_own_pair()
[[nodiscard]] inline const EmbeddedTableau& tableau_of(IntegrationMethod method) {
  return *std::ranges::find(own_pairs, method, &OwnPair::method)->tableau;
}

/// Where a time lies in a step, from 0 to 1. @throws SolverError for one outside
[[nodiscard]] inline double part_of_step(double t, double step_end, double step) {
  const double theta = (t - (step_end - step)) / step;
  // Like the step's end, a time that rounding puts outside is inside.
  if (!(theta >= -1e-6 && theta <= 1. + 1e-6)) throw SolverError("a time outside the last step was asked for");
  return theta;
}

/// A step to be tried.
struct Trial {
  double size, target;  // [s]
  bool ends = false;    // where steps have to end
};

/// Chooses steps by the errors that they made, of one drop.
class StepControl {
 public:
  StepControl(const EmbeddedTableau& pair, double tolerance, double longest)
      : order_(pair.order), beta_(pair.control_beta), tolerance_(tolerance), longest_(longest) {}

  /// A hundredth of the time in which the states change by their size, at a tolerance of 1e-6; longer and shorter as the method's error allows.
  /// Source: Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I, 2nd ed., II.4.
  /// @param scale        of each state that is controlled
  /// @param state, rate  functions of the state's number
  template <class State, class Rate>
  [[nodiscard]] double first(std::span<const double> scale, State&& state, Rate&& rate) const {
    double state_norm = 0., rate_norm = 0.;
    for (std::size_t i = 0; i < scale.size(); ++i) {
      const double allowed = scale[i] + std::fabs(state(i));
      state_norm += std::pow(state(i) / allowed, 2);
      rate_norm += std::pow(rate(i) / allowed, 2);
    }
    const double step = state_norm > 1e-10 && rate_norm > 1e-10 ? 0.01 * std::sqrt(state_norm / rate_norm) : 1e-6;
    return std::clamp(step * std::pow(tolerance_ / 1e-6, 1. / order_), 1e-3 * longest_, longest_);
  }
  /// A step of about a size from a time, to where steps have to end if that is nearly reached.
  [[nodiscard]] Trial trial(double size, double time, double end) const {
    const double step = std::min(size, longest_);
    if (time + step * (1. + 1e-6) >= end) return {end - time, end, true};
    return {step, time + step};
  }
  /// What a step is to be multiplied by that was rejected.
  [[nodiscard]] double after_rejection(double size) const {
    return std::isfinite(size) ? std::max(0.2, 0.9 * std::pow(size, -1. / order_)) : 0.25;
  }
  /// What a step is to be multiplied by that was accepted with an error of so many times what is allowed.
  /// PI control. Source: the same, IV.2.
  [[nodiscard]] double after_acceptance(double size, bool was_rejected) {
    const double exponent = 1. / order_ - 0.75 * beta_, logarithm = std::log(std::max(size, 1e-10));
    const double factor = 0.9 * std::exp(beta_ * previous_logarithm_ - exponent * logarithm);
    previous_logarithm_ = std::max(logarithm, smallest_previous);
    return std::clamp(factor, 0.2, was_rejected ? 1. : 5.);
  }

 private:
  static constexpr double smallest_previous = -9.210340371976182;  // log(1e-4)
  double order_, beta_, tolerance_, longest_, previous_logarithm_ = smallest_previous;
};

}  // namespace rotordrop
