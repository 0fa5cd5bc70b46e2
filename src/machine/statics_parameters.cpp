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
  Section<P> s("statics", "Settings of `rotordrop statics`; a drop ignores them.");
  s.choice("subject", &P::subject, {{"shaft", StaticsSubject::shaft}, {"bearings", StaticsSubject::bearings}},
           {.fallback = "shaft",
            .help = "The rotor under its weight and `loads` on all its supports, or every touchdown bearing by itself "
                    "under `force` and `moment`."});
  s.quantities(
      "force", &P::force,
      {.unit = "N",
       .fallback = {"0 N", "0 N", "0 N"},
       .help = "Force on the inner ring of every touchdown bearing along x, y, z. With subject = \"bearings\"."});
  s.quantities(
      "moment", &P::moment,
      {.unit = "N m",
       .fallback = {"0 N m", "0 N m"},
       .help = "Moment on the inner ring of every touchdown bearing about y and z. With subject = \"bearings\"."});
  s.list("loads", &P::loads, load_section());
  s.quantity("speed", &P::speed,
             {.unit = "rad/s",
              .range = between(-2e5, 2e5),
              .fallback = "0 rpm",
              .help = "Spin speed of the inner rings. Used only by bearings with ball_model = \"inertial\"."});
  const auto rise = [&](const char* key, double P::*member, const std::string& part) {
    s.quantity(key, member,
               {.unit = "K",
                .kind = QuantityKind::temperature_difference,
                .range = between(-300, 1500),
                .fallback = "0 K",
                .help = "Temperature of the " + part + " above ambient, uniform over the part, which grows freely."});
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
                        " raceways in addition to thermal growth: from fits, or computed by elasticity."});
  };
  growth("inner_growth", &P::inner_growth, "inner");
  growth("outer_growth", &P::outer_growth, "outer");
  s.choice(
      "preload_by", &P::preload_by, {{"rigid", PreloadBy::rigid}, {"spring", PreloadBy::spring}},
      {.fallback = "rigid",
       .help = "How the preload of an X or O set is held: rings clamped in position, or a spring on the outer ring of "
               "the last row. Rows whose contact angles point the same way are preloaded by a constant force."});
  s.quantity("preload_stiffness", &P::preload_stiffness,
             {.unit = "N/m",
              .range = at_least(0),
              .fallback = "0 N/m",
              .help = "Stiffness of the preload spring: its force falls as the outer ring moves. 0: constant force."});
  return s;
}

}  // namespace rotordrop
