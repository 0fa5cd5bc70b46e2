#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "analysis/facts/rotor_report.h"
#include "base/rotation.h"
#include "base/version.h"
#include "case/given_values.h"
#include "io/hdf5/recorded_series.h"
#include "io/sha256.h"
#include "study/report/report.h"
#include "study/report/time_words.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

std::string words_of_driver(const std::string& driver) {
  if (driver == recorded_driver) return "thermal growth recorded by an earlier run";
  const ThermalKind* kind = thermal_kind(driver);
  return kind ? "the " + kind->title : "no model: thermal growth, if computed, is not fed back";
}

std::string words_of_models(const ThermalParameters& thermal) {
  std::vector<std::string> titles;
  for (const ThermalKind* kind : chosen_kinds(thermal)) titles.push_back(kind->title);
  return titles.empty() ? "none" : fmt::format("{}", fmt::join(titles, " and "));
}

/// "on linear supports and magnets.": of a rotor without touchdown bearings.
std::string words_of_supports(const CaseParameters& p) {
  std::set<std::string> kinds;
  for (const auto& entry : p.bearings)
    kinds.insert(entry.linear()   ? "linear supports"
                 : entry.magnet() ? "magnets"
                                  : "supports defined by another program");
  return kinds.empty() ? "without a support." : fmt::format("on {}.", fmt::join(kinds, " and "));
}

/// "; shoulders of the rotor: 300 µm from the ring's face at -x, ...": empty without any.
std::string shoulder_words(const ShoulderParameters& shoulders) {
  std::string text;
  for (const auto& [face, gap] : {std::pair{"-x", shoulders.gap_minus_x}, std::pair{"+x", shoulders.gap_plus_x}})
    if (gap)
      text += fmt::format("{}{:.4g} µm from the ring's face at {}", text.empty() ? "; shoulders of the rotor: " : ", ",
                          *gap * 1e6, face);
  return text;
}

std::string bearing_words(const std::string& name, const TouchdownParameters& b, const ContactParameters& contact) {
  return fmt::format(
      "{} is a touchdown bearing at the rotor's node {}: {} row{} of {} {} balls of {:.4g} mm on a pitch diameter of "
      "{:.4g} mm, contact angle {:.3g}°, {}; radial air gap {:.4g} µm{}.",
      name, b.node, b.rows, b.rows == 1 ? "" : "s", b.balls_per_row, b.ball, b.ball_diameter * 1e3,
      b.pitch_diameter * 1e3, b.contact_angle * 180. / std::numbers::pi,
      b.preload > 0. ? fmt::format("preload {:.4g} N", b.preload)
                     : fmt::format("radial clearance {:.3g} µm", b.radial_clearance * 1e6),
      air_gap(b, contact) * 1e6, shoulder_words(b.shoulders));
}

/// "Waves around TB1, number and amplitude: 3 of 20 µm in the bore.": empty without any.
std::string wave_words(const std::string& name, const std::vector<WavinessParameters>& waves) {
  std::string text;
  for (const WavinessParameters& w : waves)
    text += fmt::format("{}{} of {:.4g} µm {}", text.empty() ? "" : ", ", w.order, w.amplitude * 1e6,
                        w.surface == WavySurface::bore         ? "in the bore"
                        : w.surface == WavySurface::inner_race ? "on the inner raceway"
                                                               : "on the outer raceway");
  return text.empty() ? "" : fmt::format("Waves around {}, number and amplitude: {}.", name, text);
}

/// "Coulomb's law, smoothed below 0.05 m/s"
std::string words_of_friction(const MachineParameters& p) {
  const auto& c = p.contact;
  const std::string law = c.friction_over_speed ? "a table over slip speed"
                          : c.static_friction_coefficient
                              ? fmt::format("Stribeck's law, from {:.3g} at rest to {:.3g} over {:.3g} m/s of slip",
                                            *c.static_friction_coefficient, c.friction_coefficient, c.stribeck_speed)
                              : "Coulomb's law";
  const bool sticks = c.friction_law == FrictionLaw::sticking ||
                      (c.friction_law == FrictionLaw::automatic && p.rotor.axial_motion == AxialFreedom::free);
  return law + (sticks
                    ? fmt::format(", and sticks before it slips, elastically with {:.3g} N/m", c.tangential_stiffness)
                    : fmt::format(", smoothed below {:.3g} m/s", c.regularisation_speed));
}

}  // namespace

Json report_words(const RecordedDrop& drop) {
  const auto& p = drop.parameters();
  const RotorReport rotor = rotor_report(p.rotor);
  Json words = Json::array();
  const auto touchdown = drop.bearings();
  words.push_back(
      fmt::format("A rotor of {:.4g} kg (polar inertia {:.3g} kg m², diametral {:.4g} kg m²) spins at {:.6g} rpm {} "
                  "The simulation covers {} at an ambient temperature of {:.2f} K ({}).",
                  rotor.body.mass, rotor.body.Ip, rotor.body.Id, p.run.initial_speed * to_rpm,
                  touchdown.empty() ? words_of_supports(p) : "and drops onto its touchdown bearings.",
                  in_time(drop.series("/energy/mechanical").times.back()), p.run.ambient, in_celsius(p.run.ambient)));
  if (p.run.until != EndCondition::time)
    words.push_back(fmt::format("The run ends with run.until = \"{}\", at {} at the latest.", name_of(p.run.until),
                                in_time(p.run.latest_end())));
  if (p.rotor.windage)
    words.push_back(p.rotor.windage->law == WindageLaw::geometry
                        ? "Windage of the surrounding gas brakes the rotor; it is computed from the smooth cylinders "
                          "and faces of the rotor's geometry."
                        : "Windage of the surrounding gas brakes the rotor; its torque follows a power of the speed.");
  for (const auto& entry : p.bearings)
    if (const auto* b = entry.touchdown()) {
      words.push_back(bearing_words(entry.name, *b, p.contact));
      if (const std::string waves = wave_words(entry.name, b->waviness); !waves.empty()) words.push_back(waves);
      if (const std::string carried = support_words(b->support, support_surroundings(*b)); !carried.empty())
        words.push_back(fmt::format("The outer ring of {} stands on a {}.", entry.name, carried));
    } else
      words.push_back(fmt::format("{} is a {} at the rotor's node {}.", entry.name,
                                  entry.linear()   ? "linear support"
                                  : entry.magnet() ? "magnet, which holds the rotor until its release,"
                                                   : "support defined by another program",
                                  entry.node()));
  if (!touchdown.empty()) {
    const auto& over_speed = p.contact.friction_over_speed;
    words.push_back(fmt::format(
        "The friction coefficient between rotor and inner rings is {}{}.",
        over_speed
            ? fmt::format("given over slip speed, {:.3g} at {:.3g} m/s to {:.3g} at {:.3g} m/s", over_speed->front()[1],
                          over_speed->front()[0], over_speed->back()[1], over_speed->back()[0])
        : p.contact.static_friction_coefficient
            ? fmt::format("{:.3g} at rest and {:.3g} at high slip speeds", *p.contact.static_friction_coefficient,
                          p.contact.friction_coefficient)
            : fmt::format("{:.3g}", p.contact.friction_coefficient),
        p.contact.friction_over_temperature ? ", times a factor over the inner ring's mean temperature" : ""));
    if (p.thermal.models.empty() && drop.driver() != recorded_driver)
      words.push_back("No thermal model ran: all parts stay at ambient temperature.");
    else
      words.push_back(fmt::format("Thermal models: {}. The clearances follow {}.", words_of_models(p.thermal),
                                  words_of_driver(drop.driver())));
  }
  return words;
}

Json report_assumptions(const RecordedDrop& drop) {
  const auto& p = drop.parameters();
  Json list = Json::array();
  list.push_back(fmt::format("The rotor is a Timoshenko beam with gyroscopic effect ({}), {} axial motion.",
                             p.rotor.model == RotorRepresentation::modal
                                 ? fmt::format("free-free modes up to {:.4g} Hz, damping ratio {:.3g}",
                                               p.rotor.cut_off_frequency, p.rotor.modal_damping)
                             : p.rotor.model == RotorRepresentation::full ? std::string("all degrees of freedom")
                                                                          : std::string("rigid"),
                             p.rotor.axial_motion == AxialFreedom::free ? "with rigid" : "without"));
  if (drop.bearings().empty()) return list;
  list.push_back(
      fmt::format("Contact between rotor and inner ring follows a Hunt-Crossley law with exponent {:.4g} (never "
                  "tensile); friction follows {}.",
                  p.contact.exponent, words_of_friction(p)));
  const auto bearings = drop.bearings();
  if (std::any_of(bearings.begin(), bearings.end(), [](const auto& bearing) { return bearing.second.shoulders.any(); }))
    list.push_back(
        "Shoulders of the rotor meet the faces of inner rings as linear springs with damping and the friction of the "
        "bore. Of what they rub only force and heat are computed, not local temperatures and wear. Contact forces, "
        "local temperatures, wear and whirl on this page are of the bores, unless they name the shoulders.");
  for (const auto& [name, b] : drop.bearings())
    list.push_back(fmt::format("{}: the inner ring {}; the outer ring moves radially with its support.", name,
                               b.ring_motion == RingMotion::free ? "moves radially and along its axis, tilts and spins"
                                                                 : "moves radially and spins"));
  for (const auto& [name, b] : drop.bearings())
    list.push_back(fmt::format("{}: the load-dependent friction torque uses the {} load; bearing friction heat is {}.",
                               name, b.load_law == FrictionLoadLaw::radial ? "radial" : "equivalent (preload included)",
                               b.internal_heat == InternalHeat::energy_consistent
                                   ? "friction torque times ring speed (energy-consistent)"
                               : b.internal_heat == InternalHeat::ball_speed
                                   ? "friction torque times ball speed, more than the work done (for comparison)"
                                   : "friction torque times ring speed, plus the heat of the balls' spin moments"));
  if (p.thermal.heat_share == HeatShare::constant)
    list.push_back(
        fmt::format("Heat partition in the thermal models: a constant share of {:.3g} of the rub heat enters the inner "
                    "ring, the rest enters the rotor.",
                    p.thermal.share_to_ring));
  else
    list.push_back(
        "Heat partition in the thermal models: the rub heat is divided between ring and rotor according to their "
        "surface speeds (Jaeger, Blok).");
  if (p.thermal.runs_circuit())
    list.push_back("The lumped circuit has one temperature per body; it does not resolve surface temperatures.");
  if (p.thermal.runs_sections())
    list.push_back("The finite elements are axisymmetric: all their temperatures are circumferential means.");
  list.push_back(
      fmt::format("During an impact the surfaces that rub are locally much hotter for milliseconds than any of these "
                  "temperatures. Their local temperature is that of a moving heat band, {}, whose heat is divided {}; "
                  "it has no effect on the motion.",
                  p.thermal.rub_band == RubBand::hertz ? "with the length of the Hertz line contact"
                                                       : fmt::format("{:.3g} mm long", p.thermal.rub_band_length * 1e3),
                  p.thermal.local_share == LocalShare::one_temperature
                      ? "so that rotor and bore have one temperature where they touch"
                      : "as in the thermal models"));
  list.push_back(
      fmt::format("Wear follows Archard's law, {:.2g} m2/N for the bore and {:.2g} m2/N for the rotor times force and "
                  "sliding distance; it does not change the clearances.",
                  p.contact.wear_coefficient_bore, p.contact.wear_coefficient_rotor));
  return list;
}

Json report_provenance(const RecordedDrop& drop) {
  const auto results = drop.directory() / "results.h5", parameters = drop.directory() / "parameters.toml";
  Json facts = Json::array();
  const auto fact = [&](const std::string& name, const std::string& value) { facts.push_back({name, value}); };
  fact("case", drop.case_name());
  fact("run by",
       read_attribute(results, "/", "program") + ", revision " + read_attribute(results, "/", "git_revision"));
  fact("with", "SUNDIALS " + read_attribute(results, "/", "sundials_version") + ", HDF5 " +
                   read_attribute(results, "/", "hdf5_version"));
  fact("report by", std::string(program_name()) + ", revision " + git_revision());
  fact("frame", read_attribute(results, "/", "frame"));
  fact("SHA-256 of results.h5", sha256_of_file(results));
  fact("SHA-256 of parameters.toml", sha256_of_file(parameters));

  // Results from before origins were recorded: as their parameters.toml has them.
  const auto recorded = drop.text("/given");
  const auto given = Json::parse(recorded ? *recorded : given_values_json(read_case(parameters).resolved));
  return {{"facts", facts}, {"given", given["values"]}, {"n_defaults", given["n_defaults"]}};
}

}  // namespace rotordrop
