#include "bearing/contact_parameters.h"

#include <fmt/format.h>

namespace rotordrop {

namespace {

constexpr const char* paper = "Neisi, Heikkinen & Sopanen 2019";

}  // namespace

Section<ContactParameters> contact_section() {
  using P = ContactParameters;
  Section<P> s("contact", "Contact between rotor surface and inner-ring bore, for all touchdown bearings.");
  s.quantity("friction_coefficient", &P::friction_coefficient,
             {.range = between(0, 2),
              .usual = or_zero(between(5e-3, 0.8)),
              .fallback = "0.1",
              .source = std::string(paper) + ", table 2",
              .help = "Dynamic friction coefficient between rotor and bore. Larger values spin the ring up faster and "
                      "push the rotor further sideways."});
  s.quantity("air_gap", &P::air_gap,
             {.unit = "m",
              .range = positive(),
              .usual = between(0.05e-3, 1e-3),
              .fallback = "250 um",
              .source = std::string(paper) + ", table 2",
              .help = "Radial gap between rotor and inner ring at rest and ambient temperature."});
  s.quantity("exponent", &P::exponent,
             {.range = between(1, 3),
              .usual = between(1, 1.6),
              .fallback = "1.1111111111111112",
              .source = std::string(paper) + ", n = 10/9",
              .help = "Exponent n of the normal force K delta^n."});
  s.quantity("lambda", &P::lambda,
             {.unit = "s/m",
              .range = between(0, 5),
              .usual = or_zero(between(1e-3, 1)),
              .fallback = "0.08 s/m",
              .source = std::string(paper) + "; Hunt & Crossley 1975 give 0.08..0.32",
              .help = "Contact damping; for small impact speeds v the restitution is 1 - lambda v."});
  s.quantity("regularisation_speed", &P::regularisation_speed,
             {.unit = "m/s",
              .range = positive(),
              .usual = between(1e-4, 1),
              .fallback = "0.05 m/s",
              .source = "estimate",
              .help = "Friction is smoothed through zero slip as v / sqrt(v^2 + this^2). Smaller values are sharper "
                      "and harder to integrate."});
  s.quantity("bore_radius", &P::bore_radius,
             {.unit = "m",
              .range = positive(),
              .usual = between(1e-3, 1),
              .help = "Bore radius of the inner rings; half of the inner ring's bore diameter if not given."});
  s.quantity("static_friction_coefficient", &P::static_friction_coefficient,
             {.range = between(0, 2),
              .usual = or_zero(between(5e-3, 1)),
              .help = "Static friction coefficient (Stribeck law); the dynamic value if not given."});
  s.quantity("stribeck_speed", &P::stribeck_speed,
             {.unit = "m/s",
              .range = positive(),
              .usual = between(1e-3, 20),
              .fallback = "0.5 m/s",
              .source = "estimate",
              .help = "Slip speed over which friction falls from the static to the dynamic value."});
  s.function("friction_over_speed", &P::friction_over_speed,
             {.argument_unit = "m/s",
              .range = between(0, 2),
              .usual = or_zero(between(1e-3, 1)),
              .help = "Dynamic friction coefficient between rotor and bore over slip speed; replaces "
                      "friction_coefficient in the contact. Linear between the pairs, constant outside; "
                      "regularisation_speed still applies. Values derived from a single coefficient "
                      "(race_friction_coefficient, the condition for a full rub) still use friction_coefficient."});
  s.function("friction_over_temperature", &P::friction_over_temperature,
             {.argument_unit = "K",
              .range = between(0, 10),
              .usual = between(0.01, 10),
              .help = "Factor on the friction between rotor and bore over the mean temperature of the inner ring in "
                      "the lumped circuit: linear between the pairs, constant outside. The local temperature of the "
                      "rub contact has no influence."});
  s.quantity("wear_coefficient_bore", &P::wear_coefficient_bore,
             {.unit = "m2/N",
              .range = at_least(0),
              .usual = or_zero(between(1e-18, 1e-12)),
              .fallback = "1e-14 m2/N",
              .source = "estimate: K/H with K = 7e-5 for unlubricated hardened steel (Archard 1953; Rabinowicz 1995: "
                        "1e-5 to 1e-3) and H = 7 GPa (60 HRC)",
              .help = "Wear volume of the bore divided by normal force and sliding distance (Archard). It affects only "
                      "the reported wear."});
  s.quantity("wear_coefficient_rotor", &P::wear_coefficient_rotor,
             {.unit = "m2/N",
              .range = at_least(0),
              .usual = or_zero(between(1e-18, 1e-12)),
              .fallback = "2.3e-14 m2/N",
              .source = "estimate: K/H with the same K and H = 3 GPa (quenched and tempered steel of a landing sleeve)",
              .help = "Wear volume of the rotor surface divided by normal force and sliding distance (Archard)."});
  s.quantity("wear_depth_limit", &P::wear_depth_limit,
             {.unit = "m",
              .range = positive(),
              .usual = between(1e-6, 1e-3),
              .fallback = "50 um",
              .source = "estimate: a fifth of the reference case's air gap",
              .help = "Permitted wear depth of bore or rotor; the number of drops until then is reported."});
  s.choice(
      "friction_law", &P::friction_law,
      {{"automatic", FrictionLaw::automatic},
       {"regularised", FrictionLaw::regularised},
       {"sticking", FrictionLaw::sticking}},
      {.fallback = "automatic",
       .help =
           "Friction between rotor and bore near zero slip. regularised: proportional to the slip speed there, so a "
           "resting rotor creeps. sticking: elastic-plastic, so a resting rotor stays in place. automatic: sticking "
           "with rotor.axial_motion = \"free\", otherwise regularised. Shoulders always use the regularised law."});
  s.quantity("tangential_stiffness", &P::tangential_stiffness,
             {.unit = "N/m",
              .range = positive(),
              .usual = between(1e6, 1e10),
              .fallback = "1e8 N/m",
              .source = "estimate: about a third of the normal stiffness under a resting rotor (Mindlin: 0.8 of it)",
              .help = "Tangential contact stiffness between rotor and the whole bore before slip, for friction_law = "
                      "\"sticking\"."});
  s.quantity("contact_length", &P::contact_length,
             {.unit = "m",
              .range = positive(),
              .usual = between(1e-4, 0.1),
              .fallback = "2 mm",
              .source = "estimate: Hertz' line contact of rotor and bore under some hundred newtons",
              .help = "Length of the contact along the surface; with friction_law = \"sticking\" the bristles are "
                      "renewed after surfaces that turn together have moved by it."});
  s.check([](const P& p, const Node& table, Faults& faults) {
    if (p.bore_radius && p.air_gap >= *p.bore_radius)
      faults.add(position_of_value(table, "air_gap"),
                 fmt::format("contact.air_gap = {:.6g} mm is not smaller than bore_radius = {:.6g} mm.",
                             p.air_gap * 1e3, *p.bore_radius * 1e3),
                 "The rotor's radius is bore_radius - air_gap.");
    if (p.friction_over_speed && p.static_friction_coefficient)
      faults.add(
          position_of_value(table, "static_friction_coefficient"),
          "contact.static_friction_coefficient and contact.friction_over_speed both say how friction changes with "
          "slip speed.",
          "Give one of them; a table may begin with the static value at 0 m/s.");
    if (p.friction_over_speed && p.friction_over_speed->front()[0] < 0.)
      faults.add(position_of_value(table, "friction_over_speed"),
                 "contact.friction_over_speed has a negative slip speed; friction depends on the magnitude alone.",
                 "Begin the table at 0 m/s or above.");
    if (p.friction_over_temperature && p.friction_over_temperature->front()[0] < 0.)
      faults.add(position_of_value(table, "friction_over_temperature"),
                 "contact.friction_over_temperature has a temperature below 0 K.",
                 "Temperatures are absolute: write 20 degC or 293.15 K.");
  });
  return s;
}

double largest_friction(const ContactParameters& contact) {
  const auto largest = [](const std::vector<std::array<double, 2>>& table) {
    double value = 0.;
    for (const auto& pair : table) value = std::max(value, pair[1]);
    return value;
  };
  const double mu = contact.friction_over_speed
                        ? largest(*contact.friction_over_speed)
                        : std::max(contact.friction_coefficient, contact.static_friction_coefficient.value_or(0.));
  return contact.friction_over_temperature ? mu * largest(*contact.friction_over_temperature) : mu;
}

}  // namespace rotordrop
