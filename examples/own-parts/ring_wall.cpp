#include "ring_wall.h"

#include <cmath>
#include <numbers>

#include "laws/heat/heat_flow.h"

using namespace rotordrop;

namespace {

constexpr double thickening = 1.2;  // from one shell to the next

/// Radii between shells, from bore to outside [n + 1].
std::vector<double> shell_radii(double inside, double outside, std::size_t n) {
  const double first = (outside - inside) * (thickening - 1.) / (std::pow(thickening, static_cast<double>(n)) - 1.);
  std::vector<double> radii = {inside};
  for (std::size_t j = 0; j < n; ++j)
    radii.push_back(radii.back() + first * std::pow(thickening, static_cast<double>(j)));
  radii.back() = outside;
  return radii;
}

double mean_over_shells(std::span<const double> capacity, std::span<const double> T) {
  double heat = 0., sum = 0.;
  for (std::size_t j = 1; j + 1 < T.size(); ++j) {
    heat += capacity[j] * T[j];
    sum += capacity[j];
  }
  return heat / sum;
}

}  // namespace

Section<RingWallParameters> ring_wall_section() {
  Section<RingWallParameters> s("wall", "Walls of the inner rings as shells that conduct radially.");
  s.integer("shells", &RingWallParameters::shells,
            {.range = between(2, 100),
             .fallback = 16,
             .source = "estimate: the first one is a hundredth of the wall",
             .help = "Shells of every ring, each 1.2 times as thick as the one inside it."});
  return s;
}

RingWall::RingWall(const std::vector<BearingCircuitData>& bearings, double ambient, std::size_t n_shells)
    : ambient_(ambient), n_shells_(n_shells), n_states_(n_shells + 2) {
  using std::numbers::pi;
  for (const auto& b : bearings) {
    const auto R = circuit_resistances(b);
    const double around = 2. * pi * b.ring.conductivity * b.width;
    const auto radii = shell_radii(0.5 * b.inner_bore, 0.5 * b.inner_outside, n_shells);
    const double area = radii.back() * radii.back() - radii.front() * radii.front();
    const double c = b.ring.heat_capacity, volumetric = b.ring.density * c;
    Bearing made;
    made.name = b.name;
    made.capacity = {volumetric * pi * b.journal_radius * b.journal_radius * b.shaft_length};
    std::vector<double> resistance(n_states_ - 1);
    resistance.front() = R.R2;
    for (std::size_t j = 0; j < n_shells; ++j) {
      const double middle = 0.5 * (radii[j] + radii[j + 1]);
      made.capacity.push_back(b.ring_mass * c * (radii[j + 1] * radii[j + 1] - radii[j] * radii[j]) / area);
      resistance[j] += std::log(middle / radii[j]) / around;
      resistance[j + 1] += std::log(radii[j + 1] / middle) / around;
      if (j == 0) made.half_first_shell = std::log(middle / radii[0]) / around;
    }
    resistance.back() += 2. * (R.R5_inside + R.R5_constriction) + R.R7;
    const auto sleeve = [](double inside, double outside) { return 0.25 * pi * (outside * outside - inside * inside); };
    made.capacity.push_back(volumetric * (sleeve(b.outer_bore, b.outer_outside) * b.width +
                                          sleeve(b.housing_bore, b.housing_outside) * b.housing_length));
    for (const double r : resistance) made.conductance.push_back(1. / r);
    made.to_ambient = 1. / R.R1;
    made.housing_area = pi * b.housing_outside * b.housing_length;
    const double alpha = b.ring.expansion, ball = 0.5 * b.ball_diameter * b.ball.expansion;
    made.per_shaft.shaft = alpha * b.journal_radius;
    // Growth counts where balls and races touch; contact points move along the axis with their ring's width.
    made.per_wall = {.bore = alpha * radii.front(),
                     .inner_race = alpha * b.races.inner,
                     .ball = 0.5 * ball,
                     .inner_width = alpha * b.races.width};
    made.per_outside = {.outer_race = alpha * b.races.outer, .ball = 0.5 * ball, .outer_width = alpha * b.races.width};
    bearings_.push_back(std::move(made));
  }
}

std::vector<StateEntry> RingWall::state_entries() const {
  std::vector<StateEntry> entries;
  for (const auto& b : bearings_) {
    entries.push_back({b.name + "/shaft", "K", 1.});
    for (std::size_t j = 1; j <= n_shells_; ++j) entries.push_back({b.name + "/shell " + std::to_string(j), "K", 1.});
    entries.push_back({b.name + "/outside", "K", 1.});
  }
  return entries;
}

void RingWall::initial_state(std::span<double> T) const { std::fill(T.begin(), T.end(), ambient_); }

Expansion RingWall::growth_of(const Bearing& b, std::span<const double> T, double reference) const {
  const Expansion inside =
      combined(T[0] - reference, b.per_shaft, mean_over_shells(b.capacity, T) - reference, b.per_wall);
  return combined(1., inside, T.back() - reference, b.per_outside);
}

void RingWall::growth(std::span<const double> T, std::span<Expansion> out) const {
  for (std::size_t i = 0; i < bearings_.size(); ++i)
    out[i] = growth_of(bearings_[i], T.subspan(i * n_states_, n_states_), ambient_);
}

void RingWall::growth_rates(std::span<const double> rate, std::span<Expansion> out) const {
  for (std::size_t i = 0; i < bearings_.size(); ++i)
    out[i] = growth_of(bearings_[i], rate.subspan(i * n_states_, n_states_), 0.);
}

double RingWall::rates(std::span<const double> temperature, std::span<const HeatInput> heat,
                       std::span<double> dydt) const {
  double lost = 0.;
  for (std::size_t i = 0; i < bearings_.size(); ++i) {
    const Bearing& b = bearings_[i];
    const auto T = temperature.subspan(i * n_states_, n_states_);
    const auto power = dydt.subspan(i * n_states_, n_states_);  // [W] until it is divided by the capacities
    std::fill(power.begin(), power.end(), 0.);
    power[0] = heat[i].rub - heat[i].rub_into_ring;
    power[1] += heat[i].rub_into_ring;
    power[n_shells_] += heat[i].inner;
    power[n_shells_ + 1] = heat[i].outer;
    for (std::size_t j = 0; j + 1 < n_states_; ++j) {
      const double flow = b.conductance[j] * (T[j] - T[j + 1]);
      power[j] -= flow;
      power[j + 1] += flow;
    }
    const double rise = T.back() - ambient_;
    const double from_shaft = b.to_ambient * (T[0] - ambient_),
                 from_housing = housing_convection(rise) * b.housing_area * rise;
    power[0] -= from_shaft;
    power.back() -= from_housing;
    lost += from_shaft + from_housing;
    for (std::size_t j = 0; j < n_states_; ++j) power[j] /= b.capacity[j];
  }
  return lost;
}

std::vector<Observable> RingWall::observables() const {
  std::vector<std::string> columns;
  for (std::size_t j = 1; j <= n_shells_; ++j) columns.push_back("shell " + std::to_string(j));
  std::vector<Observable> list;
  for (const auto& b : bearings_) {
    list.push_back({b.name + "/shaft", "K", "temperature of the shaft under " + b.name});
    list.push_back({b.name + "/bore", "K", "temperature of the bore's surface, " + b.name});
    list.push_back({b.name + "/inner_ring",
                    "K",
                    "mean temperature of the inner ring, " + b.name,
                    1,
                    {},
                    Observed::inner_ring_temperature,
                    b.name});
    list.push_back({b.name + "/shells", "K", "temperature of the inner ring's shells, " + b.name, n_shells_, columns});
    list.push_back({b.name + "/outside", "K", "temperature of outer ring and housing, " + b.name});
  }
  return list;
}

void RingWall::observe(std::span<const double> temperature, std::span<const HeatInput> heat,
                       std::span<double> out) const {
  std::size_t at = 0;
  for (std::size_t i = 0; i < bearings_.size(); ++i) {
    const Bearing& b = bearings_[i];
    const auto T = temperature.subspan(i * n_states_, n_states_);
    out[at++] = T[0];
    // What flows from the surface into the first shell: the rub's share, and what comes from the shaft.
    out[at++] = T[1] + b.half_first_shell * (heat[i].rub_into_ring + b.conductance[0] * (T[0] - T[1]));
    out[at++] = mean_over_shells(b.capacity, T);
    for (std::size_t j = 1; j <= n_shells_; ++j) out[at++] = T[j];
    out[at++] = T.back();
  }
}

double RingWall::stored_energy(std::span<const double> temperature) const {
  double energy = 0.;
  for (std::size_t i = 0; i < bearings_.size(); ++i)
    for (std::size_t j = 0; j < n_states_; ++j)
      energy += bearings_[i].capacity[j] * (temperature[i * n_states_ + j] - ambient_);
  return energy;
}
