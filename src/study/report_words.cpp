#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "base/version.h"
#include "io/parameter_writers.h"
#include "io/recorder.h"
#include "io/sha256.h"
#include "machine/rotor_report.h"
#include "study/report.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

/// One `key = value` of parameters.toml.
struct Assignment {
  std::string section, key, value;
  bool is_default = false;
};

std::vector<Assignment> assignments_of(const std::filesystem::path& file) {
  std::vector<Assignment> list;
  std::ifstream stream(file);
  std::string section;
  std::map<std::string, int> count;
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("[[")) {
      section = line.substr(2, line.find("]]") - 2);
      section += fmt::format("[{}]", count[section]++);
    } else if (line.starts_with("[")) {
      section = line.substr(1, line.find(']') - 1);
    } else if (const auto equals = line.find(" = "); equals != std::string::npos) {
      Assignment a{section, line.substr(0, equals), line.substr(equals + 3), false};
      for (const char* mark : {"  # default", "  # from "})
        if (const auto at = a.value.rfind(mark); at != std::string::npos) {
          a.is_default |= std::string(mark) == "  # default";
          a.value.resize(at);
        }
      list.push_back(std::move(a));
    }
  }
  return list;
}

std::string shortened(const std::string& text, std::size_t length) {
  return text.size() <= length ? text : text.substr(0, length) + " … (in parameters.toml)";
}

/// "2.0 rad/s" and 2.0 of a parameter in rad/s as number and unit; a value that begins with no number as it is.
std::string normalised(std::string text, const std::string& unit) {
  if (text.size() > 1 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (end == text.c_str()) return text;
  std::string rest(end);
  if (!rest.empty() && rest.front() != ' ') return text;
  if (rest.empty() && !unit.empty() && unit != "1") rest = " " + unit;
  return fmt::format("{:.6g}{}", number, rest);
}

using Path = std::vector<std::string>;

const Declaration* found_in(const SectionDeclaration& section, const Path& path, std::size_t at) {
  if (at >= path.size()) return nullptr;
  const Declaration* d = section.find(path[at]);
  if (!d || at + 1 == path.size()) return d;
  const bool is_named = d->kind == Declaration::Kind::tables;
  if (d->nested) return found_in(*d->nested, path, at + (is_named ? 2 : 1));
  for (const auto& variant : d->variants)
    if (const auto* found = found_in(*variant.section, path, at + 2)) return found;
  return nullptr;
}

const Declaration* declaration_of(const std::vector<ErasedSection>& sections, const std::string& name) {
  Path path;
  std::istringstream stream(name);
  for (std::string part; std::getline(stream, part, '.');) path.push_back(part.substr(0, part.find('[')));
  for (const auto& section : sections) {
    const bool is_top = section->name.empty();
    if (!is_top && section->name != path[0]) continue;
    if (const auto* found = found_in(*section, path, is_top ? 0 : 1)) return found;
  }
  return nullptr;
}

std::string driver_words(const std::string& driver) {
  if (driver == "lumped") return "the lumped thermal circuit";
  if (driver == "fe") return "the finite elements";
  if (driver == "recorded") return "growth that an earlier run recorded";
  return "nothing: thermal growth is computed, if at all, but not felt";
}

std::string bearing_words(const std::string& name, const TouchdownParameters& b, const ContactParameters& contact) {
  return fmt::format(
      "{} is a touchdown bearing at the rotor's node {}: {} row{} of {} {} balls of {:.4g} mm on a pitch diameter of "
      "{:.4g} mm, contact angle {:.3g}°, {}; radial air gap {:.4g} µm.",
      name, b.node, b.rows, b.rows == 1 ? "" : "s", b.balls_per_row, b.ball, b.ball_diameter * 1e3,
      b.pitch_diameter * 1e3, b.contact_angle * 180. / std::numbers::pi,
      b.preload > 0. ? fmt::format("preload {:.4g} N", b.preload)
                     : fmt::format("radial clearance {:.3g} µm", b.radial_clearance * 1e6),
      air_gap(b, contact) * 1e6);
}

}  // namespace

Json report_words(const RecordedDrop& drop) {
  const auto& p = drop.parameters();
  const RotorReport rotor = rotor_report(p.rotor);
  Json words = Json::array();
  const auto touchdown = drop.bearings();
  words.push_back(fmt::format(
      "A rotor of {:.4g} kg (polar inertia {:.3g} kg m², diametral {:.4g} kg m²) turns at {:.6g} rpm {} {:.6g} ms are "
      "computed, at an ambient temperature of {:.2f} K.",
      rotor.body.mass, rotor.body.Ip, rotor.body.Id, p.run.initial_speed * 30. / std::numbers::pi,
      touchdown.empty() ? "on linear supports." : "and drops onto its touchdown bearings.", p.run.end_time * 1e3,
      p.run.ambient));
  for (const auto& entry : p.bearings)
    if (const auto* b = entry.touchdown())
      words.push_back(bearing_words(entry.name, *b, p.contact));
    else
      words.push_back(fmt::format("{} is a linear support at the rotor's node {}.", entry.name, entry.node()));
  if (!touchdown.empty()) {
    words.push_back(fmt::format("Rotor and inner rings rub with a friction coefficient of {:.3g}.",
                                p.contact.friction_coefficient));
    words.push_back(fmt::format("Thermal models: {}{}{}. The clearances follow {}.",
                                p.thermal.has_lumped ? "lumped circuit" : "",
                                p.thermal.has_lumped && p.thermal.has_fe ? " and " : "",
                                p.thermal.has_fe ? "axisymmetric finite elements" : "", driver_words(drop.driver())));
  }
  return words;
}

Json report_assumptions(const RecordedDrop& drop) {
  const auto& p = drop.parameters();
  Json list = Json::array();
  list.push_back(fmt::format("The rotor is a Timoshenko beam with gyroscopic effect ({}), without axial motion.",
                             p.rotor.model == RotorRepresentation::modal
                                 ? fmt::format("free-free modes up to {:.4g} Hz, damping ratio {:.3g}",
                                               p.rotor.cut_off_frequency, p.rotor.modal_damping)
                             : p.rotor.model == RotorRepresentation::full ? std::string("all degrees of freedom")
                                                                          : std::string("rigid")));
  if (drop.bearings().empty()) return list;
  list.push_back(fmt::format(
      "Rotor and inner ring touch by a Hunt-Crossley law with exponent {:.4g} that never pulls; friction is Coulomb's, "
      "smoothed below {:.3g} m/s.",
      p.contact.exponent, p.contact.regularisation_speed));
  list.push_back("Inner rings move radially and spin; the outer ring moves with its support.");
  for (const auto& [name, b] : drop.bearings())
    list.push_back(fmt::format("{}: load-dependent friction of the {} load; heat inside the bearing is {}.", name,
                               b.load_law == FrictionLoadLaw::radial ? "radial" : "equivalent (preload included)",
                               b.internal_heat == InternalHeat::energy_consistent
                                   ? "friction torque times ring speed (energy-consistent)"
                                   : "not only friction torque times ring speed"));
  if (p.thermal.heat_share == HeatShare::constant)
    list.push_back(fmt::format("A constant share of {:.3g} of the rub heat enters the inner ring, the rest the rotor.",
                               p.thermal.share_to_ring));
  else
    list.push_back("The rub heat is shared between ring and rotor by their speeds (Jaeger, Blok).");
  if (p.thermal.has_lumped)
    list.push_back("The lumped circuit has one temperature per body; it says nothing of a surface.");
  if (p.thermal.has_fe)
    list.push_back("The finite elements are axisymmetric: all their temperatures are means around the circumference.");
  list.push_back("The swept arc of the bore is locally far warmer during an impact than any of these temperatures.");
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
  fact("report by", std::string("rotordrop ") + version() + ", revision " + git_revision());
  fact("frame", read_attribute(results, "/", "frame"));
  fact("SHA-256 of results.h5", sha256_of_file(results));
  fact("SHA-256 of parameters.toml", sha256_of_file(parameters));

  const auto sections = case_sections();
  Json given = Json::array();
  std::size_t n_defaults = 0;
  for (const auto& a : assignments_of(parameters)) {
    if (a.is_default) {
      ++n_defaults;
      continue;
    }
    const std::string name = a.section.empty() ? a.key : a.section + "." + a.key;
    const Declaration* d = declaration_of(sections, name);
    const std::string unit = d ? d->unit : "";
    const std::string fallback = d && d->fallback ? normalised(shortened(toml_value(*d->fallback), 40), unit) : "—";
    const std::string value = normalised(shortened(a.value, 60), unit);
    if (fallback == value) continue;
    given.push_back({name, value, fallback, d ? d->help : "", d ? d->source : ""});
  }
  return {{"facts", facts}, {"given", given}, {"n_defaults", n_defaults}};
}

}  // namespace rotordrop
