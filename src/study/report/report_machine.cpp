#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "analysis/facts/rotor_report.h"
#include "base/rotation.h"
#include "io/hdf5/recorded_series.h"
#include "study/modes/campbell_lines.h"
#include "study/report/packed.h"
#include "study/report/report.h"
#include "study/report/rounded.h"

// The machine from the side, how its rotor vibrates, and how it bends in the drop.
namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

/// To a nanometre: round numbers of a drawing stay round.
double mm(double metres) { return std::round(metres * 1e9) * 1e-6; }

Json touchdown_json(const TouchdownParameters& b, const ContactParameters& contact) {
  Json rows = Json::array();
  for (const RowPlace& row : row_places(b)) rows.push_back(mm(row.position));
  return {{"air_gap", 1e6 * air_gap(b, contact)},
          {"bore_diameter", mm(2. * bore_radius(b, contact))},
          {"width", mm(b.width)},
          {"ball_diameter", mm(b.ball_diameter)},
          {"pitch_diameter", mm(b.pitch_diameter)},
          {"rows", rows},
          {"inner_ring", {mm(b.inner_ring_diameters[0]), mm(b.inner_ring_diameters[1])}},
          {"outer_ring", {mm(b.outer_ring_diameters[0]), mm(b.outer_ring_diameters[1])}}};
}

Json supports_json(const CaseParameters& p) {
  Json list = Json::array();
  for (const auto& entry : p.bearings) {
    Json support = {{"name", entry.name},
                    {"kind", entry.touchdown() ? "touchdown"
                             : entry.linear()  ? "linear"
                             : entry.magnet()  ? "magnet"
                                               : "other"},
                    {"node", entry.node()},
                    {"x", mm(p.rotor.geometry.position(entry.node()))}};
    if (const auto* b = entry.touchdown()) support.update(touchdown_json(*b, p.contact));
    list.push_back(std::move(support));
  }
  return list;
}

/// Nodes at which the run's rotor has stations, as build_machine() makes them.
std::vector<int> stations(const CaseParameters& p) {
  std::vector<int> nodes;
  for (const auto& entry : p.bearings) nodes.push_back(entry.node());
  for (const auto& [name, probe] : p.rotor.probes)
    if (probe.contact) nodes.push_back(probe.node);
  return nodes;
}

bool bends(const CaseParameters& p) { return p.rotor.model != RotorRepresentation::rigid; }

std::string support_words(const CaseParameters& p) {
  const auto& all = p.bearings;
  const bool has_linear = std::any_of(all.begin(), all.end(), [](const auto& entry) { return entry.linear(); });
  const bool has_magnets = std::any_of(all.begin(), all.end(), [](const auto& entry) { return entry.magnet(); });
  if (has_linear && has_magnets) return "on linear supports and magnets";
  return has_linear ? "on linear supports" : has_magnets ? "on magnets" : "free-free";
}

/// Deflections at the instant at which the largest of them is largest, in the plane that shows it.
std::vector<double> real_shape(const WhirlMode& mode) {
  const auto size = [](const auto& a, const auto& b) { return std::abs(a) < std::abs(b); };
  const auto v = std::max_element(mode.v.begin(), mode.v.end(), size),
             w = std::max_element(mode.w.begin(), mode.w.end(), size);
  const bool is_y = std::abs(*v) >= std::abs(*w);
  const std::complex<double> top = is_y ? *v : *w;
  std::vector<double> shape;
  for (const auto& value : is_y ? mode.v : mode.w) shape.push_back((value * std::conj(top)).real() / std::norm(top));
  return shape;
}

/// Lines of one kind of motion each.
Json campbell_curves(const CriticalSpeedReport& report, double largest_frequency) {
  struct Branch {
    std::vector<double> x, y;
    Whirl whirl = Whirl::planar;
    bool is_damped = false;
  };
  Json curves = Json::array();
  const auto close = [&](Branch& branch) {
    if (branch.x.size() > 1) {
      const bool is_forward = branch.whirl == Whirl::forward, is_backward = branch.whirl == Whirl::backward;
      curves.push_back({{"name", std::string(is_forward    ? "forward"
                                             : is_backward ? "backward"
                                                           : "planar or mixed") +
                                     (branch.is_damped ? ", damping above 30 %" : "")},
                        {"colour", is_forward    ? 0
                                   : is_backward ? 1
                                                 : 6},
                        {"dash", branch.is_damped ? 2 : 0},
                        {"x", rounded(branch.x, to_rpm)},
                        {"y", rounded(branch.y, 1.)}});
    }
    branch = {};
  };
  for (const CampbellLine& line : campbell_lines(report, largest_frequency)) {
    Branch branch;
    for (const auto& [speed, mode] : line) {
      const bool is_damped = mode->damping_ratio > 0.3;
      const bool is_settled = branch.x.size() > 1;  // at rest every whirl is planar
      if (is_settled && (mode->whirl != branch.whirl || is_damped != branch.is_damped)) {
        const double x = branch.x.back(), y = branch.y.back();
        close(branch);
        branch.x = {x};
        branch.y = {y};
      }
      branch.x.push_back(speed);
      branch.y.push_back(mode->frequency);
      branch.whirl = mode->whirl;
      branch.is_damped = is_damped;
    }
    close(branch);
  }
  return curves;
}

Json campbell_chart(const CriticalSpeedReport& report, double up_to, double operating, const std::string& supports) {
  Json lines = campbell_curves(report, 1.25 * up_to / two_pi), points = Json::array();
  // At every speed of the diagram: the page reads values off the nearest point.
  lines.push_back({{"name", "spin frequency"},
                   {"colour", 7},
                   {"dash", 1},
                   {"x", rounded(report.diagram_speeds, to_rpm, 7)},
                   {"y", rounded(report.diagram_speeds, 1. / two_pi, 7)}});
  for (const auto& one : report.speeds)
    points.push_back({{"x", one.speed * to_rpm},
                      {"y", one.speed / two_pi},
                      {"text", fmt::format("critical speed {:.5g} rpm, {}, damping ratio {:.3g} %", one.speed * to_rpm,
                                           to_string(one.whirl), 100. * one.damping_ratio)}});
  return {{"id", "campbell"},
          {"section", "Vibration of the rotor"},
          {"title", "Campbell diagram"},
          {"x", {{"label", "spin speed"}, {"unit", "rpm"}}},
          {"y", {{"label", "frequency"}, {"unit", "Hz"}}},
          {"note", fmt::format("Damped frequencies of the rotor {}. Dots: critical speeds{}. Touchdown bearings do not "
                               "hold a levitated rotor and take no part.",
                               supports, report.speeds.empty() ? " (none up to here)" : "")},
          {"points", points},
          {"marks", {{{"x", operating * to_rpm}, {"name", "initial speed"}}}},
          {"lines", lines}};
}

Json map_chart(const CriticalSpeedReport& report, double up_to, double operating) {
  std::size_t most = 0;
  for (const auto& speeds : report.map_speeds) most = std::max(most, speeds.size());
  Json lines = Json::array();
  for (std::size_t k = 0; k < most; ++k) {
    std::vector<double> x, y;
    for (std::size_t i = 0; i < report.map_stiffness.size(); ++i)
      if (k < report.map_speeds[i].size()) {
        x.push_back(std::log10(report.map_stiffness[i]));
        y.push_back(report.map_speeds[i][k]);
      }
    if (x.size() < 2) continue;
    lines.push_back({{"name", "undamped critical speeds"},
                     {"colour", 0},
                     {"dash", 0},
                     {"x", rounded(x, 1., 6)},
                     {"y", rounded(y, to_rpm)}});
  }
  return {{"id", "critical-speed-map"},
          {"section", "Vibration of the rotor"},
          {"title", "Critical-speed map"},
          {"x", {{"label", "stiffness of each support"}, {"unit", "N/m"}, {"log", true}}},
          {"y", {{"label", "critical speed"}, {"unit", "rpm"}}},
          {"note", fmt::format("The rotor on isotropic springs without damping at its supports, up to {:.5g} rpm.",
                               up_to * to_rpm)},
          {"limits", {{{"name", "initial speed"}, {"value", operating * to_rpm}}}},
          {"lines", lines}};
}

}  // namespace

Json report_machine(const RecordedDrop& drop) {
  const auto& p = drop.parameters();
  const auto& g = p.rotor.geometry;
  Json elements = Json::array(), masses = Json::array(), unbalances = Json::array(), probes = Json::array();
  for (const auto& e : g.elements) elements.push_back({mm(g.position(e.n1)), mm(g.position(e.n2)), mm(e.od), mm(e.id)});
  for (const auto& m : g.mass_points)
    if (m.mass > 0. || m.Ip > 0. || m.Id > 0.)
      masses.push_back({{"x", mm(g.position(m.node))}, {"mass", m.mass}, {"Ip", m.Ip}, {"Id", m.Id}});
  for (const auto& u : p.rotor.unbalance)
    unbalances.push_back(
        {{"x", mm(g.position(u.node))}, {"me", 1e6 * u.me}, {"angle", u.angle * 180. / std::numbers::pi}});
  for (const auto& [name, probe] : p.rotor.probes)
    probes.push_back({{"name", name},
                      {"x", mm(g.position(probe.node))},
                      {"radius", mm(probe_radius(probe, g))},
                      {"clearance", 1e6 * probe.clearance}});
  const RigidBody body = rotor_report(p.rotor).body;
  return {{"elements", elements},
          {"masses", masses},
          {"unbalances", unbalances},
          {"probes", probes},
          {"supports", supports_json(p)},
          {"centre_of_gravity", mm(body.centre_of_gravity)},
          {"mass", body.mass},
          {"Ip", body.Ip},
          {"Id", body.Id},
          {"is_rigid", !bends(p)}};
}

Json report_modes(const RecordedDrop& drop) {
  const auto& p = drop.parameters();
  if (!bends(p)) return nullptr;
  constexpr std::size_t n_shown = 6;
  const double speed = p.run.initial_speed;
  const auto frequencies = rotor_report(p.rotor).free_free_frequencies;
  const double largest = frequencies.empty() ? 0. : frequencies[std::min<std::size_t>(frequencies.size(), 3) - 1];
  Json list = Json::array();
  const auto found = machine_modes(p, {speed}, 2. * std::max(largest, std::abs(speed) / two_pi));
  for (const auto& mode : found.front().modes) {
    if (list.size() == n_shown) break;
    // At rest the two planes of one mode.
    if (mode.whirl == Whirl::planar && !list.empty() && list.back()["whirl"] == "planar" &&
        std::fabs(mode.frequency - list.back()["frequency"].get<double>()) < 1e-6 * mode.frequency)
      continue;
    list.push_back({{"frequency", mode.frequency},
                    {"damping_ratio", mode.damping_ratio},
                    {"whirl", std::string(to_string(mode.whirl))},
                    {"shape", rounded(real_shape(mode), 1., 5)}});
  }
  return {{"supports", support_words(p)},
          {"speed", speed * to_rpm},
          {"x", rounded(p.rotor.geometry.node_x, 1e3, 8)},
          {"modes", list}};
}

Json report_critical_speeds(const RecordedDrop& drop) {
  const auto& p = drop.parameters();
  const double operating = std::abs(p.run.initial_speed);
  Json charts = Json::array();
  if (!bends(p) || !(operating > 0.) || p.bearings.empty()) return charts;
  CriticalSpeedOptions options;
  options.up_to = 2. * operating;
  options.n_speeds = 61;
  options.is_coarse = true;
  // Two decades to both sides of the stiffness that would hold the whole mass at the operating speed.
  const double middle =
      rotor_report(p.rotor).body.mass * operating * operating / static_cast<double>(p.bearings.size());
  const double low = std::pow(10., std::floor(std::log10(middle)) - 2.);
  constexpr int n_stiffness = 61;
  for (int k = 0; k < n_stiffness; ++k) options.map.push_back(low * std::pow(10., 5. * k / (n_stiffness - 1)));
  const CriticalSpeedReport report = critical_speeds(p, options);
  charts.push_back(campbell_chart(report, options.up_to, operating, support_words(p)));
  charts.push_back(map_chart(report, options.up_to, operating));
  return charts;
}

Json report_bending(const RecordedDrop& drop) {
  if (!drop.has("/rotor/modal_y")) return nullptr;
  constexpr std::size_t n_frames = 3000;
  const auto& p = drop.parameters();
  const RotorShapes shapes = rotor_shapes(p.rotor, stations(p));
  const std::size_t n_modes = shapes.shape.size();
  Json bending = {{"x", rounded(p.rotor.geometry.node_x, 1e3, 8)}, {"frequencies", shapes.frequency}};
  for (const auto& shape : shapes.shape) bending["shapes"].push_back(rounded(shape, 1., 7));
  for (const char* plane : {"y", "z"})
    for (std::size_t mode = 0; mode < n_modes; ++mode) {
      const TimeSeries s = drop.series(std::string("/rotor/modal_") + plane, mode);
      const std::size_t stride = (s.times.size() + n_frames - 1) / n_frames;
      std::vector<double> times, values;
      for (std::size_t k = 0; k < s.times.size(); k += stride) {
        times.push_back(s.times[k]);
        values.push_back(s.values[k]);
      }
      if (!bending.contains("time")) bending["time"] = packed_floats(times, 1e3);
      bending[plane].push_back(packed(values, 1e6));
    }
  return bending;
}

}  // namespace rotordrop
