#include "machine/finite_elements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>

#include "laws/heat_flow.h"

namespace rotordrop {
namespace {

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

constexpr long units_of_longest = 32;

PlaceEnergy combined(double f, const PlaceEnergy& a, double g, const PlaceEnergy& b) {
  return {f * a.rub + g * b.rub, f * a.rub_into_ring + g * b.rub_into_ring, f * a.inner + g * b.inner,
          f * a.outer + g * b.outer};
}
PlaceEnergy difference(const PlaceEnergy& a, const PlaceEnergy& b) { return combined(1., a, -1., b); }
PlaceEnergy sum(const PlaceEnergy& a, const PlaceEnergy& b) { return combined(1., a, 1., b); }
PlaceEnergy scaled(double f, const PlaceEnergy& a) { return combined(f, a, 0., a); }

std::size_t body_index(const HeatConductionProblem& p, const std::string& name) {
  return static_cast<std::size_t>(
      std::find_if(p.bodies.begin(), p.bodies.end(), [&](const auto& b) { return b.name == name; }) - p.bodies.begin());
}

constexpr std::array<double Expansion::*, 5> surfaces = {&Expansion::shaft, &Expansion::bore, &Expansion::inner_race,
                                                         &Expansion::outer_race, &Expansion::ball};

Expansion difference(const Expansion& a, const Expansion& b) {
  Expansion d;
  for (const auto surface : surfaces) d.*surface = a.*surface - b.*surface;
  return d;
}
double largest(const Expansion& e) {
  double value = 0.;
  for (const auto surface : surfaces) value = std::max(value, std::fabs(e.*surface));
  return value;
}

/// What heat adds to the means of the bodies that it enters, before any of it is conducted on.
Expansion growth_at_once(const FiniteElements::Section& s, const PlaceEnergy& heat) {
  const double inner = (heat.rub_into_ring + heat.inner) / s.inner_capacity,
               shaft = (heat.rub - heat.rub_into_ring) / s.shaft_capacity;
  return {.shaft = s.growth.shaft * shaft,
          .bore = s.growth.bore * inner,
          .inner_race = s.growth.inner_race * inner,
          .outer_race = s.growth.outer_race * heat.outer / s.outer_capacity,
          .ball = 0.};
}

}  // namespace

Expansion growth_of(const FiniteElements::Section& s) {
  const auto& p = s.problem;
  const double zero = p.initial_temperature;
  const std::size_t shaft = body_index(p, "shaft");
  const double inner = s.solver->body_mean(body_index(p, "inner_ring")) - zero;
  const std::size_t ring = body_index(p, "outer_ring"), housing = body_index(p, "housing");
  const double outer = (s.solver->body_capacity(ring) * (s.solver->body_mean(ring) - zero) +
                        s.solver->body_capacity(housing) * (s.solver->body_mean(housing) - zero)) /
                       s.outer_capacity;
  const double shaft_rise =
      (shaft < p.bodies.size() ? s.solver->body_mean(shaft) : s.solver->port_temperature(shaft_port)) - zero;
  return {.shaft = s.growth.shaft * shaft_rise,
          .bore = s.growth.bore * inner,
          .inner_race = s.growth.inner_race * inner,
          .outer_race = s.growth.outer_race * outer,
          .ball = s.growth.ball * (s.solver->port_temperature(ball_port) - zero)};
}

WindowedSections::WindowedSections(FiniteElements& elements, double tolerance, double longest)
    : elements_(elements),
      tolerance_(tolerance),
      unit_(longest / units_of_longest),
      longest_units_(units_of_longest),
      units_(units_of_longest),
      energy_(elements.sections.size()),
      seen_(elements.sections.size()),
      power_(elements.sections.size()),
      promised_(elements.sections.size()),
      promised_power_(elements.sections.size()),
      port_heat_(elements.sections.size()),
      before_(elements.sections.size()),
      now_(elements.sections.size()) {
  report_.shortest = longest;
}

std::vector<Expansion> WindowedSections::present_growth() const {
  std::vector<Expansion> growth;
  for (const auto& section : elements_.sections) growth.push_back(growth_of(section));
  return growth;
}

void WindowedSections::watch(double now, std::span<const PlaceEnergy> energy) {
  double error = 0.;
  for (std::size_t k = 0; k < energy.size(); ++k) {
    if (now > watched_) power_[k] = scaled(1. / (now - watched_), difference(energy[k], seen_[k]));
    seen_[k] = energy[k];
    const auto expected = sum(promised_[k], scaled(now - promised_at_, promised_power_[k]));
    error = std::max(error, largest(growth_at_once(elements_.sections[k], difference(energy[k], expected))));
  }
  watched_ = now;
  if (error > 0.5 * tolerance_) units_ = std::clamp(static_cast<long>(std::ceil((now - time_) / unit_)), 1L, units_);
}

/// Steps of powers of two units, each with a factorisation of its own.
void WindowedSections::step(double length, std::span<const PlaceEnergy> energy) {
  const double start = cpu_seconds();
  for (std::size_t k = 0; k < elements_.sections.size(); ++k) {
    const auto power = scaled(1. / length, difference(energy[k], energy_[k]));
    auto& heat = port_heat_.at(k);
    heat[bore_port] = power.rub_into_ring;
    heat[shaft_port] = power.rub - power.rub_into_ring;
    heat[inner_raceway_port] = power.inner;
    heat[outer_raceway_port] = power.outer;
    energy_[k] = energy[k];
  }
  const long n = std::lround(length / unit_);
  if (std::fabs(length - static_cast<double>(n) * unit_) > 1e-9 * unit_)
    advance_sections(length);
  else
    for (long left = n, size = longest_units_; left > 0; size /= 2)
      for (; left >= size; left -= size) advance_sections(static_cast<double>(size) * unit_);
  time_ += length;
  before_ = now_;
  now_ = present_growth();
  last_length_ = length;
  ++report_.windows;
  report_.shortest = std::min(report_.shortest, length);
  report_.longest = std::max(report_.longest, length);
  report_.mean += (length - report_.mean) / static_cast<double>(report_.windows);
  for (const auto& growth : now_) report_.largest_growth = std::max(report_.largest_growth, largest(growth));
  report_.cpu_time += cpu_seconds() - start;
}

void WindowedSections::advance_sections(double length) {
  for (std::size_t k = 0; k < elements_.sections.size(); ++k) {
    auto& solver = *elements_.sections[k].solver;
    // Eq. (16), from the rise at the start: the housing takes minutes to warm.
    const double rise = solver.port_temperature(housing_port) - elements_.sections[k].problem.initial_temperature;
    port_heat_[k][housing_port] = -housing_convection(rise) * solver.port_area(housing_port) * rise;
    film_loss_ -= port_heat_[k][housing_port] * length;
    solver.set_port_heat(port_heat_[k]);
    solver.advance_window(length);
  }
}

void WindowedSections::advance(double now, std::span<const PlaceEnergy> energy) {
  const auto energy_before = energy_;
  const long units = units_;
  step(static_cast<double>(units) * unit_, energy);

  // What was in force at the window's end against what should have been.
  std::vector<Expansion> in_force(now_.size());
  elements_.growth->at(time_, in_force);
  last_error_ = 0.;
  for (std::size_t k = 0; k < now_.size(); ++k)
    last_error_ = std::max(last_error_, largest(difference(in_force[k], now_[k])));
  report_.largest_error = std::max(report_.largest_error, last_error_);
  // The end was brought forward for the heat's sake; what conduction does is smooth.
  units_ = last_error_ > tolerance_ ? std::max(units / 2, 1L) : longest_units_;

  // From what is in force now, straight to what is expected after another window: what the heat of the last step adds, and what conduction did in this one.
  elements_.growth->cut(now);
  elements_.growth->at(now, in_force);
  std::vector<Expansion> expected = now_;
  const double ahead = std::max(static_cast<double>(units_) * unit_, now - time_ + 0.25 * unit_);
  for (std::size_t k = 0; k < now_.size(); ++k) {
    const auto& section = elements_.sections[k];
    const Expansion by_heat = growth_at_once(section, difference(energy[k], energy_before[k]));
    const Expansion to_come =
        growth_at_once(section, sum(difference(seen_[k], energy[k]), scaled(time_ + ahead - now, power_[k])));
    for (const auto surface : surfaces)
      expected[k].*surface +=
          to_come.*surface + (now_[k].*surface - before_[k].*surface - by_heat.*surface) / last_length_ * ahead;
  }
  elements_.growth->append(now, in_force);
  elements_.growth->append(time_ + ahead, expected);
  promised_ = seen_;
  promised_power_ = power_;
  promised_at_ = now;
}

void complete(FiniteElements::Section& s) {
  const auto& p = s.problem;
  const auto capacity = [&](const char* body) { return s.solver->body_capacity(body_index(p, body)); };
  s.inner_capacity = capacity("inner_ring");
  s.outer_capacity = capacity("outer_ring") + capacity("housing");
  s.shaft_capacity = p.ports[shaft_port].node ? p.nodes[*p.ports[shaft_port].node].capacity : capacity("shaft");
}

void WindowedSections::finish(double end, std::span<const PlaceEnergy> energy) {
  if (end > time_) step(end - time_, energy);
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
    list.push_back(
        {path + "growth", "m", "thermal growth", 5, {"shaft", "bore", "inner race", "outer race", "ball radius"}});
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
    for (const auto surface : surfaces) out[at++] = now_[k].*surface;
  }
}

std::vector<double> WindowedSections::packed() const {
  std::vector<double> values = {time_,
                                static_cast<double>(units_),
                                last_error_,
                                last_length_,
                                film_loss_,
                                watched_,
                                promised_at_,
                                static_cast<double>(report_.windows),
                                report_.shortest,
                                report_.longest,
                                report_.mean,
                                report_.largest_error,
                                report_.largest_growth,
                                report_.cpu_time};
  for (std::size_t k = 0; k < elements_.sections.size(); ++k) {
    for (const auto* list : {&energy_, &seen_, &power_, &promised_, &promised_power_}) {
      const auto& e = (*list)[k];
      values.insert(values.end(), {e.rub, e.rub_into_ring, e.inner, e.outer});
    }
    for (const auto* growth : {&before_[k], &now_[k]})
      for (const auto surface : surfaces) values.push_back(growth->*surface);
    const auto& solver = *elements_.sections[k].solver;
    const HeatEnergy energy = solver.energy();
    values.insert(values.end(), {energy.input, energy.lost});
    const auto field = solver.field();
    values.insert(values.end(), field.begin(), field.end());
  }
  const auto in_force = elements_.growth->packed_tail();
  values.insert(values.end(), in_force.begin(), in_force.end());
  return values;
}

void WindowedSections::unpack(std::span<const double> values) {
  std::size_t at = 0;
  const auto next = [&] { return values[at++]; };
  time_ = next();
  units_ = static_cast<long>(next());
  for (double* value : {&last_error_, &last_length_, &film_loss_, &watched_, &promised_at_}) *value = next();
  report_.windows = static_cast<long>(next());
  for (double* value : {&report_.shortest, &report_.longest, &report_.mean, &report_.largest_error,
                        &report_.largest_growth, &report_.cpu_time})
    *value = next();
  for (std::size_t k = 0; k < elements_.sections.size(); ++k) {
    for (auto* list : {&energy_, &seen_, &power_, &promised_, &promised_power_}) {
      auto& e = (*list)[k];
      for (double* value : {&e.rub, &e.rub_into_ring, &e.inner, &e.outer}) *value = next();
    }
    for (auto* growth : {&before_[k], &now_[k]})
      for (const auto surface : surfaces) growth->*surface = next();
    const double input = next(), lost = next();
    auto& solver = *elements_.sections[k].solver;
    const std::size_t n = solver.field().size();
    solver.set_field(values.subspan(at, n), time_, input, lost);
    at += n;
  }
  elements_.growth->unpack_tail(values.subspan(at, elements_.growth->packed_size()));
}

}  // namespace rotordrop
