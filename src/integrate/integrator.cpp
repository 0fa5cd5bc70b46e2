#include "integrate/integrator.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "integrate/methods.h"

namespace rotordrop {

std::unique_ptr<Integrator> make_integrator(const OdeSystem& system, const IntegrationParameters& parameters,
                                            double start_time, std::span<const double> state, double end_time) {
  const auto* kind = std::find_if(integration_methods.begin(), integration_methods.end(),
                                  [&](const auto& one) { return one.method == parameters.method; });
  return kind->make(system, parameters, start_time, state, end_time);
}

std::string worst_components(const StateLayout& layout, std::span<const double> weighted_error, std::size_t count) {
  std::vector<std::size_t> order(weighted_error.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  double sum = 0.;
  for (const double e : weighted_error) sum += e * e;
  count = std::min(count, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
                    [&](std::size_t a, std::size_t b) {
                      return weighted_error[a] * weighted_error[a] > weighted_error[b] * weighted_error[b];
                    });
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    const double share = sum > 0. ? 100. * weighted_error[order[i]] * weighted_error[order[i]] / sum : 0.;
    if (share < 0.5) break;
    text += fmt::format("{}\"{}\" ({:.0f} %)", text.empty() ? "" : ", ", layout.describe(order[i]), share);
  }
  return text;
}

}  // namespace rotordrop
