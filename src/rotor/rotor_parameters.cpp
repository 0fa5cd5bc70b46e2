#include "rotor/rotor_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace rotordrop {

namespace {

void read_geometry_key(const Node& node, RotorParameters& target, Faults& faults) {
  target.geometry_position = node.where();
  if (node.is_text())
    target.geometry_file = node.text();
  else if (node.is_table())
    target.geometry = read_rotor_geometry(node, faults);
  else
    faults.add(node.where(), fmt::format("rotor.geometry is {}, not the name of a file or a table.", kind_name(node)),
               "Write geometry = \"rotor.json\", or give nodes, elements and material in [rotor.geometry].");
}

/// "G2.5", in mm/s.
void read_balance_grade(const Node& node, RotorParameters& target, Faults& faults) {
  const std::string text = node.is_text() ? node.text() : "";
  const auto number = text.find_first_not_of(' ', 1);
  double grade = 0.;
  if (text.starts_with('G') && number != std::string::npos) {
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data() + number, end, grade);
    if (error == std::errc() && stop == end && grade > 0. && std::isfinite(grade)) {
      target.balance_grade = 1e-3 * grade;
      return;
    }
  }
  faults.add(node.where(),
             fmt::format("rotor.balance_grade = {} is not a balance grade.",
                         node.is_text() ? fmt::format("\"{}\"", text) : to_text(node)),
             (node.is_number() ? fmt::format("Did you mean \"G{}\"?  ", to_text(node)) : "") +
                 "Write G and e_per omega in mm/s, such as \"G2.5\" (ISO 21940-11).");
}

void read_balance_planes(const Node& node, RotorParameters& target, Faults& faults) {
  std::vector<int> planes;
  bool is_good = node.is_array() && (node.items().size() == 1 || node.items().size() == 2);
  if (is_good)
    for (const Node& item : node.items()) {
      is_good = is_good && item.is(Node::Kind::integer) && item.integer() >= 1 &&
                item.integer() <= std::numeric_limits<int>::max();
      if (is_good) planes.push_back(static_cast<int>(item.integer()));
    }
  if (is_good && planes.size() == 2) is_good = planes[0] != planes[1];
  if (!is_good) {
    faults.add(node.where(), "rotor.balance_planes must be one node or two different nodes, such as [2, 28].",
               "Nodes are numbered from 1.");
    return;
  }
  target.balance_planes = planes;
}

void check_inline_geometry(const RotorParameters& parameters, const Node& table, Faults& faults) {
  if (parameters.geometry_file.empty()) check_against_geometry(parameters, parameters.geometry, table, faults);
}

}  // namespace

Section<RotorParameters> rotor_section() {
  Section<Unbalance> unbalance("unbalance", "An unbalance mass whose centrifugal force rotates with the rotor.");
  unbalance.integer("node", &Unbalance::node, {.range = at_least(1), .help = "Node at which it acts."})
      .quantity("me", &Unbalance::me,
                {.unit = "kg m",
                 .range = at_least(0),
                 .usual = at_most(0.1),
                 .help = "Mass times eccentricity; 1e-6 kg m is one gram millimetre."})
      .quantity("angle", &Unbalance::angle,
                {.unit = "rad", .fallback = "0 deg", .help = "Angular position at spin angle 0, from +y towards +z."});

  Section<InitialOrbit> orbit("initial_orbit", "Circular orbit of the whole rotor at the start.");
  orbit
      .quantity("radius", &InitialOrbit::radius,
                {.unit = "m",
                 .range = at_least(0),
                 .usual = at_most(0.01),
                 .fallback = "0 m",
                 .help = "Orbit radius, added to the initial position."})
      .quantity("angle", &InitialOrbit::angle,
                {.unit = "rad",
                 .fallback = "0 deg",
                 .help = "Angular position on the orbit at the start, from +y towards +z."})
      .quantity("speed", &InitialOrbit::speed,
                {.unit = "rad/s",
                 .fallback = "0 rpm",
                 .help = "Whirl speed; positive is in the direction of positive spin. The initial velocity is radius "
                         "times this."});

  Section<RotorParameters> section("rotor", "The flexible rotor and its initial state.");
  section
      .custom("geometry",
              {.accepts = "name of a JSON or TOML file, or a table",
               .json_types = {"string", "object"},
               .required = true,
               .help = "Nodes, elements, material and mass points; a file's name is relative to this file."},
              read_geometry_key)
      .choice("model", &RotorParameters::model,
              {{"modal", RotorRepresentation::modal},
               {"full", RotorRepresentation::full},
               {"rigid", RotorRepresentation::rigid}},
              {.fallback = "modal",
               .source = "trial model: peak force +34 % rigid, +11 % with 1 kHz, 0.7 % with 5 kHz, all against full",
               .help = "modal: free-free modes up to cut_off_frequency. full: all modes, exact, some three times "
                       "slower. rigid: no bending modes."})
      .quantity("cut_off_frequency", &RotorParameters::cut_off_frequency,
                {.unit = "Hz",
                 .range = at_least(0),
                 .usual = between(100, 1e5),
                 .fallback = "4500 Hz",
                 .help = "Highest mode frequency kept with model = \"modal\". More modes soften the first impact and "
                         "shorten the time step, up to integration.exponential_above."})
      .boolean(
          "residual_flexibility", &RotorParameters::residual_flexibility,
          {.fallback = false,
           .source = "off: the modes it adds take the settling reference drop from 112 000 to 146 000 right-hand sides",
           .help =
               "For model = \"modal\": one more mode per bearing station and plane, above the cut-off, that keeps "
               "the static flexibility of the modes left out: peak forces within 0.15 % of those of \"full\" instead "
               "of 0.5 to 0.9 %."})
      .quantity("modal_damping", &RotorParameters::modal_damping,
                {.range = between(0, 0.2),
                 .usual = or_zero(between(1e-4, 0.1)),
                 .fallback = "0.005",
                 .source = "estimate for a steel rotor with shrunk-on laminations",
                 .help = "Damping ratio of every flexible free-free mode."})
      .quantity("mass_proportional_alpha", &RotorParameters::mass_proportional_alpha,
                {.unit = "1/s",
                 .range = at_least(0),
                 .usual = or_zero(between(0.1, 300)),
                 .fallback = "0 1/s",
                 .help = "Mass-proportional damping. It also damps rigid-body motion, as if the rotor fell through "
                         "oil: bounces decay sooner and the fall takes longer."})
      .list("unbalance", &RotorParameters::unbalance, unbalance, {.help = "Unbalances; none if omitted."})
      .custom("balance_grade",
              {.accepts = "G and a number, such as \"G2.5\"",
               .json_types = {"string"},
               .help = "Balance grade of ISO 21940-11, instead of unbalance: the rotor gets the permissible unbalance "
                       "of its mass times e_per = G / balance_speed, G in mm/s, in its balance_planes. `check` shows "
                       "it."},
              read_balance_grade)
      .quantity("balance_speed", &RotorParameters::balance_speed,
                {.unit = "rad/s",
                 .range = positive(),
                 .help = "Speed for which the balance grade is, the highest in service; run.initial_speed if not "
                         "given."})
      .custom("balance_planes",
              {.accepts = "one or two nodes",
               .json_types = {"array"},
               .help = "Nodes at which the unbalance of the balance grade acts: all of it at one, or parts at two by "
                       "the lever about the centre of gravity, which must lie between them. The outermost bearings "
                       "if not given."},
              read_balance_planes)
      .quantities("balance_angles", &RotorParameters::balance_angles,
                  {.unit = "rad",
                   .fallback = {"0 deg", "0 deg"},
                   .help = "Angular positions of both planes' unbalances at spin angle 0, from +y towards +z. Equal: a "
                           "static unbalance at the centre of gravity; 180 deg apart: a couple, "
                           "and what the planes' shares differ by."})
      .function("torque", &RotorParameters::torque,
                {.unit = "N m",
                 .argument_unit = "s",
                 .fallback = {{{"0 s", "0 N m"}}},
                 .help = "Motor (positive) or brake (negative) torque on the rotor: [time, torque] pairs, linear "
                         "between them, constant before and after. A constant brake torque drives a stopped rotor "
                         "backwards: end the table with 0."})
      .table("windage", &RotorParameters::windage, windage_section(),
             {.help = "Friction of the rotor in the surrounding gas; none if omitted."})
      .choice("axial_motion", &RotorParameters::axial_motion,
              {{"locked", AxialFreedom::locked}, {"free", AxialFreedom::free}},
              {.fallback = "locked",
               .help = "Whether the rotor can move axially, as a rigid body. \"free\" requires ring_motion = \"free\" "
                       "for its touchdown bearings."})
      .function("axial_force", &RotorParameters::axial_force,
                {.unit = "N",
                 .argument_unit = "s",
                 .fallback = {{{"0 s", "0 N"}}},
                 .help = "Axial force along +x on an axially free rotor, such as process thrust: [time, force] pairs, "
                         "linear between, constant before and after."})
      .quantities("initial_offset", &RotorParameters::initial_offset,
                  {.unit = "m",
                   .usual = between(-0.01, 0.01),
                   .fallback = {"0 m", "0 m"},
                   .help = "Offset (y, z) of the centre of gravity from the straight line through both ring centres."})
      .quantities("initial_tilt", &RotorParameters::initial_tilt,
                  {.unit = "rad",
                   .usual = between(-0.1, 0.1),
                   .fallback = {"0 rad", "0 rad"},
                   .help = "Tilt about y and z relative to that line."})
      .quantities("initial_velocity", &RotorParameters::initial_velocity,
                  {.unit = "m/s",
                   .usual = between(-1, 1),
                   .fallback = {"0 m/s", "0 m/s"},
                   .help = "Velocity (y, z) of the centre of gravity."})
      .quantities("initial_tilt_rate", &RotorParameters::initial_tilt_rate,
                  {.unit = "rad/s",
                   .usual = between(-5, 5),
                   .fallback = {"0 rad/s", "0 rad/s"},
                   .help = "Tilt rate about y and z."})
      .table("initial_orbit", &RotorParameters::initial_orbit, orbit,
             {.help = "Circular orbit at the start, added to the initial offset and velocity."})
      .quantity("initial_angle", &RotorParameters::initial_angle,
                {.unit = "rad",
                 .fallback = "0 deg",
                 .help = "Spin angle at the start; every unbalance then stands at its own angle plus this."})
      .tables("probes", &RotorParameters::probes, probe_section(),
              {.help = "Nodes by name whose displacement is recorded against a clearance of their own."})
      .check(check_inline_geometry);
  return section;
}

void check_against_geometry(const RotorParameters& parameters, const RotorGeometry& geometry, const Node& rotor_table,
                            Faults& faults) {
  const Node* list = rotor_table.find("unbalance");
  for (std::size_t k = 0; k < parameters.unbalance.size(); ++k)
    check_rotor_node(geometry, parameters.unbalance[k].node,
                     list ? position_of_value(list->items()[k], "node") : rotor_table.where(),
                     fmt::format("rotor.unbalance#{}.node", k + 1), faults);
  check_probes(parameters.probes, geometry, rotor_table, faults);
}

RotorSettings rotor_settings(const RotorParameters& parameters, const std::array<double, 3>& gravity) {
  RotorSettings settings;
  settings.representation = parameters.model;
  settings.cut_off_frequency = parameters.cut_off_frequency;
  settings.residual_flexibility = parameters.residual_flexibility;
  settings.modal_damping = parameters.modal_damping;
  settings.mass_proportional_alpha = parameters.mass_proportional_alpha;
  settings.gravity_y = gravity[1];
  settings.gravity_z = gravity[2];
  settings.unbalance = parameters.unbalance;
  const auto unless_zero = [](const TimeTable& table) {
    const bool acts = std::any_of(table.begin(), table.end(), [](const auto& point) { return point[1] != 0; });
    return acts ? table : TimeTable{};
  };
  settings.drive_torque = unless_zero(parameters.torque);
  if (parameters.windage) settings.windage = windage_of(parameters.geometry, *parameters.windage);
  if (parameters.axial_motion == AxialFreedom::free)
    settings.axial = AxialMotion{gravity[0], unless_zero(parameters.axial_force)};
  return settings;
}

Motion initial_disturbance(const RotorParameters& parameters) {
  Motion motion;
  motion.y = parameters.initial_offset[0];
  motion.z = parameters.initial_offset[1];
  motion.theta_y = parameters.initial_tilt[0];
  motion.theta_z = parameters.initial_tilt[1];
  motion.velocity_y = parameters.initial_velocity[0];
  motion.velocity_z = parameters.initial_velocity[1];
  motion.tilt_rate_y = parameters.initial_tilt_rate[0];
  motion.tilt_rate_z = parameters.initial_tilt_rate[1];
  return motion +
         orbit(parameters.initial_orbit.radius, parameters.initial_orbit.angle, parameters.initial_orbit.speed);
}

}  // namespace rotordrop
