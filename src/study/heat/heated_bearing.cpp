#include "study/heat/heated_bearing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "integrate/integrator.h"
#include "machine/heat/heated_model.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

std::array<double, n_bearing_ports> port_heat(const HeatInput& heat) {
  std::array<double, n_bearing_ports> watts{};
  watts[bore_port] = heat.rub_into_ring;
  watts[shaft_port] = heat.rub - heat.rub_into_ring;
  watts[inner_raceway_port] = heat.inner;
  watts[outer_raceway_port] = heat.outer;
  return watts;
}

void report_section(const HeatConductionSolver& solver, Json& to) {
  const HeatStatistics s = solver.statistics();
  to["unknowns"] = s.unknowns;
  to["cells"] = s.cells;
}

// Roundoff of absolute temperatures leaves no more.
constexpr double smallest_tolerance = 1e-13;
// So that the integrator's shortest step, a fixed part of the longest, is below all that modes need [s].
constexpr double longest_step = 0.1;

// After so many steps of one interval stability alone keeps them short: fast modes have long been even.
constexpr long most_explicit_steps = 5000;

/// Heat that goes in or out through all ports over a time, as it was told [J].
double turnover_of(const HeatInput& heat, const HeatInput& rate, double time) {
  const auto watts = port_heat(heat), rates = port_heat(rate);
  double sum = 0.;
  for (std::size_t p = 0; p < watts.size(); ++p)
    sum += 0.5 * time * (std::fabs(watts[p]) + std::fabs(watts[p] + rates[p] * time));
  return sum;
}

/// By how much each mode counts in what is shown: the largest temperature of a body, node, port or point of its surface per kelvin of the mode. Narrow modes have some 1e4 on their strip.
std::vector<double> largest_shapes(const ReducedHeat& heat) {
  std::vector<double> largest(heat.n_modes(), 1.);
  const auto consider = [&](const std::vector<double>& shapes) {
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      double& of_mode = largest[i % largest.size()];
      of_mode = std::max(of_mode, std::fabs(shapes[i]));
    }
  };
  for (const auto* list : {&heat.bodies, &heat.nodes, &heat.ports})
    for (const auto& output : *list) {
      consider(output.shape);
      consider(output.points);
    }
  return largest;
}

class InStateVector final : public HeatedBearing {
 public:
  InStateVector(const ThermalModel& model, const HeatedModelSettings& settings)
      : model_(model),
        system_(model, settings.n_places, settings.place,
                settings.section ? largest_shapes(settings.section->reduced) : std::vector<double>{}),
        settings_(settings),
        state_(system_.layout().size()),
        growth_(settings.n_places) {
    system_.initial_state(state_);
    const std::string prefix = settings.bearing + "/";
    std::size_t at = 0;
    for (const auto& o : model.observables()) {
      if (o.unit == "K") {  // of surfaces the mean, which comes first
        names_.push_back(o.name.starts_with(prefix) ? o.name.substr(prefix.size()) : o.name);
        places_.push_back(at);
      }
      at += o.size;
    }
    observed_.resize(at);
    if (settings.section) {
      capacity_ = settings.section->reduced.capacity;
    } else {
      std::vector<double> warmer(state_.begin(), state_.end() - 1);
      for (double& T : warmer) T += 1.;
      capacity_ = model.stored_energy(warmer);
    }
  }

  void advance(double until, const HeatInput& heat, const HeatInput& rate) override {
    system_.hold(time_, heat, rate);
    // Times that differ by the rounding of their decimals are one.
    if (until - time_ <= 1e-12 * until) {
      time_ = until;
      return;
    }
    turnover_ += turnover_of(heat, rate, until - time_);
    const IntegrationParameters how{
        .method = IntegrationMethod::dormand_prince,
        .step = std::min(until - time_, longest_step),
        .tolerance =
            std::max(settings_.time_tolerance * turnover_ / capacity_ / settings_.ambient, smallest_tolerance)};
    auto integrator = make_integrator(system_, how, time_, state_, until);
    const auto take = [&] {
      const auto end = integrator->state();
      std::copy(end.begin(), end.end(), state_.begin());
      const auto s = integrator->statistics();
      statistics_.steps += s.steps;
      statistics_.rejected_steps += s.rejected_steps;
    };
    bool is_explicit = true;
    while (integrator->time() < until) {
      if (ask_) ask_();
      integrator->advance();
      if (!is_explicit || integrator->statistics().steps < most_explicit_steps) continue;
      is_explicit = false;
      take();
      integrator = make_stiff_integrator(system_, how.tolerance, integrator->time(), state_, until);
    }
    take();
    time_ = until;
    require_above_zero();
  }
  void ask_between_steps(std::function<void()> ask) override { ask_ = std::move(ask); }
  [[nodiscard]] double time() const override { return time_; }
  [[nodiscard]] const std::vector<std::string>& names() const override { return names_; }
  [[nodiscard]] std::vector<double> temperatures() const override {
    model_.observe(temperature_state(), system_.heats_at(time_), observed_);
    std::vector<double> values;
    for (const std::size_t at : places_) values.push_back(observed_[at]);
    return values;
  }
  [[nodiscard]] Expansion growth() override {
    model_.growth(temperature_state(), growth_);
    return growth_[settings_.place];
  }
  [[nodiscard]] double stored() const override { return model_.stored_energy(temperature_state()); }
  [[nodiscard]] double lost() const override { return state_.back(); }
  const HeatConductionSolver* section() override {
    if (!settings_.section) return nullptr;
    auto& solver = *settings_.section->solver;
    solver.lift(temperature_state(), port_heat(system_.heats_at(time_)[settings_.place]), time_);
    return &solver;
  }
  void report(Json& to) const override {
    if (settings_.section) {
      report_section(*settings_.section->solver, to);
      to["modes"] = settings_.section->reduced.n_modes();
      for (const auto port : {bore_port, shaft_port, inner_raceway_port, outer_raceway_port}) {
        const auto& heated = settings_.section->reduced.ports.at(port);
        to["response_error"][heated.name] = heated.response_error;
      }
      to["largest_response_error"] = settings_.section->reduced.response_error;
      to["worst_response"] = settings_.section->reduced.worst_response;
    }
    to["steps"] = statistics_.steps;
    to["rejected_steps"] = statistics_.rejected_steps;
  }

 private:
  void require_above_zero() const {
    const auto T = temperatures();
    for (std::size_t i = 0; i < T.size(); ++i) {
      if (std::isnan(T[i]))
        throw SolverError(fmt::format("the temperature of {} of {} is not a number before t = {:.6g} s.", names_[i],
                                      settings_.bearing, time_));
      if (!(T[i] > 0.))
        throw SolverError(
            fmt::format("{} of {} is cooled below 0 K before t = {:.6g} s: its temperature would be "
                        "{:.4g} K. No boundary can give off so much heat: check the negative values of "
                        "[[heat.source]].",
                        names_[i], settings_.bearing, time_, T[i]));
    }
  }
  [[nodiscard]] std::span<const double> temperature_state() const { return system_.model_state(state_); }

  const ThermalModel& model_;
  HeatedModel system_;
  HeatedModelSettings settings_;
  double time_ = 0;
  double capacity_ = 0;  ///< [J/K]
  double turnover_ = 0;  ///< so far [J]
  std::vector<double> state_;
  std::vector<std::string> names_;
  std::vector<std::size_t> places_;  ///< of names_ in what the model shows
  mutable std::vector<double> observed_;
  std::vector<Expansion> growth_;
  IntegrationStatistics statistics_;
  std::function<void()> ask_;
};

class OnMesh final : public HeatedBearing {
 public:
  explicit OnMesh(FiniteElements::Section& section) : section_(section), solver_(*section.solver) {
    for (const auto& body : section.problem.bodies) names_.push_back(body.name);
    for (const auto& port : section.problem.ports)
      names_.push_back(!port.node && port.name == "shaft" ? "shaft_surface" : port.name);
  }

  void advance(double until, const HeatInput& heat, const HeatInput& rate) override {
    const auto watts = port_heat(heat), rates = port_heat(rate);
    // What goes on as it was told needs no small steps again.
    if (!goes_on(watts, rates)) {
      solver_.set_port_heat(watts, rates);
      since_ = time();
      watts_ = watts;
      rates_ = rates;
    }
    solver_.advance_to(until);
  }
  void ask_between_steps(std::function<void()> ask) override { solver_.ask_between_steps(std::move(ask)); }
  [[nodiscard]] double time() const override { return solver_.time(); }
  [[nodiscard]] const std::vector<std::string>& names() const override { return names_; }
  [[nodiscard]] std::vector<double> temperatures() const override {
    std::vector<double> values;
    for (std::size_t b = 0; b < section_.problem.bodies.size(); ++b) values.push_back(solver_.body_mean(b));
    for (std::size_t p = 0; p < section_.problem.ports.size(); ++p) values.push_back(solver_.port_temperature(p));
    return values;
  }
  [[nodiscard]] Expansion growth() override { return growth_of(section_); }
  [[nodiscard]] double stored() const override { return solver_.energy().stored; }
  [[nodiscard]] double lost() const override { return solver_.energy().lost; }
  const HeatConductionSolver* section() override { return &solver_; }
  void report(Json& to) const override {
    report_section(solver_, to);
    const HeatStatistics s = solver_.statistics();
    to["steps"] = s.steps;
    to["rejected_steps"] = s.rejected_steps;
    to["factorisations"] = s.factorisations;
  }

 private:
  using PortHeat = std::array<double, n_bearing_ports>;
  [[nodiscard]] bool goes_on(const PortHeat& watts, const PortHeat& rates) const {
    for (std::size_t p = 0; p < watts.size(); ++p) {
      const double expected = watts_[p] + rates_[p] * (time() - since_);
      if (rates[p] != rates_[p] || std::fabs(watts[p] - expected) > 1e-12 * std::fabs(watts[p])) return false;
    }
    return true;
  }

  FiniteElements::Section& section_;
  HeatConductionSolver& solver_;
  std::vector<std::string> names_;
  double since_ = 0;
  PortHeat watts_{}, rates_{};  ///< at since_ [W], and from there on [W/s]
};

}  // namespace

std::unique_ptr<HeatedBearing> heated_model(const ThermalModel& model, const HeatedModelSettings& settings) {
  return std::make_unique<InStateVector>(model, settings);
}

std::unique_ptr<HeatedBearing> heated_mesh(FiniteElements::Section& section) {
  return std::make_unique<OnMesh>(section);
}

}  // namespace rotordrop
