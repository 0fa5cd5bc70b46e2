#include "machine/preload_parameters.h"

#include <algorithm>
#include <functional>
#include <string>

#include "thermal/thermal_kinds.h"

namespace rotordrop {
namespace {

Section<PreloadMapParameters> map_section() {
  using P = PreloadMapParameters;
  Section<P> s("map",
               "Axes of the maps, in increasing order. An empty axis of growth, interference or temperature rise omits "
               "its map.");
  const auto axis = [&](const char* key, std::vector<double> P::*member, QuantityList options) {
    s.quantities(key, member, std::move(options));
    s.check([key, member](const P& p, const Node& table, Faults& faults) {
      const auto& values = p.*member;
      if (!std::is_sorted(values.begin(), values.end(), std::less_equal<>()))
        faults.add(position_of_value(table, key),
                   std::string("preload.map.") + key + " must increase from entry to entry.");
    });
  };
  axis("growth", &P::growth,
       {.unit = "m",
        .range = between(-2e-4, 2e-4),
        .fallback = {"0 um", "0.5 um", "1 um", "1.5 um", "2 um", "3 um", "4 um", "5 um", "6 um", "7 um", "8 um", "9 um",
                     "10 um"},
        .help = "Radial growth of the inner raceway over that of the outer one, balls cold."});
  axis("interference", &P::interference,
       {.unit = "m",
        .range = between(-1e-3, 1e-3),
        .fallback = {"0 um", "2 um", "4 um", "6 um", "8 um", "10 um"},
        .help = "Radial interference between outer ring and housing, in addition to the mounted value. It closes the "
                "outer raceway as "
                "thick rings of one material do (Lame)."});
  const auto rise = [&](const char* key, std::vector<double> P::*member, const char* part) {
    axis(key, member,
         {.unit = "K",
          .kind = QuantityKind::temperature_difference,
          .range = between(-300, 1500),
          .fallback = {"0 K", "5 K", "10 K", "15 K", "20 K", "25 K", "30 K", "35 K", "40 K", "45 K", "50 K"},
          .help = std::string("Temperature of the ") + part +
                  " ring over ambient, even over the ring, which grows "
                  "freely; the balls' is the mean of both rings'."});
  };
  rise("inner_rise", &P::inner_rise, "inner");
  rise("outer_rise", &P::outer_rise, "outer");
  axis("speed", &P::speed,
       {.unit = "rad/s",
        .range = between(0, 2e5),
        .help = "Speeds of the inner ring in the maps of growth and interference; standstill, half and full "
                "preload.speed if not given. Used only with growth_by_speed or ball_model = \"inertial\"."});
  return s;
}

/// Thermal models that follow a bearing that runs by itself.
std::vector<std::string> models_of_running_bearings() {
  std::vector<std::string> names;
  for (const auto* kind : thermal_kinds())
    if (kind->is_circuit || kind->meshes_sections) names.push_back(kind->name);
  return names;
}

}  // namespace

Section<PreloadParameters> preload_section() {
  using P = PreloadParameters;
  Section<P> s("preload",
               "Settings of `rotordrop preload` for each touchdown bearing on its own; a drop ignores them.");
  s.choice(
      "model", &P::model, models_of_running_bearings(),
      {.fallback = models_of_running_bearings().front(),
       .help = "Thermal model of the running bearing: its circuit with the nodes and resistors that the case adds, or "
               "finite elements of its section with thermal.fe.modes modes; independent of thermal.models."});
  s.quantity("speed", &P::speed,
             {.unit = "rad/s",
              .range = between(0, 2e5),
              .help = "Inner-ring speed in steady running; run.initial_speed if not given."});
  s.quantities("force", &P::force,
               {.unit = "N",
                .fallback = {"0 N", "0 N", "0 N"},
                .help = "Force on the inner ring along x, y, z, in maps and in steady running."});
  s.quantities("moment", &P::moment,
               {.unit = "N m",
                .fallback = {"0 N m", "0 N m"},
                .help = "Moment on the inner ring about y and z, in maps and in steady running."});
  const auto growth = [&](const char* key, double P::*member, const std::string& part) {
    s.quantity(
        key, member,
        {.unit = "m",
         .range = between(-2e-4, 2e-4),
         .fallback = "0 um",
         .help = "Radial growth of the " + part +
                 " raceway in addition to thermal and centrifugal growth: from fits, or computed by elasticity."});
  };
  growth("inner_growth", &P::inner_growth, "inner");
  growth("outer_growth", &P::outer_growth, "outer");
  s.quantity("interference", &P::interference,
             {.unit = "m",
              .range = between(-1e-3, 1e-3),
              .fallback = "0 um",
              .help = "Radial interference between outer ring and housing, in addition to the mounted value."});
  s.choice(
      "growth_by_speed", &P::growth_by_speed,
      {{"as-drop", PreloadGrowthBySpeed::as_drop},
       {"none", PreloadGrowthBySpeed::none},
       {"thin-disc", PreloadGrowthBySpeed::thin_disc}},
      {.fallback = "as-drop",
       .source = "Timoshenko & Goodier, rotating disk with a hole, plane stress",
       .help = "Centrifugal growth of bore and inner raceway. as-drop: as set by thermal.growth_by_speed; none; "
               "thin-disc: always the closed form. Not added to growth recorded by a drop that already includes it."});
  s.boolean("history_under_load", &P::history_under_load,
            {.fallback = false,
             .help = "Whether histories load the inner ring with the recorded ball forces, or leave it unloaded."});
  s.boolean("critical_values", &P::critical_values,
            {.fallback = true,
             .help = "Whether to find the critical speed, preload and cooling, and the operating points over speed. "
                     "They take most of the computing time."});
  s.quantity("end_time", &P::end_time,
             {.unit = "s",
              .range = positive(),
              .fallback = "48 h",
              .help = "End time of steady running if it neither settles nor reaches a limit."});
  s.quantity("settled_rate", &P::settled_rate,
             {.unit = "K/s",
              .range = positive(),
              .usual = between(1e-8, 1e-4),
              .fallback = "1e-6 K/s",
              .source = "estimate: 4 mK in an hour",
              .help = "The bearing counts as settled when no temperature changes faster than this."});
  s.quantity("temperature_limit", &P::temperature_limit,
             {.unit = "K",
              .range = positive(),
              .usual = between(300, 800),
              .fallback = "150 degC",
              .source = "estimate: rings are commonly stabilised up to 150 degC (class S0)",
              .help = "Any node hotter than this counts as seized."});
  s.quantity("pressure_limit", &P::pressure_limit,
             {.unit = "Pa",
              .range = positive(),
              .usual = between(5e8, 1e10),
              .fallback = "4.2 GPa",
              .source = "ISO 76, ball bearings",
              .help = "A contact pressure between balls and raceways above this counts as seized."});
  s.quantity("tolerance", &P::tolerance,
             {.range = between(1e-12, 1e-2),
              .usual = at_most(1e-5),
              .fallback = "1e-7",
              .help = "Relative local error of the integration in time; absolute: this times 1 K."});
  s.table("map", &P::map, map_section());
  return s;
}

}  // namespace rotordrop
