#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "io/hdf5/recorded_series.h"
#include "study/drop/whirl.h"
#include "study/report/report.h"
#include "study/report/rounded.h"

// What moves in the page: rotor and rings, the shapes of bent rings, the balls' loads.
namespace rotordrop {

namespace {

using Json = nlohmann::ordered_json;

/// Shape of a bent inner ring: times [ms] and at each the coefficients of cos and sin [um]; null for rigid rings.
Json ring_shape(const RecordedDrop& drop, const std::string& bearing) {
  constexpr std::size_t n_frames = 1000;
  const std::string path = "/bearings/" + bearing + "/inner_ring_shape";
  if (!drop.has(path)) return nullptr;
  Json shape = {{"time", Json::array()}, {"coefficients", Json::array()}};
  const std::size_t n_columns = read_attribute_list(drop.directory() / "results.h5", path, "columns").size();
  for (std::size_t column = 0; column < n_columns; ++column) {
    const TimeSeries s = drop.series(path, column);
    const std::size_t stride = (s.times.size() + n_frames - 1) / n_frames;
    std::vector<double> times, values;
    for (std::size_t k = 0; k < s.times.size(); k += stride) {
      times.push_back(s.times[k]);
      values.push_back(std::round(s.values[k] * 1e8) * 1e-8);  // to 0.01 um
    }
    if (column == 0) shape["time"] = rounded(times, 1e3, 6);
    shape["coefficients"].push_back(rounded(values, 1e6, 4));
  }
  return shape;
}

/// Probes, drawn as the rotor in a bore that stands still.
void add_probe_frames(const RecordedDrop& drop, std::size_t n_frames, Json& animation) {
  animation["probes"] = Json::array();
  for (const auto& [name, probe] : drop.parameters().rotor.probes) {
    const std::string prefix = "/probes/" + name + "/";
    if (!drop.has(prefix + "position")) continue;
    const TimeSeries y = drop.series(prefix + "position", 0), z = drop.series(prefix + "position", 1),
                     left = drop.series(prefix + "clearance"), spin = drop.series("/rotor/spin_angle");
    const std::size_t n = std::min({y.times.size(), z.times.size(), left.times.size(), spin.times.size()});
    const std::size_t stride = (n + n_frames - 1) / n_frames;
    std::vector<double> times, at_y, at_z, clearance, angle;
    for (std::size_t k = 0; k < n; k += stride) {
      times.push_back(y.times[k]);
      at_y.push_back(y.values[k] - probe.centre[0]);
      at_z.push_back(z.values[k] - probe.centre[1]);
      clearance.push_back(left.values[k]);
      angle.push_back(std::fmod(spin.values[k], 2. * std::numbers::pi));
    }
    animation["probes"].push_back({{"name", name},
                                   {"gap", 1e6 * probe.clearance},
                                   {"time", rounded(times, 1e3, 6)},
                                   {"y", rounded(at_y, 1e6)},
                                   {"z", rounded(at_z, 1e6)},
                                   {"clearance", rounded(clearance, 1e6, 4)},
                                   {"rotor_angle", rounded(angle, 1., 3)}});
  }
}

/// Largest value in each of equal spans of time from 0 to the last row.
struct SpanPeaks {
  std::vector<double> values;  ///< a span without a row has the value of the last row before
  bool is_held = false;        ///< some have
};
SpanPeaks peaks_of_spans(const TimeSeries& s, std::size_t n_spans) {
  SpanPeaks peaks;
  double before = s.values.front();
  std::size_t row = 0;
  for (std::size_t span = 1; span <= n_spans; ++span) {
    const double end = s.times.back() * static_cast<double>(span) / static_cast<double>(n_spans);
    double peak = before;
    bool has_row = false;
    for (; row < s.times.size() && (s.times[row] < end || span == n_spans); ++row) {
      peak = has_row ? std::max(peak, s.values[row]) : s.values[row];
      before = s.values[row];
      has_row = true;
    }
    peaks.values.push_back(peak);
    peaks.is_held = peaks.is_held || !has_row;
  }
  return peaks;
}

}  // namespace

Json report_ball_loads(const RecordedDrop& drop) {
  constexpr std::size_t most_spans = 400;
  Json all = Json::array();
  for (const auto& [name, parameters] : drop.bearings()) {
    const std::string path = "/bearings/" + name + "/ball_loads";
    if (!drop.has(path)) continue;
    Json loads = Json::array();
    double largest = 0., end = 0.;
    bool is_held = false;
    for (std::size_t ball = 0; ball < drop.table(path).n_columns; ++ball) {
      const TimeSeries s = drop.series(path, ball);
      end = s.times.back();
      const SpanPeaks peaks = peaks_of_spans(s, std::min(most_spans, s.times.size()));
      is_held = peaks.is_held;
      largest = std::max(largest, *std::max_element(peaks.values.begin(), peaks.values.end()));
      loads.push_back(rounded(peaks.values, 1., 3));
    }
    if (!(largest > 0.)) continue;
    all.push_back({{"name", name},
                   {"end", 1e3 * end},
                   {"largest", largest},
                   {"is_held", is_held},
                   {"balls_per_row", parameters.balls_per_row},
                   {"loads", std::move(loads)}});
  }
  return all;
}

namespace {

/// What the pictures of the drop leave out of its motion and surfaces.
Json not_drawn(const RecordedDrop& drop) {
  const auto bearings = drop.bearings();
  const auto some = [&](const auto& is_so) {
    return std::any_of(bearings.begin(), bearings.end(), [&](const auto& bearing) { return is_so(bearing.second); });
  };
  Json list = Json::array();
  if (some([](const TouchdownParameters& b) { return !b.waviness.empty(); })) list.push_back("waves of the surfaces");
  if (some([](const TouchdownParameters& b) { return b.ring_motion == RingMotion::free; }))
    list.push_back("tilts of rotor and rings");
  return list;
}

/// Instant of the largest recorded contact force of all bearings, shoulders included [s].
double start_of_slider(const RecordedDrop& drop) {
  Extreme largest;
  for (const auto& [name, parameters] : drop.bearings())
    for (const char* dataset : {"contact_force", "shoulder_force"}) {
      const std::string path = "/bearings/" + name + "/" + dataset;
      if (!drop.has(path)) continue;
      TimeSeries magnitude = drop.series(path);
      for (double& v : magnitude.values) v = std::fabs(v);
      if (const Extreme here = largest_of(magnitude); here.value > largest.value) largest = here;
    }
  return largest.time;
}

}  // namespace

Json report_animation(const RecordedDrop& drop) {
  constexpr std::size_t n_frames = 3000;
  Json animation = {{"start", 1e3 * start_of_slider(drop)}, {"bearings", Json::array()}};
  for (const auto& [name, parameters] : drop.bearings()) {
    const std::string prefix = "/bearings/" + name + "/";
    const TimeSeries y = drop.series(prefix + "orbit", 0), z = drop.series(prefix + "orbit", 1),
                     ring_y = drop.series(prefix + "ring_position", 0),
                     ring_z = drop.series(prefix + "ring_position", 1),
                     penetration = drop.series(prefix + "penetration"), force = drop.series(prefix + "contact_force"),
                     spin = drop.series("/rotor/spin_angle"), speed = drop.series(prefix + "ring_speed");
    const TimeSeries angle = integral_of(speed);
    const std::size_t n = std::min({y.times.size(), z.times.size(), penetration.times.size(), force.times.size(),
                                    spin.times.size(), angle.times.size(), ring_y.times.size(), ring_z.times.size()});
    const std::size_t stride = (n + n_frames - 1) / n_frames;
    const auto frames = [&](const TimeSeries& s, double scale, int digits = 5) {
      std::vector<double> values;
      for (std::size_t k = 0; k < n; k += stride) values.push_back(s.values[k]);
      return rounded(values, scale, digits);
    };
    const auto turned = [&](TimeSeries s) {
      for (double& v : s.values) v = std::fmod(v, 2. * std::numbers::pi);
      return frames(s, 1., 3);
    };
    std::vector<double> times;
    for (std::size_t k = 0; k < n; k += stride) times.push_back(y.times[k]);
    animation["bearings"].push_back({{"name", name},
                                     {"gap", 1e6 * air_gap(parameters, drop.parameters().contact)},
                                     {"time", rounded(times, 1e3, 6)},
                                     {"y", frames(y, 1e6)},
                                     {"z", frames(z, 1e6)},
                                     {"ring_y", frames(ring_y, 1e6, 4)},
                                     {"ring_z", frames(ring_z, 1e6, 4)},
                                     {"penetration", frames(penetration, 1e6, 3)},
                                     {"force", frames(force, 1e-3, 3)},
                                     {"rotor_angle", turned(spin)},
                                     {"ring_angle", turned(angle)}});
    if (Json shape = ring_shape(drop, name); !shape.is_null()) animation["bearings"].back()["shape"] = std::move(shape);
  }
  add_probe_frames(drop, n_frames, animation);
  animation["not_drawn"] = not_drawn(drop);
  return animation;
}

}  // namespace rotordrop
