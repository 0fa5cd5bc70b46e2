#include "study/rub/bore_report.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "analysis/facts/thermal_report.h"
#include "study/json_number.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

BoreTemperatures bore_temperatures(const std::string& bearing, BoreHistory history, const TimeSeries* node,
                                   const TimeSeries* mean, double ambient) {
  BoreTemperatures b;
  b.bearing = bearing;
  const std::size_t n = history.times.size();
  for (std::size_t i = 0; i < n; ++i) {
    const double t = history.times[i];
    // Over the half space's own mean: that part of the heat is in the finite elements already.
    const double bulk = mean ? mean->at(t) - history.mean_rise[i] : ambient;
    b.node.push_back(node ? node->at(t) : nothing);
    b.mean.push_back(bulk + history.mean_rise[i]);
    b.local.push_back(bulk + history.largest_rise[i]);
    b.flash.push_back(bulk + history.rise_at_contact[i]);
    b.rotor_flash.push_back(history.rotor_flash[i]);
  }
  b.history = std::move(history);
  return b;
}

/// The row whose time comes closest to t.
std::size_t row_at(const std::vector<double>& times, double t) {
  const auto after = std::lower_bound(times.begin(), times.end(), t);
  if (after == times.begin()) return 0;
  const auto i = static_cast<std::size_t>(after - times.begin());
  return i < times.size() && times[i] - t < t - times[i - 1] ? i : i - 1;
}

Json largest_excess(const BoreTemperatures& b, const std::vector<double>& over) {
  Extreme most{-std::numeric_limits<double>::infinity(), nothing};
  for (std::size_t i = 0; i < b.local.size(); ++i)
    if (b.local[i] - over[i] > most.value) most = {b.local[i] - over[i], b.history.times[i]};
  return {{"value", json_number(most.value)}, {"time", json_number(most.time)}};
}

Json bore_json(const BoreTemperatures& b, const RubRecord& r, const RubSurfaces& s, double hertz_half_width,
               bool has_mean, const Impact& impact, const std::vector<Instant>& instants) {
  const auto& h = b.history;
  Json j = {{"mean_from", has_mean ? "finite elements" : "half space"},
            {"half_width", s.half_width},
            {"hertz_half_width", json_number(hertz_half_width)},
            {"axial_width", s.axial_width},
            {"wall_crossed_after", h.valid_until},
            {"track_widens_after", s.half_width * s.half_width * s.bore.capacity / s.bore.conductivity},
            {"largest_local_over_node", largest_excess(b, b.node)},
            {"largest_local_over_mean", largest_excess(b, b.mean)},
            {"at", Json::array()}};
  for (const auto& [name, t] : instants) {
    const std::size_t i = row_at(h.times, t);
    j["at"].push_back({{"instant", name},
                       {"time", h.times[i]},
                       {"lumped_node", json_number(b.node[i])},
                       {"mean", b.mean[i]},
                       {"local", b.local[i]},
                       {"flash", json_number(b.flash[i])},
                       {"rotor_flash_rise", json_number(b.rotor_flash[i])},
                       {"arc", h.arc[i] * s.bore.radius},
                       {"heated_arc", h.heated_arc[i] * s.bore.radius},
                       {"ring_turns", h.ring_turns[i]},
                       {"half_space_valid", !(h.times[i] > impact.start + h.valid_until)}});
  }
  if (!std::isfinite(impact.start)) return j;
  const TimeSeries heat{r.times, r.joules_into_ring}, angle{r.times, r.ring_angle};
  const double duration = impact.end - impact.start;
  // Contact ends between two rows; what was swept until the last one before.
  double arc = 0., local = 0., local_time = nothing;
  for (std::size_t i = 0; i < h.times.size() && h.times[i] <= impact.end; ++i) {
    arc = std::max(arc, h.arc[i]);
    if (h.largest_rise[i] > local) {
      local = h.largest_rise[i];
      local_time = h.times[i];
    }
  }
  const double joules = heat.at(impact.end) - heat.at(impact.start);
  j["first_impact"] = {{"duration", duration},
                       {"heat_into_ring", joules},
                       {"arc", arc * s.bore.radius},
                       {"ring_angle", angle.at(impact.end) - angle.at(impact.start)},
                       {"largest_local_rise", local},
                       {"largest_local_rise_time", json_number(local_time)},
                       {"steady_band_rise", steady_band_rise(s, joules, duration, arc)}};
  return j;
}

}  // namespace

std::vector<std::string> series_of_rub(const std::string& bearing) {
  const std::string at = "/bearings/" + bearing + "/", ledger = "/ledger/" + bearing + "/";
  return {at + "orbit",        at + "ring_position",          at + "ring_speed",          at + "slip_speed",
          ledger + "rub_heat", ledger + "rub_heat_into_ring", ledger + "contact_impulse", "/rotor/spin_angle"};
}

RubRecord rub_record(const RecordedDrop& drop, const std::string& bearing) {
  const std::string at = "/bearings/" + bearing + "/", ledger = "/ledger/" + bearing + "/";
  const TimeSeries y = drop.series(at + "orbit", 0), z = drop.series(at + "orbit", 1);
  const TimeSeries ring_y = drop.series(at + "ring_position", 0), ring_z = drop.series(at + "ring_position", 1);
  const TimeSeries all = drop.series(ledger + "rub_heat");
  RubRecord r;
  r.times = y.times;
  r.joules_into_ring = drop.series(ledger + "rub_heat_into_ring").values;
  r.ring_angle = integral_of(drop.series(at + "ring_speed")).values;
  r.rotor_angle = drop.series("/rotor/spin_angle").values;
  r.impulse = drop.series(ledger + "contact_impulse").values;
  r.slip_speed = drop.series(at + "slip_speed").values;
  for (std::size_t i = 0; i < r.times.size(); ++i) {
    r.contact_angle.push_back(std::atan2(z.values[i] - ring_z.values[i], y.values[i] - ring_y.values[i]));
    r.joules_into_rotor.push_back(all.values[i] - r.joules_into_ring[i]);
  }
  return r;
}

RubbedBore rubbed_bore(const std::string& bearing, const TouchdownParameters& p, const RecordedDrop& drop,
                       const std::optional<double>& band_length) {
  const auto& parameters = drop.parameters();
  return {rub_record(drop, bearing),
          rub_surfaces(parameters, bearing, p, band_length.value_or(parameters.thermal.rub_band_length))};
}

BoreReport report_bore(const std::string& bearing, const TouchdownParameters& p, const RecordedDrop& drop,
                       const RubbedBore& rubbed, BoreHistory history, const ModelOfRun& circuit,
                       const ModelOfRun& section, const Impact& impact, const std::vector<Instant>& instants) {
  std::optional<TimeSeries> node, mean;
  if (circuit) node = circuit.drop->series(circuit.drop->node_path(*circuit.kind, bearing, "inner_ring"));
  if (section) mean = section.drop->series(section.drop->node_path(*section.kind, bearing, "bore"), 0);
  const auto& parameters = drop.parameters();
  BoreReport r;
  r.temperatures = bore_temperatures(bearing, std::move(history), node ? &*node : nullptr, mean ? &*mean : nullptr,
                                     parameters.run.ambient);
  r.report = bore_json(r.temperatures, rubbed.rub, rubbed.surfaces, rub_half_width(parameters, p, impact.peak),
                       mean.has_value(), impact, instants);
  return r;
}

}  // namespace rotordrop
