#include "machine/heat/finite_elements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/cpu_time.h"
#include "laws/heat/heat_flow.h"
#include "thermal/heating/rolling_exchange.h"

namespace rotordrop {
namespace {

constexpr double shortest_of_longest = 1. / 64.;
// A window may heat a bore by this part of its largest rise so far, or of 1 K.
constexpr double heating_of_a_window = 0.1, least_rise = 1.;

/// Mean rise of a half space under a joule into the bore at constant power, times the root of its duration: 2/(sqrt(pi) A sqrt(k rho c)).
double rise_per_joule(const FiniteElements::Section& s) {
  const auto& p = s.problem;
  const auto& ring = p.bodies[body_index(p.bodies, "inner_ring")];
  const double T = p.initial_temperature;
  return 2. / (std::sqrt(std::numbers::pi * ring.conductivity.value(T) * ring.density * ring.heat_capacity.value(T)) *
               s.solver->port_area(bore_port));
}

/// Steps that a window of so many shortest ones is taken in: 1, 2, 3, 4, 6, 8, 12, ... of them, the largest first. Few lengths are few factorisations.
std::vector<double> steps_of_few_lengths(double number) {
  std::vector<double> steps;
  while (number >= 1.) {
    double size = 1.;
    while (2. * size <= number) size *= 2.;
    if (size > 1. && 1.5 * size <= number) size *= 1.5;
    steps.push_back(size);
    number -= size;
  }
  return steps;
}

double largest(const Expansion& e) {
  double value = 0.;
  for (const auto surface : growth_surfaces) value = std::max(value, std::fabs(e.*surface));
  return value;
}

}  // namespace

AdiabaticSection adiabatic_section(const FiniteElements::Section& s) {
  const auto& p = s.problem;
  const auto capacity = [&](const char* body) { return s.solver->body_capacity(body_index(p.bodies, body)); };
  const auto& shaft = p.ports[shaft_port];
  const double outer_ring = capacity("outer_ring"), outer = outer_ring + capacity("housing");
  // What enters at the outer raceway first warms the outer ring alone.
  GrowthPerRise growth = s.formula;
  growth.outer_width *= outer / outer_ring;
  if (!growth.is_housed) growth.outer_race *= outer / outer_ring;
  return {s.name, capacity("inner_ring"), shaft.node ? p.nodes[*shaft.node].capacity : capacity("shaft"), outer,
          growth};
}

GrowthPerRise immediate_elastic_growth(FiniteElements::Section& s) {
  constexpr double step = 1e-6;  // [s]: conduction reaches about 4 um
  const auto start = s.solver->field();
  const auto per_joule = [&](std::size_t port) {
    std::array<double, n_bearing_ports> heat{};
    heat.at(port) = 1. / step;
    s.solver->set_port_heat(heat);
    s.solver->advance_window(step);
    const Expansion growth = s.elastic->linear(s.solver->field());
    heat.at(port) = 0.;
    s.solver->set_port_heat(heat);
    s.solver->set_field(start, 0., 0., 0.);
    return growth;
  };
  // The inner ring's heat is nearly all from the rub.
  const Expansion rub = per_joule(bore_port);
  const auto& a = s.adiabatic;
  const Expansion outer = per_joule(outer_raceway_port);
  return {.bore = rub.bore * a.inner_capacity,
          .inner_race = rub.inner_race * a.inner_capacity,
          .outer_race = outer.outer_race * a.outer_capacity,
          .shaft = per_joule(shaft_port).shaft * a.shaft_capacity,
          .ball = a.growth.ball,
          .inner_width = rub.inner_width * a.inner_capacity,
          .outer_width = outer.outer_width * a.outer_capacity};
}

Expansion growth_of(FiniteElements::Section& s) {
  if (s.grows_elastically) return s.elastic->solved(s.solver->field());
  const auto& p = s.problem;
  const double zero = p.initial_temperature;
  const std::size_t shaft = body_index(p.bodies, "shaft");
  const double inner = s.solver->body_mean(body_index(p.bodies, "inner_ring")) - zero;
  const std::size_t ring = body_index(p.bodies, "outer_ring"), housing = body_index(p.bodies, "housing");
  const double outer_ring = s.solver->body_mean(ring) - zero;
  const double outer = s.formula.is_housed
                           ? (s.solver->body_capacity(ring) * outer_ring +
                              s.solver->body_capacity(housing) * (s.solver->body_mean(housing) - zero)) /
                                 s.adiabatic.outer_capacity
                           : outer_ring;
  const double shaft_rise =
      (shaft < p.bodies.size() ? s.solver->body_mean(shaft) : s.solver->port_temperature(shaft_port)) - zero;
  return {.shaft = s.formula.shaft * shaft_rise,
          .bore = s.formula.bore * inner,
          .inner_race = s.formula.inner_race * inner,
          .outer_race = s.formula.outer_race * outer,
          .ball = s.formula.ball * (s.solver->port_temperature(ball_port) - zero),
          .inner_width = s.formula.inner_width * inner,
          .outer_width = s.formula.outer_width * outer_ring};
}

WindowedSections::WindowedSections(FiniteElements& elements, double tolerance, double longest)
    : elements_(elements),
      tolerance_(tolerance),
      shortest_(longest * shortest_of_longest),
      longest_(longest),
      length_(longest),
      energy_(elements.sections.size()),
      growth_(elements.sections.size()),
      before_(elements.sections.size()),
      conducted_(elements.sections.size()),
      in_force_(elements.sections.size()) {
  for (std::size_t k = 0; k < elements.sections.size(); ++k) {
    const auto& section = elements.sections[k];
    rise_per_joule_.push_back(rise_per_joule(section));
    port_heat_.emplace_back(section.problem.ports.size(), 0.);
    energy_[k].rows.resize(section.row_ports.size());
    // Where an earlier drop may have left it.
    const std::vector<double> start(section.solver->field().size(), section.problem.initial_temperature);
    section.solver->set_field(start, 0., 0., 0.);
  }
  largest_rise_.resize(elements.sections.size());
  report_.shortest = longest;
  report_.tolerance = tolerance;
}

// Strips follow within the window: their rise by conducted heat is left to the solver, from the temperatures at its start.
void WindowedSections::heat_raceways(std::size_t k, double length, const PlaceEnergy& given,
                                     const PlaceConduction& balls) {
  const auto& section = elements_.sections[k];
  const auto& solver = *section.solver;
  const PlaceEnergy& earlier = energy_[k];
  auto& heat = port_heat_[k];
  heat[ball_port] = 0.;
  const auto add = [&](const RacewayRowPorts& ports, double inner, double outer, const BallConduction& G) {
    heat[ports.inner] = inner / length;
    heat[ports.outer] = outer / length;
    if (G.inner_to_ball + G.outer_to_ball + G.inner_to_outer <= 0.) return;
    const ContactHeat q = contact_heat(G, solver.port_temperature(ports.inner), solver.port_temperature(ports.outer),
                                       solver.port_temperature(ball_port), 0., 0., 0.);
    heat[ports.inner] += q.inner;
    heat[ports.outer] += q.outer;
    heat[ball_port] -= q.from_balls();
  };
  for (std::size_t row = 0; row < section.row_ports.size(); ++row)
    add(section.row_ports[row], given.rows[row][0] - earlier.rows[row][0], given.rows[row][1] - earlier.rows[row][1],
        row < balls.rows.size() ? balls.rows[row] : BallConduction{});
  if (section.row_ports.empty())
    add({inner_raceway_port, outer_raceway_port}, given.inner - earlier.inner, given.outer - earlier.outer, balls.all);
}

void WindowedSections::advance_section(HeatConductionSolver& solver, double length) const {
  const double number = std::round(length / shortest_);
  if (std::fabs(length - number * shortest_) > 1e-9 * length) return solver.advance_window(length);  // the drop's last
  for (const double step : steps_of_few_lengths(number)) solver.advance_window(step * shortest_);
}

void WindowedSections::step(double length, std::span<const PlaceEnergy> energy,
                            std::span<const PlaceConduction> balls) {
  const double start = cpu_seconds();
  before_ = conducted_;
  for (std::size_t k = 0; k < elements_.sections.size(); ++k) {
    auto& section = elements_.sections[k];
    auto& solver = *section.solver;
    auto& heat = port_heat_.at(k);
    const PlaceEnergy &given = energy[k], &earlier = energy_[k];
    heat[bore_port] = (given.rub_into_ring - earlier.rub_into_ring) / length;
    heat[shaft_port] = (given.rub - earlier.rub) / length - heat[bore_port];
    heat_raceways(k, length, given, balls[k]);
    // Eq. (16), from the rise at the start: the housing takes minutes to warm.
    const double rise = solver.port_temperature(housing_port) - section.problem.initial_temperature;
    heat[housing_port] = -housing_convection(rise) * solver.port_area(housing_port) * rise;
    film_loss_ -= heat[housing_port] * length;
    solver.set_port_heat(heat);
    advance_section(solver, length);
    largest_rise_[k] =
        std::max(largest_rise_[k], solver.port_temperature(bore_port) - section.problem.initial_temperature);
    energy_[k] = given;
    growth_[k] = growth_of(section);
    conducted_[k] = combined(
        1., growth_[k], -1.,
        section.adiabatic.growth_by(given.rub_into_ring + given.inner, given.rub - given.rub_into_ring, given.outer));
    report_.largest_growth = std::max(report_.largest_growth, largest(growth_[k]));
  }
  time_ += length;
  last_length_ = length;
  ++report_.windows;
  report_.shortest = std::min(report_.shortest, length);
  report_.longest = std::max(report_.longest, length);
  report_.mean += (length - report_.mean) / static_cast<double>(report_.windows);
  report_.cpu_time += cpu_seconds() - start;
}

void WindowedSections::look(double now, std::span<const PlaceEnergy> energy) {
  const double elapsed = now - time_;
  if (is_cut_ || elapsed <= 0. || length_ <= shortest_) return;
  for (std::size_t k = 0; k < energy.size(); ++k) {
    const double joules = energy[k].rub_into_ring - energy_[k].rub_into_ring,
                 rise = joules * rise_per_joule_[k] / std::sqrt(std::max(elapsed, shortest_));
    if (rise > heating_of_a_window * std::max(largest_rise_[k], least_rise)) is_cut_ = true;
  }
  // In whole shortest windows, see advance_section().
  if (is_cut_) length_ = std::min(length_, std::ceil(elapsed / shortest_) * shortest_);
}

void WindowedSections::advance(double now, std::span<const PlaceEnergy> energy,
                               std::span<const PlaceConduction> balls) {
  step(length_, energy, balls);
  const std::size_t n = growth_.size();
  std::vector<Expansion> in_force(n), expected(n);
  in_force_.at(time_, in_force);
  last_error_ = 0.;
  for (std::size_t k = 0; k < n; ++k)
    last_error_ = std::max(last_error_, largest(combined(1., in_force[k], -1., conducted_[k])));
  if (last_error_ > report_.largest_error) {
    report_.largest_error = last_error_;
    report_.largest_error_time = time_;
  }
  if (last_error_ > tolerance_) ++report_.beyond_tolerance;
  if (is_cut_)
    length_ = last_error_ > tolerance_ ? shortest_ : 2. * shortest_;
  else if (last_error_ > tolerance_)
    length_ = std::max(0.5 * length_, shortest_);
  else if (last_error_ < 0.25 * tolerance_)
    length_ = std::min(2. * length_, longest_);

  is_cut_ = false;

  // From what is in force now, straight to where conduction leads in another window.
  in_force_.cut(now);
  in_force_.at(now, in_force);
  const double ahead = std::max(length_, now - time_ + 0.25 * length_), share = ahead / last_length_;
  for (std::size_t k = 0; k < n; ++k) expected[k] = combined(1. + share, conducted_[k], -share, before_[k]);
  in_force_.append(now, in_force);
  in_force_.append(time_ + ahead, expected);
}

void WindowedSections::finish(double end, std::span<const PlaceEnergy> energy, std::span<const PlaceConduction> balls) {
  if (end > time_) step(end - time_, energy, balls);
}

WindowedSections::Report WindowedSections::report() const { return report_; }

HeatEnergy WindowedSections::energy() const {
  HeatEnergy sum;
  for (const auto& section : elements_.sections) {
    const HeatEnergy e = section.solver->energy();
    sum.input += e.input;
    sum.stored += e.stored;
    sum.lost += e.lost;
  }
  sum.input += film_loss_;  // which the solver books as heat taken out
  sum.lost += film_loss_;
  return sum;
}

std::vector<Observable> WindowedSections::observables() const {
  std::vector<Observable> list = {{"/windows/length", "s", "length of the window that ends here", 1, {}},
                                  {"/windows/error", "m", "error of the growth that was in force at its end", 1, {}}};
  for (const auto& section : elements_.sections) {
    const std::string path = "/windows/" + section.name + "/";
    for (const auto& body : section.problem.bodies)
      list.push_back({path + body.name, "K", "volume mean of " + body.name, 1, {}});
    for (const auto& port : section.problem.ports) {
      if (port.node)
        list.push_back({path + port.name, "K", "temperature of " + port.name, 1, {}});
      else
        list.push_back({path + (port.name == "shaft" ? "shaft_surface" : port.name),
                        "K",
                        "temperature of a surface, over its circumference the mean: " + port.name,
                        3,
                        {"mean", "lowest", "highest"}});
    }
    list.push_back(growth_observable(path + "growth", "thermal growth"));
    if (section.grows_elastically)
      for (auto& o : housing_fit_observables(path, section.name)) list.push_back(std::move(o));
    else if (section.elastic)
      list.push_back(growth_observable(path + "elastic_growth", judged_growth_name));
    if (!section.row_growth.empty()) list.push_back(row_growth_observable(path, section.row_growth.size()));
  }
  return list;
}

void WindowedSections::observe(std::span<double> out) const {
  std::size_t at = 0;
  out[at++] = last_length_;
  out[at++] = last_error_;
  for (std::size_t k = 0; k < elements_.sections.size(); ++k) {
    const auto& section = elements_.sections[k];
    for (std::size_t b = 0; b < section.problem.bodies.size(); ++b) out[at++] = section.solver->body_mean(b);
    for (std::size_t p = 0; p < section.problem.ports.size(); ++p) {
      if (section.problem.ports[p].node) {
        out[at++] = section.solver->port_temperature(p);
        continue;
      }
      const SurfaceRange range = section.solver->surface(section.problem.ports[p].boundaries);
      for (const double value : {range.mean, range.lowest, range.highest}) out[at++] = value;
    }
    for (const auto surface : growth_surfaces) out[at++] = growth_[k].*surface;
    if (section.grows_elastically) {
      const FitState fit = section.elastic->fit_state();
      for (const double value : {fit.mean_pressure, fit.lowest_pressure, fit.open_fraction}) out[at++] = value;
    } else if (section.elastic) {
      for (const double value : growth_values(section.elastic->linear(section.solver->field()))) out[at++] = value;
    }
    for (const auto& row : section.row_growth)
      for (const auto* weights : {&row.radial, &row.axial}) {
        const auto field = section.solver->field();
        double sum = 0.;
        for (std::size_t i = 0; i < field.size(); ++i)
          sum += (*weights)[i] * (field[i] - section.problem.initial_temperature);
        out[at++] = sum;
      }
  }
}

std::vector<double> WindowedSections::packed() const {
  std::vector<double> values = {time_,
                                length_,
                                last_error_,
                                last_length_,
                                film_loss_,
                                is_cut_ ? 1. : 0.,
                                static_cast<double>(report_.windows),
                                report_.shortest,
                                report_.longest,
                                report_.mean,
                                report_.largest_error,
                                report_.largest_error_time,
                                static_cast<double>(report_.beyond_tolerance),
                                report_.largest_growth,
                                report_.cpu_time};
  for (std::size_t k = 0; k < elements_.sections.size(); ++k) {
    const auto& e = energy_[k];
    values.insert(values.end(), {e.rub, e.rub_into_ring, e.inner, e.outer, largest_rise_[k]});
    for (const auto& row : e.rows) values.insert(values.end(), row.begin(), row.end());
    for (const auto* growth : {&growth_[k], &before_[k], &conducted_[k]})
      for (const auto surface : growth_surfaces) values.push_back(growth->*surface);
    const auto& solver = *elements_.sections[k].solver;
    const HeatEnergy energy = solver.energy();
    values.insert(values.end(), {energy.input, energy.lost});
    const auto field = solver.field();
    values.insert(values.end(), field.begin(), field.end());
  }
  const auto in_force = in_force_.packed_tail();
  values.insert(values.end(), in_force.begin(), in_force.end());
  return values;
}

void WindowedSections::unpack(std::span<const double> values) {
  std::size_t at = 0;
  const auto next = [&] { return values[at++]; };
  for (double* value : {&time_, &length_, &last_error_, &last_length_, &film_loss_}) *value = next();
  is_cut_ = next() != 0.;
  report_.windows = static_cast<long>(next());
  for (double* value :
       {&report_.shortest, &report_.longest, &report_.mean, &report_.largest_error, &report_.largest_error_time})
    *value = next();
  report_.beyond_tolerance = static_cast<long>(next());
  for (double* value : {&report_.largest_growth, &report_.cpu_time}) *value = next();
  for (std::size_t k = 0; k < elements_.sections.size(); ++k) {
    auto& e = energy_[k];
    for (double* value : {&e.rub, &e.rub_into_ring, &e.inner, &e.outer, &largest_rise_[k]}) *value = next();
    for (auto& row : e.rows)
      for (double& value : row) value = next();
    for (auto* growth : {&growth_[k], &before_[k], &conducted_[k]})
      for (const auto surface : growth_surfaces) growth->*surface = next();
    const double input = next(), lost = next();
    auto& solver = *elements_.sections[k].solver;
    const std::size_t n = solver.field().size();
    solver.set_field(values.subspan(at, n), time_, input, lost);
    at += n;
  }
  in_force_.unpack_tail(values.subspan(at, in_force_.packed_size()));
}

}  // namespace rotordrop
