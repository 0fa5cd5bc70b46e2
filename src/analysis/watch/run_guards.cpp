#include "analysis/watch/run_guards.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "analysis/watch/heated_parts.h"
#include "analysis/watch/packed_numbers.h"
#include "base/errors.h"
#include "bearing/statics/bearing_statics.h"
#include "bearing/touchdown_bearing.h"
#include "machine/heat/growth_history.h"

namespace rotordrop {
namespace {

/// Steps at the start of a run, and after a resumption or a known instant, grow from what the method guesses first.
constexpr double steps_left_out = 20;

/// Parts of "/thermal/TB1/inner_ring".
struct TemperaturePath {
  std::string model, bearing, part;
};
/// What tells the thermal model whose temperatures lie in a group of the results.
std::string mark_of(const std::string& group, const ThermalParameters& parameters) {
  if (group == "windows")
    if (const ThermalKind* kind = section_kind(parameters)) return kind->mark;
  for (const ThermalKind* kind : chosen_kinds(parameters))
    if (kind->group == "/" + group + "/") return kind->mark;
  return group;
}

TemperaturePath parts_of(const std::string& path) {
  const auto second = path.find('/', 1);
  const auto third = second == std::string::npos ? second : path.find('/', second + 1);
  if (third == std::string::npos) return {};
  TemperaturePath p{path.substr(1, second - 1), path.substr(second + 1, third - second - 1), path.substr(third + 1)};
  std::replace(p.part.begin(), p.part.end(), '_', ' ');
  return p;
}

/// Names in checkpoints have no empty parts: "guards/ball-load/TB1/row 1", "guards/step-collapse".
std::string key_of(const std::string& name) {
  std::string key;
  for (const char c : name)
    if (c != '/' || (!key.empty() && key.back() != '/')) key += c;
  while (key.ends_with('/')) key.pop_back();
  return key;
}

}  // namespace

RunGuards::RunGuards(const Machine& machine, const MachineParameters& p, const IntegrationParameters& integration)
    : parameters_(p), rows_(*this), shortest_step_(1e-3 * step_or_bound(integration)) {
  step_guard_ = add("step-collapse", "", "", shortest_step_, -1.);
  look_at_bearings(machine, p);
  look_at_supports_and_probes(machine, p);
  const std::size_t n_step = observed_size(machine.step_observables());
  look_at_temperatures(machine.state_observables(), n_step, rows_);
  look_at_balances(machine, n_step);
  look_at_heat_ports(machine, n_step);
}

std::size_t RunGuards::add(const char* code, const std::string& place, const std::string& part, double limit,
                           double sign) {
  const WarningKind* kind = find_warning_kind(code);
  if (!kind || !kind->is_guarded) throw std::logic_error(std::string("no guard is called ") + code);
  guards_.push_back({kind, place, part, limit, parameters_.run.is_fatal(code), sign});
  return guards_.size() - 1;
}

void RunGuards::look_at_bearings(const Machine& machine, const MachineParameters& p) {
  const auto& list = machine.step_observables();
  for (const auto& pressure : columns_of(list, Observed::contact_pressure))
    for (std::size_t row = 0; row < pressure.size; ++row)
      steps_.push_back({add("ball-load", pressure.place, fmt::format("row {}", row + 1), static_pressure_limit),
                        pressure.first + row});
  for (const auto& truncation : columns_of(list, Observed::ellipse_truncation))
    for (std::size_t row = 0; row < truncation.size; ++row)
      steps_.push_back(
          {add("ellipse-truncated", truncation.place, fmt::format("row {}", row + 1), 0.), truncation.first + row});
  for (const auto& clearance : columns_of(list, Observed::clearance))
    steps_.push_back({add("gap-closed", clearance.place, "", 0., -1.), clearance.first});
  for (const auto& penetration : columns_of(list, Observed::penetration))
    for (const auto& entry : p.bearings)
      if (const auto* touchdown = entry.touchdown(); touchdown && entry.name == penetration.place)
        steps_.push_back({add("penetration", entry.name, "", penetration_limit * air_gap(*touchdown, p.contact)),
                          penetration.first});
}

void RunGuards::look_at_supports_and_probes(const Machine& machine, const MachineParameters& p) {
  std::size_t at = 0;
  for (const auto& o : machine.step_observables()) {
    for (const auto& entry : p.bearings)
      if (const auto* b = entry.touchdown();
          b && b->support.travel_limit && o.name == "/bearings/" + entry.name + "/support_position")
        steps_.push_back({add("support-travel", entry.name, "", *b->support.travel_limit), at, 2, true});
    for (const Probe& probe : machine.probes())
      if (o.name == "/probes/" + probe.name + "/clearance")
        steps_.push_back({add("probe-touched", probe.name, "", 0., -1.), at});
    at += o.size;
  }
}

void RunGuards::look_at_temperatures(const std::vector<Observable>& observables, std::size_t first, Rows& rows) {
  for (const auto& o : observables) {
    if (o.kind == Observed::housing_fit_open)
      rows.looks.push_back({add("fit-open", o.place, "", 0.), first});
    else if (const auto path = parts_of(o.name); o.unit == "K")
      for (const auto& entry : parameters_.bearings)
        if (const auto* b = entry.touchdown(); b && entry.name == path.bearing)
          if (const auto* material = material_of_part(parameters_, *b, path.part);
              material && material->temperature_limit)
            rows.looks.push_back({add("temperature", entry.name,
                                      fmt::format("{} ({})", path.part, mark_of(path.model, parameters_.thermal)),
                                      *material->temperature_limit),
                                  first, o.size});
    first += o.size;
  }
}

void RunGuards::look_at_balances(const Machine& machine, std::size_t first) {
  Rows::Balance mechanical{add("energy-residual", "", "", residual_limit), 0, {}};
  std::optional<std::size_t> deposited;
  std::vector<std::pair<std::string, std::size_t>> heats;
  for (const auto& o : machine.state_observables()) {
    if (o.kind == Observed::energy_residual) mechanical.residual = first;
    if (o.kind == Observed::energy_moved) mechanical.moved.push_back(first);
    if (o.kind == Observed::heat_deposited) deposited = first;
    if (o.kind == Observed::heat_residual) heats.emplace_back(o.place, first);
    first += o.size;
  }
  rows_.balances.push_back(std::move(mechanical));
  for (const auto& [model, column] : heats)
    if (deposited) rows_.balances.push_back({add("heat-residual", "", model, residual_limit), column, {*deposited}});
  // At first next to nothing is moved: a fall through the air gap counts at least.
  const double weight = rigid_body(parameters_.rotor.geometry).mass *
                        std::hypot(parameters_.run.gravity[0], parameters_.run.gravity[1], parameters_.run.gravity[2]);
  least_energy_ = std::max(1e-3, weight * parameters_.contact.air_gap);
}

void RunGuards::look_at_heat_ports(const Machine& machine, std::size_t first) {
  for (std::size_t i = 0; i < machine.n_supports(); ++i) {
    const std::string& name = machine.support(i).name();
    const auto column = [&](const char* ledger) {
      return column_of(machine.state_observables(), "/ledger/" + name + "/" + ledger);
    };
    const auto heat = column("heat_into_port"), dissipated = column("other_dissipation");
    if (heat && dissipated)
      rows_.ports.push_back({add("heat-port", name, "", residual_limit), first + *heat, first + *dissipated});
  }
}

RowSink& RunGuards::windows(const std::vector<Observable>& observables) {
  Rows& rows = windows_.emplace_back(*this);
  look_at_temperatures(observables, 0, rows);
  return rows;
}

void RunGuards::follow(std::size_t index, double time, double value) {
  Guard& guard = guards_[index];
  if (!guard.seen.follow(time, guard.sign * value, guard.sign * guard.limit) || !guard.is_fatal) return;
  throw SolverError(fmt::format("run.fatal_warnings: {}{}{} at t = {:.6g} ms: {:.4g}, limit {:.4g} {}. It counts {}.",
                                guard.kind->code, guard.place.empty() ? "" : " of " + guard.place,
                                guard.part.empty() ? "" : ", " + guard.part, time * 1e3, value, guard.limit,
                                guard.kind->unit, guard.kind->meaning));
}

void RunGuards::follow(std::span<const Look> looks, double time, std::span<const double> values) {
  for (const Look& look : looks) {
    double value = values[look.first];
    if (look.is_vector)
      value = std::hypot(value, values[look.first + 1]);
    else
      for (std::size_t k = 1; k < look.size; ++k) value = std::max(value, values[look.first + k]);
    const Guard& guard = guards_[look.guard];
    if (guard.seen.was_above() || guard.sign * value > guard.sign * guard.limit) follow(look.guard, time, value);
  }
}

void RunGuards::step(const Step& step) {
  if (step.is_observed) follow(steps_, step.time, step.found->step);
  if (step.time == step.start) return;
  if (++n_steps_ > steps_left_out && !step.is_last && !step.is_cut)
    follow(step_guard_, step.time, step.time - step.start);
  if (step.is_cut) n_steps_ = 0;
}

void RunGuards::Rows::row(double time, std::span<const double> values) {
  guards_.follow(looks, time, values);
  for (const Balance& balance : balances) {
    double moved = 0.;
    for (const std::size_t column : balance.moved) moved += std::fabs(values[column]);
    const double part = std::fabs(values[balance.residual]) / std::max(moved, guards_.least_energy_);
    guards_.follow(balance.guard, time, std::isnan(part) ? std::numeric_limits<double>::infinity() : part);
  }
  for (const Port& port : ports) {
    const double heat = values[port.heat], dissipated = values[port.dissipated];
    const double beyond = std::max(heat - dissipated, -heat);
    const double moved = std::max({std::fabs(heat), std::fabs(dissipated), guards_.least_energy_});
    guards_.follow(port.guard, time, beyond / moved);
  }
}

void RunGuards::pack(PackedValues& to) const {
  for (const Guard& guard : guards_) {
    Exceedance seen = guard.seen;
    to[key_of(guard.name())] = packed_numbers(seen.numbers());
  }
}

void RunGuards::unpack(const PackedValues& from) {
  for (Guard& guard : guards_) unpack_numbers(from.at(key_of(guard.name())), guard.seen.numbers());
}

std::vector<RunWarning> RunGuards::found(const DropScalars& scalars) const {
  std::vector<RunWarning> list;
  for (const Guard& guard : guards_) {
    RunWarning w = guard.seen.as_warning(guard.kind, guard.place, guard.part, guard.limit);
    w.worst *= guard.sign;
    if (guard.kind->code == std::string_view("ball-load"))  // peaks between steps by a parabola, as in the summary
      for (std::size_t i = 0; i < scalars.size(); ++i)
        if (const auto& peak = scalars.of(i).row_pressure[std::stoul(guard.part.substr(4)) - 1];
            scalars.name(i) == guard.place && peak.value > guard.limit) {
          w.worst = peak.value;
          w.time = peak.time;
          w.count = std::max(w.count, 1L);
        }
    if (guard.kind->code == std::string_view("probe-touched"))
      for (std::size_t i = 0; i < scalars.probes().size() && w.count > 0; ++i)
        if (scalars.probes().name(i) == guard.place) {  // between steps by parabolas, as in the summary
          const auto& probe = scalars.probes().of(i);
          w.worst = probe.smallest_clearance();
          w.time = probe.overlap.time;
          w.first_time = probe.first_touch_time;
          w.duration = probe.time_touching;
        }
    if (w.count > 0) list.push_back(std::move(w));
  }
  return list;
}

std::vector<RunWarning> warnings_at_end(const EndedRun& run) {
  std::vector<RunWarning> list;
  const auto warn = [&](const char* code, const std::string& place, const std::string& part, double worst, double limit,
                        double time = RunWarning::never, double duration = RunWarning::never) {
    list.push_back({find_warning_kind(code), place, part, 1, worst, limit, time, RunWarning::never, duration});
  };
  bool touches_any = run.scalars.size() == 0;
  for (std::size_t i = 0; i < run.scalars.size(); ++i) touches_any = touches_any || has_touched(run.scalars.of(i));
  if (!touches_any && run.is_whole) warn("no-contact", "", "", run.end_time, run.end_time);
  for (std::size_t i = 0; i < run.scalars.size(); ++i) {
    const auto& s = run.scalars.of(i);
    const std::string& name = run.scalars.name(i);
    const SkidVerdict skid = skid_verdict(s, run.scalars.n_rows(i));
    const auto* touchdown = dynamic_cast<const TouchdownBearing*>(&run.machine.support(run.scalars.support(i)));
    const bool is_rolling = !touchdown || !touchdown->data().free_cage;  // of a free cage the slip is computed
    if (const double all = skid.demand.speed_change, beyond = skid.demand.speed_change_beyond;
        is_rolling && beyond > least_spin && is_skidding_relevant(beyond, all, run.parameters.run.initial_speed))
      warn("skidding", name, skid.row ? fmt::format("row {}", *skid.row + 1) : "", beyond / all, relevant_speed_share,
           skid.demand.largest_time, skid.demand.time_beyond);
    if (s.gyroscopic.largest > 1.)
      warn("pivoting", name, "", s.gyroscopic.largest, 1., s.gyroscopic.largest_time, s.gyroscopic.time_beyond);
    double centrifugal = 0.;
    for (std::size_t row = 0; row < run.scalars.n_rows(i); ++row)
      centrifugal = std::max(centrifugal, s.row_centrifugal[row].over_load());
    if (touchdown && touchdown->data().ball_model == BallModel::quasi_static &&
        centrifugal > relevant_centrifugal_share)
      warn("centrifugal-force", name, "", centrifugal, relevant_centrifugal_share);
  }
  constexpr double same_time = 1e-9;  // rows end where their run ended, but for rounding
  if (const auto& recorded = run.machine.parts().prescribed_growth; recorded)
    if (const auto last = recorded->last_time(); last && run.end_time > *last * (1. + same_time))
      warn("recorded-growth", "", "", run.end_time, *last);
  if (run.windows && run.windows->beyond_tolerance > 0) {
    warn("window-error", "", "", run.windows->largest_error, run.windows->tolerance, run.windows->largest_error_time);
    list.back().count = run.windows->beyond_tolerance;
  }
  if (const double input = std::max(std::fabs(run.windows_energy.input), 1e-3);
      run.windows && !(std::fabs(run.windows_energy.residual()) <= residual_limit * input))
    warn("heat-residual", "", "windows", std::fabs(run.windows_energy.residual()) / input, residual_limit);
  if (run.elements && run.elements->coupling != FeCoupling::windowed)
    for (const auto& section : run.elements->sections)
      if (section.reduced.response_error > response_error_limit)
        warn("response-error", section.name, section.reduced.worst_response, section.reduced.response_error,
             response_error_limit);
  return list;
}

}  // namespace rotordrop
