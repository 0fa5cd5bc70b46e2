#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "base/parameters/suggestion.h"
#include "thermal/field_parameters.h"
#include "thermal/heating/boundary_geometry.h"
#include "thermal/heating/heat_parameters.h"

// From the parameters of a case of heat alone to the problem that they state.
namespace rotordrop {
namespace {

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
                        .end_grading = p_.fe.end_grading,
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
    add_elastic();
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
  void add_bodies() {
    std::vector<std::string> materials;
    for (const auto& entry : p_.materials) materials.push_back(entry.first);
    for (std::size_t i = 0; i < p_.section.rectangles.size(); ++i) {
      const auto& from = p_.section.rectangles[i];
      HeatBody body{from.name, from.x, from.r, 0., {}, {}, from.temperature};
      const auto found = std::find_if(p_.materials.begin(), p_.materials.end(),
                                      [&](const auto& m) { return m.first == from.material; });
      if (found == p_.materials.end()) {
        fault("rectangle", i, "material", "there is no material \"" + from.material + "\".",
              suggestion(from.material, materials));
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
    fault(list, i, key, "there is no boundary \"" + name + "\".", suggestion(name, names));
    return {};
  }
  /// A boundary of which something is left for flux or convection.
  std::optional<HeatBoundary> exposed(const char* list, std::size_t i, const std::string& name) {
    const auto b = boundary(list, i, "boundary", name);
    if (!b) return {};
    if (b->side == HeatSide::inner && line(study_.problem, *b) == 0.) {
      fault(list, i, "boundary", "\"" + name + "\" is the axis, which has no area.");
      return {};
    }
    if (study_.problem.bodies[b->body].held_at)
      fault(list, i, "boundary",
            "all of body \"" + study_.problem.bodies[b->body].name + "\" is held at a temperature.",
            "It takes what heat it needs: leave out this, or the rectangle's temperature.");
    if (free_parts(study_.problem, *b).empty())
      fault(list, i, "boundary", "all of \"" + name + "\" is covered by interfaces.",
            "Flux, convection and fixed temperatures act on the part that is free.");
    return b;
  }
  /// Where a flux goes.
  struct HeatedArea {
    HeatFlux flux;
    double area = 0;  ///< [m2]
  };
  std::optional<HeatedArea> heated_area(std::size_t i) {
    const auto& from = p_.fluxes[i];
    if (from.boundary) {
      const auto b = exposed("flux", i, *from.boundary);
      if (!b) return {};
      return HeatedArea{{.boundary = *b, .times = {}, .values = {}}, free_area(study_.problem, *b)};
    }
    const auto a = boundary("flux", i, "between", from.between[0]), b = boundary("flux", i, "between", from.between[1]);
    if (!a || !b) return {};
    const auto& all = study_.problem.interfaces;
    const auto found = std::find_if(all.begin(), all.end(), [&](const HeatInterface& other) {
      return (other.first == *a && other.second == *b) || (other.first == *b && other.second == *a);
    });
    if (found == all.end()) {
      fault("flux", i, "between",
            "there is no interface between \"" + from.between[0] + "\" and \"" + from.between[1] + "\".",
            "Give one as [[interface]], with its contact resistance; heat into a free boundary takes boundary = ....");
      return {};
    }
    const auto along_a = extent_along(study_.problem, *a), along_b = extent_along(study_.problem, *b);
    return HeatedArea{{.boundary = *a,
                       .times = {},
                       .values = {},
                       .second = *b,
                       .resistance_beyond = from.resistance_beyond.value_or(0.5)},
                      area_of(study_.problem, *a, std::max(along_a[0], along_b[0]), std::min(along_a[1], along_b[1]))};
  }

  void add_flux(std::size_t i) {
    const auto& from = p_.fluxes[i];
    auto heated = heated_area(i);
    FluxSteps steps{from.times, from.values};
    if (from.pulse) {
      steps = steps_of(pulse_train(*from.pulse));
    } else if (from.recorded) {
      const Node* table = entry("flux", i);
      if (!table || !read_recorded_) return;
      const auto heat = read_recorded_({*from.recorded, *from.bearing, *from.heat + "_heat"}, *table,
                                       "flux#" + std::to_string(i + 1), faults_);
      if (!heat || !heated) return;
      if (heated->area > 0.) steps = steps_of(*heat, heated->area, from.share.value_or(1.), from.interval.value_or(0.));
    }
    if (!heated) return;
    heated->flux.times = steps.times;
    heated->flux.values = steps.values;
    study_.problem.fluxes.push_back(std::move(heated->flux));
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
    if (const auto sides = facing("interface", i, p_.interfaces[i].between))
      study_.problem.interfaces.push_back({(*sides)[0], (*sides)[1], p_.interfaces[i].resistance});
  }
  /// Two boundaries that lie on each other somewhere.
  std::optional<std::array<HeatBoundary, 2>> facing(const char* list, std::size_t i,
                                                    const std::vector<std::string>& between) {
    const auto a = boundary(list, i, "between", between[0]), b = boundary(list, i, "between", between[1]);
    if (!a || !b) return {};
    const auto faces = [](HeatSide one, HeatSide other) {
      return (one == HeatSide::outer && other == HeatSide::inner) ||
             (one == HeatSide::inner && other == HeatSide::outer) ||
             (one == HeatSide::right && other == HeatSide::left) || (one == HeatSide::left && other == HeatSide::right);
    };
    const std::string both = "\"" + between[0] + "\" and \"" + between[1] + "\"";
    const auto along_a = extent_along(study_.problem, *a), along_b = extent_along(study_.problem, *b);
    const double size = std::max(along_a[1] - along_a[0], along_b[1] - along_b[0]);
    if (a->body == b->body || !faces(a->side, b->side))
      fault(list, i, "between", both + " do not face each other.",
            "Join outer with inner, or right with left, of two bodies.");
    else if (std::fabs(line(study_.problem, *a) - line(study_.problem, *b)) > 1e-9 * size)
      fault(list, i, "between", both + " do not lie on each other.",
            "The radii, or places x, of the two must be equal.");
    else if (std::min(along_a[1], along_b[1]) - std::max(along_a[0], along_b[0]) < 1e-6 * size)
      fault(list, i, "between", both + " do not meet anywhere.");
    else if (!joined_[list].insert(std::minmax(between[0], between[1])).second)
      fault(list, i, "between", both + " are joined already.", "Two boundaries are joined once, in either order.");
    else
      return std::array{*a, *b};
    return {};
  }

  void add_probe(std::size_t i) { add_place("probe", i, p_.probes[i], study_.probes); }

  /// Where a temperature or displacement is wanted.
  void add_place(const char* list, std::size_t i, const auto& from, std::vector<HeatProbe>& places) {
    HeatProbe probe;
    probe.name = from.name;
    for (const auto& other : places)
      if (other.name == probe.name)
        fault(list, i, "name", "the name \"" + probe.name + "\" is taken.", "Choose another name.");
    if (from.boundary) {
      probe.boundary = boundary(list, i, "boundary", *from.boundary);
      if (probe.boundary && probe.boundary->side == HeatSide::inner && line(study_.problem, *probe.boundary) == 0.)
        fault(list, i, "boundary", "\"" + *from.boundary + "\" is the axis, which has no area.",
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
        fault(list, i, "x",
              "\"" + probe.name + "\" is not inside any body" + (from.body ? " called \"" + *from.body + "\"." : "."),
              "Compare its x and r with those of section.rectangle.");
      else
        probe.body = static_cast<std::size_t>(found - bodies.begin());
    }
    places.push_back(probe);
  }

  void add_elastic() {
    if (p_.displacements.empty() && p_.fits.empty()) {
      if (!p_.holds.empty())
        fault("hold", 0, "boundary", "no displacement is computed.", "Add [[displacement]], or leave it out.");
      return;
    }
    auto& elastic = study_.elastic.emplace();
    auto& problem = elastic.problem;
    problem.numerics = study_.problem.numerics;
    problem.reference_temperature = p_.elastic.strain_free_temperature.value_or(p_.run.ambient);
    for (std::size_t i = 0; i < p_.section.rectangles.size(); ++i) add_elastic_body(i, problem);
    for (std::size_t i = 0; i < p_.fits.size(); ++i) add_fit(i, problem);
    for (std::size_t i = 0; i < p_.holds.size(); ++i) {
      const auto direction = p_.holds[i].direction;
      if (const auto b = boundary("hold", i, "boundary", p_.holds[i].boundary))
        problem.holds.push_back(
            {.boundary = *b, .axial = direction != HoldDirection::radial, .radial = direction != HoldDirection::axial});
    }
    for (std::size_t i = 0; i < p_.displacements.size(); ++i)
      add_place("displacement", i, p_.displacements[i], elastic.displacements);
  }

  void add_elastic_body(std::size_t i, ElasticProblem& problem) {
    const auto& from = p_.section.rectangles[i];
    const auto found =
        std::find_if(p_.materials.begin(), p_.materials.end(), [&](const auto& m) { return m.first == from.material; });
    if (found == p_.materials.end()) return;  // said already
    const auto& m = found->second;
    if (!m.E || !m.nu || !m.alpha)
      fault("rectangle", i, "material", "material \"" + from.material + "\" lacks what displacements need.",
            "Give E, nu and alpha.");
    problem.bodies.push_back({from.name, from.x, from.r, m.rho, m.E.value_or(0.), m.nu.value_or(0.),
                              PropertyTable(m.alpha.value_or(0.)), 0.});
  }

  void add_fit(std::size_t i, ElasticProblem& problem) {
    const auto& from = p_.fits[i];
    const auto sides = facing("fit", i, from.between);
    if (!sides) return;
    for (const auto& other : problem.fits)
      if (other.name == from.name)
        fault("fit", i, "name", "the name \"" + from.name + "\" is taken.", "Choose another name.");
    problem.fits.push_back({from.name, (*sides)[0], (*sides)[1], from.interference, from.kind});
  }

  void add_times() {
    auto& times = study_.output_times;
    times = p_.output_times;
    const SourcePosition where = position_of_value(tree_, "output_times");
    if (!std::is_sorted(times.begin(), times.end(), std::less_equal<>()))
      faults_.add(where, "output_times must increase.");
    if (p_.run.end_time) {
      if (!times.empty() && times.back() > *p_.run.end_time) faults_.add(where, "output_times go beyond run.end_time.");
      if (times.empty() || times.back() < *p_.run.end_time) times.push_back(*p_.run.end_time);
    }
    study_.field_times = p_.field_times;
    study_.field_interval = p_.field_interval.value_or(0.);
    const auto& fields = study_.field_times;
    const SourcePosition where_fields = position_of_value(tree_, "field_times");
    if (!std::is_sorted(fields.begin(), fields.end(), std::less_equal<>()))
      faults_.add(where_fields, "field_times must increase.");
    if (!fields.empty() && !times.empty() && fields.back() > times.back())
      faults_.add(where_fields, "field_times go beyond the last of output_times.", "Give a later run.end_time.");
    if (times.empty() || times.back() <= 0.)
      faults_.add(where, "nothing says how long to compute.", "Give output_times = [...], or run.end_time.");
    else
      check_number_of_fields("field_interval", study_.field_interval, times.back(),
                             position_of_value(tree_, "field_interval"), faults_);
  }

  const HeatParameters& p_;
  const Node& tree_;
  const ReadRecordedHeat& read_recorded_;
  Faults& faults_;
  HeatStudy study_;
  std::map<std::string, std::set<std::pair<std::string, std::string>>>
      joined_;  ///< boundaries, by the list that joins them
};

}  // namespace

HeatStudy make_heat_study(const HeatParameters& parameters, const Node& tree, const ReadRecordedHeat& read_recorded,
                          Faults& faults) {
  HeatStudy study = StudyMaker(parameters, tree, read_recorded, faults).make();
  check_proportions(study.problem, tree, faults);
  return study;
}

}  // namespace rotordrop
