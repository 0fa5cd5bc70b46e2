#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>

#include "base/rotation.h"
#include "study/drop/damage_summary.h"
#include "study/drop/drop_summary.h"
#include "study/drop/warning_summary.h"
#include "study/opinion/second_opinion.h"
#include "study/result_limits.h"
#include "study/statics/shoulder_words.h"

namespace rotordrop {
namespace {

std::string ms(double time) { return std::isfinite(time) ? fmt::format("{:.4g} ms", time * 1e3) : "never"; }

/// "5.29 kN", and of small machines "4.71 N". @param values  [N]; what is below 1 uN is roundoff
std::string in_kilonewtons(std::initializer_list<double> values, const char* between = "") {
  double largest = 0.;
  for (const double value : values) largest = std::max(largest, std::fabs(value));
  const bool is_small = largest > 1e-6 && largest < 100.;
  std::string text;
  for (const double value : values)
    text +=
        (text.empty() ? "" : between) + (is_small ? fmt::format("{:.3g}", value) : fmt::format("{:.2f}", value * 1e-3));
  return text + (is_small ? " N" : " kN");
}

/// "924.2 J", and of small machines "0.0123 J".
std::string in_joules(double heat, int digits) {
  const double least = 10. * std::pow(10., -digits);  // below it two digits would not be left
  return heat != 0. && std::fabs(heat) < least ? fmt::format("{:.3g} J", heat) : fmt::format("{:.{}f} J", heat, digits);
}

std::string in_kilowatts(double rate) {
  return rate != 0. && std::fabs(rate) < 1e3 ? fmt::format("{:.3g} W", rate) : fmt::format("{:.1f} kW", rate * 1e-3);
}

/// "1.23 K inner ring (21.4 degC), 0.45 K shaft (20.6 degC)": of the bodies that a model has. @param ambient  [K]; 0: unknown
std::string rises_text(const BearingSummary::Rises& rises, double ambient) {
  std::string text;
  for (const auto& [node, words] :
       {std::pair{"inner_ring", "inner ring"}, std::pair{"shaft", "shaft"}, std::pair{"ball", "balls"}})
    if (const double* rise = rises.find(node))
      text += fmt::format("{}{:.2f} K {}{}", text.empty() ? "" : ", ", *rise, words,
                          ambient > 0. ? fmt::format(" ({:.1f} degC)", ambient + *rise - 273.15) : "");
  return text;
}

/// "2.31 K inner ring, 0.96 K shaft, 0.01 K balls; finite elements 2.33 K inner ring ...": by every model.
std::string all_rises_text(const BearingSummary& b, double ambient) {
  std::string text;
  const auto add = [&](const ThermalKind& kind, const std::string& rises) {
    text += text.empty() ? "" : "; ";
    text += (text.empty() ? "" : kind.word + " ") + rises;
  };
  for (const auto& rises : b.rises)
    if (rises.kind->is_unmarked) add(*rises.kind, rises_text(rises, ambient));
  if (b.section) {
    const FeSummary& fe = b.section->fe;
    const auto* bore = fe.surface("bore");
    add(*b.section->kind,
        rises_text({b.section->kind, fe.rises}, ambient) +
            (bore && bore->has_rows ? fmt::format(", bore {:.1f} K at {}", bore->highest, ms(bore->highest_time))
                                    : ""));
  }
  for (const auto& rises : b.rises)
    if (!rises.kind->is_unmarked) add(*rises.kind, rises_text(rises, ambient));
  return text;
}

/// "13.3 ms"; of a rotor that does not spin there is none to speak of.
std::string spin_up_text(const BearingScalars& s, double rotor_speed_end) {
  if (std::isnan(s.catch_up_time) && std::fabs(rotor_speed_end) < least_spin)
    return "no spin-up, as the rotor does not spin";
  return "spin-up complete: " + ms(s.catch_up_time);
}

std::string bearing_text(const BearingSummary& b, double ambient, double rotor_speed_end) {
  const BearingScalars& s = b.scalars;
  const std::size_t indent = b.name.size() + 2;
  std::string text = fmt::format("{}: first contact {}, peak contact force {}{}, rub heat {} (peak {})\n", b.name,
                                 b.shoulder ? fmt::format("in the bore {}, on a shoulder {}", ms(s.first_contact_time),
                                                          ms(s.first_shoulder_contact_time))
                                            : ms(s.first_contact_time),
                                 b.shoulder ? "in the bore " : "", in_kilonewtons({s.contact_force.value}),
                                 in_joules(b.friction_heat, 1), in_kilowatts(s.friction_heat_rate.value));
  const std::string rises = all_rises_text(b, ambient);
  text += fmt::format("{:{}}ring speed {:.0f} rpm at the end, {}{}{}\n", "", indent,
                      std::round(s.ring_speed_end * to_rpm) + 0., spin_up_text(s, rotor_speed_end),
                      rises.empty() ? "" : "; mean temperature rise ", rises);
  if (b.local) text += local_text(b.name, *b.local, std::isfinite(b.scalars.first_shoulder_contact_time));
  if (b.damage) text += damage_text(*b.damage, indent);
  if (b.is_free)
    text += fmt::format("{:{}}axial force on the ring {}\n", "", indent,
                        in_kilonewtons({s.axial_force.smallest, s.axial_force.largest}, " to "));
  if (b.shoulder) text += shoulder_text(shoulder_json(*b.shoulder), indent);
  if (b.support) text += support_text(b.name, *b.support);
  return b.whirl ? text + whirl_text(b.name, *b.whirl) : text;
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
  return fmt::format(
      ", of the finite elements {:.1e} J\nWindows: {} of {:.3g} to {:.3g} ms; growth error up to {:.2g} nm of {:.0f} "
      "nm",
      w.energy.residual(), r.windows, r.shortest * 1e3, r.longest * 1e3, r.largest_error * 1e9, r.largest_growth * 1e9);
}

std::string energy_text(const DropSummary& s) {
  const EnergyBalance& e = s.energy;
  std::string text = fmt::format("Energy: {} dissipated", in_joules(e.dissipated, 2));
  if (s.has_windage) text += fmt::format(" ({} by windage)", in_joules(e.windage, 2));
  text += fmt::format(", residual {:.1e} J; heat {} deposited", e.residual, in_joules(e.heat_deposited, 2));
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
  for (const auto& b : s.bearings) text += bearing_text(b, s.ambient, s.rotor_speed_end);
  text += probe_text(s.probes) + reduction_text(s);
  if (!s.until.empty())
    text += s.ended_by == s.until ? fmt::format("Ended by run.until = \"{}\" at t = {:.6g} s, at {:.4g} rpm\n", s.until,
                                                s.end_time, s.rotor_speed_end * to_rpm)
                                  : fmt::format("run.until = \"{}\" was not met by t = {:.6g} s; raise run.end_time\n",
                                                s.until, s.end_time);
  text += energy_text(s) + warnings_text(warnings_json(s.warnings));
  if (s.second_opinion) text += second_opinion_text(*s.second_opinion);
  return s.limits ? text + limits_text(*s.limits, s.second_opinion.value_or(nullptr), s.warnings.size()) : text;
}

}  // namespace rotordrop
