#include "study/statics/shoulder_words.h"

#include <fmt/format.h>

namespace rotordrop {

using Json = nlohmann::ordered_json;

Json shoulder_json(const MachineParameters& p, const std::string& bearing) {
  const auto report = shoulder_report(p, bearing);
  return report ? shoulder_json(*report) : Json(nullptr);
}

Json shoulder_json(const ShoulderReport& report) {
  Json j = {{"stiffness", report.stiffness},
            {"stiffness_from", report.is_given ? "given" : "geometry"},
            {"rotor_stiffness", report.rotor_stiffness},
            {"ring_stiffness", report.ring_stiffness}};
  j["sides"] = Json::array();
  for (const auto& side : report.sides)
    j["sides"].push_back(
        {{"push", side.direction > 0. ? "+x" : "-x"},
         {"gap", side.gap},
         {"thrust", side.thrust},
         {"approach_speed", side.speed},
         {"force_by_energy",
          {{"half_stiffness", side.force[0]}, {"stiffness", side.force[1]}, {"double_stiffness", side.force[2]}}}});
  return j;
}

std::string shoulder_text(const Json& j, std::size_t indent) {
  if (j.is_null()) return {};
  const auto number = [](const Json& object, const char* key) { return object[key].get<double>(); };
  std::string text =
      fmt::format("{:{}}shoulder stiffness {:.3g} N/m ({}: rotor {:.3g} and ring {:.3g} N/m in series)\n", "", indent,
                  number(j, "stiffness"), j["stiffness_from"] == "given" ? "given; by the bodies" : "from the bodies",
                  number(j, "rotor_stiffness"), number(j, "ring_stiffness"));
  for (const auto& side : j["sides"]) {
    const auto& force = side["force_by_energy"];
    text += fmt::format(
        "{:{}}shoulder force by energy under {:.4g} N towards {} over {:.4g} mm: {:.3g} kN; {:.3g} kN with half, "
        "{:.3g} "
        "kN with double that stiffness\n",
        "", indent, number(side, "thrust"), side["push"].get<std::string>(), number(side, "gap") * 1e3,
        number(force, "stiffness") * 1e-3, number(force, "half_stiffness") * 1e-3,
        number(force, "double_stiffness") * 1e-3);
  }
  return text;
}

std::string conventions_text(const MachineParameters& p, const std::string& bearing) {
  const auto& b = touchdown_of(p, bearing);
  const double um = 1e6, gap = air_gap(b, p.contact) * um, clearance = b.radial_clearance * um,
               fit = b.housing_fit * um;
  const double bore = 2e3 * bore_radius(b, p.contact), shaft = 1e3 * shaft_diameter(p.rotor.geometry, b.node);
  std::string text = fmt::format("{}: ", bearing);
  if (b.catalogue) text += *b.catalogue + (b.count > 1 ? fmt::format(", {} of them", b.count) : "") + ", ";
  if (b.rows == 2)
    text += b.arrangement == RowArrangement::tandem         ? "tandem, "
            : b.arrangement == RowArrangement::back_to_back ? "O arrangement, "
                                                            : "X arrangement, ";
  text += fmt::format("node {} at x = {:.6g} mm; journal {:.6g} mm in a bore of {:.6g} mm", b.node,
                      1e3 * p.rotor.geometry.position(b.node), bore - 2. * gap * 1e-3, bore);
  if (shaft > 0.) text += fmt::format(", the shaft there has {:.6g} mm", shaft);
  text +=
      fmt::format(";\n{:{}}air gap {:.6g} um by radius ({:.6g} um by diameter)", "", bearing.size() + 2, gap, 2. * gap);
  if (b.contact_angle == 0.)
    text += fmt::format(", radial clearance {:.6g} um (catalogue's radial internal clearance, diametral: {:.6g} um)",
                        clearance, 2. * clearance);
  if (b.contact_angle != 0. && b.rows > 1)
    text += b.preload == 0. ? std::string(", no preload")
                            : fmt::format(", preload {:.6g} N on each row{}", b.preload,
                                          b.rows == 2 && b.arrangement != RowArrangement::tandem
                                              ? " (catalogues call this the pair's preload)"
                                              : "");
  else if (b.contact_angle != 0.)
    text += fmt::format(", preload {:.6g} N on its row", b.preload);
  text += fmt::format(",\n{:{}}housing fit {:.6g} um of interference by radius ({:.6g} um by diameter), ", "",
                      bearing.size() + 2, fit, 2. * fit);
  text += b.rows > 1 ? fmt::format("C0 {:.6g} kN of all {} rows ({:.6g} kN of one, as the catalogue has one bearing)\n",
                                   b.C0 * 1e-3, b.rows, b.C0 / b.rows * 1e-3)
                     : fmt::format("C0 {:.6g} kN\n", b.C0 * 1e-3);
  return text;
}

}  // namespace rotordrop
