#include "machine/heat/make_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.h"
#include "machine/bearing_data.h"

namespace rotordrop {
namespace {

void add_elastic_growth(const MachineParameters& p, const TouchdownParameters& b, const FiniteElements& elements,
                        FiniteElements::Section& section) {
  const auto material = [](const MaterialParameters& m) {
    return BearingElasticData::Material{m.E, m.nu, m.rho, m.alpha};
  };
  const auto kind = b.housing_fit_kind == HousingFit::bonded ? FitKind::bonded : FitKind::frictionless;
  const ElasticProblem problem =
      bearing_elastic_problem(section.problem, section.solver->section_mesh(),
                              {material(material_of(p, b.ring)), material(shaft_material(p, b)), b.housing_fit, kind});
  section.elastic_solver = elements.make_elastic_solver(problem);
  section.elastic.emplace(*section.elastic_solver, problem, section.problem, section.formula,
                          contact_point_surfaces(b.ball_diameter, b.pitch_diameter, b.contact_angle, b.width),
                          section.solver->field().size());
  const double to_side = 0.5 * b.ball_diameter * std::sin(b.contact_angle);
  std::vector<ElasticGrowth::RowStrips> strips;
  for (const auto& row : row_places(b))
    strips.push_back({row.position - row.direction * to_side, row.position + row.direction * to_side});
  section.row_growth = section.elastic->row_weights(strips);
}

/// Refuses modes that answer heat less exactly than is asked for.
/// @param always_reduced  another coupling is no way out
void check_reduction(const FiniteElements::Section& section, const FeParameters& fe, bool always_reduced) {
  const ReducedHeat& heat = section.reduced;
  if (heat.response_error <= fe.response_tolerance) return;
  throw InputError(
      {},
      fmt::format("the section of {} on {} modes answers heat with an error of {:.2g} % ({}), and "
                  "thermal.fe.response_tolerance = {:.4g} allows {:.2g} %.",
                  section.name, heat.n_modes(), 100. * heat.response_error, heat.worst_response, fe.response_tolerance,
                  100. * fe.response_tolerance),
      fmt::format("{}allow a larger error{}.",
                  heat.n_modes() < static_cast<std::size_t>(fe.modes)
                      ? "More modes would hardly lower it: "
                      : fmt::format("thermal.fe.modes = {} is the most that the case allows: raise it (200 if not "
                                    "given){} ",
                                    fe.modes, always_reduced ? " or" : ","),
                  always_reduced ? "" : ", or set thermal.fe.coupling = \"windowed\""));
}

/// Rows of a ring that only translates carry the same loads but for their balls' places; a free one has thrust and tilts.
bool heats_rows_apart(const TouchdownParameters& b) { return b.rows > 1 && b.ring_motion == RingMotion::free; }

ReducedSection::Elastic reduced_elastic(const FiniteElements::Section& section) {
  ReducedSection::Elastic elastic;
  for (std::size_t s = 0; s < elastic.growth.size(); ++s)
    elastic.growth[s] = section.solver->project(section.elastic->weights()[s]);
  const auto& fit = section.elastic->housing_fit();
  const auto functional = [&](const ElasticInfluence& g) {
    return ReducedSection::Functional{g.at_rest, section.solver->project(g.weights)};
  };
  elastic.mean_pressure = functional(fit.mean);
  for (const auto& node : fit.node) elastic.node_pressure.push_back(functional(node));
  elastic.node_share = fit.share;
  for (const auto& row : section.row_growth)
    for (const auto* weights : {&row.radial, &row.axial}) elastic.rows.push_back(section.solver->project(*weights));
  elastic.drives = section.grows_elastically;
  return elastic;
}

}  // namespace

void make_sections(const MachineParameters& p, FiniteElements& elements, ReductionSettings reduction, bool of_a_drop) {
  const auto& fe = p.thermal.fe;
  elements.coupling = fe.coupling;
  for (const auto& entry : p.bearings) {
    const auto* b = entry.touchdown();
    if (!b) continue;
    const auto circuit = circuit_data(p, entry.name, *b);
    SectionSettings settings{fe.shaft != FeShaft::lump, {}};
    settings.numerics.degree = fe.degree;
    settings.numerics.solver = fe.solver;
    settings.numerics.cells = std::max(2, static_cast<int>(std::lround(8 * fe.refinement)));
    settings.shaft_contact = fe.shaft_contact_resistance;
    settings.rows_apart = of_a_drop && heats_rows_apart(*b);
    settings.housing_film = elements.alone && fe.coupling == FeCoupling::windowed;
    if (elements.alone) settings.numerics.tolerance = elements.alone->time_tolerance;
    const SectionMesh mesh = fe.section == FeSection::plain ? SectionMesh{} : elements.make_mesh(entry.name);
    FiniteElements::Section section;
    section.name = entry.name;
    section.problem = bearing_heat_problem(circuit, mesh, p.run.ambient, settings);
    section.solver = elements.make_solver(section.problem);
    section.row_ports = raceway_row_ports(section.problem);
    section.formula = section_growth(circuit);
    section.adiabatic = adiabatic_section(section);
    section.grows_elastically = p.thermal.expansion == GrowthSource::elastic;
    if (section.grows_elastically || (of_a_drop && elements.make_elastic_solver && b->housing_fit >= 0.))
      add_elastic_growth(p, *b, elements, section);
    if (section.grows_elastically) {
      if (fe.coupling == FeCoupling::windowed) section.adiabatic.growth = immediate_elastic_growth(section);
    }
    if (fe.coupling != FeCoupling::windowed) {
      if (fe.coupling == FeCoupling::monolithic) {
        reduction.modes = 0;
        reduction.fastest = std::numeric_limits<double>::infinity();
      } else {
        // The shaft beside the bearing has modes of its own, which must not be taken from the rings'.
        reduction.modes =
            static_cast<std::size_t>(fe.modes) + std::max(circuit.fins.size(), 8 * circuit.shaft_steps.size());
        reduction.response_tolerance = elements.aimed_response > 0.
                                           ? std::min(elements.aimed_response, fe.response_tolerance)
                                           : fe.response_tolerance;
        reduction.longest_time = std::max(reduction.longest_time, p.run.end_time);
      }
      section.reduced = section.solver->reduce(reduction);
      check_reduction(section, fe, elements.always_reduced);
    }
    elements.sections.push_back(std::move(section));
  }
}

std::vector<ReducedSection> reduced_sections(const MachineParameters& p, const FiniteElements& elements) {
  std::vector<ReducedSection> sections;
  std::size_t k = 0;
  for (const auto& entry : p.bearings) {
    const auto* b = entry.touchdown();
    if (!b) continue;
    const auto& made = elements.sections[k++];
    ReducedSection section{made.name, made.reduced, made.formula, {}, false, made.row_ports, {}};
    if (made.elastic) section.elastic = reduced_elastic(made);
    const auto circuit = circuit_data(p, entry.name, *b);
    section.balls_roll = circuit.balls_roll;
    if (circuit.shaft_ring_link == BearingCircuitData::Link::in_contact) {
      const double touching = p.thermal.fe.shaft_contact_resistance.value_or(circuit_resistances(circuit).R2);
      section.contact_link = {touching, touching + circuit.gap_resistance};
    }
    sections.push_back(std::move(section));
  }
  return sections;
}

std::shared_ptr<const ThermalModel> reduced_fe_model(const MachineParameters& p, FiniteElements& finite_elements,
                                                     double longest) {
  MachineParameters reduced = p;
  reduced.thermal.fe.coupling = FeCoupling::reduced;
  finite_elements.always_reduced = true;
  ReductionSettings settings;
  settings.shortest_time = 0.01;
  settings.longest_time = longest;
  make_sections(reduced, finite_elements, settings);
  return std::make_shared<ReducedSections>(reduced_sections(reduced, finite_elements), p.run.ambient);
}

}  // namespace rotordrop
