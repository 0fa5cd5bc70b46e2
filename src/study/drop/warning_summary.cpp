#include "study/drop/warning_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string_view>

#include "base/errors.h"
#include "study/drop/drop_summary.h"
#include "study/json_number.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

std::string times(long n) { return n == 1 ? "once" : fmt::format("{} times", n); }

/// " at 5.2 ms", if it is known.
std::string when(const RunWarning& w) {
  return std::isfinite(w.time) ? fmt::format(" at {:.4g} ms", w.time * 1e3) : "";
}

/// Of a balance in which an energy or a heat is no number, which a part of one's own may give.
std::string not_a_number(const RunWarning& w) {
  const std::string_view code = w.kind->code;
  const std::string what = code == "energy-residual" ? std::string("the energy balance")
                           : code == "heat-residual"
                               ? fmt::format("the heat balance of the thermal model \"{}\"", w.part)
                               : std::string("the heat that the support puts into a thermal model");
  return fmt::format("{} is not a number{}: a part of the model gives one that is none", what, when(w));
}

/// What happened, without its place.
std::string sentence(const RunWarning& w) {
  const std::string_view code = w.kind->code;
  if (!std::isfinite(w.worst) && (code == "energy-residual" || code == "heat-residual" || code == "heat-port"))
    return not_a_number(w);
  if (code == "energy-residual")
    return fmt::format(
        "the energy balance leaves up to {:.2g} % of the energy moved{} (limit {:.2g} %). Smaller integration.step or "
        "integration.tolerance leave less",
        100. * w.worst, when(w), 100. * w.limit);
  if (code == "heat-residual")
    return fmt::format(
        "the heat balance of the thermal model \"{}\" leaves up to {:.2g} % of the heat{} (limit {:.2g} %). Smaller "
        "integration.step or integration.tolerance leave less",
        w.part, 100. * w.worst, when(w), 100. * w.limit);
  if (code == "heat-port")
    return fmt::format(
        "the heat that the support puts into a thermal model is below 0 or more than it dissipates, by up to {:.2g} % "
        "of the larger of the two{} (limit {:.2g} %): heat_into_port must be a part of other_dissipation",
        100. * w.worst, when(w), 100. * w.limit);
  if (code == "step-collapse")
    return fmt::format(
        "the time step becomes shorter than {:.3g} ns {}, down to {:.3g} ns{}: something changes fast for the "
        "tolerance",
        w.limit * 1e9, times(w.count), w.worst * 1e9, when(w));
  if (code == "ball-load")
    return fmt::format(
        "contact pressure of the balls of {} exceeds {:.1f} GPa {}, up to {:.2f} GPa{}; at {:.1f} GPa about 0.0001 of "
        "a "
        "steel ball's diameter stays as indentation (ISO 76)",
        w.part, w.limit * 1e-9, times(w.count), w.worst * 1e-9, when(w), w.limit * 1e-9);
  if (code == "ellipse-truncated")
    return fmt::format(
        "the contact ellipses of {} reach over the raceway's edge for {:.3g} ms, by up to {:.0f} % of their length{}: "
        "pressure and static safety are void there",
        w.part, w.duration * 1e3, 100. * w.worst, when(w));
  if (code == "penetration")
    return fmt::format(
        "rotor and bore overlap by up to {:.4g} um{}, more than half the air gap ({:.4g} um), {}: the contact law is "
        "that of a narrow contact. Check contact_stiffness and the speed",
        w.worst * 1e6, when(w), w.limit * 1e6, times(w.count));
  if (code == "gap-closed")
    return fmt::format("growth by heat and speed leaves {:.4g} um of the air gap{}", w.worst * 1e6, when(w));
  if (code == "temperature")
    return fmt::format(
        "{} reaches {:.4g} K ({:.4g} degC){}, above the {:.4g} K ({:.4g} degC) that its material stands "
        "(temperature_limit)",
        w.part, w.worst, w.worst - 273.15, when(w), w.limit, w.limit - 273.15);
  if (code == "fit-open")
    return fmt::format("the fit of the outer ring in its housing opens or would have to pull, up to {:.0f} % of it{}",
                       100. * w.worst, when(w));
  if (code == "support-travel")
    return fmt::format("the outer ring moves by {:.4g} um{}, beyond its travel limit of {:.4g} um", w.worst * 1e6,
                       when(w), w.limit * 1e6);
  if (code == "probe-touched")
    return fmt::format("the rotor moves up to {:.4g} um beyond the clearance at the probe{}", -w.worst * 1e6, when(w));
  if (code == "no-contact")
    return fmt::format("the run ends at {:.4g} ms, before the rotor touches a touchdown bearing", w.worst * 1e3);
  if (code == "tilt")
    return fmt::format(
        "the rotor ends tilted by {:.3g} rad ({:.3g} degrees): its motion is that of small tilts, whose sine and "
        "cosine are off by more than 0.5 % above {:.2g} rad. It tips over if supports do not hold both its ends",
        w.worst, w.worst * 180. / std::numbers::pi, w.limit);
  if (code == "recorded-growth")
    return fmt::format(
        "the growth of thermal.recorded ends at {:.4g} ms, and stays as it was to the end of the run at {:.4g} ms",
        w.limit * 1e3, w.worst * 1e3);
  if (code == "window-error")
    return fmt::format(
        "{} windows left more than thermal.fe.window_tolerance = {:.2g} nm, the most{} ({:.2g} nm); a shorter "
        "thermal.fe.longest_window leaves less",
        w.count, w.limit * 1e9, when(w), w.worst * 1e9);
  if (code == "response-error")
    return fmt::format(
        "the modes of the finite elements follow heat within {:.2g} % only (worst: {}); reduce "
        "thermal.fe.response_tolerance",
        100. * w.worst, w.part);
  if (code == "coarse-rows")
    return fmt::format(
        "local temperatures, depths of wear and whirl are taken from rows: with every second row alone a local "
        "temperature or depth of wear would be {:.2g} % off (limit {:.2g} %), so that rows this far apart leave them "
        "uncertain; make output.interval smaller",
        100. * w.worst, 100. * w.limit);
  if (code == "local-temperature")
    return fmt::format(
        "the {} reaches {:.0f} K ({:.0f} degC) where it rubs{}, above the {:.4g} K ({:.4g} degC) that its material "
        "stands",
        w.part, w.worst, w.worst - 273.15, when(w), w.limit, w.limit - 273.15);
  if (code == "wear")
    return fmt::format("the {} wears by {:.3g} um in this drop, more than contact.wear_depth_limit = {:.3g} um", w.part,
                       w.worst * 1e6, w.limit * 1e6);
  if (code == "skidding")
    return fmt::format(
        "balls{} may skid: for {:.4g} ms, with {:.0f} % of the ring's speed changes, friction at the raceways cannot "
        "keep them rolling",
        w.part.empty() ? "" : " of " + w.part, w.duration * 1e3, 100. * w.worst);
  if (code == "pivoting")
    return fmt::format(
        "balls may pivot: their gyroscopic moments require up to {:.3g} times the available friction at the "
        "raceway that needs more of it, and exceed it for {:.4g} ms",
        w.worst, w.duration * 1e3);
  if (code == "centrifugal-force")
    return fmt::format(
        "centrifugal forces of the balls are {:.2g} times the load of the row's most loaded ball (weighted mean), and "
        "ball_model = \"quasi-static\" leaves them out",
        w.worst);
  if (code == "backward-whirl")
    return fmt::format("sustained backward whirl, up to {:.4g} Hz", w.worst * 0.5 / std::numbers::pi);
  return fmt::format("{}: {:.4g} {}, limit {:.4g}", code, w.worst, w.kind->unit, w.limit);
}

std::string placed_sentence(const RunWarning& w) { return (w.place.empty() ? "" : w.place + ": ") + sentence(w); }

}  // namespace

std::vector<RunWarning> warnings_in_summary(const MachineParameters& p, const DropSummary& summary) {
  std::vector<RunWarning> list;
  const auto warn = [&](const char* code, const std::string& place, const std::string& part, double worst, double limit,
                        double time = RunWarning::never) {
    if (worst > limit) list.push_back({find_warning_kind(code), place, part, 1, worst, limit, time});
  };
  warn("tilt", "", "", summary.tilt_end, tilt_limit, summary.end_time);
  for (const BearingSummary& b : summary.bearings) {
    if (b.local) {
      const LocalRub& rub = b.local->rub;
      warn("coarse-rows", b.name, "", b.local->change_by_fewer_rows, change_by_rows_limit,
           b.scalars.first_contact_time);
      const auto* ring = find_material(p, touchdown_of(p, b.name).ring);
      if (ring && ring->temperature_limit && std::isfinite(rub.stated.time))
        warn("local-temperature", b.name, "bore", p.run.ambient + rub.stated.bore, *ring->temperature_limit,
             rub.stated.time);
      const auto& own = touchdown_of(p, b.name).journal;
      const auto* journal = own ? find_material(p, *own) : nullptr;
      if (journal && journal->temperature_limit && std::isfinite(rub.stated.time))
        warn("local-temperature", b.name, "rotor", p.run.ambient + rub.stated.rotor, *journal->temperature_limit);
      warn("wear", b.name, "bore", rub.wear.bore_depth, p.contact.wear_depth_limit);
      warn("wear", b.name, "rotor", rub.wear.rotor_depth, p.contact.wear_depth_limit);
    }
    if (b.whirl) warn("backward-whirl", b.name, "", b.whirl->largest_backward_speed.value_or(0.), 0.);
  }
  return list;
}

Json warnings_json(const std::vector<RunWarning>& warnings) {
  Json list = Json::array();
  for (const auto& w : warnings)
    list.push_back({{"code", w.kind->code},
                    {"place", w.place},
                    {"part", w.part},
                    {"count", w.count},
                    {"worst", json_number(w.worst)},
                    {"limit", json_number(w.limit)},
                    {"unit", w.kind->unit},
                    {"time", json_number(w.time)},
                    {"first_time", json_number(w.first_time)},
                    {"duration", json_number(w.duration)},
                    {"text", placed_sentence(w)}});
  return list;
}

std::string warnings_text(const Json& warnings) {
  if (warnings.empty()) return {};
  std::string text =
      fmt::format("{} warning{} (docs/reference/warnings.md):\n", warnings.size(), warnings.size() == 1 ? "" : "s");
  for (const auto& w : warnings)
    text += fmt::format("  warning: {} [{}]\n", w["text"].get<std::string>(), w["code"].get<std::string>());
  return text;
}

void stop_at_fatal_warnings(const RunParameters& run, const Json& warnings) {
  std::string text;
  for (const auto& w : warnings)
    if (const auto code = w["code"].get<std::string>(); run.is_fatal(code))
      text += fmt::format("\n       {} [{}]", w["text"].get<std::string>(), code);
  if (!text.empty()) throw SolverError("the run is complete, but run.fatal_warnings makes it fail:" + text);
}

}  // namespace rotordrop
