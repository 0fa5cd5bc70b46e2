#include "thermal/heat_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "thermal/fe_parameters.h"

namespace rotordrop {
namespace {

Section<HeatRunParameters> run_section() {
  using P = HeatRunParameters;
  Section<P> s("run", "Surroundings, start and end.");
  s.quantity(
      "ambient", &P::ambient,
      {.unit = "K", .range = between(1, 2000), .fallback = "293.15 K", .help = "Temperature of the surroundings."});
  s.quantity(
      "initial_temperature", &P::initial_temperature,
      {.unit = "K", .range = between(1, 2000), .help = "Temperature of everything at the start; ambient if left out."});
  s.quantity("end_time", &P::end_time,
             {.unit = "s", .range = positive(), .help = "Where to stop; the last of output_times if left out."});
  return s;
}

Section<HeatMaterialParameters> material_section() {
  using P = HeatMaterialParameters;
  Section<P> s(
      "material",
      "A material of bodies. Of k and k_table one is needed (k_table counts if both are there), and so for c.");
  s.quantity("rho", &P::rho, {.unit = "kg/m3", .range = between(1, 3e4), .help = "Density."});
  s.quantity("k", &P::k, {.unit = "W/(m K)", .range = positive(), .help = "Thermal conductivity."});
  s.quantity("c", &P::c, {.unit = "J/(kg K)", .range = positive(), .help = "Specific heat capacity."});
  s.function("k_table", &P::k_table,
             {.unit = "W/(m K)",
              .argument_unit = "K",
              .range = positive(),
              .help = "Conductivity over temperature: linear between the pairs, constant outside."});
  s.function("c_table", &P::c_table,
             {.unit = "J/(kg K)",
              .argument_unit = "K",
              .range = positive(),
              .help = "Specific heat capacity over temperature: linear between the pairs, constant outside."});
  s.quantity("E", &P::E, {.unit = "Pa", .help = "Not used by conduction."});
  s.quantity("nu", &P::nu, {.help = "Not used by conduction."});
  s.quantity("alpha", &P::alpha, {.unit = "1/K", .help = "Not used by conduction."});
  return s;
}

void check_rising(const std::array<double, 2>& extent, const char* key, const Node& table, const std::string& path,
                  Faults& faults) {
  if (!(extent[1] > extent[0]))
    faults.add(position_of_value(table, key), path + "." + key + " does not rise.", "Write [smaller, larger].");
}

Section<HeatRectangleParameters> rectangle_section() {
  using P = HeatRectangleParameters;
  Section<P> s("rectangle",
               "A ring of rectangular section. Its boundaries are called NAME.inner, NAME.outer (radius), NAME.left "
               "and NAME.right (x).");
  s.text("name", &P::name, {.help = "Name of the body."});
  s.quantities("x", &P::x, {.unit = "m", .help = "From and to, along the axis."});
  s.quantities("r", &P::r, {.unit = "m", .range = at_least(0), .help = "Inner and outer radius; 0 for a solid body."});
  s.text("material", &P::material, {.help = "A name of [materials]."});
  s.check([](const P& p, const Node& table, const std::string& path, Faults& faults) {
    check_rising(p.x, "x", table, path, faults);
    check_rising(p.r, "r", table, path, faults);
    if (p.name.empty() || p.name.find('.') != std::string::npos)
      faults.add(position_of_value(table, "name"), path + ".name = \"" + p.name + "\" is empty or has a dot in it.",
                 "Boundaries are called NAME.inner and so on.");
  });
  return s;
}

}  // namespace

Section<HeatPulseParameters> pulse_section(const std::string& unit) {
  using P = HeatPulseParameters;
  Section<P> s("pulse", "Equal pulses at equal distances.");
  s.quantity("height", &P::height,
             {.unit = unit, .help = unit == "W" ? "Heat during a pulse." : "Heat flux density during a pulse."});
  s.quantity("width", &P::width, {.unit = "s", .range = positive(), .help = "Duration of a pulse."});
  s.quantity(
      "period", &P::period,
      {.unit = "s", .range = positive(), .help = "From one pulse's beginning to the next one's; for several pulses."});
  s.quantity("start", &P::start,
             {.unit = "s", .range = at_least(0), .fallback = "0 s", .help = "Beginning of the first pulse."});
  s.integer("count", &P::count, {.range = between(1, 100000), .fallback = 1, .help = "Number of pulses."});
  s.check([](const P& p, const Node& table, const std::string& path, Faults& faults) {
    if (p.count > 1 && !p.period)
      faults.add(position_of(table, "count"), path + ".count = " + std::to_string(p.count) + " needs a period.",
                 "Give period = ..., from one pulse's beginning to the next one's.");
    if (p.period && *p.period < p.width)
      faults.add(position_of_value(table, "period"), path + ".period is shorter than its width.",
                 "Pulses must not overlap; a second one at the same place adds to the first.");
  });
  return s;
}

PulseTrain pulse_train(const HeatPulseParameters& p) {
  return {p.height, p.width, p.period.value_or(p.width), p.start, p.count};
}

namespace {

/// Which of three ways says what flows, and whether it is said completely.
void check_flux_form(const HeatFluxParameters& p, const Node& table, const std::string& path, Faults& faults) {
  const bool has_steps = table.has("times") || table.has("values");
  const int n_ways = int{has_steps} + int{p.pulse.has_value()} + int{p.recorded.has_value()};
  if (n_ways != 1)
    faults.add(table.where(), path + (n_ways == 0 ? " does not say what flows." : " says in several ways what flows."),
               "Give one of: times and values; pulse = { height, width, ... }; recorded, with bearing and heat.");
  if (has_steps && (p.times.empty() || p.values.empty()))
    faults.add(table.where(), path + " needs times and values, one at least.");
  for (const char* key : {"bearing", "heat", "share", "interval"})
    if (!p.recorded && table.has(key))
      faults.add(position_of(table, key), path + "." + key + " belongs to a recorded heat.",
                 "Name its file: recorded = \"out/CASE/results.h5\".");
  if (!p.recorded) return;
  for (const auto& [key, is_given] :
       {std::pair("bearing", p.bearing.has_value()), std::pair("heat", p.heat.has_value())})
    if (!is_given)
      faults.add(position_of(table, "recorded"), path + ".recorded needs " + key + " beside it.",
                 "Such as bearing = \"TB1\", heat = \"rub\".");
}

Section<HeatFluxParameters> flux_section() {
  using P = HeatFluxParameters;
  Section<P> s("flux",
               "Heat into a boundary, where no interface covers it: as steps (times and values), as pulses, or as an "
               "earlier drop recorded it.");
  s.text("boundary", &P::boundary, {.help = "BODY.inner, .outer, .left or .right."});
  s.quantities("times", &P::times, {.unit = "s", .help = "Rising; values[i] holds from times[i] until the next one."});
  s.quantities("values", &P::values, {.unit = "W/m2", .help = "Heat flux density from each of the times."});
  s.table<HeatPulseParameters>("pulse", &P::pulse, pulse_section("W/m2"));
  s.text("recorded", &P::recorded,
         {.help = "results.h5 of an earlier drop, relative to this file: the flux that brings its heat, row by row."});
  s.text("bearing", &P::bearing, {.help = "Of a recorded heat: the bearing's name."});
  s.choice("heat", &P::heat, {"rub", "inner", "outer"},
           {.help = "Of a recorded heat: rub of rotor and ring, or friction at the inner or outer race."});
  s.quantity(
      "share", &P::share,
      {.range = between(0, 1), .help = "Of a recorded heat: the part that goes into this boundary; 1 if left out."});
  s.quantity("interval", &P::interval,
             {.unit = "s",
              .range = positive(),
              .help = "Of a recorded heat: shortest step; rows between are left out. The heat stays the same, and is "
                      "spread over longer steps."});
  s.check([](const P& p, const Node& table, const std::string& path, Faults& faults) {
    check_flux_form(p, table, path, faults);
    if (p.times.size() != p.values.size())
      faults.add(position_of_value(table, "values"),
                 path + " has " + std::to_string(p.times.size()) + " times and " + std::to_string(p.values.size()) +
                     " values.",
                 "Give one value for every time.");
    if (!std::is_sorted(p.times.begin(), p.times.end(), std::less_equal<>()))
      faults.add(position_of_value(table, "times"), path + ".times do not rise.");
  });
  return s;
}

Section<HeatConvectionParameters> convection_section() {
  using P = HeatConvectionParameters;
  Section<P> s("convection",
               "Heat lost from a boundary, where no interface covers it: coefficient * rise^(1 + exponent), the rise "
               "over `ambient`.");
  s.text("boundary", &P::boundary, {.help = "BODY.inner, .outer, .left or .right."});
  s.quantity("coefficient", &P::coefficient,
             {.unit = "W/(m2 K^n)", .range = at_least(0), .help = "In W/m2 at a rise of 1 K."});
  s.quantity("exponent", &P::exponent,
             {.range = between(0, 3),
              .fallback = "0",
              .help = "0: in proportion to the rise. Above 0 nothing is exchanged below ambient."});
  s.quantity("ambient", &P::ambient,
             {.unit = "K",
              .range = between(1, 2000),
              .help = "Temperature of the surroundings there; run.ambient if left out."});
  return s;
}

Section<HeatFixedParameters> fixed_section() {
  using P = HeatFixedParameters;
  Section<P> s("fixed", "A boundary that is held at a temperature, where no interface covers it.");
  s.text("boundary", &P::boundary, {.help = "BODY.inner, .outer, .left or .right."});
  s.quantity("temperature", &P::temperature, {.unit = "K", .range = between(1, 2000), .help = "Held from the start."});
  return s;
}

Section<HeatInterfaceParameters> interface_section() {
  using P = HeatInterfaceParameters;
  Section<P> s(
      "interface",
      "Two boundaries that lie on each other and exchange heat where they do. Bodies that only touch exchange none.");
  s.custom("between",
           {.accepts = "[\"BODY.side\", \"BODY.side\"]",
            .json_types = {"array"},
            .required = true,
            .help = "The two boundaries."},
           [](const Node& node, P& target, Faults& faults) {
             if (node.is_array() && node.items().size() == 2 && node.items()[0].is_text() && node.items()[1].is_text())
               target.between = {node.items()[0].text(), node.items()[1].text()};
             else
               faults.add(node.where(),
                          "interface.between must be two names of boundaries, not " + to_text(node) + ".");
           });
  s.quantity("resistance", &P::resistance,
             {.unit = "m2 K/W", .range = positive(), .help = "Temperature jump over heat flux density."});
  return s;
}

Section<HeatProbeParameters> probe_section() {
  using P = HeatProbeParameters;
  Section<P> s("probe", "A temperature that is reported: at a point (x, r), or the mean of a boundary.");
  s.text("name", &P::name, {.help = "Its name in the results."});
  s.quantity("x", &P::x, {.unit = "m", .help = "Of the point."});
  s.quantity("r", &P::r, {.unit = "m", .help = "Of the point."});
  s.text("body", &P::body,
         {.help = "Which body is meant where two meet; the first one that holds the point if left out."});
  s.text("boundary", &P::boundary, {.help = "BODY.inner, .outer, .left or .right: the mean over its area."});
  s.check([](const P& p, const Node& table, const std::string& path, Faults& faults) {
    const bool point = p.x && p.r;
    if (point == p.boundary.has_value() || p.x.has_value() != p.r.has_value())
      faults.add(position_of(table, "name"), path + " (\"" + p.name + "\") needs either x and r, or boundary.");
    if (p.name.empty() || p.name.find('/') != std::string::npos)
      faults.add(position_of_value(table, "name"), path + ".name = \"" + p.name + "\" is empty or has a slash in it.");
  });
  return s;
}

Section<HeatNumericsParameters> numerics_section() {
  using P = HeatNumericsParameters;
  Section<P> s("fe", "Mesh and accuracy of the finite-element model.");
  s.integer("degree", &P::degree, {.range = between(1, 4), .fallback = 2, .help = "Of the elements: 2 is quadratic."});
  s.integer("cells", &P::cells,
            {.range = between(1, 1000),
             .fallback = 8,
             .help = "Cells across every body, in both directions, before grading."});
  s.quantity("grading", &P::grading,
             {.range = between(1, 1e5),
              .fallback = "30",
              .help = "How many times thinner the cells are at boundaries with flux. The first one should be thinner "
                      "than sqrt(diffusivity * first output time)."});
  s.quantity("growth", &P::growth,
             {.range = between(1.05, 5), .fallback = "1.5", .help = "Largest ratio of neighbouring cells."});
  s.quantity("time_tolerance", &P::time_tolerance,
             {.range = between(1e-12, 1e-1),
              .fallback = "1e-6",
              .help = "Error of one time step, over the largest change of temperature."});
  s.choice("solver", &P::solver, linear_solvers(), {.fallback = "direct", .help = linear_solver_help});
  return s;
}

// ---------------------------------------------------------------------------------------------------------------- the problem

const char* const side_names[] = {"left", "right", "inner", "outer"};

/// Finds names and places in the parameters of one case.
class StudyMaker {
 public:
  StudyMaker(const HeatParameters& parameters, const Node& tree, const ReadRecordedHeat& read_recorded, Faults& faults)
      : p_(parameters), tree_(tree), read_recorded_(read_recorded), faults_(faults) {}

  HeatStudy make() {
    auto& problem = study_.problem;
    problem.initial_temperature = p_.run.initial_temperature.value_or(p_.run.ambient);
    problem.numerics = {.degree = p_.fe.degree,
                        .cells = p_.fe.cells,
                        .grading = p_.fe.grading,
                        .growth = p_.fe.growth,
                        .tolerance = p_.fe.time_tolerance,
                        .solver = p_.fe.solver};
    add_bodies();
    for (std::size_t i = 0; i < p_.interfaces.size(); ++i) add_interface(i);
    for (std::size_t i = 0; i < p_.fluxes.size(); ++i) add_flux(i);
    for (std::size_t i = 0; i < p_.convections.size(); ++i) {
      const auto& law = p_.convections[i];
      if (const auto b = exposed("convection", i, law.boundary))
        problem.convections.push_back({*b, law.coefficient, law.exponent, law.ambient.value_or(p_.run.ambient)});
    }
    for (std::size_t i = 0; i < p_.fixed.size(); ++i) add_fixed(i);
    for (std::size_t i = 0; i < p_.probes.size(); ++i) add_probe(i);
    add_times();
    return std::move(study_);
  }

 private:
  [[nodiscard]] const Node* entry(const char* list, std::size_t i) const {
    const Node* parent = std::string(list) == "rectangle" ? tree_.find("section") : &tree_;
    const Node* found = parent ? parent->find(list) : nullptr;
    return found && found->is_array() && i < found->items().size() ? &found->items()[i] : nullptr;
  }
  void fault(const char* list, std::size_t i, const char* key, const std::string& message,
             const std::string& advice = "") {
    const Node* table = entry(list, i);
    const std::string place = std::string(list) == "rectangle" ? "section.rectangle" : list;
    faults_.add(table ? position_of_value(*table, key) : SourcePosition{},
                place + "#" + std::to_string(i + 1) + ": " + message, advice);
  }
  static std::string known(const std::string& word, const std::vector<std::string>& names) {
    const std::string guess = closest_name(word, names);
    std::string list;
    for (const auto& name : names) list += (list.empty() ? "" : ", ") + name;
    return (guess.empty() ? "" : "Did you mean \"" + guess + "\"?  ") + ("Known: " + list + ".");
  }

  void add_bodies() {
    std::vector<std::string> materials;
    for (const auto& entry : p_.materials) materials.push_back(entry.first);
    for (std::size_t i = 0; i < p_.section.rectangles.size(); ++i) {
      const auto& from = p_.section.rectangles[i];
      HeatBody body{from.name, from.x, from.r, 0., {}, {}};
      const auto found = std::find_if(p_.materials.begin(), p_.materials.end(),
                                      [&](const auto& m) { return m.first == from.material; });
      if (found == p_.materials.end()) {
        fault("rectangle", i, "material", "there is no material \"" + from.material + "\".",
              known(from.material, materials));
      } else {
        const auto& m = found->second;
        if ((!m.k && !m.k_table) || (!m.c && !m.c_table))
          fault("rectangle", i, "material",
                "material \"" + from.material + "\" lacks its conductivity or heat capacity.",
                "Give k or k_table, and c or c_table.");
        body.density = m.rho;
        if (m.k_table || m.k) body.conductivity = m.k_table ? PropertyTable(*m.k_table) : PropertyTable(*m.k);
        if (m.c_table || m.c) body.heat_capacity = m.c_table ? PropertyTable(*m.c_table) : PropertyTable(*m.c);
      }
      for (const auto& other : study_.problem.bodies) {
        if (other.name == body.name)
          fault("rectangle", i, "name", "the name \"" + body.name + "\" is taken.", "Choose another name.");
        const auto overlap = [](const auto& a, const auto& b) {
          const double shared = std::min(a[1], b[1]) - std::max(a[0], b[0]);
          return shared > 1e-6 * std::min(a[1] - a[0], b[1] - b[0]);
        };
        if (overlap(body.x, other.x) && overlap(body.r, other.r))
          fault("rectangle", i, "name", "\"" + body.name + "\" lies partly inside \"" + other.name + "\".",
                "Correct x or r of one of them.");
      }
      study_.problem.bodies.push_back(body);
    }
  }

  std::optional<HeatBoundary> boundary(const char* list, std::size_t i, const char* key, const std::string& name) {
    std::vector<std::string> names;
    for (std::size_t b = 0; b < study_.problem.bodies.size(); ++b)
      for (std::size_t side = 0; side < 4; ++side) {
        names.push_back(study_.problem.bodies[b].name + "." + side_names[side]);
        if (names.back() == name) return HeatBoundary{b, static_cast<HeatSide>(side)};
      }
    fault(list, i, key, "there is no boundary \"" + name + "\".", known(name, names));
    return {};
  }
  [[nodiscard]] std::array<double, 2> extent_along(const HeatBoundary& b) const {
    const auto& body = study_.problem.bodies[b.body];
    return b.side == HeatSide::left || b.side == HeatSide::right ? body.r : body.x;
  }
  [[nodiscard]] double line(const HeatBoundary& b) const {
    const auto& body = study_.problem.bodies[b.body];
    switch (b.side) {
      case HeatSide::left:
        return body.x[0];
      case HeatSide::right:
        return body.x[1];
      case HeatSide::inner:
        return body.r[0];
      case HeatSide::outer:
        return body.r[1];
      case HeatSide::raceway:
      case HeatSide::strip:
        break;  // rectangles have none
    }
    return 0.;
  }

  /// A boundary of which something is left for flux or convection.
  std::optional<HeatBoundary> exposed(const char* list, std::size_t i, const std::string& name) {
    const auto b = boundary(list, i, "boundary", name);
    if (!b) return {};
    if (b->side == HeatSide::inner && line(*b) == 0.) {
      fault(list, i, "boundary", "\"" + name + "\" is the axis, which has no area.");
      return {};
    }
    if (free_parts(*b).empty())
      fault(list, i, "boundary", "all of \"" + name + "\" is covered by interfaces.",
            "Flux, convection and fixed temperatures act on the part that is free.");
    return b;
  }
  /// What interfaces leave of a boundary, from and to along it [m].
  [[nodiscard]] std::vector<std::array<double, 2>> free_parts(const HeatBoundary& b) const {
    const auto whole = extent_along(b);
    std::vector<std::array<double, 2>> covered, parts;
    for (const auto& interface : study_.problem.interfaces)
      for (const auto* side : {&interface.first, &interface.second})
        if (*side == b) covered.push_back(extent_along(side == &interface.first ? interface.second : interface.first));
    std::sort(covered.begin(), covered.end());
    covered.push_back({whole[1], whole[1]});
    double reached = whole[0];
    const double slack = 1e-6 * (whole[1] - whole[0]);
    for (const auto& [from, to] : covered) {
      const double end = std::min(from, whole[1]);
      if (end > reached + slack) parts.push_back({reached, end});
      reached = std::max(reached, to);
    }
    return parts;
  }
  /// Of the free part of a boundary [m2].
  [[nodiscard]] double free_area(const HeatBoundary& b) const {
    const bool is_face = b.side == HeatSide::left || b.side == HeatSide::right;
    double area = 0.;
    for (const auto& [from, to] : free_parts(b))
      area += std::numbers::pi * (to - from) * (is_face ? to + from : 2. * line(b));
    return area;
  }

  void add_flux(std::size_t i) {
    const auto& from = p_.fluxes[i];
    const auto b = exposed("flux", i, from.boundary);
    FluxSteps steps{from.times, from.values};
    if (from.pulse) {
      steps = steps_of(pulse_train(*from.pulse));
    } else if (from.recorded) {
      const Node* table = entry("flux", i);
      if (!table || !read_recorded_) return;
      const auto heat = read_recorded_({*from.recorded, *from.bearing, *from.heat + "_heat"}, *table,
                                       "flux#" + std::to_string(i + 1), faults_);
      if (!heat || !b) return;
      const double area = free_area(*b);
      if (area > 0.) steps = steps_of(*heat, area, from.share.value_or(1.), from.interval.value_or(0.));
    }
    if (b) study_.problem.fluxes.push_back({*b, steps.times, steps.values});
  }

  void add_fixed(std::size_t i) {
    const auto& from = p_.fixed[i];
    const auto b = exposed("fixed", i, from.boundary);
    if (!b) return;
    const auto conflict = [&](const auto& list, const char* what) {
      if (std::any_of(list.begin(), list.end(), [&](const auto& other) { return other.boundary == *b; }))
        fault("fixed", i, "boundary", "\"" + from.boundary + "\" has " + what + ".",
              "A boundary that is held at a temperature takes what heat it needs; say one or the other.");
    };
    conflict(study_.problem.fluxes, "a flux, too");
    conflict(study_.problem.convections, "convection, too");
    conflict(study_.problem.fixed, "a fixed temperature already");
    study_.problem.fixed.push_back({*b, from.temperature});
  }

  void add_interface(std::size_t i) {
    const auto& from = p_.interfaces[i];
    const auto a = boundary("interface", i, "between", from.between[0]),
               b = boundary("interface", i, "between", from.between[1]);
    if (!a || !b) return;
    const auto faces = [](HeatSide one, HeatSide other) {
      return (one == HeatSide::outer && other == HeatSide::inner) ||
             (one == HeatSide::inner && other == HeatSide::outer) ||
             (one == HeatSide::right && other == HeatSide::left) || (one == HeatSide::left && other == HeatSide::right);
    };
    const std::string both = "\"" + from.between[0] + "\" and \"" + from.between[1] + "\"";
    const auto along_a = extent_along(*a), along_b = extent_along(*b);
    const double size = std::max(along_a[1] - along_a[0], along_b[1] - along_b[0]);
    if (a->body == b->body || !faces(a->side, b->side))
      fault("interface", i, "between", both + " do not face each other.",
            "Join outer with inner, or right with left, of two bodies.");
    else if (std::fabs(line(*a) - line(*b)) > 1e-9 * size)
      fault("interface", i, "between", both + " do not lie on each other.",
            "The radii, or places x, of the two must be equal.");
    else if (std::min(along_a[1], along_b[1]) - std::max(along_a[0], along_b[0]) < 1e-6 * size)
      fault("interface", i, "between", both + " do not meet anywhere.");
    else
      study_.problem.interfaces.push_back({*a, *b, from.resistance});
  }

  void add_probe(std::size_t i) {
    const auto& from = p_.probes[i];
    HeatProbe probe;
    probe.name = from.name;
    for (const auto& other : study_.probes)
      if (other.name == probe.name)
        fault("probe", i, "name", "the name \"" + probe.name + "\" is taken.", "Choose another name.");
    if (from.boundary) {
      probe.boundary = boundary("probe", i, "boundary", *from.boundary);
      if (probe.boundary && probe.boundary->side == HeatSide::inner && line(*probe.boundary) == 0.)
        fault("probe", i, "boundary", "\"" + *from.boundary + "\" is the axis, which has no area.",
              "Give a point x, r = 0 instead.");
    } else {
      probe.x = *from.x;
      probe.r = *from.r;
      const auto& bodies = study_.problem.bodies;
      const auto holds = [&](const HeatBody& body) {
        const double slack = 1e-9 * (body.x[1] - body.x[0] + body.r[1] - body.r[0]);
        return (!from.body || *from.body == body.name) && probe.x >= body.x[0] - slack &&
               probe.x <= body.x[1] + slack && probe.r >= body.r[0] - slack && probe.r <= body.r[1] + slack;
      };
      const auto found = std::find_if(bodies.begin(), bodies.end(), holds);
      if (found == bodies.end())
        fault("probe", i, "x",
              "\"" + probe.name + "\" lies in no body" + (from.body ? " called \"" + *from.body + "\"." : "."),
              "Compare its x and r with those of section.rectangle.");
      else
        probe.body = static_cast<std::size_t>(found - bodies.begin());
    }
    study_.probes.push_back(probe);
  }

  void add_times() {
    auto& times = study_.output_times;
    times = p_.output_times;
    const SourcePosition where = position_of_value(tree_, "output_times");
    if (!std::is_sorted(times.begin(), times.end(), std::less_equal<>()))
      faults_.add(where, "output_times do not rise.");
    if (p_.run.end_time) {
      if (!times.empty() && times.back() > *p_.run.end_time) faults_.add(where, "output_times go beyond run.end_time.");
      if (times.empty() || times.back() < *p_.run.end_time) times.push_back(*p_.run.end_time);
    }
    study_.field_times = p_.field_times;
    study_.field_interval = p_.field_interval.value_or(0.);
    const auto& fields = study_.field_times;
    const SourcePosition where_fields = position_of_value(tree_, "field_times");
    if (!std::is_sorted(fields.begin(), fields.end(), std::less_equal<>()))
      faults_.add(where_fields, "field_times do not rise.");
    if (!fields.empty() && !times.empty() && fields.back() > times.back())
      faults_.add(where_fields, "field_times go beyond the last of output_times.", "Give a later run.end_time.");
    if (times.empty() || times.back() <= 0.)
      faults_.add(where, "nothing says how long to compute.", "Give output_times = [...], or run.end_time.");
  }

  const HeatParameters& p_;
  const Node& tree_;
  const ReadRecordedHeat& read_recorded_;
  Faults& faults_;
  HeatStudy study_;
};

}  // namespace

Section<HeatParameters> heat_section(const Node& default_materials) {
  using P = HeatParameters;
  Section<P> s("", "Heat conduction alone.");
  s.table<HeatRunParameters>("run", &P::run, run_section());
  s.tables<HeatMaterialParameters>(
      "materials", &P::materials, material_section(),
      {.fallback = default_materials,
       .help = "Materials by name. Those given here add to, or replace, the built-in ones."});
  s.table<HeatSectionParameters>("section", &P::section, [] {
    Section<HeatSectionParameters> section("section",
                                           "The section of all bodies in the plane of axis (x) and radius (r).");
    section.list("rectangle", &HeatSectionParameters::rectangles, rectangle_section(),
                 {.min_count = 1, .help = "Rings of rectangular section."});
    return section;
  }());
  s.list("flux", &P::fluxes, flux_section(),
         {.help = "Prescribed heat; boundaries are insulated where nothing is said."});
  s.list("convection", &P::convections, convection_section(), {.help = "Losses to the surroundings."});
  s.list("fixed", &P::fixed, fixed_section(), {.help = "Temperatures that are held."});
  s.list("interface", &P::interfaces, interface_section(), {.help = "Contact between bodies."});
  s.list("probe", &P::probes, probe_section(), {.help = "Temperatures to report."});
  s.quantities("output_times", &P::output_times,
               {.unit = "s", .range = at_least(0), .help = "When probes are reported; met exactly."});
  s.quantities("field_times", &P::field_times,
               {.unit = "s",
                .range = at_least(0),
                .help = "When the whole temperature field is written for ParaView; the start is always among them."});
  s.quantity("field_interval", &P::field_interval,
             {.unit = "s", .range = positive(), .help = "The same at multiples of this time."});
  s.table<HeatNumericsParameters>("fe", &P::fe, numerics_section());
  return s;
}

namespace {

/// A grid common to all bodies cannot show one that is far thinner than the whole.
void check_proportions(const HeatConductionProblem& problem, const Node& tree, Faults& faults) {
  constexpr double thinnest = 1e-6;  // of the whole; lines closer than 1e-9 of it are one
  for (const auto side : {&HeatBody::x, &HeatBody::r}) {
    double low = std::numeric_limits<double>::infinity(), high = -low, least = low;
    for (const auto& body : problem.bodies) {
      low = std::min(low, (body.*side)[0]);
      high = std::max(high, (body.*side)[1]);
      least = std::min(least, (body.*side)[1] - (body.*side)[0]);
    }
    if (least < thinnest * (high - low))
      faults.add(position_of(tree, "section"),
                 fmt::format("the section is {:.4g} m {}, but a body of it only {:.4g} m: no mesh can show both.",
                             high - low, side == &HeatBody::x ? "long" : "high", least),
                 "Check the units: a bare number is in metres.");
  }
}

}  // namespace

HeatStudy make_heat_study(const HeatParameters& parameters, const Node& tree, const ReadRecordedHeat& read_recorded,
                          Faults& faults) {
  HeatStudy study = StudyMaker(parameters, tree, read_recorded, faults).make();
  check_proportions(study.problem, tree, faults);
  return study;
}

}  // namespace rotordrop
