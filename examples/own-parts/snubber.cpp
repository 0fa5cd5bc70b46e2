#include "snubber.h"

#include <cmath>

using namespace rotordrop;

Section<SnubberParameters> snubber_section() {
  using P = SnubberParameters;
  Section<P> s("snubber", "Plain bush in an elastic mount around the shaft.");
  s.integer("node", &P::node,
            {.range = at_least(1), .help = "Rotor node around which the bush sits, numbered from 1."});
  s.quantity(
      "mass", &P::mass,
      {.unit = "kg", .range = positive(), .fallback = "2 kg", .source = "estimate", .help = "Mass of the bush."});
  s.quantity("stiffness", &P::stiffness,
             {.unit = "N/m",
              .range = positive(),
              .fallback = "2e7 N/m",
              .source = "estimate: rubber mount",
              .help = "Of the mount. A softer one brakes the shaft more gently and lets it go farther."});
  s.quantity("damping", &P::damping,
             {.unit = "N s/m",
              .range = at_least(0),
              .fallback = "4e3 N s/m",
              .source = "estimate: a third of critical",
              .help = "Of the mount. More takes more energy out of every touch."});
  s.quantity("gap", &P::gap,
             {.unit = "m", .range = positive(), .help = "Radial gap. Wider than the touchdown bearings' air gap."});
  s.quantity("radius", &P::radius, {.unit = "m", .range = positive(), .help = "Radius of the rotor in the bush."});
  s.quantity("contact_stiffness", &P::contact_stiffness,
             {.range = positive(), .help = "K of the contact [N/m^n]. Larger values need a shorter step."});
  s.quantity("exponent", &P::exponent,
             {.range = between(1, 2),
              .fallback = "1.1111111111111112",
              .source = "a journal in a bore, as the touchdown bearings'",
              .help = "n of the contact."});
  s.quantity("lambda", &P::lambda,
             {.unit = "s/m",
              .range = at_least(0),
              .fallback = "0.08 s/m",
              .source = "Neisi 2019, steel on steel",
              .help = "Damping of the contact; the restitution is 1 - lambda times the speed of a gentle touch."});
  s.quantity("friction_coefficient", &P::friction_coefficient,
             {.range = between(0, 1),
              .fallback = "0.1",
              .source = "estimate: bronze on steel, poorly lubricated",
              .help = "Of rotor and bush. Brakes the rotor and drives it backwards around the bush."});
  s.quantity("regularisation_speed", &P::regularisation_speed,
             {.unit = "m/s",
              .range = positive(),
              .fallback = "0.05 m/s",
              .source = "as the touchdown bearings'",
              .help = "Friction fades below this slip speed."});
  s.text("heats", &P::heats,
         {.help = "Node of a thermal model that a share of the friction heat enters, such as one of [[thermal.node]]; "
                  "none: no model is heated."});
  s.quantity("heat_share", &P::heat_share,
             {.range = between(0, 1),
              .fallback = "0.5",
              .source = "estimate: equal bodies; the rotor's half stays in the shaft, far from every bearing",
              .help = "Part of the friction heat that enters this node."});
  return s;
}

Snubber::Snubber(std::string name, const SnubberParameters& parameters)
    : name_(std::move(name)),
      p_(parameters),
      normal_{p_.contact_stiffness, p_.exponent, p_.lambda},
      friction_{.mu = p_.friction_coefficient, .regularisation_speed = p_.regularisation_speed} {}

std::vector<StateEntry> Snubber::state_entries() const {
  return {
      {"bush y", "m", 1e-4}, {"bush z", "m", 1e-4}, {"bush velocity y", "m/s", 0.1}, {"bush velocity z", "m/s", 0.1}};
}

std::vector<StateEntry> Snubber::ledger_entries() const {
  return {{"bush friction heat", "J", 10., "friction heat of rotor and bush"}};
}

std::vector<Observable> Snubber::observables() const {
  return {{"orbit", "m", "position of the rotor at the bush", 2, {"y", "z"}},
          {"bush_position", "m", "position of the bush", 2, {"y", "z"}},
          {"normal_force", "N", "normal force between rotor and bush"},
          {"friction_force", "N", "friction force on the bush, positive about +x"}};
}

void Snubber::initial_state(std::span<double> y) const { std::fill(y.begin(), y.end(), 0.); }

Snubber::Place Snubber::place(const Motion& journal, std::span<const double> y) const {
  const double e_y = journal.y - y[bush_y], e_z = journal.z - y[bush_z], e = std::hypot(e_y, e_z);
  if (e <= p_.gap) return {};
  return {e_y / e, e_z / e, e - p_.gap};
}

void Snubber::evaluate(const SupportInput& input, std::span<const double> y, std::span<double> dydt,
                       std::span<double> ledger_rates, SupportOutput& out) const {
  const Motion& rotor = input.journal;
  const double v_y = y[bush_velocity_y], v_z = y[bush_velocity_z];
  const auto [n_y, n_z, delta] = place(rotor, y);
  const double w_y = rotor.velocity_y - v_y, w_z = rotor.velocity_z - v_z;
  const double delta_rate = w_y * n_y + w_z * n_z;
  const double slip = input.rotor_spin.speed * p_.radius - w_y * n_z + w_z * n_y;  // t = (-n_z, n_y)
  const double elastic = normal_.elastic(delta);
  const double F_n = delta > 0. ? normal_.total(elastic, delta_rate) : 0.;
  const double F_t = friction_.coefficient(slip) * F_n;
  const double on_bush_y = F_n * n_y - F_t * n_z, on_bush_z = F_n * n_z + F_t * n_y;

  out.force_on_rotor = {};
  out.force_on_rotor.y = -on_bush_y;
  out.force_on_rotor.z = -on_bush_z;
  out.force_on_rotor.torque = -F_t * p_.radius;
  out.heat = {};
  out.energy_gradient = {};
  out.prescribed_work = 0.;
  const double mount = p_.damping * (v_y * v_y + v_z * v_z);
  out.other_dissipation = F_t * slip + (F_n - elastic) * delta_rate + mount;
  out.heat_into_port = p_.heat_share * F_t * slip;
  ledger_rates[0] = F_t * slip;

  dydt[bush_y] = v_y;
  dydt[bush_z] = v_z;
  dydt[bush_velocity_y] = (on_bush_y - p_.stiffness * y[bush_y] - p_.damping * v_y) / p_.mass;
  dydt[bush_velocity_z] = (on_bush_z - p_.stiffness * y[bush_z] - p_.damping * v_z) / p_.mass;

  if (!out.observed.empty()) {
    const double values[] = {rotor.y, rotor.z, y[bush_y], y[bush_z], F_n, F_t};
    std::copy(std::begin(values), std::end(values), out.observed.begin());
  }
}

double Snubber::energy(const SupportInput& input, std::span<const double> y) const {
  const double speed_squared = y[bush_velocity_y] * y[bush_velocity_y] + y[bush_velocity_z] * y[bush_velocity_z];
  const double distance_squared = y[bush_y] * y[bush_y] + y[bush_z] * y[bush_z];
  return 0.5 * p_.mass * speed_squared + 0.5 * p_.stiffness * distance_squared +
         normal_.energy(place(input.journal, y).penetration);
}
