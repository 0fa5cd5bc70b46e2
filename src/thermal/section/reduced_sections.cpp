#include "thermal/section/reduced_sections.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "laws/heat/heat_flow.h"
#include "thermal/section/modal_sums.h"

namespace rotordrop {

namespace {

double sum(const std::vector<double>& shape, const double* y, double zero) {
  double s = 0.;
  for (std::size_t i = 0; i < shape.size(); ++i) s += shape[i] * (y[i] - zero);
  return s;
}

const ReducedHeat::Output& find(const std::vector<ReducedHeat::Output>& list, const std::string& name) {
  for (const auto& output : list)
    if (output.name == name) return output;
  throw std::invalid_argument("the reduced section has no \"" + name + "\"");
}

std::vector<double> times(double factor, std::vector<double> v) {
  for (double& x : v) x *= factor;
  return v;
}

/// Shapes of growth_surfaces, each so much per rise of a mean.
std::array<std::vector<double>, growth_surfaces.size()> growth_of_means(const ReducedHeat& heat,
                                                                        const GrowthPerRise& g) {
  const auto& inner = find(heat.bodies, "inner_ring").shape;
  const auto &outer = find(heat.bodies, "outer_ring"), &housing = find(heat.bodies, "housing");
  std::vector<double> outside(heat.n_modes());
  for (std::size_t i = 0; i < outside.size(); ++i)
    outside[i] =
        (outer.capacity * outer.shape[i] + housing.capacity * housing.shape[i]) / (outer.capacity + housing.capacity);
  const bool is_lump =
      std::any_of(heat.nodes.begin(), heat.nodes.end(), [](const auto& o) { return o.name == "shaft"; });
  return {times(g.shaft, find(is_lump ? heat.nodes : heat.bodies, "shaft").shape),
          times(g.bore, inner),
          times(g.inner_race, inner),
          times(g.outer_race, outside),
          times(g.ball, find(heat.nodes, "ball").shape),
          times(g.inner_width, inner),
          times(g.outer_width, outer.shape)};
}

// What observe() writes for a surface.
const std::vector<std::string> surface_columns = {"mean", "lowest", "highest"};
constexpr std::array<std::size_t, 4> surface_ports = {bore_port, inner_raceway_port, outer_raceway_port, housing_port};

/// Those, and of rows that are heated apart each row's strips.
std::vector<std::size_t> observed_ports(const ReducedSection& section) {
  std::vector<std::size_t> ports(surface_ports.begin(), surface_ports.end());
  for (const auto& row : section.rows) ports.insert(ports.end(), {row.inner, row.outer});
  return ports;
}

}  // namespace

ReducedSections::ReducedSections(std::vector<ReducedSection> sections, double ambient)
    : sections_(std::move(sections)), ambient_(ambient) {
  std::size_t first = 0;
  for (const auto& section : sections_) {
    const ReducedHeat& heat = section.heat;
    Place p;
    p.first = first;
    p.n = heat.n_modes();
    first += p.n;
    p.rate = heat.rate;
    const auto input = [&](std::size_t port) { return times(1. / heat.capacity, heat.ports.at(port).shape); };
    p.bore_input = input(bore_port);
    p.shaft_input = input(shaft_port);
    p.inner_input = input(inner_raceway_port);
    p.outer_input = input(outer_raceway_port);
    const auto& film = heat.ports.at(housing_port);
    p.film = film.shape;
    p.film_input = times(1. / heat.capacity, film.shape);
    p.film_area = film.area;
    p.loss = heat.loss;
    p.bore = heat.ports[bore_port].shape;
    p.shaft_surface = heat.ports[shaft_port].shape;
    for (const auto& row : section.rows) {
      const auto &inner = heat.ports.at(row.inner), &outer = heat.ports.at(row.outer);
      p.rows.push_back({input(row.inner), input(row.outer), inner.shape, outer.shape, inner.at_once, outer.at_once,
                        inner.area / heat.ports[inner_raceway_port].area,
                        outer.area / heat.ports[outer_raceway_port].area});
    }
    if (section.balls_roll) {
      p.inner_strip = heat.ports[inner_raceway_port].shape;
      p.outer_strip = heat.ports[outer_raceway_port].shape;
      p.inner_at_once = heat.ports[inner_raceway_port].at_once;
      p.outer_at_once = heat.ports[outer_raceway_port].at_once;
      p.balls = heat.ports.at(ball_port).shape;
      p.ball_input = input(ball_port);
    }
    const bool is_elastic = section.elastic && section.elastic->drives;
    p.growth = is_elastic ? section.elastic->growth : growth_of_means(heat, section.growth);
    p.has_widths = is_elastic || section.growth.inner_width != 0. || section.growth.outer_width != 0.;
    p.stored.assign(p.n, 0.);
    for (const auto* list : {&heat.bodies, &heat.nodes})
      for (const auto& output : *list)
        for (std::size_t i = 0; i < p.n; ++i) p.stored[i] += output.capacity * output.shape[i];
    const auto not_stored = [&](const std::vector<double>& port) {
      constexpr double roundoff = 1e-12;
      if (port.empty()) return 0.;
      const double part = 1. - std::inner_product(port.begin(), port.end(), p.stored.begin(), 0.);
      return std::fabs(part) < roundoff ? 0. : part;
    };
    p.lost = {not_stored(p.bore_input),  not_stored(p.shaft_input), not_stored(p.inner_input),
              not_stored(p.outer_input), not_stored(p.film_input),  not_stored(p.ball_input)};
    for (auto& row : p.rows) {
      row.inner_lost = not_stored(row.inner_input);
      row.outer_lost = not_stored(row.outer_input);
    }
    p.surface_ports = observed_ports(section);
    for (const std::size_t port : p.surface_ports) {
      const auto& output = heat.ports[port];
      const std::size_t n_points = output.points.size() / p.n;
      Place::Surface surface{std::vector<double>(output.points.size()), output.points_at_once};
      surface.at_once.resize(n_points);
      for (std::size_t k = 0; k < n_points; ++k)
        for (std::size_t i = 0; i < p.n; ++i) surface.by_mode[i * n_points + k] = output.points[k * p.n + i];
      p.surfaces.push_back(std::move(surface));
      most_points_ = std::max(most_points_, n_points);
    }
    places_.push_back(std::move(p));
  }
}

std::vector<StateEntry> ReducedSections::state_entries() const {
  std::vector<StateEntry> entries;
  for (const auto& section : sections_)
    for (std::size_t i = 0; i < section.heat.n_modes(); ++i)
      entries.push_back({section.name + "/mode " + std::to_string(i + 1), "K", 1.,
                         "amplitude of a thermal mode of the section, over zero at ambient"});
  return entries;
}

void ReducedSections::initial_state(std::span<double> state) const { std::fill(state.begin(), state.end(), ambient_); }

void ReducedSections::add_growth(std::size_t k, std::span<const double> values, double zero, Expansion& out) const {
  const Place& p = places_[k];
  const double* y = values.data() + p.first;
  const auto& g = p.growth;
  const auto u = five_sums(y, zero, g[0].data(), g[1].data(), g[2].data(), g[3].data(), g[4].data(), p.n);
  out = {.shaft = u.a, .bore = u.b, .inner_race = u.c, .outer_race = u.d, .ball = u.e};
  if (!p.has_widths) return;
  const auto widths = two_sums(y, zero, g[5].data(), g[6].data(), p.n);
  out.inner_width = widths.a;
  out.outer_width = widths.b;
}

void ReducedSections::growth(std::span<const double> state, std::span<Expansion> out) const {
  for (std::size_t k = 0; k < places_.size(); ++k) add_growth(k, state, ambient_, out[k]);
}

void ReducedSections::growth_rates(std::span<const double> rate, std::span<Expansion> out) const {
  for (std::size_t k = 0; k < places_.size(); ++k) add_growth(k, rate, 0., out[k]);
}

ContactHeat ReducedSections::rolling_heat(const Place& p, const double* y, const HeatInput& heat) const {
  const auto rise = three_sums(y, ambient_, p.inner_strip.data(), p.outer_strip.data(), p.balls.data(), p.n);
  return contact_heat(heat.balls, rise.a + p.inner_at_once * heat.inner, rise.b + p.outer_at_once * heat.outer, rise.c,
                      p.inner_at_once, 0., p.outer_at_once);
}

ContactHeat ReducedSections::rolling_heat(const Place& p, const Place::Row& row, const double* y,
                                          const RowHeat& heat) const {
  const auto rise = three_sums(y, ambient_, row.inner_strip.data(), row.outer_strip.data(), p.balls.data(), p.n);
  return contact_heat(heat.balls, rise.a + row.inner_at_once * heat.inner, rise.b + row.outer_at_once * heat.outer,
                      rise.c, row.inner_at_once, 0., row.outer_at_once);
}

double ReducedSections::heat_rows(std::size_t k, const double* y, const HeatInput& heat, double* dydt) const {
  const Place& p = places_[k];
  double from_balls = 0., lost = 0.;
  for (std::size_t i = 0; i < p.rows.size(); ++i) {
    const auto& row = p.rows[i];
    double q_inner = heat.rows[i].inner, q_outer = heat.rows[i].outer;
    if (sections_[k].balls_roll) {
      const ContactHeat q = rolling_heat(p, row, y, heat.rows[i]);
      q_inner += q.inner;
      q_outer += q.outer;
      from_balls += q.from_balls();
    }
    add_times(q_inner, row.inner_input.data(), dydt, p.n);
    add_times(q_outer, row.outer_input.data(), dydt, p.n);
    lost += row.inner_lost * q_inner + row.outer_lost * q_outer;
  }
  if (sections_[k].balls_roll) add_times(-from_balls, p.ball_input.data(), dydt, p.n);
  return lost - p.lost.balls * from_balls;
}

double ReducedSections::rates(std::span<const double> state, std::span<const HeatInput> heat,
                              std::span<double> dydt) const {
  double lost = 0.;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const Place& p = places_[k];
    const double* y = state.data() + p.first;
    const auto [housing_rise, linear_loss] = two_sums(y, ambient_, p.film.data(), p.loss.data(), p.n);
    // Eq. (16) with the mean rise of the housing's surface.
    const double film_loss = housing_convection(housing_rise) * p.film_area * housing_rise;
    double q_bore = heat[k].rub_into_ring, q_shaft = heat[k].rub - q_bore;
    if (const auto& link = sections_[k].contact_link) {
      const auto [bore, shaft] = two_sums(y, ambient_, p.bore.data(), p.shaft_surface.data(), p.n);
      const double q = (bore - shaft) / (heat[k].is_in_contact ? link->touching : link->apart);
      q_bore -= q;
      q_shaft += q;
    }
    const bool is_apart = !p.rows.empty();
    double q_inner = is_apart ? 0. : heat[k].inner, q_outer = is_apart ? 0. : heat[k].outer, from_balls = 0.;
    if (sections_[k].balls_roll && !is_apart) {
      const ContactHeat q = rolling_heat(p, y, heat[k]);
      q_inner += q.inner;
      q_outer += q.outer;
      from_balls = q.from_balls();
    }
    modal_rates(y, ambient_, p.rate.data(),
                {p.bore_input.data(), p.shaft_input.data(), p.inner_input.data(), p.outer_input.data(),
                 p.film_input.data(), q_bore, q_shaft, q_inner, q_outer, -film_loss},
                dydt.data() + p.first, p.n);
    if (is_apart)
      lost += heat_rows(k, y, heat[k], dydt.data() + p.first);
    else if (sections_[k].balls_roll)
      add_times(-from_balls, p.ball_input.data(), dydt.data() + p.first, p.n);
    lost += linear_loss + film_loss;
    lost += p.lost.bore * q_bore + p.lost.shaft * q_shaft + p.lost.inner * q_inner + p.lost.outer * q_outer -
            p.lost.film * film_loss - p.lost.balls * from_balls;
  }
  return lost;
}

std::vector<Observable> ReducedSections::observables() const {
  std::vector<Observable> list;
  for (const auto& section : sections_) {
    for (const auto* outputs : {&section.heat.bodies, &section.heat.nodes})
      for (const auto& output : *outputs)
        list.push_back({section.name + "/" + output.name,
                        "K",
                        "volume mean of " + output.name,
                        1,
                        {},
                        output.name == "inner_ring" ? Observed::inner_ring_temperature : Observed::temperature,
                        section.name});
    for (const std::size_t port : observed_ports(section)) {
      const std::string& name = section.heat.ports[port].name;
      list.push_back({section.name + "/" + name, "K",
                      "temperature of a surface, over its circumference the mean: " + name, 3, surface_columns});
    }
    if (!section.elastic) continue;
    if (section.elastic->drives)
      for (auto& o : housing_fit_observables(section.name + "/", section.name)) list.push_back(std::move(o));
    else
      list.push_back(growth_observable(section.name + "/elastic_growth", judged_growth_name));
    if (const std::size_t n = section.elastic->rows.size() / 2; n > 0)
      list.push_back(row_growth_observable(section.name + "/", n));
  }
  return list;
}

double* ReducedSections::observe_surfaces(std::size_t k, const double* y, const HeatInput& heat, double* out,
                                          std::vector<double>& rises) const {
  const Place& p = places_[k];
  const ReducedHeat& of = sections_[k].heat;
  const bool rolls = sections_[k].balls_roll, is_apart = !p.rows.empty();
  std::vector<double> watts = {heat.rub_into_ring, 0., 0., 0.};
  if (!is_apart) {
    const ContactHeat q = rolls ? rolling_heat(p, y, heat) : ContactHeat{};
    watts[1] = heat.inner + q.inner;
    watts[2] = heat.outer + q.outer;
  }
  for (std::size_t i = 0; i < p.rows.size(); ++i) {
    const ContactHeat q = rolls ? rolling_heat(p, p.rows[i], y, heat.rows[i]) : ContactHeat{};
    watts.insert(watts.end(), {heat.rows[i].inner + q.inner, heat.rows[i].outer + q.outer});
  }
  for (std::size_t i = 0; i < p.surface_ports.size(); ++i) {
    const auto& port = of.ports[p.surface_ports[i]];
    const auto& surface = p.surfaces[i];
    const RiseRange range = extremes(y, ambient_, p.n, surface.by_mode.data(), surface.at_once.data(), watts[i],
                                     rises.data(), surface.at_once.size());
    out[3 * i] = ambient_ + sum(port.shape, y, ambient_) + port.at_once * watts[i];
    out[3 * i + 1] = ambient_ + range.lowest;
    out[3 * i + 2] = ambient_ + range.highest;
  }
  // A raceway is its rows' strips together.
  for (std::size_t race = 0; race < 2 && is_apart; ++race) {
    double* whole = out + 3 * (1 + race);
    std::fill(whole, whole + 3, 0.);
    for (std::size_t i = 0; i < p.rows.size(); ++i) {
      const double* row = out + 3 * (surface_ports.size() + 2 * i + race);
      whole[0] += (race == 0 ? p.rows[i].inner_share : p.rows[i].outer_share) * row[0];
      whole[1] = i == 0 ? row[1] : std::min(whole[1], row[1]);
      whole[2] = i == 0 ? row[2] : std::max(whole[2], row[2]);
    }
  }
  return out + 3 * p.surface_ports.size();
}

void ReducedSections::observe(std::span<const double> state, std::span<const HeatInput> heats,
                              std::span<double> out) const {
  std::vector<double> rises(most_points_);
  std::size_t at = 0;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const ReducedHeat& heat = sections_[k].heat;
    const double* y = state.data() + places_[k].first;
    for (const auto* outputs : {&heat.bodies, &heat.nodes})
      for (const auto& output : *outputs) out[at++] = ambient_ + sum(output.shape, y, ambient_);
    at = static_cast<std::size_t>(observe_surfaces(k, y, heats[k], out.data() + at, rises) - out.data());
    const auto& elastic = sections_[k].elastic;
    if (elastic && !elastic->drives)
      for (const auto& shape : elastic->growth) out[at++] = sum(shape, y, ambient_);
    if (elastic && elastic->drives) {
      const auto value = [&](const ReducedSection::Functional& f) { return f.at_rest + sum(f.shape, y, ambient_); };
      double lowest = std::numeric_limits<double>::infinity(), pulling = 0.;
      for (std::size_t i = 0; i < elastic->node_pressure.size(); ++i) {
        const double p = value(elastic->node_pressure[i]);
        lowest = std::min(lowest, p);
        if (p < -no_pressure) pulling += elastic->node_share[i];
      }
      out[at++] = value(elastic->mean_pressure);
      out[at++] = lowest;
      out[at++] = pulling;
    }
    if (elastic)
      for (const auto& shape : elastic->rows) out[at++] = sum(shape, y, ambient_);
  }
}

double ReducedSections::stored_energy(std::span<const double> state) const {
  double stored = 0.;
  for (const auto& p : places_) stored += sum(p.stored, state.data() + p.first, ambient_);
  return stored;
}

}  // namespace rotordrop
