#pragma once
#include <cmath>
#include <numbers>
#include <vector>

namespace rotordrop {

/// 1/sqrt(s) as a sum of exponentials, sum_k weight_k exp(-rate_k s), for heat that half spaces remember:
///   1/sqrt(s) = pi^(-1/2) sum H e^(z/2) exp(-s e^z) over z = z_0 + j H,  error 2 sqrt(2) exp(-pi^2/H) of it.
/// Terms that have died within a fifth of the shortest interval [s] are left out (where rows come unevenly some are nearer to each other); the endless
/// many that change little within the duration [s] are one, the first: all their weight at their mean rate, so that the error is of second order in
/// rate times duration. From that fifth to the duration the sum is met to 4e-4; beyond the duration it falls too fast.
struct RootKernel {
  std::vector<double> rate, weight;  ///< [1/s], [s^-1/2]
  RootKernel(double duration, double shortest_interval) {
    constexpr double H = 1.1, slow = 0.1, dead = 60.;
    const double lowest = std::log(slow / duration), highest = std::log(dead / shortest_interval);
    const auto weight_at = [](double z) { return H / std::sqrt(std::numbers::pi) * std::exp(0.5 * z); };
    // Geometric series over z = lowest - H, lowest - 2 H, ... of weight_at(z), and of weight_at(z) e^z.
    const double all_weights = weight_at(lowest - H) / (1. - std::exp(-0.5 * H));
    const double all_rates = weight_at(lowest - H) * std::exp(lowest - H) / (1. - std::exp(-1.5 * H));
    rate.push_back(all_rates / all_weights);
    weight.push_back(all_weights);
    for (double z = lowest; z < highest; z += H) {
      rate.push_back(std::exp(z));
      weight.push_back(weight_at(z));
    }
  }
};

}  // namespace rotordrop
