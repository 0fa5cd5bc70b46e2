#include "machine/heat/local_rub.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <initializer_list>
#include <numbers>
#include <numeric>

#include "base/rotation.h"
#include "laws/arc_cells.h"
#include "laws/heat/heat_flow.h"
#include "laws/heat/rubbing_pair.h"

namespace rotordrop {
namespace {

using std::numbers::pi;

constexpr std::size_t n_ring_cells = 720, n_rotor_cells = 180, n_wear_cells = 720;

/// One interval in which rotor and bore touch, or one without.
struct Interval {
  double end = 0, step = 0;
  double heat = 0, heat_into_ring = 0;                        // [J]
  double sliding_work = 0;                                    // [J]
  double force = 0;                                           // mean [N]; 0: no contact
  double contact_angle = 0, ring_angle = 0, rotor_angle = 0;  // at the end
  double turned = 0, ring_turned = 0, rotor_turned = 0;       // in it: line of centres, ring, rotor
};

/// Whether there is friction heat: a coefficient of friction of 1e-12 is none.
bool rubs(const std::vector<Interval>& list) {
  double heat = 0., sliding_work = 0.;
  for (const auto& v : list) {
    heat += v.heat;
    sliding_work += v.sliding_work;
  }
  return heat > 1e-12 * sliding_work;
}

double largest_force(const std::vector<Interval>& list) {
  double largest = 0.;
  for (const auto& v : list) largest = std::max(largest, v.force);
  return largest;
}

std::vector<Interval> intervals_of(const RubRecord& r, std::size_t most_rows,
                                   const std::optional<double>& largest_friction) {
  const auto rows = rows_to_follow(r, most_rows);
  std::vector<Interval> list;
  list.reserve(rows.size());
  double largest_heat = 0.;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    const std::size_t i = rows[k - 1], j = rows[k];
    Interval v;
    v.end = r.times[j];
    v.step = r.times[j] - r.times[i];
    if (!(v.step > 0.)) continue;
    v.heat_into_ring = r.joules_into_ring[j] - r.joules_into_ring[i];
    v.heat = v.heat_into_ring + r.joules_into_rotor[j] - r.joules_into_rotor[i];
    for (std::size_t m = i; m < j; ++m)
      v.sliding_work +=
          (r.impulse[m + 1] - r.impulse[m]) * 0.5 * (std::fabs(r.slip_speed[m]) + std::fabs(r.slip_speed[m + 1]));
    if (largest_friction && v.heat > *largest_friction * v.sliding_work) {
      const double most = std::max(*largest_friction * v.sliding_work, 0.);  // an impulse may fall by rounding
      v.heat_into_ring *= most / v.heat;
      v.heat = most;
    }
    v.force = (r.impulse[j] - r.impulse[i]) / v.step;
    v.contact_angle = r.contact_angle[j];
    v.ring_angle = r.ring_angle[j];
    v.rotor_angle = r.rotor_angle[j];
    v.turned = shorter_way(r.contact_angle[j] - r.contact_angle[i]);
    v.ring_turned = r.ring_angle[j] - r.ring_angle[i];
    v.rotor_turned = r.rotor_angle[j] - r.rotor_angle[i];
    largest_heat = std::max(largest_heat, v.heat);
    list.push_back(v);
  }
  // What a ledger gains by rounding is no contact; bristles that recover give heat without any.
  const bool has_heat = rubs(list);
  const double least_force = 1e-9 * largest_force(list);
  for (auto& v : list)
    if ((has_heat && v.heat <= 1e-9 * largest_heat) || !(v.force > least_force)) v.force = 0.;
  return list;
}

RubRecord every_second_row(const RubRecord& r) {
  RubRecord half;
  for (const auto list :
       {&RubRecord::times, &RubRecord::joules_into_ring, &RubRecord::joules_into_rotor, &RubRecord::contact_angle,
        &RubRecord::ring_angle, &RubRecord::rotor_angle, &RubRecord::impulse, &RubRecord::slip_speed}) {
    for (std::size_t i = 0; i < (r.*list).size(); i += 2) (half.*list).push_back((r.*list)[i]);
    if ((r.*list).size() % 2 == 0 && !(r.*list).empty()) (half.*list).push_back((r.*list).back());
  }
  return half;
}

enum class Share { one_temperature, recorded, by_speeds };

class Replay {
 public:
  Replay(const RubRecord& r, const std::vector<Interval>& list, const LocalRubSettings& s)
      : list_(list),
        s_(s),
        ring_{s.surfaces.bore.radius, s.surfaces.bore.conductivity, s.surfaces.bore.capacity},
        rotor_{s.surfaces.rotor_radius, s.surfaces.rotor_conductivity, s.surfaces.rotor_capacity},
        start_(r.times.empty() ? 0. : r.times.front()) {
    // Under a hundredth of the largest width the flux of so small a force is no matter; a point would have no area.
    least_force_ = 1e-4 * largest_force(list);
  }

  [[nodiscard]] double half_width(bool hertz, double force) const {
    return hertz ? s_.hertz_width_per_root * std::sqrt(std::max(force, least_force_)) : s_.surfaces.half_width;
  }

  /// By one band, for several shares at once. [shares]
  [[nodiscard]] std::vector<LocalRise> run(bool hertz, const std::vector<Share>& shares) const {
    std::vector<LocalRise> rises(shares.size());
    if (list_.empty()) return rises;
    RubbingPair pair(ring_, rotor_, options(shares), start_);
    std::vector<double> given(shares.size(), 0.);
    double touched_at = start_;
    for (const auto& v : list_) {
      if (v.force == 0.) {
        pair.advance(v.end, v.ring_angle, v.rotor_angle);
        touched_at = v.end;
        continue;
      }
      const double b = half_width(hertz, v.force);
      for (std::size_t i = 0; i < shares.size(); ++i) given[i] = given_share(shares[i], v, b, v.end - touched_at);
      pair.advance(v.end, {v.heat, b, v.contact_angle, v.ring_angle, v.rotor_angle}, given);
      for (std::size_t i = 0; i < shares.size(); ++i) {
        LocalRise& rise = rises[i];
        const auto& now = pair.state(i);
        rise.heat += v.heat;
        rise.rotor = std::max(rise.rotor, now.rotor_rise);
        if (now.ring_rise > rise.bore) {
          rise.bore = now.ring_rise;
          rise.time = v.end;
          rise.share_then = now.share_to_ring;
          rise.half_width = b;
          rise.difference_then = now.largest_difference;
        }
      }
    }
    for (std::size_t i = 0; i < shares.size(); ++i) {
      LocalRise& rise = rises[i];
      rise.heat_into_ring = pair.heat_into_ring(i);
      rise.heat_into_rotor = pair.heat_into_rotor(i);
      rise.share_to_ring = rise.heat > 0. ? rise.heat_into_ring / rise.heat : 0.;
    }
    return rises;
  }

  /// Source: Archard (1953), Contact and rubbing of flat surfaces, J. Appl. Phys. 24, 981-988.
  [[nodiscard]] Wear wear() const {
    std::vector<double> on_ring(n_wear_cells, 0.), on_rotor(n_wear_cells, 0.);
    Wear w;
    const auto spread = [&](std::vector<double>& cells, double place, double way, double half_angle, double work) {
      spread_over_cells(n_wear_cells, place - way, place, half_angle,
                        [&](std::size_t cell, double share) { cells[cell] += share * work; });
    };
    const double r_b = s_.surfaces.bore.radius, r_r = s_.surfaces.rotor_radius;
    for (const auto& v : list_) {
      if (v.sliding_work <= 0.) continue;
      w.sliding_work += v.sliding_work;
      const double b = half_width(s_.by_hertz, v.force);
      spread(on_ring, v.contact_angle - v.ring_angle, v.turned - v.ring_turned, b / r_b, v.sliding_work);
      spread(on_rotor, v.contact_angle - v.rotor_angle, v.turned - v.rotor_turned, b / r_r, v.sliding_work);
    }
    const auto depth = [&](const std::vector<double>& cells, double k, double radius, double& largest, double& mean,
                           double& volume) {
      const double area = 2. * pi * radius * s_.surfaces.axial_width / static_cast<double>(n_wear_cells);
      largest = k * *std::max_element(cells.begin(), cells.end()) / area;
      volume = k * std::accumulate(cells.begin(), cells.end(), 0.);
      mean = volume / (area * static_cast<double>(n_wear_cells));
    };
    depth(on_ring, s_.bore_wear, r_b, w.bore_depth, w.bore_mean_depth, w.bore_volume);
    depth(on_rotor, s_.rotor_wear, r_r, w.rotor_depth, w.rotor_mean_depth, w.rotor_volume);
    return w;
  }

 private:
  [[nodiscard]] RubbingPair::Options options(const std::vector<Share>& shares) const {
    RubbingPair::Options o;
    o.divisions.clear();
    for (const Share share : shares)
      o.divisions.push_back(share == Share::one_temperature ? RubDivision::one_temperature : RubDivision::given);
    o.axial_width = s_.surfaces.axial_width;
    o.shortest_interval = list_.front().step;
    o.duration = std::max(list_.back().end - start_, 2. * list_.front().step);
    o.ring_cells = n_ring_cells;
    o.rotor_cells = n_rotor_cells;
    return o;
  }
  /// @param b, age  half width of the band [m], time in contact [s]
  [[nodiscard]] double given_share(Share share, const Interval& v, double b, double age) const {
    if (share == Share::recorded) return v.heat_into_ring / v.heat;
    if (share == Share::one_temperature) return 0.;  // it follows
    const JaegerShare law{2. * b, age, rotor_.effusivity() / ring_.effusivity()};
    return law.to_ring((v.turned - v.rotor_turned) * rotor_.radius / v.step,
                       (v.turned - v.ring_turned) * ring_.radius / v.step);
  }

  const std::vector<Interval>& list_;
  const LocalRubSettings& s_;
  RubbedBody ring_, rotor_;
  double start_ = 0, least_force_ = 0;
};

}  // namespace

LocalRub local_rub(const RubRecord& r, const LocalRubSettings& s, std::size_t most_rows) {
  LocalRub result;
  const auto& bore = s.surfaces.bore;
  result.valid_until = 0.25 * bore.wall_thickness * bore.wall_thickness * bore.capacity / bore.conductivity;
  const auto list = intervals_of(r, most_rows, s.largest_friction);
  const Replay replay(r, list, s);
  result.wear = replay.wear();
  if (largest_force(list) == 0. || !rubs(list)) return result;
  const Share stated = s.is_one_temperature ? Share::one_temperature : Share::recorded;
  const Share other = s.is_one_temperature ? Share::recorded : Share::one_temperature;
  // The two bands know nothing of each other, and run at the same time where there are threads for them.
  auto by_other_band = std::async([&] { return replay.run(!s.by_hertz, {stated, other}); });
  const auto by_stated_band = replay.run(s.by_hertz, {stated, other, Share::by_speeds});
  result.stated = by_stated_band[0];
  result.other_share = by_stated_band[1];
  result.by_speeds = by_stated_band[2];
  const auto others = by_other_band.get();
  result.other_band = others[0];
  result.other_both = others[1];
  const auto bounds = std::minmax({result.stated.bore, result.other_share.bore, result.other_band.bore,
                                   result.other_both.bore, result.by_speeds.bore});
  result.bore_rise_low = bounds.first;
  result.bore_rise_high = bounds.second;
  return result;
}

double change_without_every_second_row(const RubRecord& r, const LocalRubSettings& s, const LocalRub& of_all) {
  const RubRecord half = every_second_row(r);
  const auto list = intervals_of(half, most_followed_rows, s.largest_friction);
  const Replay replay(half, list, s);
  double largest = 0.;
  const auto compare = [&](double value, double with_all) {
    if (with_all > 0.) largest = std::max(largest, std::fabs(value / with_all - 1.));
  };
  const Wear wear = replay.wear();
  compare(wear.bore_depth, of_all.wear.bore_depth);
  compare(wear.rotor_depth, of_all.wear.rotor_depth);
  if (std::isfinite(of_all.stated.time) && rubs(list))
    compare(replay.run(s.by_hertz, {s.is_one_temperature ? Share::one_temperature : Share::recorded})[0].bore,
            of_all.stated.bore);
  return largest;
}

}  // namespace rotordrop
