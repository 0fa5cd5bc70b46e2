#include "study/statics/statics_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "analysis/statics/statics.h"
#include "integrate/equilibrium.h"
#include "study/json_number.h"
#include "study/statics/shoulder_words.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

constexpr double degrees = 180. / std::numbers::pi;

void require_found(const EquilibriumResult& r, const std::string& what) {
  if (r.found) return;
  throw SolverError(
      fmt::format("no equilibrium of {} was found: the residual is still {:.2g} of the forces after {} Newton steps "
                  "and {} descent steps.\n"
                  "       Check the loads against the static load rating C0, and the units.",
                  what, r.residual, r.newton_steps, r.descent_steps));
}

Json search_json(const EquilibriumResult& r) {
  return {{"residual", r.residual},
          {"newton_steps", r.newton_steps},
          {"descent_steps", r.descent_steps},
          {"continuation_steps", r.continuation_steps}};
}

Json ellipse_json(const EllipseReport& e) {
  return {{"load", e.load},
          {"angle", e.angle},
          {"semi_major_axis", e.semi_major},
          {"semi_minor_axis", e.semi_minor},
          {"pressure", e.pressure},
          {"edge_margin", json_number(e.edge_margin)},
          {"truncation", e.truncation}};
}

Json harmonics_json(const std::vector<RingHarmonic>& harmonics, const std::vector<double>& shape) {
  Json list = Json::array();
  for (std::size_t k = 0; k < harmonics.size(); ++k) {
    const auto& h = harmonics[k];
    list.push_back({{"n", h.n},
                    {"stiffness", h.stiffness},
                    {"mass", h.mass},
                    {"frequency", h.frequency()},
                    {"cosine", shape[2 * k]},
                    {"sine", shape[2 * k + 1]}});
  }
  return list;
}

Json bending_json(const BendingReport& b) {
  return {{"inner", harmonics_json(b.inner, b.inner_shape)},
          {"outer", harmonics_json(b.outer, b.outer_shape)},
          {"largest_outwards", b.largest_outwards},
          {"largest_inwards", b.largest_inwards},
          {"energy", b.energy}};
}

Json ring_json(const RingReport& r) {
  Json j;
  j["floating"] = r.is_floating;
  j["free_directions"] = r.n_free;
  j["displacement"] = {{"x", r.place[0]}, {"y", r.place[1]}, {"z", r.place[2]}};
  j["tilt"] = {{"y", r.place[3]}, {"z", r.place[4]}};
  j["spring_travel"] = r.spring_travel;
  j["preload"] = r.preload;
  j["stiffness"] = r.stiffness;
  j["contact_energy"] = r.energy;
  if (r.bending) j["bending"] = bending_json(*r.bending);
  j["rows"] = Json::array();
  for (const auto& row : r.rows) {
    Json one = {{"axial_force", row.axial_force},
                {"loaded_balls", row.n_loaded},
                {"largest_ball_load", row.largest_load},
                {"largest_pressure", row.largest_pressure},
                {"static_safety", json_number(row.static_safety)},
                {"truncation", row.truncation},
                {"edge_margin", json_number(row.edge_margin)},
                {"pressure_is_void", row.truncation > 0.},
                {"centrifugal_over_load", row.centrifugal_over_load},
                {"neglects_centrifugal", row.neglects_centrifugal}};
    one["ball_stiffness"] = row.ball_stiffness;
    one["ball_loads"] = Json::array();
    for (const auto& b : row.balls) one["ball_loads"].push_back(b.inner.load);
    one["balls"] = Json::array();
    for (const auto& b : row.balls)
      one["balls"].push_back({{"azimuth", b.azimuth},
                              {"inner", ellipse_json(b.inner)},
                              {"outer", ellipse_json(b.outer)},
                              {"centrifugal_force", b.centrifugal_force},
                              {"gyroscopic_moment", b.gyroscopic_moment},
                              {"inner_traction", b.inner_traction},
                              {"residual", b.residual}});
    j["rows"].push_back(std::move(one));
  }
  return j;
}

Json growth_json(const Expansion& g) {
  return {{"shaft", g.shaft},
          {"bore", g.bore},
          {"inner_race", g.inner_race},
          {"outer_race", g.outer_race},
          {"ball", g.ball},
          {"inner_width", g.inner_width},
          {"outer_width", g.outer_width}};
}

Json bearing_json(const Case& c, const std::string& name) {
  const auto& b = touchdown_of(c.parameters, name);
  auto system = bearing_equilibrium(c.parameters, name, b);
  std::vector<double> x = system.start();
  const auto result = find_equilibrium(system, x);
  require_found(result, name + " under its load");
  Json j = {{"ball_model", b.ball_model == BallModel::inertial ? "inertial" : "quasi-static"}};
  j["growth"] = growth_json(static_growth(c.parameters, b));
  j.update(ring_json(report_ring(system.bent_ring(), system.ring_unknowns(x), 1e-6 * system.force_scale())));
  j["search"] = search_json(result);
  if (const auto shoulder = shoulder_json(c.parameters, name); !shoulder.is_null()) j["shoulder"] = shoulder;
  return j;
}

Json shaft_json(const Case& c) {
  ShaftEquilibrium system(c.parameters, c.tree);
  std::vector<double> x(system.size());
  const auto result = find_equilibrium(system, x);
  require_found(result, "the rotor on its supports");
  const auto report = system.report(x);
  const auto& p = c.parameters;
  const double axial = rigid_body(p.rotor.geometry).mass * p.run.gravity[0];
  Json j = {{"weight", report.weight}, {"axial_weight", axial}, {"sag", report.sag}, {"sag_position", report.sag_x}};
  if (axial != 0.)
    j["note"] = fmt::format(
        "gravity's part along the axis, {:.6g} N towards {}, is left out: the shaft takes no axial load here. "
        "statics.subject = \"bearings\" loads them by statics.force, also along x",
        std::fabs(axial), axial > 0. ? "+x" : "-x");
  j["supports"] = Json::object();
  for (const auto& s : report.supports) {
    Json one = {{"node", s.node},
                {"force_on_rotor", {{"y", s.force_on_rotor[0]}, {"z", s.force_on_rotor[1]}}},
                {"journal", {{"y", s.journal[0]}, {"z", s.journal[1]}}}};
    if (s.moment_on_rotor) one["moment_on_rotor"] = {{"y", (*s.moment_on_rotor)[0]}, {"z", (*s.moment_on_rotor)[1]}};
    if (s.is_touchdown) {
      one["clearance"] = s.clearance;
      one["outer_ring"] = {{"y", s.outer_ring[0]}, {"z", s.outer_ring[1]}};
      one["inner_ring"] = ring_json(s.ring);
    }
    j["supports"][s.name] = std::move(one);
  }
  for (const auto& [name, probe] : c.parameters.rotor.probes) {
    const auto at = static_cast<std::size_t>(probe.node - 1);
    const double y = report.axis[0][at], z = report.axis[1][at];
    j["probes"][name] = {{"node", probe.node},
                         {"position", {{"y", y}, {"z", z}}},
                         {"clearance", probe.clearance - std::hypot(y - probe.centre[0], z - probe.centre[1])}};
  }
  j["axis"] = {{"x", report.node_x}, {"y", report.axis[0]}, {"z", report.axis[1]}};
  j["search"] = search_json(result);
  return j;
}

std::string ring_text(const Json& r) {
  std::string text;
  const auto& d = r["displacement"];
  text += fmt::format("  ring at x {:.4g}, y {:.4g}, z {:.4g} um; tilt about y {:.4g}, z {:.4g} urad",
                      d["x"].get<double>() * 1e6, d["y"].get<double>() * 1e6, d["z"].get<double>() * 1e6,
                      r["tilt"]["y"].get<double>() * 1e6, r["tilt"]["z"].get<double>() * 1e6);
  if (r.contains("bending"))
    text += fmt::format("\n  inner ring bent by {:.4g} um outwards, {:.4g} um inwards",
                        r["bending"]["largest_outwards"].get<double>() * 1e6,
                        r["bending"]["largest_inwards"].get<double>() * 1e6);
  if (r["floating"].get<bool>()) return text + "\n  floating: no ball touches the inner ring\n";
  text += fmt::format("; remaining preload {:.4g} N\n", r["preload"].get<double>());
  if (const int n = r["free_directions"].get<int>(); n > 0)
    text += fmt::format("  {} of the five directions {} unconstrained: no ball resists motion there\n", n,
                        n == 1 ? "is" : "are");
  text += fmt::format("  {:>4} {:>8} {:>10} {:>12} {:>19} {:>12} {:>10} {:>8}\n", "row", "loaded", "axial [N]",
                      "ball max [N]", "angles in/out [deg]", "ellipse [mm]", "p [GPa]", "s0");
  std::size_t i = 0;
  for (const auto& row : r["rows"]) {
    ++i;
    const auto& balls = row["balls"];
    const auto worst = std::max_element(balls.begin(), balls.end(), [](const Json& a, const Json& b) {
      return std::max(a["inner"]["pressure"].get<double>(), a["outer"]["pressure"].get<double>()) <
             std::max(b["inner"]["pressure"].get<double>(), b["outer"]["pressure"].get<double>());
    });
    const auto& ellipse =
        (*worst)["inner"]["pressure"] > (*worst)["outer"]["pressure"] ? (*worst)["inner"] : (*worst)["outer"];
    text += fmt::format("  {:>4} {:>5}/{:<2} {:>10.2f} {:>12.2f} {:>9.3f} {:>9.3f} {:>12} {:>10.3f} {:>8}\n", i,
                        row["loaded_balls"].get<int>(), balls.size(), row["axial_force"].get<double>(),
                        row["largest_ball_load"].get<double>(), (*worst)["inner"]["angle"].get<double>() * degrees,
                        (*worst)["outer"]["angle"].get<double>() * degrees,
                        fmt::format("{:.3f}x{:.3f}", 2e3 * ellipse["semi_major_axis"].get<double>(),
                                    2e3 * ellipse["semi_minor_axis"].get<double>()),
                        row["largest_pressure"].get<double>() * 1e-9,
                        row["pressure_is_void"].get<bool>() ? "void"
                        : row["static_safety"].is_null()    ? "-"
                                                         : fmt::format("{:.3g}", row["static_safety"].get<double>()));
  }
  i = 0;
  for (const auto& row : r["rows"]) {
    ++i;
    if (row["pressure_is_void"].get<bool>())
      text += fmt::format(
          "  warning: contact ellipses of row {} reach over the raceway's edge, by up to {:.0f} % of their length: "
          "pressure and s0 are void\n",
          i, 100. * row["truncation"].get<double>());
    else if (!row["edge_margin"].is_null())
      text += fmt::format("  row {}: {:.3f} mm of raceway left beside the contact ellipse\n", i,
                          1e3 * row["edge_margin"].get<double>());
    if (row["neglects_centrifugal"].get<bool>())
      text += fmt::format(
          "  warning: centrifugal forces are {:.2g} times the ball loads of row {}, and ball_model = \"quasi-static\" "
          "leaves them out\n",
          row["centrifugal_over_load"].get<double>(), i);
  }
  const auto& K = r["stiffness"];
  text += fmt::format(
      "  stiffness: axial {:.5g}, radial {:.5g} (y), {:.5g} (z) N/um; tilting {:.5g} (y), {:.5g} (z) N m/rad\n",
      K[0][0].get<double>() * 1e-6, K[1][1].get<double>() * 1e-6, K[2][2].get<double>() * 1e-6, K[3][3].get<double>(),
      K[4][4].get<double>());
  if (!r.contains("bending"))
    text += "  rings are rigid: rings that bend (ring_bending) load fewer balls, and more heavily\n";
  return text;
}

std::string residual_text(const Json& search) {
  return fmt::format("Residual {:.1e} of the forces after {} Newton steps.\n", search["residual"].get<double>(),
                     search["newton_steps"].get<long>() + search["descent_steps"].get<long>());
}

}  // namespace

Json find_rest(const Case& c, const std::string& bearing) {
  Json j;
  j["case"] = c.name;
  const auto names = chosen_touchdowns(c, bearing);
  if (bearing.empty() && c.parameters.statics.subject == StaticsSubject::shaft) {
    j["shaft"] = shaft_json(c);
    return j;
  }
  if (names.empty())
    throw InputError(position_of(c.tree, "bearings"), "the case has no touchdown bearing to load by itself.",
                     "statics.subject = \"shaft\" takes linear supports.");
  j["bearings"] = Json::object();
  for (const auto& name : names) j["bearings"][name] = bearing_json(c, name);
  return j;
}

std::string statics_text(const Json& report) {
  std::string text;
  if (report.contains("bearings"))
    for (const auto& [name, b] : report["bearings"].items()) {
      text += fmt::format("{} ({} balls) under its load\n", name, b["ball_model"].get<std::string>());
      text += ring_text(b);
      if (b.contains("shoulder")) text += shoulder_text(b["shoulder"], 2);
      text += "  " + residual_text(b["search"]);
    }
  if (report.contains("shaft")) {
    const auto& s = report["shaft"];
    text += fmt::format("Rotor at rest, weight {:.6g} N; static sag {:.4g} um at x = {:.4g} m\n",
                        s["weight"].get<double>(), s["sag"].get<double>() * 1e6, s["sag_position"].get<double>());
    if (s.contains("note")) text += "note: " + s["note"].get<std::string>() + "\n";
    for (const auto& [name, one] : s["supports"].items()) {
      text += fmt::format("{} (node {}): carries y {:.6g}, z {:.6g} N; journal at y {:.4g}, z {:.4g} um\n", name,
                          one["node"].get<int>(), one["force_on_rotor"]["y"].get<double>(),
                          one["force_on_rotor"]["z"].get<double>(), one["journal"]["y"].get<double>() * 1e6,
                          one["journal"]["z"].get<double>() * 1e6);
      if (!one.contains("inner_ring")) continue;
      const double clearance = one["clearance"].get<double>() * 1e6;
      text += clearance > 0. ? fmt::format("  rotor clear of the bore by {:.4g} um\n", clearance)
                             : fmt::format("  rotor pressed {:.4g} um into the bore\n", -clearance);
      text += ring_text(one["inner_ring"]);
    }
    if (s.contains("probes"))
      for (const auto& [name, one] : s["probes"].items()) {
        const double left = one["clearance"].get<double>() * 1e6;
        text += fmt::format("{} (node {}): at y {:.4g}, z {:.4g} um; {}\n", name, one["node"].get<int>(),
                            one["position"]["y"].get<double>() * 1e6, one["position"]["z"].get<double>() * 1e6,
                            left > 0. ? fmt::format("clearance left {:.4g} um", left)
                                      : fmt::format("warning: {:.4g} um beyond its clearance, where the static balance "
                                                    "has no contact",
                                                    -left));
      }
    text += residual_text(s["search"]);
  }
  return text;
}

}  // namespace rotordrop
