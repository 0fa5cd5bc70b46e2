#include "machine/statics_parameters.h"

#include <string>

namespace rotordrop {
namespace {

Section<RotorLoad> load_section() {
  Section<RotorLoad> s("load", "A constant force on the rotor.");
  s.integer("node", &RotorLoad::node, {.range = at_least(1), .help = "Node of the rotor, numbered from 1."});
  s.quantities("force", &RotorLoad::force, {.unit = "N", .help = "Force along y and z."});
  return s;
}

}  // namespace

Section<StaticsParameters> statics_section() {
  using P = StaticsParameters;
  Section<P> s("statics", "What `rotordrop statics` puts at rest; a drop does not look at it.");
  s.choice("subject", &P::subject, {{"shaft", StaticsSubject::shaft}, {"bearings", StaticsSubject::bearings}},
           {.fallback = "shaft",
            .help = "The rotor under its weight and `loads` on all its supports, or every touchdown bearing by itself "
                    "under `force` and `moment`."});
  s.quantities("force", &P::force,
               {.unit = "N",
                .fallback = {"0 N", "0 N", "0 N"},
                .help = "On the inner ring of every touchdown bearing along x, y, z. With subject = \"bearings\"."});
  s.quantities("moment", &P::moment,
               {.unit = "N m",
                .fallback = {"0 N m", "0 N m"},
                .help = "On the inner ring of every touchdown bearing about y and z. With subject = \"bearings\"."});
  s.list("loads", &P::loads, load_section());
  s.quantity("speed", &P::speed,
             {.unit = "rad/s",
              .range = between(-2e4, 2e4),
              .fallback = "0 rpm",
              .help = "Of the inner rings. Matters to bearings with ball_model = \"inertial\" alone."});
  const auto rise = [&](const char* key, double P::*member, const std::string& part) {
    s.quantity(key, member,
               {.unit = "K",
                .kind = QuantityKind::temperature_difference,
                .range = between(-300, 1500),
                .fallback = "0 K",
                .help = "Temperature of the " + part + " over ambient, even over the part, which grows freely."});
  };
  rise("inner_rise", &P::inner_rise, "inner rings");
  rise("outer_rise", &P::outer_rise, "outer rings");
  rise("ball_rise", &P::ball_rise, "balls");
  rise("shaft_rise", &P::shaft_rise, "shaft where it rests");
  const auto growth = [&](const char* key, double P::*member, const std::string& part) {
    s.quantity(key, member,
               {.unit = "m",
                .range = between(-2e-4, 2e-4),
                .fallback = "0 um",
                .help = "Radial growth of the " + part +
                        " raceways besides that of temperature: by fits, or as elasticity gives it."});
  };
  growth("inner_growth", &P::inner_growth, "inner");
  growth("outer_growth", &P::outer_growth, "outer");
  s.choice(
      "preload_by", &P::preload_by, {{"rigid", PreloadBy::rigid}, {"spring", PreloadBy::spring}},
      {.fallback = "rigid",
       .help = "What holds the preload of an X or O set: rings clamped to their places, or a spring that presses the "
               "outer ring of the last row. Rows that lean one way are pressed by a constant force."});
  s.quantity("preload_stiffness", &P::preload_stiffness,
             {.unit = "N/m",
              .range = at_least(0),
              .fallback = "0 N/m",
              .help = "Of the spring: the outer ring is pressed less as it yields. 0 is a constant force."});
  return s;
}

}  // namespace rotordrop
