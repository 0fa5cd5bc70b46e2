#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "analysis/statics/statics.h"
#include "study/drop/drop_summary.h"
#include "study/statics/shoulder_words.h"

namespace rotordrop {
namespace {

constexpr double rpm = 30. / std::numbers::pi;

std::string ms(double time) { return std::isfinite(time) ? fmt::format("{:.4g} ms", time * 1e3) : "never"; }

/// Lines on balls that friction may not keep rolling, if any.
std::string skid_text(const BearingSummary& b) {
  const std::string indent(b.name.size() + 2, ' ');
  const SkidVerdict skid = skid_verdict(b.scalars, b.n_rows);
  const double beyond = skid.demand.speed_change_beyond, all = skid.demand.speed_change;
  std::string text;
  if (beyond > relevant_speed_share * all)
    text += fmt::format(
        "{}balls of row {} may skid: for {:.4g} ms, with {:.0f} % of the ring's speed changes, friction at the "
        "raceways cannot keep them rolling\n",
        indent, skid.row.value_or(0) + 1, skid.demand.time_beyond * 1e3, 100. * beyond / all);
  if (const auto& gyroscopic = b.scalars.gyroscopic; gyroscopic.largest > 1.)
    text += fmt::format(
        "{}balls may pivot: their gyroscopic moments require up to {:.3g} times the available friction at the outer "
        "raceway and exceed it for {:.4g} ms\n",
        indent, gyroscopic.largest, gyroscopic.time_beyond * 1e3);
  return text;
}

/// Lines on what the balls' model leaves out and where pressures are void, if anywhere.
std::string ball_text(const BearingSummary& b) {
  const std::string indent(b.name.size() + 2, ' ');
  std::string text;
  if (!b.is_inertial) {
    double largest = 0.;
    for (std::size_t row = 0; row < b.n_rows; ++row)
      largest = std::max(largest, b.scalars.row_centrifugal[row].over_load());
    if (largest > relevant_centrifugal_share)
      text += fmt::format(
          "{}warning: centrifugal forces of the balls (up to {:.3g} N) are {:.2g} times their loads, and ball_model = "
          "\"quasi-static\" leaves them out\n",
          indent, b.scalars.row_centrifugal[0].largest, largest);
  }
  for (std::size_t row = 0; row < b.n_rows; ++row)
    if (const auto& truncation = b.scalars.row_truncation[row]; truncation.largest > 0.)
      text += fmt::format(
          "{}warning: the contact ellipses of row {} reach over the raceway's edge for {:.3g} ms, by up to {:.0f} % of "
          "their length at {:.4g} ms: pressure and static safety are void there\n",
          indent, row + 1, truncation.time_truncated * 1e3, 100. * truncation.largest, truncation.largest_time * 1e3);
  return text;
}

/// "1.23 K inner ring, 0.45 K shaft": of the bodies that a model has.
std::string rises_text(const BearingSummary::Rises& rises) {
  std::string text;
  for (const auto& [node, words] :
       {std::pair{"inner_ring", "inner ring"}, std::pair{"shaft", "shaft"}, std::pair{"ball", "balls"}})
    if (const double* rise = rises.find(node))
      text += fmt::format("{}{:.2f} K {}", text.empty() ? "" : ", ", *rise, words);
  return text;
}

/// "2.31 K inner ring, 0.96 K shaft, 0.01 K balls; finite elements 2.33 K inner ring ...": by every model.
std::string all_rises_text(const BearingSummary& b) {
  std::string text;
  const auto add = [&](const ThermalKind& kind, const std::string& rises) {
    text += text.empty() ? "" : "; ";
    text += (text.empty() ? "" : kind.word + " ") + rises;
  };
  for (const auto& rises : b.rises)
    if (rises.kind->is_unmarked) add(*rises.kind, rises_text(rises));
  if (b.section) {
    const FeSummary& fe = b.section->fe;
    const auto* bore = fe.surface("bore");
    add(*b.section->kind,
        rises_text({b.section->kind, fe.rises}) +
            (bore && bore->has_rows ? fmt::format(", bore {:.1f} K at {}", bore->highest, ms(bore->highest_time))
                                    : ""));
  }
  for (const auto& rises : b.rises)
    if (!rises.kind->is_unmarked) add(*rises.kind, rises_text(rises));
  return text;
}

std::string bearing_text(const BearingSummary& b) {
  const BearingScalars& s = b.scalars;
  const std::size_t indent = b.name.size() + 2;
  std::string text = fmt::format(
      "{}: first contact {}, peak contact force {:.2f} kN, rub heat {:.1f} J (peak {:.1f} kW)\n", b.name,
      ms(s.first_contact_time), s.contact_force.value * 1e-3, b.friction_heat, s.friction_heat_rate.value * 1e-3);
  text += fmt::format("{:{}}ring speed {:.0f} rpm at the end, spin-up complete: {}; mean temperature rise {}\n", "",
                      indent, s.ring_speed_end * rpm, ms(s.catch_up_time), all_rises_text(b));
  if (b.local) text += local_text(b.name, *b.local);
  if (s.contact_pressure.value > static_pressure_limit)
    text +=
        fmt::format("{:{}}contact pressure of the balls {:.2f} GPa exceeds the static limit of {:.1f} GPa (ISO 76)\n",
                    "", indent, s.contact_pressure.value * 1e-9, static_pressure_limit * 1e-9);
  text += ball_text(b) + skid_text(b);
  if (b.is_free)
    text += fmt::format("{:{}}axial force on the ring {:.2f} to {:.2f} kN\n", "", indent, s.axial_force.smallest * 1e-3,
                        s.axial_force.largest * 1e-3);
  if (b.shoulder) text += shoulder_text(shoulder_json(*b.shoulder), indent);
  if (b.support) text += support_text(b.name, *b.support);
  return text + whirl_text(b.name, b.whirl);
}

/// How far the modes of reduced finite elements are off.
std::string reduction_text(const DropSummary& s) {
  std::string text;
  for (const auto& b : s.bearings) {
    if (!b.section || !b.section->fe.reduction || b.section->fe.reduction->worst.empty()) continue;
    const auto& r = *b.section->fe.reduction;
    text += fmt::format("{} {}: {} modes follow heat within {:.2g} % (worst: {})\n",
                        text.empty() ? "Finite elements," : "                 ", b.name, r.modes,
                        100. * r.largest_error, r.worst);
  }
  return text;
}

std::string windows_text(const DropSummary::Windows& w) {
  const auto& r = w.report;
  std::string text = fmt::format(
      ", of the finite elements {:.1e} J\nWindows: {} of {:.3g} to {:.3g} ms; growth error up to {:.2g} nm of {:.0f} "
      "nm",
      w.energy.residual(), r.windows, r.shortest * 1e3, r.longest * 1e3, r.largest_error * 1e9, r.largest_growth * 1e9);
  if (r.beyond_tolerance > 0)
    text += fmt::format(
        "\n{} of {} windows left more than thermal.fe.window_tolerance = {:.2g} nm, the most at {:.4g} ms; "
        "a shorter thermal.fe.longest_window leaves less",
        r.beyond_tolerance, r.windows, r.tolerance * 1e9, r.largest_error_time * 1e3);
  return text;
}

std::string energy_text(const DropSummary& s) {
  const EnergyBalance& e = s.energy;
  std::string text = fmt::format("Energy: {:.2f} J dissipated", e.dissipated);
  if (s.has_windage) text += fmt::format(" ({:.2f} J by windage)", e.windage);
  text += fmt::format(", residual {:.1e} J; heat {:.2f} J deposited", e.residual, e.heat_deposited);
  for (std::size_t k = 0; k < e.heat.size(); ++k) {
    const bool is_named = !s.heat_prefixes[k].empty() && s.heat_models[k];
    text += fmt::format(", {}residual {:.1e} J", is_named ? s.heat_models[k]->word + " " : "", e.heat[k].residual);
  }
  if (s.windows) text += windows_text(*s.windows);
  return text + "\n";
}

}  // namespace

std::string summary_text(const DropSummary& s) {
  std::string text;
  for (const auto& b : s.bearings) text += bearing_text(b);
  text += probe_text(s.probes) + reduction_text(s);
  if (!s.until.empty())
    text += s.ended_by == s.until ? fmt::format("Ended by run.until = \"{}\" at t = {:.6g} s, at {:.4g} rpm\n", s.until,
                                                s.end_time, s.rotor_speed_end * rpm)
                                  : fmt::format("run.until = \"{}\" was not met by t = {:.6g} s; raise run.end_time\n",
                                                s.until, s.end_time);
  return text + energy_text(s);
}

}  // namespace rotordrop
