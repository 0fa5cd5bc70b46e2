#include "laws/support/ribbon.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rotordrop {
namespace {

using Branch = std::vector<std::array<double, 2>>;

double area_under(const Branch& b) {
  double sum = 0.;
  for (std::size_t k = 1; k < b.size(); ++k) sum += 0.5 * (b[k][1] + b[k - 1][1]) * (b[k][0] - b[k - 1][0]);
  return sum;
}

/// Loss of a slider in one steady turn of amplitude x: two passes from one side to the other.
double slider_loss(const StopOperator& s, double amplitude) {
  // At the turn z = z_t; the pass of 2 x ends at -z_t: elastic for z_t + (1 - e) z_s, then the exponential.
  const double e = StopOperator::onset, z_s = s.reach, elastic = (1. - e) * z_s;
  if (amplitude <= elastic) return 0.;
  double z_t = z_s;
  for (int k = 0; k < 200; ++k) {
    const double next = z_s - e * z_s * std::exp(-(2. * amplitude - z_t - elastic) / (e * z_s));
    const bool is_done = std::fabs(next - z_t) <= 1e-16 * z_s;
    z_t = next;
    if (is_done) break;
  }
  // Work of the force k z over a pass, from z_t to -z_t; what is stored is the same at both ends.
  const double beyond = 2. * amplitude - z_t - elastic, tail = e * z_s;
  const double work =
      0.5 * (elastic * elastic - z_t * z_t) + z_s * beyond - tail * tail * (1. - std::exp(-beyond / tail));
  return 2. * s.stiffness * work;
}

}  // namespace

std::string fault_of(const MeasuredLoop& loop) {
  if (loop.loading.size() < 2 || loop.unloading.size() < 2) return "a branch needs two points or more";
  const double first = loop.loading.front()[0], last = loop.loading.back()[0], range = last - first;
  if (!(range > 0.)) return "the displacement of the loading branch does not rise";
  if (std::fabs(loop.unloading.front()[0] - first) > 1e-6 * range ||
      std::fabs(loop.unloading.back()[0] - last) > 1e-6 * range)
    return fmt::format(
        "its branches are measured over different displacements, {:.6g} to {:.6g} um and {:.6g} to {:.6g} um",
        first * 1e6, last * 1e6, loop.unloading.front()[0] * 1e6, loop.unloading.back()[0] * 1e6);
  double force = 0.;
  for (const auto& p : loop.loading) force = std::max(force, std::fabs(p[1]));
  for (const auto* branch : {&loop.loading, &loop.unloading})
    for (const auto& p : *branch) {
      const double difference = table_value(loop.loading, p[0]) - table_value(loop.unloading, p[0]);
      if (difference < -1e-6 * force)
        return fmt::format("it makes energy: at {:.6g} um the unloading branch lies {:.6g} N above the loading one",
                           p[0] * 1e6, -difference);
    }
  if (loop_area(loop) < 0.) return "it makes energy";
  for (const auto* branch : {&loop.loading, &loop.unloading})
    for (std::size_t k = 1; k < branch->size(); ++k)
      if ((*branch)[k][1] < (*branch)[k - 1][1] - 1e-6 * force)
        return fmt::format(
            "its force falls with rising displacement between {:.6g} and {:.6g} um: a negative stiffness",
            (*branch)[k - 1][0] * 1e6, (*branch)[k][0] * 1e6);
  return {};
}

double loop_area(const MeasuredLoop& loop) { return area_under(loop.loading) - area_under(loop.unloading); }

double steady_loop_loss(const RibbonSupport::Axis& axis, double amplitude) {
  double loss = 0.;
  for (const auto& s : axis.elements) loss += slider_loss(s, amplitude);
  return loss;
}

RibbonSupport::Axis ribbon_from_loop(const MeasuredLoop& loop) {
  const double x_1 = loop.loading.front()[0], range = loop.loading.back()[0] - x_1, x_2 = x_1 + range;
  std::vector<double> at = {0., range};
  for (const auto& p : loop.loading) at.push_back(p[0] - x_1);
  for (const auto& p : loop.unloading) at.push_back(x_2 - p[0]);
  std::sort(at.begin(), at.end());
  const auto branch = [&](double d) {
    return 0.5 * (table_value(loop.loading, x_1 + d) - loop.loading.front()[1] + loop.unloading.back()[1] -
                  table_value(loop.unloading, x_2 - d));
  };
  struct Piece {
    double length, rise;
    [[nodiscard]] double slope() const { return rise / length; }
  };
  std::vector<Piece> pieces;
  double from = 0.;
  for (const double to : at) {
    if (to - from <= 1e-9 * range) continue;
    pieces.push_back({to - from, branch(to) - branch(from)});
    from = to;
    // Slopes that rise are levelled with those before them.
    while (pieces.size() > 1 && pieces.back().slope() >= pieces[pieces.size() - 2].slope() * (1. - 1e-9)) {
      const Piece last = pieces.back();
      pieces.pop_back();
      pieces.back().length += last.length;
      pieces.back().rise += last.rise;
    }
  }
  RibbonSupport::Axis axis;
  axis.stiffness = std::max(pieces.back().slope(), 0.);
  double travelled = 0.;
  for (std::size_t j = 0; j + 1 < pieces.size(); ++j) {
    travelled += pieces[j].length;
    StopOperator s{pieces[j].slope() - std::max(pieces[j + 1].slope(), 0.), 0.5 * travelled};
    // A sharp slider loses 4 k z_s (X - z_s) in a turn of amplitude X; the soft one the same with a slightly different reach.
    const double sharp = 4. * s.stiffness * s.reach * (0.5 * range - s.reach);
    const auto excess = [&](double reach) { return slider_loss({s.stiffness, reach}, 0.5 * range) - sharp; };
    // The loss first rises with the reach, then falls to zero where the slider no longer slips.
    const bool rises = s.reach <= 0.25 * range, is_larger = (excess(s.reach) < 0.) == rises;
    double other = is_larger ? std::min(1.5 * s.reach, 0.5 * range / (1. - StopOperator::onset)) : 0.5 * s.reach;
    if (excess(s.reach) * excess(other) <= 0.)
      for (int k = 0; k < 100; ++k) {
        const double middle = 0.5 * (s.reach + other);
        (excess(middle) * excess(s.reach) > 0. ? s.reach : other) = middle;
      }
    // What no reach gives, for a slider that slips at a fifth to a third of the travel, up to 2 % more stiffness does.
    s.stiffness *= sharp / slider_loss(s, 0.5 * range);
    axis.elements.push_back(s);
  }
  return axis;
}

double wave_stiffness(const RibbonGeometry& g) {
  const double l = 0.5 * g.pitch;
  return g.modulus * std::pow(g.thickness / l, 3) * g.width / (2. * (1. - g.poisson_ratio * g.poisson_ratio));
}

RibbonSupport::Axis ribbon_from_geometry(const RibbonGeometry& g) {
  const double k = wave_stiffness(g), load = k * g.interference, n = g.n_waves;
  const double kappa = std::numbers::pi * std::numbers::pi * g.height / (4. * g.pitch);
  const double strip = 4. * g.modulus * g.thickness * g.width / g.pitch;
  RibbonSupport::Axis axis;
  axis.stiffness = 0.5 * n * k;
  const auto add = [&](double friction, double stiffness) {
    if (!(friction > 0.)) return;
    const double slips = friction * 2. * n / std::numbers::pi, sticks = 0.5 * n * stiffness;
    const double reach = std::max(slips / sticks, g.stick_length);
    axis.elements.push_back({slips / reach, reach});
  };
  add(g.friction_coefficient * load * kappa, kappa * kappa * strip);
  add(g.friction_coefficient * load, strip);
  return axis;
}

}  // namespace rotordrop
