#pragma once
#include <cmath>
#include <numbers>
#include <vector>

namespace rotordrop {

/// 1/sqrt(s) as a sum of exponentials, sum_k weight_k exp(-rate_k s), for heat that half spaces remember:
///   1/sqrt(s) = pi^(-1/2) sum H e^(z/2) exp(-s e^z) over z = z_0 + j H,  error 2 sqrt(2) exp(-pi^2/H) of it.
/// Terms that have died at the shortest interval [s] are left out; those that do not change within the duration [s] are one constant, the first term.
struct RootKernel {
  std::vector<double> rate, weight;  ///< [1/s], [s^-1/2]
  RootKernel(double duration, double shortest_interval) {
    constexpr double H = 1.1;
    const double lowest = std::log(4e-3 / duration), highest = std::log(10. / shortest_interval);
    const auto weight_at = [](double z) { return H / std::sqrt(std::numbers::pi) * std::exp(0.5 * z); };
    rate.push_back(0.);
    weight.push_back(weight_at(lowest - H) / (1. - std::exp(-0.5 * H)));
    for (double z = lowest; z < highest + H; z += H) {
      rate.push_back(std::exp(z));
      weight.push_back(weight_at(z));
    }
  }
};

}  // namespace rotordrop
