#include "bearing/friction_parameters.h"

namespace rotordrop {

void add_friction_keys(Section<TouchdownParameters>& s) {
  using P = TouchdownParameters;
  s.quantity("f1_z", &P::f1_z,
             {.range = at_least(0),
              .usual = or_zero(between(1e-5, 0.02)),
              .help = "z in f1 = z (P0/C0)^y of the load-dependent friction torque f1 P1 d_m; load_law defines the "
                      "loads P0 and P1."});
  s.quantity("f1_y", &P::f1_y,
             {.range = at_least(0), .usual = or_zero(between(0.1, 1)), .help = "y in f1 = z (P0/C0)^y."});
  s.quantity("C0", &P::C0,
             {.unit = "N",
              .range = positive(),
              .usual = between(100, 1e8),
              .help = "Static load rating of all rows together; for a pair twice the catalogue value of a single "
                      "bearing. Each of n rows has C0 / n."});
  s.quantity(
      "C", &P::C,
      {.unit = "N",
       .range = positive(),
       .usual = between(100, 1e8),
       .help = "Dynamic load rating of all rows together; for a pair 2^0.7 times the catalogue value of a single "
               "bearing. For contact fatigue by a drop (ISO 281); without it fatigue is not assessed."});
  s.quantity("required_static_safety", &P::required_static_safety,
             {.range = positive(),
              .usual = between(0.3, 5),
              .fallback = "1",
              .source = "ISO 76: at 1 the most loaded ball dents the raceway by a ten-thousandth of its diameter",
              .help = "Smallest static safety of a ball with which the drop may be repeated; below it the number of "
                      "allowed drops is 0."});
  s.quantity("f2", &P::f2,
             {.range = at_least(0),
              .usual = or_zero(between(0.01, 20)),
              .fallback = "0.25",
              .source = "calibration: 0.25 per bearing gives the paper's 110 W; catalogues' 1-2 would give 0.4-0.7 kW",
              .help = "Factor of the speed-dependent friction torque, for the whole bearing or set."});
  s.quantity("drag_viscosity", &P::drag_viscosity,
             {.unit = "m2/s",
              .range = positive(),
              .usual = between(1e-7, 1e-2),
              .fallback = "15e-6 m2/s",
              .source = "Neisi, Heikkinen & Sopanen 2019, air",
              .help = "Kinematic viscosity in the speed-dependent friction torque."});
  s.quantity("drag_regularisation", &P::drag_regularisation,
             {.unit = "rad/s",
              .range = positive(),
              .usual = between(0.01, 100),
              .fallback = "2 rad/s",
              .source = "estimate",
              .help = "The friction torque passes through standstill as tanh(speed / this)."});
  s.choice(
      "load_law", &P::load_law, {{"radial", FrictionLoadLaw::radial}, {"equivalent", FrictionLoadLaw::equivalent}},
      {.fallback = "equivalent",
       .help = "Loads in the friction torque. equivalent: for each row, including its axial load F_a and thus preload, "
               "P0 = max(F_r, X0 F_r + Y0 F_a) by ISO 76 in (P0/C0)^y and P1 = max(F_r, 0.9 F_a cot phi - 0.1 F_r) "
               "times f1, for a row without contact angle 3 F_a in place of 0.9 F_a cot phi. radial: P0 and P1 are the "
               "radial resultant of all rows, without preload; thrust then causes no friction."});
  s.choice("internal_heat", &P::internal_heat,
           {{"energy-consistent", InternalHeat::energy_consistent},
            {"with-spin", InternalHeat::with_spin},
            {"ball-speed", InternalHeat::ball_speed}},
           {.fallback = "energy-consistent",
            .help = "Bearing friction heat. energy-consistent: from the friction torque. with-spin: the balls' spin "
                    "moments are an additional torque. ball-speed: friction torque times ball speed as in eq. 24 of "
                    "the reference paper, more heat than the work done; for comparison only."});
  s.quantity("race_friction_coefficient", &P::race_friction_coefficient,
             {.range = at_least(0),
              .usual = or_zero(between(5e-3, 0.5)),
              .help = "Friction coefficient between balls and raceways, for the spin moment and for the traction that "
                      "keeps the balls rolling (skid_demand); "
                      "contact.friction_coefficient if not given."});
}

}  // namespace rotordrop
