#include "study/compare/calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>

#include "base/errors.h"
#include "base/version.h"
#include "case/modules/fe_module.h"
#include "io/text/parameter_writers.h"
#include "io/text/toml_reader.h"
#include "machine/build_machine.h"
#include "machine/check_machine.h"

namespace rotordrop {

namespace fs = std::filesystem;

namespace {

// Of the elements' modes: finer than a drop's, since speed is of no matter here.
constexpr double aimed_response = 2e-3;

}  // namespace

std::vector<CalibratedBearing> calibrate(const Case& c, const CalibrationSettings& settings) {
  CaseParameters p = c.parameters;
  for (const auto* kind : thermal_kinds())
    if (kind->meshes_sections && !p.thermal.runs(kind->name)) p.thermal.models.push_back(kind->name);
  p.thermal.driver = automatic_driver;
  p.thermal.fe.coupling = FeCoupling::reduced;
  p.thermal.contact_conduction = BallConductionModel::fixed;  // there are no loads
  // The resistance that is fitted is that of a contact, and the mesh has one only where it stays.
  p.thermal.shaft_ring_link = BearingCircuitData::Link::permanent;
  p.thermal.expansion = GrowthSource::formula;  // growth has no part in it
  // What a user adds to the circuit is not fitted.
  p.thermal.nodes.clear();
  p.thermal.resistors.clear();
  // Nor is heat of supports of others, which may enter these.
  std::erase_if(p.bearings, [](const SupportEntry& entry) { return entry.other() != nullptr; });
  Faults faults;
  check_machine(p, c.tree, faults);
  faults.throw_if_any();
  FiniteElements elements = finite_elements_of(c);
  elements.always_reduced = true;
  elements.aimed_response = aimed_response;
  {
    const std::lock_guard guard(section_lock());
    build_machine(p, c.tree, &elements);
  }
  std::vector<CalibratedBearing> bearings;
  CaseParameters spreading = p;
  spreading.thermal.spreading = RacewaySpreading::strip;
  for (const auto& section : elements.sections) {
    const auto circuit = [&](const CaseParameters& of) {
      return circuit_data(of, section.name, touchdown_of(of, section.name));
    };
    bearings.push_back(fit_circuit(circuit(p), section.reduced, p.run.ambient, settings,
                                   uncertain_resistances(circuit(p), circuit(spreading))));
    bearings.back().elements_error = section.reduced.response_error;
  }
  if (bearings.empty())
    throw InputError({c.file.string(), 0, 0},
                     "the case has no touchdown bearing, so there is no circuit to calibrate.");
  return bearings;
}

namespace {

/// Behind a factor in the file: its bounds, and whether it is at one.
std::string bounds_text(const CalibratedBearing::Resistance& r) {
  const auto& u = r.uncertain;
  return fmt::format("{}, {:.3g} to {:.3g}{}", u.words, u.lowest, u.highest,
                     r.is_at_lowest    ? ": AT ITS LOWER BOUND"
                     : r.is_at_highest ? ": AT ITS UPPER BOUND"
                                       : "");
}

/// "KEY = VALUE" of a setting in a file in `folder`, from where files are named.
/// @param key  what remains of the setting's within its table
std::string setting_text(const std::string& key, const Node& value, const fs::path& folder) {
  const bool is_file = value.is_text() && fs::path(value.text()).has_extension() && fs::is_regular_file(value.text());
  return fmt::format("{} = {}\n", key, toml_value(is_file ? Node(fs::relative(value.text(), folder).string()) : value));
}

/// The last of each key.
std::vector<Setting> settings_of(const std::vector<std::string>& overrides) {
  std::vector<Setting> settings;
  for (const auto& text : overrides) {
    const Setting setting = read_setting(text);
    std::erase_if(settings, [&](const Setting& earlier) { return earlier.key == setting.key; });
    settings.push_back(setting);
  }
  return settings;
}

}  // namespace

std::string calibration_file(const Case& c, const std::vector<std::string>& overrides, const fs::path& file,
                             const std::vector<CalibratedBearing>& bearings, const CalibrationSettings& s) {
  const auto folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  std::string text = fmt::format(
      "# source: factors of the circuit's uncertain resistances are fitted to the finite elements of this case by "
      "rotordrop {} ({}): responses of mean\n"
      "# temperatures to steps of heat into each port, from {:g} s to {:g} s. Capacities and convection stay. Set the "
      "factors to 1 for the circuit without calibration.\n"
      "base = {}\n",
      version(), git_revision(), s.from, s.until, toml_value(Node(fs::relative(c.file, folder).string())));
  const auto settings = settings_of(overrides);
  const auto circuit_of = [](const CalibratedBearing& b) { return fmt::format("bearings.{}.circuit.", b.name); };
  const auto stands_in_a_circuit = [&](const Setting& setting) {
    return std::ranges::any_of(bearings, [&](const auto& b) { return setting.key.starts_with(circuit_of(b)); });
  };
  for (const Setting& setting : settings)
    if (!stands_in_a_circuit(setting)) text += setting_text(setting.key, setting.value, folder);
  for (const auto& b : bearings) {
    text += fmt::format("\n[bearings.{}.circuit]  # error of responses: rms {:.2g} % before, {:.2g} % after\n", b.name,
                        100. * b.before.rms, 100. * b.after.rms);
    for (const auto& r : b.resistances)
      text += fmt::format("{} = {:.4f}  # {}\n", r.uncertain.name, b.factors.*r.uncertain.member, bounds_text(r));
    for (const Setting& setting : settings) {
      if (!setting.key.starts_with(circuit_of(b))) continue;
      const std::string key = setting.key.substr(circuit_of(b).size());
      if (std::ranges::none_of(b.resistances, [&](const auto& r) { return r.uncertain.name == key; }))
        text += setting_text(key, setting.value, folder);
    }
  }
  return text;
}

std::string calibration_text(const std::vector<CalibratedBearing>& bearings) {
  std::string text;
  for (const auto& b : bearings) {
    text += fmt::format(
        "{}: error of the circuit's responses, rms {:.3g} % -> {:.3g} %, largest {:.3g} % -> {:.3g} %: the fit removes "
        "{:.0f} %\n",
        b.name, 100. * b.before.rms, 100. * b.after.rms, 100. * b.before.largest, 100. * b.after.largest,
        100. * (1. - b.after.rms / b.before.rms));
    if (b.elements_error > aimed_response)
      text += fmt::format(
          "    The modes of the finite elements answer heat with an error of up to {:.2g} %: differences below are no "
          "closer than that.\n",
          100. * b.elements_error);
    for (const auto& [node, e] : b.nodes)
      text += fmt::format("    {:<12} rms {:8.3f} % -> {:8.3f} %   largest {:8.3f} % -> {:8.3f} %\n", node,
                          100. * e[0].rms, 100. * e[1].rms, 100. * e[0].largest, 100. * e[1].largest);
    for (const auto& r : b.resistances)
      text += fmt::format("    factor {:<10} {:6.3f}   rms {:6.3f} % without it   {}\n", r.uncertain.name,
                          b.factors.*r.uncertain.member, 100. * r.rms_without, bounds_text(r));
    if (const auto* most = b.carrier())
      text += fmt::format("    Of the error that the fit removes, {} carries most (factor {} = {:.3f}).\n",
                          most->uncertain.words, most->uncertain.name, b.factors.*most->uncertain.member);
    for (const auto& r : b.resistances)
      if (r.is_at_lowest || r.is_at_highest)
        text += fmt::format(
            "    The factor {} is at its {} bound, {:.3g}: the error that is left is not one of this resistance, but "
            "of "
            "what one node per body cannot represent.\n",
            r.uncertain.name, r.is_at_lowest ? "lower" : "upper",
            r.is_at_lowest ? r.uncertain.lowest : r.uncertain.highest);
  }
  return text;
}

}  // namespace rotordrop
