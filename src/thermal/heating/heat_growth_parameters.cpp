#include "thermal/heating/heat_growth_parameters.h"

#include "thermal/heating/result_name.h"

namespace rotordrop {

std::vector<std::string> read_two_boundaries(const Node& node, const std::string& table, Faults& faults) {
  if (node.is_array() && node.items().size() == 2 && node.items()[0].is_text() && node.items()[1].is_text())
    return {node.items()[0].text(), node.items()[1].text()};
  faults.add(node.where(), table + ".between must be two names of boundaries, not " + to_text(node) + ".");
  return {};
}

Section<HeatElasticParameters> heat_elastic_section() {
  using P = HeatElasticParameters;
  Section<P> s("elastic", "Displacements by thermo-elasticity; computed if there is a [[displacement]] or [[fit]].");
  s.quantity("strain_free_temperature", &P::strain_free_temperature,
             {.unit = "K",
              .range = between(1, 2000),
              .usual = between(200, 1500),
              .help = "Temperature at which the bodies have the dimensions of [section]; run.ambient if omitted."});
  return s;
}

Section<HeatFitParameters> heat_fit_section() {
  using P = HeatFitParameters;
  Section<P> s("fit",
               "Two boundaries that press on each other where they lie on each other. Bodies without a fit do not feel "
               "each other. Heat passes through an [[interface]], which is stated on its own.");
  s.text("name", &P::name, {.help = "Name of the quantity in the results."});
  s.custom(
      "between",
      {.accepts = "[\"BODY.side\", \"BODY.side\"]",
       .json_types = {"array"},
       .required = true,
       .help = "The two boundaries."},
      [](const Node& node, P& target, Faults& faults) { target.between = read_two_boundaries(node, "fit", faults); });
  s.quantity("interference", &P::interference,
             {.unit = "m",
              .range = between(-1e-2, 1e-2),
              .usual = between(-1e-3, 1e-3),
              .fallback = "0 m",
              .help = "Radial or axial interference of the parts before assembly; negative: clearance."});
  s.choice("kind", &P::kind, {{"frictionless", FitKind::frictionless}, {"bonded", FitKind::bonded}},
           {.fallback = "frictionless",
            .help = "frictionless: transmits only pressure and opens instead of going into tension. bonded: the parts "
                    "are one body."});
  s.check([](const P& p, const Node& table, const std::string& path, Faults& faults) {
    require_result_name(p.name, table, path, faults);
  });
  return s;
}

Section<HeatHoldParameters> heat_hold_section() {
  using P = HeatHoldParameters;
  Section<P> s("hold", "A boundary that does not move. What is free along the axis keeps its mean place there.");
  s.text("boundary", &P::boundary, {.help = "Boundary: BODY.inner, .outer, .left or .right."});
  s.choice("direction", &P::direction,
           {{"axial", HoldDirection::axial}, {"radial", HoldDirection::radial}, {"both", HoldDirection::both}},
           {.fallback = "axial", .help = "Direction in which the boundary is held."});
  return s;
}

Section<HeatPlaceParameters> heat_place_section(const std::string& name, const std::string& sentence) {
  using P = HeatPlaceParameters;
  Section<P> s(name, sentence);
  s.text("name", &P::name, {.help = "Name of the quantity in the results."});
  s.quantity("x", &P::x, {.unit = "m", .help = "Axial coordinate of the point."});
  s.quantity("r", &P::r, {.unit = "m", .help = "Radius of the point."});
  s.text("body", &P::body,
         {.help = "Body of the point where two bodies meet; the first one that contains the point if omitted."});
  s.text("boundary", &P::boundary,
         {.help = "Boundary whose area mean is reported: BODY.inner, .outer, .left or .right."});
  s.check([](const P& p, const Node& table, const std::string& path, Faults& faults) {
    const bool point = p.x && p.r;
    if (point == p.boundary.has_value() || p.x.has_value() != p.r.has_value())
      faults.add(position_of(table, "name"), path + " (\"" + p.name + "\") needs either x and r, or boundary.");
    require_result_name(p.name, table, path, faults);
  });
  return s;
}

Section<DisplacementParameters> displacement_section() {
  return heat_place_section(
      "displacement",
      "An axial and radial displacement that is reported: at a point (x, r), or the mean of a boundary.");
}

}  // namespace rotordrop
