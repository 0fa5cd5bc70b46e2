#include "thermal/fe_parameters.h"

#include <algorithm>
#include <functional>

namespace rotordrop {

Section<FeParameters> fe_section() {
  using P = FeParameters;
  Section<P> s("fe", "Finite elements of every touchdown bearing: the mesh of rings and housing (docs/mesh.md).");
  s.quantity("surface_cell", &P::surface_cell,
             {.unit = "m",
              .range = between(1e-7, 1e-2),
              .fallback = "25 um",
              .source = "estimate: a sixth of the layer that an impact of 2 ms heats",
              .help = "Thickness of the cells on the bore and on the raceways' strips."});
  s.quantity("largest_cell", &P::largest_cell,
             {.unit = "m",
              .range = between(1e-6, 0.1),
              .fallback = "2 mm",
              .source = "estimate",
              .help = "Size of cells far from heated surfaces."});
  s.quantity("refinement", &P::refinement,
             {.range = between(0.25, 16), .fallback = "1", .help = "All cells are divided by this; 2 halves them."});
  s.quantity(
      "strip_half_width", &P::strip_half_width,
      {.unit = "m",
       .range = positive(),
       .help = "Half width of the raceways' strips that take the balls' heat, along the arc: the semi-major axis "
               "of the contact ellipse. thermal.contact_half_width if not given."});
  s.quantity("relieved_shoulder", &P::relieved_shoulder,
             {.range = between(0, 1),
              .fallback = "0.4",
              .source = "estimate from drawings of spindle bearings",
              .help = "Part of the groove's depth that the outer ring's shoulder keeps on the side away from the load, "
                      "where balls and cage go in. Of bearings with a contact angle; 1: not relieved."});
  s.boolean("shaft", &P::shaft,
            {.fallback = false, .help = "Whether the shaft is meshed too, over shaft_lump_length; a lump otherwise."});
  s.text("mesh", &P::mesh,
         {.help = "Your own mesh instead: a .msh file of gmsh, or a .geo recipe, beside the case. NAME in it stands "
                  "for the bearing's name: "
                  "\"meshes/NAME.msh\". docs/mesh.md says what it must have."});
  s.choice(
      "section", &P::section, {{"grooved", FeSection::grooved}, {"plain", FeSection::plain}},
      {.fallback = "grooved",
       .help = "Races with their grooves, meshed by gmsh; or plain rectangles of the rings' diameters, heated over "
               "their whole width."});
  s.choice(
      "coupling", &P::coupling,
      {{"reduced", FeCoupling::reduced}, {"windowed", FeCoupling::windowed}, {"monolithic", FeCoupling::monolithic}},
      {.fallback = "reduced",
       .help = "How the finite elements take part in a drop: reduced to few modes in the state vector; windowed, "
               "advanced implicitly beside it with the energy of each window; monolithic, with all modes of a small "
               "mesh, for tests."});
  s.integer("degree", &P::degree,
            {.range = between(1, 4), .fallback = 2, .help = "Polynomial degree of the elements."});
  s.integer("modes", &P::modes,
            {.range = between(8, 200),
             .fallback = 200,
             .help = "The most modes of each bearing's section that a reduced coupling may keep. It keeps as few as "
                     "response_tolerance allows; a case that allows too few is refused."});
  s.quantity(
      "response_tolerance", &P::response_tolerance,
      {.range = between(1e-4, 10),
       .fallback = "0.005",
       .source = "a tenth of what rotordrop compare calls a difference",
       .help = "Largest relative error of a reduced coupling's responses to heat, of every port and of every mean "
               "of a body, from 0.1 ms to 1000 s or to the run's end. Decides how many modes are kept."});
  s.choice("solver", &P::solver, linear_solvers(), {.fallback = "direct", .help = linear_solver_help});
  s.quantity("window_tolerance", &P::window_tolerance,
             {.unit = "m",
              .range = between(1e-13, 1e-6),
              .fallback = "0.5 nm",
              .help = "Error of a surface's growth that a window may leave. Decides how long windows are."});
  s.quantity("longest_window", &P::longest_window,
             {.unit = "s",
              .range = between(1e-5, 0.1),
              .fallback = "2 ms",
              .help = "The longest window of a windowed coupling; the others are halves, quarters and so on."});
  s.quantities("field_times", &P::field_times,
               {.unit = "s",
                .range = at_least(0),
                .help = "When the temperature field of every section is written for ParaView; the start is always "
                        "among them. A windowed coupling writes at the first window's end from then on."});
  s.quantity("field_interval", &P::field_interval,
             {.unit = "s", .range = positive(), .help = "The same at multiples of this time."});
  s.check([](const P& p, const Node& table, Faults& faults) {
    if (!std::is_sorted(p.field_times.begin(), p.field_times.end(), std::less_equal<>()))
      faults.add(position_of_value(table, "field_times"), "thermal.fe.field_times do not rise.");
    if (p.surface_cell > p.largest_cell)
      faults.add(position_of_value(table, "surface_cell"),
                 "thermal.fe.surface_cell is larger than thermal.fe.largest_cell.", "Cells grow away from surfaces.");
  });
  return s;
}

std::string own_mesh_file(const std::string& pattern, const std::string& bearing) {
  std::string file = pattern;
  for (std::size_t at = file.find("NAME"); at != std::string::npos; at = file.find("NAME", at + bearing.size()))
    file.replace(at, 4, bearing);
  return file;
}

}  // namespace rotordrop
