#include "machine/heat/bore_history.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/rotation.h"

namespace rotordrop {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

double turned(double from, double to) { return shorter_way(to - from); }

}  // namespace

std::vector<std::size_t> rows_to_follow(const RubRecord& r, std::size_t most) {
  const std::size_t n = r.times.size();
  std::vector<std::size_t> rows;
  if (n == 0) return rows;
  const std::size_t one_by_one = n <= most ? n : most / 2,
                    stride = n <= most ? 1 : (n - one_by_one) / (most - one_by_one) + 1;
  double way = 0.;
  for (std::size_t i = 0, last = 0; i < n; ++i) {
    if (i > 0)
      way += std::fabs(turned(r.contact_angle[i - 1] - r.ring_angle[i - 1], r.contact_angle[i] - r.ring_angle[i]));
    if (i >= one_by_one && i + 1 < n && i - last < stride && way < 1.) continue;
    rows.push_back(last = i);
    way = 0.;
  }
  return rows;
}

BoreHistory bore_history(const RubRecord& r, const RubSurfaces& s, std::size_t most_rows) {
  BoreHistory h;
  const auto rows = rows_to_follow(r, most_rows);
  if (rows.empty()) return h;
  double largest_heat = 0.;
  for (std::size_t i = 1; i < rows.size(); ++i)
    largest_heat = std::max(largest_heat, r.joules_into_ring[rows[i]] - r.joules_into_ring[rows[i - 1]]);

  SweptArcHistory::Options options;
  options.n_cells = SweptArcHistory::cells_for(s.bore.radius, s.half_width);
  if (rows.size() > 1) {
    options.shortest_interval = r.times[rows[1]] - r.times[rows[0]];
    options.duration = std::max(r.times[rows.back()] - r.times[rows[0]], 2. * options.shortest_interval);
  }
  SweptArcHistory history(s.bore, options, r.times[rows[0]]);
  h.valid_until = history.valid_until();

  double touched_at = r.times[rows[0]];
  const auto add = [&](double t, bool touches, double rotor_flash) {
    const auto& state = history.state();
    h.times.push_back(t);
    h.largest_rise.push_back(state.largest_rise);
    h.mean_rise.push_back(state.mean_rise);
    h.rise_at_contact.push_back(touches ? state.rise_at_contact : nothing);
    h.rotor_flash.push_back(rotor_flash);
    h.arc.push_back(state.arc_of_contact);
    h.heated_arc.push_back(state.heated_arc);
    h.ring_turns.push_back(state.ring_turns);
  };
  add(r.times[rows[0]], false, nothing);
  for (std::size_t k = 1; k < rows.size(); ++k) {
    const std::size_t i = rows[k - 1], j = rows[k];
    const double step = r.times[j] - r.times[i], heat = r.joules_into_ring[j] - r.joules_into_ring[i];
    if (!(step > 0.)) continue;
    // What a ledger gains by rounding is no contact.
    const bool touches = heat > 1e-9 * largest_heat;
    history.advance(r.times[j],
                    {touches ? heat / step : 0., r.contact_angle[j], r.ring_angle[j], s.half_width, s.axial_width});
    if (!touches) touched_at = r.times[j];
    MovingBand on_rotor;
    on_rotor.half_width = s.half_width;
    on_rotor.speed =
        (r.rotor_angle[j] - r.rotor_angle[i] - turned(r.contact_angle[i], r.contact_angle[j])) * s.rotor_radius / step;
    on_rotor.flux = (r.joules_into_rotor[j] - r.joules_into_rotor[i]) / (step * 2. * s.half_width * s.axial_width);
    on_rotor.conductivity = s.rotor_conductivity;
    on_rotor.capacity = s.rotor_capacity;
    add(r.times[j], touches, touches ? on_rotor.largest_rise_estimate(r.times[j] - touched_at) : nothing);
  }
  return h;
}

double steady_band_rise(const RubSurfaces& s, double heat, double duration, double arc) {
  if (!(duration > 0.)) return 0.;
  MovingBand band;
  band.half_width = s.half_width;
  band.speed = arc * s.bore.radius / duration;
  band.flux = heat / (duration * 2. * s.half_width * s.axial_width);
  band.conductivity = s.bore.conductivity;
  band.capacity = s.bore.capacity;
  return band.largest_rise_estimate(duration);
}

}  // namespace rotordrop
