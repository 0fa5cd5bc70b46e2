#include "machine/machine_parameters.h"

#include "base/parameters/suggestion.h"
#include "base/parameters/value_reader.h"
#include "model/material_keys.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>

#include "model/run_warning.h"

namespace rotordrop {

namespace {

constexpr std::array<std::pair<const char*, EndCondition>, 3> end_conditions = {
    {{"standstill", EndCondition::standstill},
     {"no contact", EndCondition::no_contact},
     {"rings at speed", EndCondition::rings_at_speed}}};

void read_until(const Node& node, RunParameters& target, Faults& faults) {
  if (node.is_text()) {
    std::vector<std::string> known;
    for (const auto& [name, condition] : end_conditions) {
      known.emplace_back(name);
      if (node.text() == name) {
        target.until = condition;
        return;
      }
    }
    const std::string& text = node.text();
    if (std::none_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c); })) {
      faults.add(node.where(), "run.until = \"" + text + "\" is neither a condition nor a time.",
                 suggestion(text, known,
                            "Allowed: \"standstill\", \"no contact\", \"rings at speed\", or a time such as \"2 s\"."));
      return;
    }
  }
  target.until_time = read_quantity(node, {.unit = "s", .range = positive()}, "run.until", faults);
}

void read_fatal_warnings(const Node& node, RunParameters& target, Faults& faults) {
  std::vector<std::string> known{"all"};
  for (const auto& kind : warning_kinds) known.emplace_back(kind.code);
  if (!node.is_array()) {
    faults.add(node.where(), "run.fatal_warnings must be a list of codes.", "Such as [\"energy-residual\"].");
    return;
  }
  for (const Node& item : node.items())
    if (!item.is_text() || std::find(known.begin(), known.end(), item.text()) == known.end())
      faults.add(item.where(), "run.fatal_warnings: no warning is called " + to_text(item) + ".",
                 suggestion(item.is_text() ? item.text() : "", known));
    else
      target.fatal_warnings.push_back(item.text());
}

void check_until(const RunParameters& p, const Node& table, Faults& faults) {
  if (p.until_time && *p.until_time > p.end_time)
    faults.add(position_of_value(table, "until"), "run.until is later than run.end_time, the latest end of the run.",
               "Raise run.end_time; only a run.until that comes first has an effect.");
  if (p.until == EndCondition::standstill && std::fabs(p.initial_speed) < standstill_speed)
    faults.add(
        position_of_value(table, "until"),
        "run.until = \"standstill\", but the rotor already stands at the start: run.initial_speed is below 1 rad/s.",
        "Give a higher run.initial_speed, or end the run at a time.");
}

}  // namespace

bool RunParameters::is_fatal(std::string_view code) const {
  return std::any_of(fatal_warnings.begin(), fatal_warnings.end(),
                     [&](const auto& named) { return named == code || named == "all"; });
}

std::string name_of(EndCondition condition) {
  for (const auto& [name, known] : end_conditions)
    if (known == condition) return name;
  return "";
}

Section<RunParameters> run_section() {
  using P = RunParameters;
  Section<P> s("run", "Initial speed, duration and surroundings of the drop.");
  s.quantity("end_time", &P::end_time,
             {.unit = "s",
              .range = positive(),
              .usual = between(1e-5, 1e4),
              .fallback = "0.3 s",
              .source = "Neisi, Heikkinen & Sopanen 2019",
              .help = "Simulated time; with run.until the latest end of the run."});
  s.custom(
      "until",
      {.accepts = "\"standstill\", \"no contact\", \"rings at speed\", or a time",
       .json_types = {"string", "number"},
       .help = "Condition that ends the run before run.end_time. standstill: the rotor's spin speed falls below 1 "
               "rad/s. no "
               "contact: after a contact, the rotor has touched no inner ring, in its bore or with a shoulder, for 0.1 "
               "s, longer than any bounce. "
               "rings at speed: the bores of all inner rings run within 1 % of the rotor's surface speed. The run "
               "ends with the step in which this first holds."},
      read_until);
  s.quantity("initial_speed", &P::initial_speed,
             {.unit = "rad/s",
              .range = between(-2e5, 2e5),
              .usual = between(-6500, 6500),
              .help = "Spin speed of the rotor when levitation is lost; positive from +y towards +z. No formula has a "
                      "bound of its own; what limits it is the surface speed, above 400 m/s of which `check` warns."});
  s.custom("gravity",
           {.unit = "m/s2",
            .accepts = "a number (along -y), or [x, y, z]",
            .json_types = {"number", "string", "array"},
            .fallback = Node(9.81),
            .source = "standard",
            .help = "Gravitational acceleration of rotor and inner rings. A single number acts along -y. The x "
                    "component acts on a rotor with "
                    "axial_motion = \"free\" and on inner rings with ring_motion = \"free\"."},
           [](const Node& node, P& target, Faults& faults) {
             const Quantity along_axis{.unit = "m/s2", .range = between(-1e3, 1e3)};
             const Quantity downwards{.unit = "m/s2",
                                      .range = between(0, 1e3)};  // upwards only as a vector, not by a slip of sign
             if (node.is_array()) {
               if (const auto xyz = read_quantities(node, along_axis, 3, 3, "run.gravity", faults))
                 target.gravity = {(*xyz)[0], (*xyz)[1], (*xyz)[2]};
             } else if (const auto down = read_quantity(node, downwards, "run.gravity", faults)) {
               target.gravity = {0., -*down, 0.};
             }
           });
  s.quantity("ambient", &P::ambient,
             {.unit = "K",
              .range = between(60, 2000),
              .usual = between(200, 500),
              .fallback = "293.15 K",
              .source = "estimate: the paper's plots start near 293 K",
              .help = "Temperature of the surroundings and of everything at the start."});
  s.custom("parts",
           {.accepts = "a list of files",
            .json_types = {"array"},
            .help = "Modules with supports and thermal models of others, shared objects that are loaded when the case "
                    "is read (docs/how-to/extending.md). A name without a folder means a file beside the case, or in "
                    "the folder of the program's modules. Loading a module runs its code: name only those you trust."},
           [](const Node& node, P& target, Faults& faults) {
             bool is_good = node.is_array();
             if (is_good)
               for (const Node& file : node.items()) {
                 is_good = is_good && file.is_text() && !file.text().empty();
                 if (is_good) target.parts.push_back(file.text());
               }
             if (!is_good) faults.add(node.where(), "run.parts must be a list of files, such as [\"snubber.so\"].");
           });
  s.custom(
      "fatal_warnings",
      {.accepts = "a list of codes, such as [\"energy-residual\"], or [\"all\"]",
       .json_types = {"array"},
       .fallback = Node::array({}),
       .help = "Warnings of the run (`warnings` in summary.json, docs/reference/warnings.md) that make it fail: at "
               "the instant of a warning that is watched in time, at the end of the run for the others."},
      read_fatal_warnings);
  s.boolean(
      "second_opinion", &P::second_opinion,
      {.fallback = false,
       .help = "Whether `rotordrop run` computes the drop again when it is done, to tell by how much its numbers "
               "differ: the first impacts with a tenth of the tolerance and half the longest step, and two drops "
               "that start 1 nm higher and lower. Takes somewhat more than twice the drop's own time, and no memory "
               "on disk. Studies and `rerun` leave it out."});
  s.check(check_until);
  return s;
}

Section<MaterialParameters> material_section() {
  Section<MaterialParameters> s("material", "A material of rings, balls, housing and shaft.");
  add_material_keys(s, 10.);
  s.quantity("temperature_limit", &MaterialParameters::temperature_limit,
             {.unit = "K",
              .range = positive(),
              .usual = between(320, 2000),
              .help = "Temperature up to which parts of a bearing, or the rotor under it (`journal`), keep their "
                      "hardness and dimensions. A run in which rings, balls or the rotor under a bearing whose journal "
                      "is given exceed it warns; without it nothing is assessed. Built in: steel 150 degC (rings "
                      "stabilised as S0, bearing catalogues), Si3N4 800 degC (estimate: strength falls above)."});
  return s;
}

Node default_materials() {
  return Node::table({{"steel", Node::table({{"E", 2.0e11},
                                             {"nu", 0.30},
                                             {"rho", 7800.},
                                             {"k", 70.},
                                             {"c", 510.},
                                             {"alpha", 11.8e-6},
                                             {"temperature_limit", 423.15}})},
                      {"Si3N4", Node::table({{"E", 3.15e11},
                                             {"nu", 0.26},
                                             {"rho", 3200.},
                                             {"k", 35.},
                                             {"c", 673.},
                                             {"alpha", 3.2e-6},
                                             {"temperature_limit", 1073.15}})}});
}

const Node& table_of(const Node& case_node, const char* section) {
  static const Node empty = Node::table();
  const Node* found = case_node.find(section);
  return found ? *found : empty;
}

const MaterialParameters* find_material(const MachineParameters& p, const std::string& name) {
  for (const auto& [known, material] : p.materials)
    if (known == name) return &material;
  return nullptr;
}

const MaterialParameters& material_of(const MachineParameters& p, const std::string& name) {
  if (const auto* material = find_material(p, name)) return *material;
  throw std::invalid_argument("no material is called " + name);
}

std::vector<std::string> touchdown_names(const MachineParameters& p) {
  std::vector<std::string> names;
  for (const auto& entry : p.bearings)
    if (entry.touchdown()) names.push_back(entry.name);
  return names;
}

const TouchdownParameters& touchdown_of(const MachineParameters& p, const std::string& name) {
  for (const auto& entry : p.bearings)
    if (entry.name == name && entry.touchdown()) return *entry.touchdown();
  throw std::invalid_argument("no touchdown bearing is called " + name);
}

MachineParameters with_single_bearing(MachineParameters p, const std::string& name) {
  for (const auto& entry : p.bearings)
    if (entry.touchdown() && entry.name != name) p.single.neighbours.push_back(entry.node());
  std::erase_if(p.bearings, [&](const SupportEntry& entry) { return entry.name != name; });
  return p;
}

}  // namespace rotordrop
