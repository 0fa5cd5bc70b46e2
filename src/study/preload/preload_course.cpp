#include "study/preload/preload_course.h"

#include <algorithm>
#include <cmath>

#include "analysis/preload/build_preload.h"
#include "integrate/integrator.h"

namespace rotordrop {
namespace {

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
    const auto rates = rates_at(t, y);
    end.is_settled = std::all_of(rates.begin(), rates.begin() + static_cast<std::ptrdiff_t>(loop_.size()),
                                 [&](double r) { return std::fabs(r) < settings_.settled_rate; });
    end.time = t;
    end.y.assign(y.begin(), y.end());
    end.limit = limit(y);
    return end.is_settled || end.limit != LimitMet::none;
  }
  /// Of the step that ends at t, on average: fast modes stand off their place by the integration's error, and their rate of the moment is that error
  /// times thousands. It began where the course stands; at the start of all there is no step yet.
  [[nodiscard]] std::vector<double> rates_at(double t, std::span<const double> y) {
    std::vector<double> rates(y.size());
    if (t == 0.) {
      system_.rhs(t, y, rates);
      return rates;
    }
    for (std::size_t i = 0; i < y.size(); ++i) rates[i] = (y[i] - course_.y[i]) / (t - course_.time);
    return rates;
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
};

}  // namespace

PreloadCourse follow_preload(const PreloadLoop& loop, const PreloadParameters& settings, const std::string& prefix) {
  return Way(loop, settings, prefix).run();
}

}  // namespace rotordrop
