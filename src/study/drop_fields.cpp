#include "study/drop_fields.h"

#include <algorithm>
#include <vector>

namespace rotordrop {

static constexpr double rounding = 1e-9;

void lift_sections(FiniteElements& elements, const Machine& machine, std::span<const double> y,
                   const Evaluation& found) {
  std::size_t model = 0;
  while (machine.thermal_name(model) != "fe") ++model;
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

DropFields::DropFields(const std::filesystem::path& directory, FiniteElements& elements, const FeParameters& parameters,
                       const Machine& machine, double start)
    : elements_(elements), machine_(machine), times_(parameters.field_times, parameters.field_interval.value_or(0.)) {
  if (times_.empty()) return;
  double last = -1.;
  for (const auto& section : elements.sections) {
    series_.emplace_back(directory / "fields", section.name, start > 0. ? start : -1.);
    last = series_.back().empty() ? -1. : series_.back().last_time();
  }
  if (!series_.empty())
    next_ = times_.after(last * (1. + rounding));  // a window's end may lie a bit before the time it stands for
}

bool DropFields::is_due(double t) const { return next_ <= t * (1. + rounding); }

void DropFields::write(std::size_t section, double t) {
  series_[section].add(t, [&](const std::string& file) { elements_.sections[section].solver->write_vtu(file); });
}

void DropFields::write_reduced(std::span<const double> y, const Evaluation& found) {
  lift_sections(elements_, machine_, y, found);
  write_windowed(found.time);
}

void DropFields::write_windowed(double t) {
  for (std::size_t k = 0; k < elements_.sections.size(); ++k) write(k, t);
  next_ = times_.after(std::max(t, next_));
}

}  // namespace rotordrop
