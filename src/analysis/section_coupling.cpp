#include "analysis/section_coupling.h"

#include <algorithm>
#include <vector>

namespace rotordrop {
namespace {

/// Sections that the state vector holds or that follow it, on few modes or on all, or none.
class SectionsInTheVector final : public SectionCoupling {
 public:
  SectionsInTheVector(const Machine& machine, FiniteElements* elements)
      : machine_(machine), elements_(elements), state_(machine.layout().size()) {}

  void set_fields(FieldSink& fields) override { fields_ = &fields; }
  void step(const Step& step) override {
    while (fields_ && fields_->is_due(step.time)) {
      step.interpolate(std::min(fields_->next(), step.time), state_);
      machine_.evaluate(std::min(fields_->next(), step.time), state_, found_);
      lift_sections(*elements_, machine_, state_, found_);
      fields_->write(found_.time);
    }
  }

 private:
  const Machine& machine_;
  FiniteElements* elements_;
  FieldSink* fields_ = nullptr;
  Evaluation found_;
  std::vector<double> state_;
};

class SectionsInWindows final : public SectionCoupling {
 public:
  SectionsInWindows(const Machine& machine, const ThermalParameters& thermal, FiniteElements& elements,
                    RowSchedule schedule)
      : machine_(machine),
        balls_roll_(thermal.contact_conduction == BallConductionModel::rolling),
        windows_(elements, thermal.fe.window_tolerance, thermal.fe.longest_window),
        schedule_(std::move(schedule)),
        energies_(machine.n_thermal_places()),
        balls_(machine.n_thermal_places()),
        state_(machine.layout().size()),
        row_(observed_size(windows_.observables())) {
    found_.growth_in_force = growth_in_force();
  }

  [[nodiscard]] const GrowthHistory* growth_in_force() const override { return &windows_.growth_in_force(); }
  [[nodiscard]] std::vector<Observable> observables() const override { return windows_.observables(); }
  void add(RowSink& sink) override { sinks_.push_back(&sink); }
  void watch(RowSink& sink) override { watchers_.push_back(&sink); }
  void set_fields(FieldSink& fields) override { fields_ = &fields; }

  void step(const Step& step) override {
    if (step.is_observed) schedule_.follow(step.time, step.found->step);
    if (step.time == step.start) {
      write_fields(step.time);
      return;
    }
    windows_.look(step.time, energies(step.after));
    while (windows_.next_end() <= step.time) {
      const double end = windows_.next_end();
      step.interpolate(end, state_);
      windows_.advance(step.time, energies(state_), balls(end, state_));
      show(end, false);
    }
  }
  void finish(double time, std::span<const double> y) override {
    windows_.finish(time, energies(y), balls(time, y));
    show(time, true);
  }

  void pack(PackedValues& to) const override {
    to["window rows"] = schedule_.packed();
    to["windows"] = windows_.packed();
  }
  void unpack(const PackedValues& from) override {
    schedule_.unpack(from.at("window rows"));
    windows_.unpack(from.at("windows"));
  }
  [[nodiscard]] std::optional<WindowsReport> windows() const override {
    return WindowsReport{windows_.report(), windows_.energy()};
  }

 private:
  /// Energies of the thermal places in a state.
  std::span<const PlaceEnergy> energies(std::span<const double> y) {
    for (std::size_t place = 0; place < energies_.size(); ++place) energies_[place] = machine_.heat_given(place, y);
    return energies_;
  }

  /// What the balls of the thermal places conduct in a state, if they do as they roll.
  std::span<const PlaceConduction> balls(double t, std::span<const double> y) {
    if (!balls_roll_) return balls_;
    machine_.evaluate(t, y, found_);
    for (std::size_t place = 0; place < balls_.size(); ++place) {
      const HeatInput& heat = found_.heats[place];
      balls_[place].all = heat.balls;
      balls_[place].rows.clear();
      for (const auto& row : heat.rows) balls_[place].rows.push_back(row.balls);
    }
    return balls_;
  }

  void show(double t, bool is_last) {
    windows_.observe(row_);
    for (RowSink* watcher : watchers_) watcher->row(t, row_);
    if (is_last || schedule_.due() <= t || is_same_time(schedule_.due(), t)) {
      for (RowSink* sink : sinks_) sink->row(t, row_);
      schedule_.written(t);
    }
    write_fields(t);
  }

  void write_fields(double t) {
    if (fields_ && fields_->is_due(t)) fields_->write(t);
  }

  const Machine& machine_;
  bool balls_roll_;
  WindowedSections windows_;
  RowSchedule schedule_;
  FieldSink* fields_ = nullptr;
  std::vector<RowSink*> sinks_, watchers_;
  Evaluation found_;
  std::vector<PlaceEnergy> energies_;
  std::vector<PlaceConduction> balls_;  // of the thermal places
  std::vector<double> state_, row_;
};

}  // namespace

void lift_sections(FiniteElements& elements, const Machine& machine, std::span<const double> y,
                   const Evaluation& found) {
  std::size_t model = 0;
  const auto meshes = [&](std::size_t k) {
    const ThermalKind* kind = thermal_kind(machine.thermal_name(k));
    return kind && kind->meshes_sections;
  };
  while (!meshes(model)) ++model;
  const auto states = machine.thermal_state(model, y);
  std::size_t first = 0;
  for (std::size_t k = 0; k < elements.sections.size(); ++k) {
    auto& section = elements.sections[k];
    const HeatInput& heat = found.heats[k];
    std::vector<double> watts(section.problem.ports.size());
    watts[bore_port] = heat.rub_into_ring;
    watts[shaft_port] = heat.rub - heat.rub_into_ring;
    if (section.row_ports.empty()) {
      watts[inner_raceway_port] = heat.inner;
      watts[outer_raceway_port] = heat.outer;
    }
    for (std::size_t row = 0; row < section.row_ports.size(); ++row) {
      watts[section.row_ports[row].inner] = heat.rows[row].inner;
      watts[section.row_ports[row].outer] = heat.rows[row].outer;
    }
    section.solver->lift(states.subspan(first, section.reduced.n_modes()), watts, found.time);
    first += section.reduced.n_modes();
  }
}

std::unique_ptr<SectionCoupling> make_section_coupling(const Machine& machine, const ThermalParameters& thermal,
                                                       FiniteElements* elements, RowSchedule schedule) {
  if (elements && !elements->sections.empty() && elements->coupling == FeCoupling::windowed)
    return std::make_unique<SectionsInWindows>(machine, thermal, *elements, std::move(schedule));
  return std::make_unique<SectionsInTheVector>(machine, elements);
}

}  // namespace rotordrop
