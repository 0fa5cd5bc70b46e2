#include "study/preload/preload_course.h"

#include <algorithm>
#include <cmath>

#include "analysis/preload/build_preload.h"
#include "integrate/integrator.h"

namespace rotordrop {
namespace {

/// Rates of temperatures at an instant.
struct Rates {
  double at = 0;           // [s]
  std::vector<double> of;  // [K/s] [nodes]
};

class Way {
 public:
  Way(const PreloadLoop& loop, const PreloadParameters& settings, const std::string& prefix)
      : loop_(loop), settings_(settings), limits_(preload_limits(settings)), system_(loop) {
    auto& channels = course_.table.group.channels;
    course_.table.group.time_path = prefix + "time";
    channels = running_channels(prefix);
    channels.push_back({prefix + "heat_rate", "W", "friction heat of the bearing", 1, {}});
    channels.push_back({prefix + "load_torque", "N m", "load-dependent friction torque, load law equivalent", 1, {}});
    channels.push_back({prefix + "drag_torque", "N m", "speed-dependent friction torque", 1, {}});
    channels.push_back({prefix + "spin_torque", "N m", "torque of the balls' spin moments, if they add heat", 1, {}});
    channels.push_back(
        {prefix + "growth", "m", "thermal growth of the inner raceway minus that of the outer one", 1, {}});
    channels.push_back({prefix + "ball_growth", "m", "of a ball's radius, by heat", 1, {}});
    channels.push_back({prefix + "heat_made", "J", "integral of the heat rate", 1, {}});
    channels.push_back({prefix + "heat_lost", "J", "heat lost to ambient, integrated", 1, {}});
    channels.push_back({prefix + "heat_stored", "J", "heat stored in the parts, above ambient", 1, {}});
    for (const auto& node : loop.nodes())
      channels.push_back({prefix + "temperature/" + node.name, "K", node.long_name, 1, {}});
  }

  PreloadCourse run() {
    auto& end = course_;
    end.y.resize(system_.layout().size());
    system_.initial_state(end.y);
    record(0., end.y);
    if (is_over(0., end.y)) return std::move(course_);
    const auto integrator = make_stiff_integrator(system_, settings_.tolerance, 0., end.y, settings_.end_time);
    while (integrator->time() < settings_.end_time) {
      const double before = integrator->time();
      integrator->advance();
      if (limit(integrator->state()) != LimitMet::none) {
        find_limit(*integrator, before);
        record(end.time, end.y);
        break;
      }
      record(integrator->time(), integrator->state());
      if (is_over(integrator->time(), integrator->state())) break;
    }
    return std::move(course_);
  }

 private:
  [[nodiscard]] LimitMet limit(std::span<const double> y) const {
    const auto T = system_.temperatures(y);
    return limit_met(loop_, limits_, T, loop_.state(T));
  }
  bool is_over(double t, std::span<const double> y) {
    auto& end = course_;
    end.limit = limit(y);
    look_at_rates(t, y);
    end.y.assign(y.begin(), y.end());
    return end.is_settled || end.limit != LimitMet::none;
  }
  /// Rates of a step are its means, and stand at its middle: fast modes stand off their place by the integration's error, and their rate of the moment is
  /// that error times thousands. The step began where the course stands; at the start of all there is none yet.
  void look_at_rates(double t, std::span<const double> y) {
    const Rates last = std::move(rates_);
    const bool is_first = t == 0.;
    rates_ = {0.5 * (course_.time + t), std::vector<double>(y.size())};
    if (is_first)
      system_.rhs(t, y, rates_.of);
    else
      for (std::size_t i = 0; i < y.size(); ++i) rates_.of[i] = (y[i] - course_.y[i]) / (t - course_.time);
    rates_.of.resize(loop_.size());  // of temperatures
    course_.is_settled = std::all_of(rates_.of.begin(), rates_.of.end(), [&](double r) { return is_slow(r); });
    course_.time = course_.is_settled && !is_first ? settling_between(last, rates_) : t;
  }
  [[nodiscard]] bool is_slow(double rate) const { return std::fabs(rate) < settings_.settled_rate; }
  /// The instant from which every rate is slow, between one at which some is not and one at which all are. A rate of one sign dies away exponentially,
  /// one that changes its sign is taken as straight.
  [[nodiscard]] double settling_between(const Rates& before, const Rates& after) const {
    const double slow = settings_.settled_rate;
    double part = 0.;
    for (std::size_t i = 0; i < after.of.size(); ++i) {
      if (is_slow(before.of[i])) continue;
      const double from = std::fabs(before.of[i]), to = std::fabs(after.of[i]);
      part = std::max(part, before.of[i] * after.of[i] > 0. ? std::log(from / slow) / std::log(from / to)
                                                            : (from - slow) / (from + to));
    }
    return before.at + part * (after.at - before.at);
  }
  /// The instant within the last step at which a limit is met.
  void find_limit(const Integrator& integrator, double before) {
    auto& end = course_;
    double inside = before, outside = integrator.time();
    end.y.assign(integrator.state().begin(), integrator.state().end());
    while (outside - inside > 1e-9 * outside) {
      const double middle = 0.5 * (inside + outside);
      std::vector<double> y(end.y.size());
      integrator.interpolate(middle, y);
      if (limit(y) == LimitMet::none) {
        inside = middle;
      } else {
        outside = middle;
        end.y = y;
      }
    }
    end.time = outside;
    end.limit = limit(end.y);
  }
  void record(double t, std::span<const double> y) {
    const auto T = system_.temperatures(y);
    const auto s = loop_.state(T);
    const auto growth = loop_.growth(T);
    auto row = running_values(s);
    const double stored = loop_.stored_energy(T);
    for (const double v : {s.heat, s.load_torque, s.drag_torque, s.spin_torque, growth.inner_race - growth.outer_race,
                           growth.ball, y[loop_.size()], y[loop_.size() + 1], stored})
      row.push_back(v);
    for (const double temperature : loop_.node_temperatures(T, s.heat)) row.push_back(temperature);
    course_.table.axis.push_back(t);
    course_.table.rows.push_back(std::move(row));
    if (s.preload > course_.largest_preload) {
      course_.largest_preload = s.preload;
      course_.largest_preload_time = t;
    }
  }

  const PreloadLoop& loop_;
  const PreloadParameters& settings_;
  PreloadLimits limits_;
  PreloadTransient system_;
  PreloadCourse course_;
  Rates rates_;  // of the last step
};

}  // namespace

PreloadCourse follow_preload(const PreloadLoop& loop, const PreloadParameters& settings, const std::string& prefix) {
  return Way(loop, settings, prefix).run();
}

}  // namespace rotordrop
