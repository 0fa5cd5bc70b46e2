#include "machine/finite_elements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>

namespace rotordrop {
namespace {

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

constexpr int most_halvings = 5;           // of the longest window
constexpr double worth_a_longer_one = 0.1;  // of the tolerance: the error grows with the square of the window
constexpr std::size_t ball_port = n_bearing_ports;

std::size_t body_index(const HeatConductionProblem& p, const std::string& name) {
  return static_cast<std::size_t>(std::find_if(p.bodies.begin(), p.bodies.end(), [&](const auto& b) { return b.name == name; }) -
                                  p.bodies.begin());
}

constexpr std::array<double Expansion::*, 5> surfaces = {&Expansion::shaft, &Expansion::bore, &Expansion::inner_race,
                                                         &Expansion::outer_race, &Expansion::ball};

double largest(const Expansion& e) {
  double value = 0.;
  for (const auto surface : surfaces) value = std::max(value, std::fabs(e.*surface));
  return value;
}

}  // namespace

Expansion growth_of(const FiniteElements::Section& s) {
  const auto& p = s.problem;
  const double zero = p.initial_temperature;
  const std::size_t shaft = body_index(p, "shaft");
  const auto volume_share = [&](const char* name) {  // rings and housing are of one material
    const auto& b = p.bodies[body_index(p, name)];
    return (b.r[1] * b.r[1] - b.r[0] * b.r[0]) * (b.x[1] - b.x[0]);
  };
  const double inner = s.solver->body_mean(body_index(p, "inner_ring")) - zero;
  const double V_o = volume_share("outer_ring"), V_h = volume_share("housing");
  const double outer = (V_o * (s.solver->body_mean(body_index(p, "outer_ring")) - zero) +
                        V_h * (s.solver->body_mean(body_index(p, "housing")) - zero)) /
                       (V_o + V_h);
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
      longest_(longest),
      window_(longest),
      energy_(elements.sections.size()),
      before_(elements.sections.size()),
      now_(elements.sections.size()) {
  report_.shortest = longest;
}

std::vector<Expansion> WindowedSections::present_growth() const {
  std::vector<Expansion> growth;
  for (const auto& section : elements_.sections) growth.push_back(growth_of(section));
  return growth;
}

void WindowedSections::step(double length, std::span<const PlaceEnergy> energy) {
  const double start = cpu_seconds();
  for (std::size_t k = 0; k < elements_.sections.size(); ++k) {
    const auto& now = energy[k];
    auto& then = energy_[k];
    std::array<double, n_bearing_ports> power{};
    const double ring = now.rub_into_ring - then.rub_into_ring;
    power[bore_port] = ring / length;
    power[shaft_port] = (now.rub - then.rub - ring) / length;
    power[inner_raceway_port] = (now.inner - then.inner) / length;
    power[outer_raceway_port] = (now.outer - then.outer) / length;
    elements_.sections[k].solver->set_port_heat(power);
    elements_.sections[k].solver->advance_window(length);
    then = now;
  }
  time_ += length;
  before_ = now_;
  now_ = present_growth();
  ++report_.windows;
  report_.shortest = std::min(report_.shortest, length);
  report_.longest = std::max(report_.longest, length);
  report_.mean += (length - report_.mean) / static_cast<double>(report_.windows);
  for (const auto& growth : now_) report_.largest_growth = std::max(report_.largest_growth, largest(growth));
  report_.cpu_time += cpu_seconds() - start;
}

void WindowedSections::advance(double now, std::span<const PlaceEnergy> energy) {
  const double length = window_;
  step(length, energy);

  // What was in force at the window's end against what should have been.
  std::vector<Expansion> in_force(now_.size());
  elements_.growth->at(time_, in_force);
  last_error_ = 0.;
  for (std::size_t k = 0; k < now_.size(); ++k)
    for (const auto surface : surfaces) last_error_ = std::max(last_error_, std::fabs(in_force[k].*surface - now_[k].*surface));
  report_.largest_error = std::max(report_.largest_error, last_error_);
  const double allowed = tolerance_ * std::max(report_.largest_growth, 1e-12);
  if (last_error_ > allowed && window_ > longest_ * std::ldexp(1.5, -most_halvings))
    window_ *= 0.5;
  else if (last_error_ < worth_a_longer_one * allowed && window_ < 0.75 * longest_)
    window_ *= 2.;

  // From what is in force now, straight to what is expected after another window.
  elements_.growth->cut(now);
  elements_.growth->at(now, in_force);
  std::vector<Expansion> expected = now_;
  const double ahead = std::max(window_, now - time_ + 0.25 * window_);
  for (std::size_t k = 0; k < now_.size(); ++k)
    for (const auto surface : surfaces)
      expected[k].*surface += (now_[k].*surface - before_[k].*surface) / length * ahead;
  elements_.growth->append(now, in_force);
  elements_.growth->append(time_ + ahead, expected);
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
  return sum;
}

std::vector<Observable> WindowedSections::observables() const {
  std::vector<Observable> list = {{"/windows/length", "s", "length of the window that ends here", 1, {}},
                                  {"/windows/error", "m", "error of the growth that was in force at its end", 1, {}}};
  for (const auto& section : elements_.sections) {
    const std::string path = "/windows/" + section.name + "/";
    for (const auto& body : section.problem.bodies) list.push_back({path + body.name, "K", "volume mean of " + body.name, 1, {}});
    for (const auto& port : section.problem.ports) {
      if (port.node)
        list.push_back({path + port.name, "K", "temperature of " + port.name, 1, {}});
      else
        list.push_back({path + port.name + "_surface", "K", "temperature of a surface, over its circumference the mean: " + port.name,
                        3, {"mean", "lowest", "highest"}});
    }
    list.push_back({path + "growth", "m", "thermal growth", 5, {"shaft", "bore", "inner race", "outer race", "ball radius"}});
  }
  return list;
}

void WindowedSections::observe(std::span<double> out) const {
  std::size_t at = 0;
  out[at++] = report_.windows > 0 ? window_ : 0.;
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
  std::vector<double> values = {time_, window_, last_error_, static_cast<double>(report_.windows), report_.shortest, report_.longest,
                                report_.mean, report_.largest_error, report_.largest_growth, report_.cpu_time};
  for (std::size_t k = 0; k < elements_.sections.size(); ++k) {
    const auto& e = energy_[k];
    values.insert(values.end(), {e.rub, e.rub_into_ring, e.inner, e.outer});
    for (const auto* growth : {&before_[k], &now_[k]})
      for (const auto surface : surfaces) values.push_back(growth->*surface);
    const HeatEnergy energy = elements_.sections[k].solver->energy();
    values.insert(values.end(), {energy.input, energy.lost});
    const auto field = elements_.sections[k].solver->field();
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
  window_ = next();
  last_error_ = next();
  report_.windows = static_cast<long>(next());
  for (double* value : {&report_.shortest, &report_.longest, &report_.mean, &report_.largest_error, &report_.largest_growth,
                        &report_.cpu_time})
    *value = next();
  for (std::size_t k = 0; k < elements_.sections.size(); ++k) {
    auto& e = energy_[k];
    for (double* value : {&e.rub, &e.rub_into_ring, &e.inner, &e.outer}) *value = next();
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
