#include "thermal/thermal_parameters.h"

#include "base/parameters/suggestion.h"

#include <algorithm>
#include <cctype>
#include <set>

namespace rotordrop {
namespace {

Section<ExtraNode> node_section() {
  Section<ExtraNode> s("node", "A node added to the circuit.");
  s.text("name", &ExtraNode::name,
         {.help = "Unique name; the built-in nodes are BEARING/shaft, /inner_ring, /inner_contact, /ball, "
                  "/outer_contact, /outer_ring, /housing, and of a fin /shaft_left_1, /shaft_right_1, ..."});
  s.quantity("capacity", &ExtraNode::capacity,
             {.unit = "J/K", .range = at_least(0), .help = "Heat capacity; 0 for a massless node."});
  return s;
}

Section<ExtraResistor> resistor_section() {
  Section<ExtraResistor> s("resistor", "A resistor added to the circuit.");
  s.custom(
      "between",
      {.accepts = "two node names",
       .json_types = {"array"},
       .required = true,
       .help = "The two nodes that it connects; \"ambient\" is the surroundings."},
      [](const Node& node, ExtraResistor& target, Faults& faults) {
        if (node.is_array() && node.items().size() == 2 && node.items()[0].is_text() && node.items()[1].is_text()) {
          target.between = {node.items()[0].text(), node.items()[1].text()};
          return;
        }
        faults.add(node.where(),
                   "thermal.resistor.between must be two node names, such as [\"TB1/housing\", \"ambient\"].");
      });
  s.quantity("resistance", &ExtraResistor::resistance,
             {.unit = "K/W", .range = positive(), .help = "Thermal resistance."});
  return s;
}

}  // namespace

std::string list_of_thermal_models() {
  const auto names = thermal_kind_names();
  std::string text = "a list of ";
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "\"" : i + 1 < names.size() ? ", \"" : " and \"") + names[i] + "\"";
  return text;
}

std::vector<std::string> driver_words() {
  std::vector<std::string> words = {automatic_driver};
  for (const auto& name : thermal_kind_names()) words.push_back(name);
  words.insert(words.end(), {no_driver, recorded_driver});
  return words;
}

bool is_group_of_results(const std::string& name) {
  static const std::set<std::string> taken = {
      // At the root of result files (io, machine/machine_observables.cpp, study/drop/drop_record.cpp).
      "bearings", "rotor", "probes", "growth", "energy", "ledger", "windows", "time", "thermal", "detail", "parameters",
      "given", "inputs",
      // Of a bearing in summary.json (study/drop/summary_json.cpp).
      "first_contact_time", "first_contact_end", "ends_in_first_contact", "first_touch_time", "second_contact_time",
      "peak_contact_force", "peak_contact_force_time", "first_bounce_apex", "peak_friction_heat_rate", "friction_heat",
      "inner_heat", "outer_heat", "catch_up_time", "ring_speed_end", "mean_contact_force_end", "load_torque_peak",
      "spin_torque_peak", "inner_heat_rate_max", "outer_heat_rate_max", "largest_ball_force",
      "largest_contact_pressure", "largest_contact_pressure_time", "static_safety", "rows", "centrifugal_force",
      "ball_model", "preload", "skid", "gyroscopic", "clearance", "axial", "temperature_rise_end", "local", "wear",
      "damage", "shoulder", "whirl", "support", "spin_up"};
  return taken.count(name) != 0;
}

std::vector<std::string> read_thermal_models(const Node& node, const std::string& name, bool may_be_none,
                                             Faults& faults) {
  const auto known = thermal_kind_names();
  std::vector<std::string> given, models;
  bool is_good = node.is_array();
  std::string advice;
  for (const Node& item : is_good ? node.items() : std::vector<Node>{}) {
    const bool is_known = item.is_text() && std::find(known.begin(), known.end(), item.text()) != known.end();
    if (is_known)
      given.push_back(item.text());
    else if (advice.empty() && item.is_text())
      advice = suggestion(item.text(), known);
    is_good = is_good && is_known;
  }
  for (const auto& model : known)
    if (std::find(given.begin(), given.end(), model) != given.end()) models.push_back(model);
  if (!is_good || (models.empty() && !may_be_none))
    faults.add(node.where(),
               name + " must be " + list_of_thermal_models() + ", such as [\"" + known[0] + "\", \"" + known[1] +
                   "\"]" + (may_be_none ? ", or [] for none." : "."),
               advice);
  return models;
}

bool ThermalParameters::runs(const std::string& model) const {
  return std::find(models.begin(), models.end(), model) != models.end();
}

bool ThermalParameters::runs_circuit() const {
  const auto chosen = chosen_kinds(*this);
  return std::any_of(chosen.begin(), chosen.end(), [](const ThermalKind* kind) { return kind->is_circuit; });
}

bool ThermalParameters::runs_sections() const { return section_kind(*this) != nullptr; }

const ThermalKind* section_kind(const ThermalParameters& p) {
  for (const auto* kind : chosen_kinds(p))
    if (kind->meshes_sections) return kind;
  return nullptr;
}

std::vector<const ThermalKind*> chosen_kinds(const ThermalParameters& p) {
  auto kinds = thermal_kinds();
  std::erase_if(kinds, [&](const ThermalKind* kind) { return !p.runs(kind->name); });
  return kinds;
}

std::string driver_of(const ThermalParameters& p) {
  if (!p.growth) return no_driver;
  if (p.driver != automatic_driver) return p.driver;
  const auto chosen = chosen_kinds(p);
  return chosen.empty() ? no_driver : chosen.front()->name;
}

MakeThermalModel maker_of(const ThermalParameters& p, const ThermalKind& kind, Faults& faults) {
  if (const auto given = p.makers.find(kind.name); given != p.makers.end()) return given->second;
  return kind.read ? kind.read(Node::table(), {.path = "thermal." + kind.name}, faults) : kind.make;
}

Section<ThermalParameters> thermal_section() {
  using P = ThermalParameters;
  Section<P> s("thermal", "Lumped thermal circuit of every touchdown bearing.");
  s.custom(
      "models",
      {.accepts = list_of_thermal_models(),
       .json_types = {"array"},
       .fallback = Node::array({Node(thermal_kinds().front()->name)}),
       .help = "Thermal models that run: the lumped circuit, the finite elements, or both on the same heat. []: none; "
               "parts stay at ambient, and friction heat and the rub's local temperatures are still told."},
      [](const Node& node, P& target, Faults& faults) {
        target.models = read_thermal_models(node, "thermal.models", true, faults);
      });
  s.choice("driver", &P::driver, driver_words(),
           {.fallback = automatic_driver,
            .help = "Source of the thermal growth that is fed back: a thermal model, none, or the record of an earlier "
                    "run. automatic: lumped if it runs, otherwise fe, otherwise the first of your own."});
  s.text("recorded", &P::recorded,
         {.help =
              "results.h5 whose recorded growth is fed back with driver = \"recorded\"; a path relative to the case."});
  s.boolean("growth", &P::growth,
            {.fallback = true, .help = "Whether thermal growth is fed back into clearances and ball loads."});
  s.choice("heat_share", &P::heat_share, {{"constant", HeatShare::constant}, {"jaeger", HeatShare::jaeger}},
           {.fallback = "constant",
            .help = "Heat partition between ring and rotor: constant (share_to_ring), or from the surface speeds (Blok "
                    "and Jaeger)."});
  s.quantity("share_to_ring", &P::share_to_ring,
             {.range = between(0, 1),
              .usual = or_zero(between(0.01, 1)),
              .fallback = "0.66",
              .source = "calibration: gives the paper's ratio of ring and shaft rise",
              .help = "Share of the rub heat that enters the inner ring; the rest enters the shaft."});
  s.quantity("rub_band_length", &P::rub_band_length,
             {.unit = "m",
              .range = positive(),
              .usual = between(1e-5, 0.1),
              .fallback = "5.9 mm",
              .source = "estimate: Hertz width of a 35 mm bore on a 34.75 mm rotor at 5 kN",
              .help = "Length of the rub contact along the surface, for the Jaeger partition, and for local "
                      "temperatures if rub_band is fixed."});
  s.quantity("rub_contact_time", &P::rub_contact_time,
             {.unit = "s",
              .range = positive(),
              .usual = between(1e-5, 0.1),
              .fallback = "2.2 ms",
              .source = "estimate: duration of the first contact",
              .help = "Heating time of a stationary surface, for the Jaeger partition."});
  s.choice("rub_band", &P::rub_band, {{"hertz", RubBand::hertz}, {"fixed", RubBand::fixed}},
           {.fallback = "hertz",
            .source = "Johnson, Contact Mechanics (1985), eq. (4.43)",
            .help = "Length of the rub contact for local temperatures: Hertz line contact under the instantaneous "
                    "force, or rub_band_length. The reported bounds include the other choice."});
  s.choice("local_share", &P::local_share,
           {{"one-temperature", LocalShare::one_temperature}, {"as-heated", LocalShare::as_heated}},
           {.fallback = "one-temperature",
            .source = "Blok 1937; Jaeger 1942",
            .help = "Heat partition for local temperatures: equal temperatures of rotor and bore where they touch, or "
                    "the share used by the thermal models. The reported bounds include the other choice. The thermal "
                    "models always use heat_share."});
  s.quantity("h_shaft", &P::h_shaft,
             {.unit = "W/(m2 K)",
              .range = positive(),
              .usual = between(1, 4e3),
              .fallback = "50 W/(m2 K)",
              .source = "estimate",
              .help = "Convection from the shaft."});
  s.quantity("h_ball", &P::h_ball,
             {.unit = "W/(m2 K)",
              .range = positive(),
              .usual = between(1, 4e3),
              .fallback = "50 W/(m2 K)",
              .source = "estimate",
              .help = "Convection from the balls."});
  s.quantity("fit_resistance", &P::fit_resistance,
             {.unit = "K/W",
              .range = at_least(0),
              .usual = or_zero(between(1e-5, 50)),
              .fallback = "0.005 K/W",
              .source = "estimate, of a metal fit",
              .help = "Resistance between outer ring and housing. Estimates: 0.005 K/W of a metal fit, 0.05 to 0.5 K/W "
                      "of an oil film or a ribbon, 1 to 30 K/W of O-rings."});
  s.quantity(
      "contact_half_width", &P::contact_half_width,
      {.unit = "m",
       .range = positive(),
       .usual = between(1e-5, 5e-3),
       .fallback = "0.4 mm",
       .source = "estimate",
       .help =
           "Half width a of the contact spot across the track. It sets the width of the strips on raceways and balls "
           "from which heat spreads and, if contact_conduction is fixed, the balls' constriction resistance."});
  s.choice(
      "contact_conduction", &P::contact_conduction,
      {{"rolling", BallConductionModel::rolling}, {"fixed", BallConductionModel::fixed}},
      {.fallback = "rolling",
       .help = "Conduction between balls and raceways. rolling: from load and rolling speed of the balls, none "
               "without load (docs/theory/model.md, section 6). fixed: the resistance R5 of the published circuit. "
               "`rotordrop heat` takes the load of the balls from heat.ball_load (the fixed resistance without it); "
               "`calibrate` uses the fixed resistance."});
  s.quantity(
      "oil_film", &P::oil_film,
      {.unit = "m",
       .range = between(0, 1e-5),
       .usual = or_zero(between(1e-8, 3e-6)),
       .fallback = "0 um",
       .help = "Thickness of the oil film between balls and raceways through which rolling contacts conduct; 0: dry. "
               "0.1 um cuts the conductance to about a third."});
  s.quantity("oil_conductivity", &P::oil_conductivity,
             {.unit = "W/(m K)",
              .range = positive(),
              .usual = between(0.02, 2),
              .fallback = "0.14 W/(m K)",
              .source = "mineral oil at ambient pressure",
              .help = "Thermal conductivity of the oil film."});
  s.choice(
      "ball_track", &P::ball_track, {{"repeating", BallTrack::repeating}, {"wandering", BallTrack::wandering}},
      {.fallback = "repeating",
       .help = "Track of the contacts on a rolling ball, which sets the resistance between track and ball. repeating: "
               "always the same circle. wandering: the ball's axis wanders, so that its whole surface is heated."});
  s.choice(
      "spreading", &P::spreading, {{"strip", RacewaySpreading::strip}, {"none", RacewaySpreading::none}},
      {.fallback = "strip",
       .help = "Heat spreading in R4 and R7. strip: they include the resistance of heat that spreads from the balls' "
               "strips over the rings' width. none: raceways are uniformly heated cylinders (the published circuit)."});
  s.choice("shaft", &P::shaft, {{"fin", ShaftModel::fin}, {"lump", ShaftModel::lump}},
           {.fallback = "fin",
            .help = "Thermal model of the shaft. fin: it conducts to both sides of its lump with the rotor's diameters "
                    "and convection h_shaft along its surface, up to the rotor's end or half-way to the next touchdown "
                    "bearing. lump: only a lump of shaft_lump_length (the published circuit)."});
  s.choice("shaft_ring_link", &P::shaft_ring_link,
           {{"permanent", BearingCircuitData::Link::permanent}, {"in-contact", BearingCircuitData::Link::in_contact}},
           {.fallback = "permanent",
            .source = "Neisi, Heikkinen & Sopanen 2019, fig. 6",
            .help = "permanent: shaft and inner ring always conduct to each other (the paper's circuit). in-contact: "
                    "across the air gap while they do not touch."});
  s.quantity("gas_conductivity", &P::gas_conductivity,
             {.unit = "W/(m K)",
              .range = positive(),
              .usual = between(0.005, 0.5),
              .fallback = "0.026 W/(m K)",
              .source = "air at 20 degC",
              .help = "Conductivity of the gas in the air gap."});
  s.boolean(
      "plane_strain_growth", &P::plane_strain_growth,
      {.fallback = false,
       .help = "true: growth times 1 + nu, as if axial growth were prevented (plane strain). false: free rings. With "
               "expansion = \"paper\"."});
  s.choice("expansion", &P::expansion,
           {{"formula", GrowthSource::formula}, {"paper", GrowthSource::paper}, {"elastic", GrowthSource::elastic}},
           {.fallback = "formula",
            .help = "Growth of the rings. \"formula\": radial and axial growth of free rings at the ball contacts, "
                    "from mean temperatures. \"paper\": radial growth of the shoulders, as in Neisi (2019); uniform "
                    "heating of a bearing made of one material then changes its preload. \"elastic\": elasticity of "
                    "the meshed section, including the housing fit and the inner ring's centrifugal growth; the "
                    "circuit still uses the formulas (docs/theory/growth.md)."});
  s.choice("growth_by_speed", &P::growth_by_speed,
           {{"closed-form", GrowthBySpeed::closed_form}, {"none", GrowthBySpeed::none}},
           {.fallback = "closed-form",
            .source = "Timoshenko & Goodier, rotating disk with a hole, plane stress",
            .help = "Centrifugal growth of the inner rings and of the rotor surface, in drops and in `rotordrop "
                    "preload`. \"closed-form\": spinning rings of rectangular section, a solid or hollow shaft; with "
                    "expansion = \"elastic\" and growth driver fe, the rings' growth comes from the elasticity of "
                    "their section. Independent of the source of thermal growth, but with driver = \"recorded\" "
                    "nothing is added to the growth that the earlier run recorded."});
  s.table(fe_name, &P::fe, fe_section(), {.help = "Finite elements of every touchdown bearing."});
  for (const auto* kind : thermal_kinds())
    if (kind->section)
      s.table(kind->name, kind->section,
              [kind](const Node& table, const ReadContext& here, P& target, Faults& faults) {
                target.makers[kind->name] = kind->read(table, here, faults);
              },
              {.help = "Keys of the thermal model \"" + kind->name + "\": " + kind->title + "."});
  s.list("node", &P::nodes, node_section(), {.help = "Additional nodes."});
  s.list("resistor", &P::resistors, resistor_section(), {.help = "Additional resistors."});
  return s;
}

void add_extra_parts(const ThermalParameters& parameters, const Node& table, ThermalNetworkData& network,
                     Faults& faults) {
  std::vector<std::string> names = {ambient_node};
  for (const auto& node : network.nodes) names.push_back(node.name);
  const auto known = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  // Place of a key of the k-th table of a list.
  const auto place = [&](const char* list, std::size_t k, const char* key) {
    const Node* found = table.find(list);
    return found && found->is_array() && k < found->items().size() ? position_of_value(found->items()[k], key)
                                                                   : position_of(table, list);
  };
  for (std::size_t k = 0; k < parameters.nodes.size(); ++k) {
    const auto& node = parameters.nodes[k];
    // Names become paths in results: "TB1/flange" or "frame".
    const bool is_good =
        std::all_of(node.name.begin(), node.name.end(),
                    [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-' || c == '/'; }) &&
        !node.name.empty() && node.name.front() != '/' && node.name.back() != '/' &&
        node.name.find("//") == std::string::npos;
    const bool hides = std::any_of(names.begin(), names.end(), [&](const std::string& other) {
      return other.starts_with(node.name + "/") || node.name.starts_with(other + "/");
    });
    if (!is_good || hides)
      faults.add(place("node", k, "name"), "thermal.node cannot be called \"" + node.name + "\".",
                 hides ? "It is part of another node's name." : "Use letters, digits, _ and -, and / between parts.");
    if (known(node.name))
      faults.add(place("node", k, "name"), "thermal.node: the name \"" + node.name + "\" is taken.",
                 "Choose another name.");
    names.push_back(node.name);
    network.nodes.push_back({node.name, node.capacity, "node \"" + node.name + "\" of the parameter file"});
  }
  for (std::size_t k = 0; k < parameters.resistors.size(); ++k) {
    const auto& resistor = parameters.resistors[k];
    bool complete = true;
    for (const auto& name : resistor.between)
      if (!known(name)) {
        complete = false;
        faults.add(place("resistor", k, "between"), "thermal.resistor: there is no node \"" + name + "\".",
                   suggestion(name, names));
      }
    if (resistor.between[0] == resistor.between[1])
      faults.add(place("resistor", k, "between"), "thermal.resistor joins \"" + resistor.between[0] + "\" with itself.",
                 "Name two different nodes.");
    if (complete)
      network.resistors.push_back({resistor.between[0], resistor.between[1], resistor.resistance,
                                   ThermalNetworkData::Law::constant, 0., 0., 0});
  }
  // A point without mass has a temperature only if resistors lead from it to a node with capacity or to the surroundings.
  std::vector<std::string> reached = {ambient_node};
  for (const auto& node : network.nodes)
    if (node.capacity > 0.) reached.push_back(node.name);
  const auto is_reached = [&](const std::string& name) {
    return std::find(reached.begin(), reached.end(), name) != reached.end();
  };
  for (bool grows = true; grows;) {
    grows = false;
    for (const auto& r : network.resistors)
      if (is_reached(r.between) != is_reached(r.and_node)) {
        reached.push_back(is_reached(r.between) ? r.and_node : r.between);
        grows = true;
      }
  }
  for (std::size_t k = 0; k < parameters.nodes.size(); ++k)
    if (const auto& name = parameters.nodes[k].name; !is_reached(name))
      faults.add(place("node", k, "capacity"),
                 "thermal.node \"" + name + "\" has no capacity, and no resistor leads from it to a node that has.",
                 "Give it a capacity, or a resistor to the rest of the circuit.");
}

}  // namespace rotordrop
