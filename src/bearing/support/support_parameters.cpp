#include "bearing/support/support_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bearing/support/support_law_kinds.h"

namespace rotordrop {

namespace {

Section<RibbonLoopParameters> loop_section() {
  using P = RibbonLoopParameters;
  Section<P> s("loop", "A measured loop of force over displacement, between two turns.");
  s.function("loading", &P::loading,
             {.unit = "N",
              .argument_unit = "m",
              .usual = between(-1e6, 1e6),
              .usual_argument = between(-2e-3, 2e-3),
              .help = "[displacement, force] pairs on the way of rising displacement, all around."});
  s.function("unloading", &P::unloading,
             {.unit = "N",
              .argument_unit = "m",
              .usual = between(-1e6, 1e6),
              .usual_argument = between(-2e-3, 2e-3),
              .help = "The same of the way back, also listed with rising displacement: it lies below the loading "
                      "branch, and the area between is the loss of a turn."});
  return s;
}

Section<RibbonGeometryParameters> ribbon_geometry_section() {
  using P = RibbonGeometryParameters;
  Section<P> s("geometry", "A ring of corrugations, pressed between outer ring and housing.");
  s.integer("waves", &P::waves, {.range = between(6, 1000), .help = "Number of waves around the circumference."});
  s.quantity("pitch", &P::pitch,
             {.unit = "m",
              .range = positive(),
              .usual = between(5e-4, 0.05),
              .help = "Length of a wave around the circumference."});
  s.quantity(
      "height", &P::height,
      {.unit = "m", .range = positive(), .usual = between(5e-5, 0.01), .help = "Of a wave's crest above its feet."});
  s.quantity("thickness", &P::thickness,
             {.unit = "m",
              .range = positive(),
              .usual = between(3e-5, 2e-3),
              .help = "Of the strip; the stiffness grows with its cube."});
  s.quantity("strip_width", &P::strip_width,
             {.unit = "m", .range = positive(), .usual = between(1e-3, 0.5), .help = "Of the strip along the axis."});
  s.quantity("interference", &P::interference,
             {.unit = "m",
              .range = positive(),
              .usual = between(5e-6, 1e-3),
              .help = "By which mounting presses every wave, radially. Beyond this travel waves lift off."});
  s.quantity("modulus", &P::modulus,
             {.unit = "Pa",
              .range = positive(),
              .usual = between(4e10, 2.5e11),
              .fallback = "206 GPa",
              .source = "spring steel",
              .help = "Young's modulus of the strip."});
  s.quantity("poisson_ratio", &P::poisson_ratio,
             {.range = between(0, 0.499),
              .usual = or_zero(between(0.05, 0.499)),
              .fallback = "0.3",
              .source = "steel",
              .help = "Of the strip."});
  s.quantity("friction_coefficient", &P::friction_coefficient,
             {.range = between(0, 1),
              .usual = or_zero(between(0.01, 0.6)),
              .fallback = "0.15",
              .source = "estimate: steel on steel",
              .help = "Of crests and feet."});
  s.quantity("stick_length", &P::stick_length,
             {.unit = "m",
              .range = between(1e-7, 1e-4),
              .fallback = "2 um",
              .source = "estimate: rough surfaces slide within a few micrometres",
              .help = "Travel within which friction builds up, at least. Shorter values shorten the time step."});
  return s;
}

Section<RibbonParameters> ribbon_section() {
  using P = RibbonParameters;
  Section<P> s("ribbon", "Corrugated ribbon: springs and friction, by numbers, by a measured loop or by geometry.");
  s.quantity("stiffness", &P::stiffness,
             {.unit = "N/m",
              .range = positive(),
              .usual = between(1e5, 1e10),
              .help = "While its friction slips; of a bilinear ribbon given by numbers."});
  s.quantity(
      "slip_force", &P::slip_force,
      {.unit = "N", .range = positive(), .usual = between(0.1, 1e6), .help = "Friction force at which it slips."});
  s.quantity("stick_stiffness", &P::stick_stiffness,
             {.unit = "N/m",
              .range = positive(),
              .usual = between(1e5, 1e11),
              .help = "By which it is stiffer before it slips."});
  s.quantity("damping", &P::damping,
             {.unit = "N s/m",
              .range = at_least(0),
              .usual = or_zero(between(1, 1e6)),
              .fallback = "0 N s/m",
              .help = "Besides friction."});
  s.table("loop", &P::loop, loop_section(),
          {.help = "Instead of numbers: sliders with the shape and the area of a measured loop."});
  s.table("geometry", &P::geometry, ribbon_geometry_section(),
          {.help = "Instead of numbers: an estimate from the corrugation."});
  s.check([](const P& p, const Node& table, const std::string& path, Faults& faults) {
    const bool by_numbers = p.stiffness || p.slip_force || p.stick_stiffness;
    if ((by_numbers ? 1 : 0) + (p.loop ? 1 : 0) + (p.geometry ? 1 : 0) != 1)
      return faults.add(table.where(),
                        fmt::format("{} must be given in one way, and {}.", path,
                                    by_numbers || p.loop || p.geometry ? "it is given in several" : "it is empty"),
                        "Give stiffness, slip_force and stick_stiffness, or a measured loop, or the geometry.");
    if (by_numbers && !(p.stiffness && p.slip_force && p.stick_stiffness))
      faults.add(table.where(), fmt::format("{} needs stiffness, slip_force and stick_stiffness together.", path),
                 "The loop of a bilinear ribbon has these three numbers.");
    if (p.loop)
      if (const std::string fault = fault_of({p.loop->loading, p.loop->unloading}); !fault.empty())
        faults.add(position_of_value(table, "loop"),
                   fmt::format("{}.loop is no loop of a passive ribbon: {}.", path, fault),
                   "The loading branch lies above the unloading one, both rise, over the same displacements. Are they "
                   "exchanged?");
    if (p.geometry && p.geometry->height >= 0.5 * p.geometry->pitch)
      faults.add(position_of_value(table, "geometry"),
                 fmt::format("{}.geometry has waves of height {:.4g} mm on a pitch of {:.4g} mm: they are not shallow.",
                             path, p.geometry->height * 1e3, p.geometry->pitch * 1e3),
                 "The formulas hold for waves lower than half their pitch; measure a loop instead.");
  });
  return s;
}

Section<ElastomerParameters> elastomer_section() {
  using P = ElastomerParameters;
  Section<P> s("elastomer", "Elastomer ring, by its storage and loss moduli over frequency.");
  s.choice("model", &P::model, {{"maxwell", ElastomerModel::maxwell}, {"kelvin-voigt", ElastomerModel::kelvin_voigt}},
           {.fallback = "maxwell",
            .help = "maxwell: springs and dampers that have the whole table (generalised Maxwell). kelvin-voigt: one "
                    "spring and one damper, with the table's values at `frequency`."});
  s.function("storage", &P::storage,
             {.unit = "Pa",
              .argument_unit = "Hz",
              .range = positive(),
              .usual = between(1e4, 1e10),
              .usual_argument = between(1e-4, 1e6),
              .help = "[frequency, storage modulus] pairs."});
  s.function("loss", &P::loss,
             {.unit = "Pa",
              .argument_unit = "Hz",
              .range = at_least(0),
              .usual = or_zero(between(1e2, 1e10)),
              .usual_argument = between(1e-4, 1e6),
              .help = "[frequency, loss modulus] pairs at the same frequencies."});
  s.quantity("shape_factor", &P::shape_factor,
             {.unit = "m",
              .range = positive(),
              .usual = between(1e-3, 100),
              .help = "Radial stiffness of the ring over its modulus: of a measured stiffness, or by its form."});
  s.quantity("frequency", &P::frequency,
             {.unit = "Hz",
              .range = positive(),
              .usual = between(0.1, 1e5),
              .help = "At which model = \"kelvin-voigt\" has the table's values."});
  s.quantity("fit_tolerance", &P::fit_tolerance,
             {.range = between(1e-12, 1),
              .usual = between(1e-6, 0.1),
              .fallback = "0.01",
              .help = "Largest deviation of model = \"maxwell\" from the table, over the magnitude there. A table that "
                      "a passive material can have is met to "
                      "about 1e-8."});
  s.check([](const P& p, const Node& table, const std::string& path, Faults& faults) {
    const auto same = [](const auto& a, const auto& b) { return std::fabs(a[0] - b[0]) <= 1e-9 * std::fabs(a[0]); };
    if (p.storage.size() != p.loss.size() || !std::equal(p.storage.begin(), p.storage.end(), p.loss.begin(), same))
      return faults.add(position_of_value(table, "loss"),
                        fmt::format("{}.storage and .loss are not given at the same frequencies.", path),
                        "Give both at each frequency.");
    if (p.storage.empty() || p.storage.front()[0] <= 0.)
      return faults.add(position_of_value(table, "storage"), fmt::format("{}.storage begins at 0 Hz.", path),
                        "Begin at a frequency above zero.");
    if (p.model == ElastomerModel::kelvin_voigt) {
      if (!p.frequency)
        faults.add(
            table.where(),
            fmt::format("{}.frequency is missing: model = \"kelvin-voigt\" has the table's values at one frequency.",
                        path),
            "Give the frequency of the largest motion.");
      return;
    }
    if (p.storage.size() < 2)
      return faults.add(position_of_value(table, "storage"),
                        fmt::format("{} has one frequency; model = \"maxwell\" needs two or more.", path),
                        "Give more rows, or set model = \"kelvin-voigt\".");
    const MaxwellFit fit = fit_maxwell(stiffness_table(p));
    if (fit.largest_error > p.fit_tolerance)
      faults.add(position_of_value(table, "storage"),
                 fmt::format("{}: no springs and dampers have this table; the nearest are {:.3g} % off at {:.4g} Hz.",
                             path, 100. * fit.largest_error, fit.worst_frequency),
                 "In a passive material storage rises where loss is high. Check the table, or raise fit_tolerance.");
    else if (!(fit.model.stiffness > 1e-9 * p.storage.front()[1] * p.shape_factor))
      faults.add(position_of_value(table, "storage"),
                 fmt::format("{}: by its table the elastomer flows away at rest.", path),
                 "Give rows at lower frequencies, where the storage modulus becomes constant.");
  });
  return s;
}

Section<SqueezeFilmParameters> squeeze_film_section() {
  using P = SqueezeFilmParameters;
  Section<P> s("squeeze_film", "Oil film around an outer ring that does not turn; short bearing with open ends.");
  s.quantity("viscosity", &P::viscosity,
             {.unit = "Pa s", .range = positive(), .usual = between(1e-4, 1), .help = "Dynamic viscosity of the oil."});
  s.quantity("clearance", &P::clearance,
             {.unit = "m",
              .range = positive(),
              .usual = between(1e-5, 1e-3),
              .help = "Radial thickness of the film when centred. Damping falls with its cube."});
  s.quantity(
      "radius", &P::radius,
      {.unit = "m", .range = positive(), .help = "Of the film; half the outer ring's outside diameter if not given."});
  s.quantity("length", &P::length,
             {.unit = "m",
              .range = positive(),
              .help = "Of the film along the axis; the bearing's width if not given. Damping grows with its cube."});
  s.boolean(
      "cavitates", &P::cavitates,
      {.fallback = true, .help = "Whether the film breaks where it would pull (pi film); else it pulls (2 pi film)."});
  return s;
}

Section<StopParameters> stop_section() {
  using P = StopParameters;
  Section<P> s("stop", "Round stop behind a gap.");
  s.quantity("gap", &P::gap,
             {.unit = "m",
              .range = positive(),
              .usual = between(1e-6, 0.01),
              .help = "Travel of the outer ring, in any direction, until it meets the stop."});
  s.quantity("stiffness", &P::stiffness,
             {.unit = "N/m",
              .range = positive(),
              .usual = between(1e6, 1e11),
              .help = "Of the stop, beside the support's own."});
  s.quantity("lambda", &P::lambda,
             {.unit = "s/m",
              .range = at_least(0),
              .usual = or_zero(between(1e-3, 1)),
              .fallback = "0.08 s/m",
              .source = "Neisi, Heikkinen & Sopanen 2019, of a rotor in its bearing",
              .help = "Damping: a slow impact at the speed v rebounds with 1 - lambda v of it."});
  return s;
}

/// A member of a law as one of P.
template <class P, class M>
M P::*of(M SupportLawParameters::*member) {
  return member;
}

template <class P>
void add_law_keys(Section<P>& s) {
  using L = SupportLawParameters;
  std::vector<std::string> types;
  for (const auto& kind : support_law_kinds()) types.push_back(kind.type);
  s.choice("type", of<P>(&L::type), std::move(types),
           {.fallback = "linear",
            .help = "linear: springs and dampers. ribbon: corrugated strip with friction. elastomer: ring of rubber. "
                    "squeeze-film: oil film beside springs. bump-stop: springs and a stop behind a gap, which every "
                    "other type may have too."});
  s.quantity("K_y", of<P>(&L::K_y),
             {.unit = "N/m",
              .range = positive(),
              .usual = between(1e4, 1e12),
              .help = "Vertical stiffness; of types with springs."});
  s.quantity("K_z", of<P>(&L::K_z),
             {.unit = "N/m", .range = positive(), .usual = between(1e4, 1e12), .help = "Horizontal stiffness."});
  s.quantity("C_y", of<P>(&L::C_y),
             {.unit = "N s/m",
              .range = at_least(0),
              .usual = at_most(1e7),
              .help = "Vertical damping; of types with springs."});
  s.quantity("C_z", of<P>(&L::C_z),
             {.unit = "N s/m", .range = at_least(0), .usual = at_most(1e7), .help = "Horizontal damping."});
  s.table("ribbon", of<P>(&L::ribbon), ribbon_section(), {.help = "Of type = \"ribbon\"."});
  s.table("elastomer", of<P>(&L::elastomer), elastomer_section(), {.help = "Of type = \"elastomer\"."});
  s.table("squeeze_film", of<P>(&L::squeeze_film), squeeze_film_section(),
          {.help = "Of type = \"squeeze-film\"; round, also beside `z`, where it cannot stand."});
  s.table("stop", of<P>(&L::stop), stop_section(),
          {.help = "Of type = \"bump-stop\", and by choice of every other type; round, also beside `z`, where it "
                   "cannot stand."});
}

}  // namespace

Section<SupportParameters> support_section() {
  using P = SupportParameters;
  Section<SupportLawParameters> z("z", "The law along z, if it is another one than along y.");
  add_law_keys(z);
  Section<P> s("support", "What carries the outer ring in its housing: effective mass on a law of force over travel.");
  s.quantity("mass", &P::mass,
             {.unit = "kg",
              .range = positive(),
              .usual = between(0.01, 2e4),
              .help = "Effective mass that moves with the outer ring: of the housing on springs, of the ring in a "
                      "ribbon. Gravity does not act on it."});
  add_law_keys(s);
  s.table("z", &P::z, z,
          {.help = "Another law along z; the other keys are then of the law along y. Squeeze film and stop "
                   "are round: they stand in `support` and act along both."});
  s.quantity("travel_limit", &P::travel_limit,
             {.unit = "m",
              .range = positive(),
              .usual = between(2e-6, 0.01),
              .help = "Travel of the outer ring above which results warn; none if not given."});
  s.check([](const P& p, const Node& table, const std::string& path, Faults& faults) {
    const auto* kind = law_kind(p.type);
    if (!kind) return;  // a fault of its own
    const std::size_t n_before = faults.size();
    kind->check(p, table, path, faults);
    if (p.z) {
      const Node* found = table.find("z");
      const Node& own = found ? *found : table;
      const auto* other = law_kind(p.z->type);
      const auto refuse_round = [&](const std::string& key, const std::string& is) {
        faults.add(position_of_value(own, key),
                   fmt::format("{}.z.{}, but {} acts in any direction.", path, is, key == "type" ? "this type" : "it"),
                   "Film and stop are round: give them in `support` itself, where they act along y and z, and in z a "
                   "type without them.");
      };
      if (other && other->is_round) {
        refuse_round("type", fmt::format("type = \"{}\"", p.z->type));
      } else {
        if (p.z->stop) refuse_round("stop", "stop is given");
        if (p.z->squeeze_film) refuse_round("squeeze_film", "squeeze_film is given");
        if (other) other->check(*p.z, own, path + ".z", faults);
      }
    } else if (faults.size() == n_before && kind->has_springs) {
      for (const auto& [key, value] :
           {std::pair{"K_y", &p.K_y}, std::pair{"K_z", &p.K_z}, std::pair{"C_y", &p.C_y}, std::pair{"C_z", &p.C_z}})
        if (!*value) add_missing_key(table, path, key, p.type, faults);
    }
  });
  return s;
}

}  // namespace rotordrop
