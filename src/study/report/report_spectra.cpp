#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/rotation.h"
#include "study/report/packed.h"
#include "study/report/report.h"
#include "study/report/rounded.h"
#include "study/report/spectrum.h"

// Spectra of orbits and forces, as figures and as waterfalls.
namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;
constexpr double decades = 3.;  ///< below the largest amplitude, in colours and on axes

/// Of a frequency whose sign is that of the whirl. @param spin  speed of the rotor at the start
std::string frequency_label(bool is_two_sided, double spin) {
  return is_two_sided ? std::string("frequency (positive: ") + (spin < 0. ? "backward)" : "forward)") : "frequency";
}

std::string words(const Waterfall& w) {
  return fmt::format(
      "Amplitudes, 0-peak, of {} segments of {:.4g} ms: Hann window, mean of the segment taken away, filled up with "
      "zeros to four times its length; a steady sine shows its amplitude within 1 %. Lines closer than {:.3g} Hz run "
      "into one. "
      "Samples are {:.3g} µs apart; motion faster than {:.6g} Hz would fold back.",
      w.times.size(), w.segment * 1e3, 2. / w.segment, w.interval * 1e6, 0.5 / w.interval);
}

/// Of amplitudes, to be drawn on a logarithmic axis; not a number where they are more than `decades` below the largest.
std::vector<double> logarithms(std::vector<double> values, double scale) {
  const double floor = std::pow(10., -decades) * *std::max_element(values.begin(), values.end());
  for (double& v : values) v = v >= floor ? std::log10(v * scale) : std::nan("");
  return values;
}

/// How many points of a spectrum become one of a picture.
std::size_t group_of(const Waterfall& w) {
  constexpr std::size_t most_points = 1000;
  return (w.frequencies.size() + most_points - 1) / most_points;
}

/// The largest amplitude of each group, and its frequency.
struct Line {
  std::vector<double> frequencies, amplitudes;
};
Line grouped(const Waterfall& w, const std::vector<double>& amplitude) {
  const std::size_t n = group_of(w);
  Line line;
  for (std::size_t first = 0; first < amplitude.size(); first += n) {
    const auto begin = amplitude.begin() + static_cast<std::ptrdiff_t>(first);
    const auto at = std::max_element(begin, begin + static_cast<std::ptrdiff_t>(std::min(n, amplitude.size() - first)));
    line.frequencies.push_back(w.frequencies[static_cast<std::size_t>(at - amplitude.begin())]);
    line.amplitudes.push_back(*at);
  }
  return line;
}

/// A signal of which there are spectra.
struct Signal {
  std::string id, title, quantity, unit;
  double scale = 1;
  TimeSeries y;
  std::optional<TimeSeries> z;
};

Json spectrum_chart(const Signal& signal, const Waterfall& w, double spin, std::size_t colour) {
  const auto line = [&](const std::string& name, const std::vector<double>& values, std::size_t dash) {
    const Line few = grouped(w, values);
    return Json{{"name", name},
                {"colour", colour},
                {"dash", dash},
                {"x", rounded(few.frequencies, 1., 6)},
                {"y", rounded(logarithms(few.amplitudes, signal.scale), 1., 5)}};
  };
  Json marks = {{{"x", signal.z ? spin : std::abs(spin)}, {"name", "1x"}}};
  if (signal.z) marks.push_back({{"x", -spin}, {"name", "-1x"}});
  return {{"id", "spectrum-" + signal.id},
          {"section", "Spectra"},
          {"title", signal.title},
          {"x", {{"label", frequency_label(signal.z.has_value(), spin)}, {"unit", "Hz"}}},
          {"y", {{"label", signal.quantity}, {"unit", signal.unit}, {"log", true}}},
          {"note", words(w) + " 1x: spin frequency of the rotor at the start."},
          {"marks", marks},
          {"lines",
           {line("largest of all segments", w.largest(), 0), line("root mean square of the segments", w.mean(), 2)}}};
}

Json waterfall_json(const Signal& signal, const Waterfall& w, const TimeSeries& spin) {
  double largest = 0.;
  for (const auto& one : w.amplitude) largest = std::max(largest, *std::max_element(one.begin(), one.end()));
  std::vector<std::uint8_t> levels;
  const std::size_t n = group_of(w), columns = (w.frequencies.size() + n - 1) / n;
  const double step = w.frequencies.size() > 1 ? w.frequencies[1] - w.frequencies[0] : 1.;
  const double low = w.frequencies.front() + 0.5 * static_cast<double>(n - 1) * step;
  for (const auto& one : w.amplitude)
    for (const double a : grouped(w, one).amplitudes) {
      const double part = a > 0. ? 1. + std::log10(a / largest) / decades : 0.;
      levels.push_back(static_cast<std::uint8_t>(std::lround(255. * std::clamp(part, 0., 1.))));
    }
  std::vector<double> spins;
  for (const double t : w.times) spins.push_back(std::abs(spin.at(t)) / two_pi);
  return {{"id", "waterfall-" + signal.id},
          {"title", signal.title + ", over time"},
          {"quantity", signal.quantity},
          {"unit", signal.unit},
          {"largest", largest * signal.scale},
          {"decades", decades},
          {"times", rounded(w.times, 1e3, 6)},
          {"low", low},
          {"high", low + static_cast<double>((columns - 1) * n) * step},
          {"columns", columns},
          {"spin", rounded(spins, 1., 5)},
          {"is_two_sided", signal.z.has_value()},
          {"frequency", frequency_label(signal.z.has_value(), spin.values.front())},
          {"segment", w.segment * 1e3},
          {"levels", base64(levels)}};
}

std::vector<Signal> signals_of(const RecordedDrop& drop) {
  std::vector<Signal> list;
  const auto add_orbit = [&](const std::string& id, const std::string& name, const std::string& path) {
    if (drop.has(path))
      list.push_back({"orbit-" + id, name + ": spectrum of the orbit", "amplitude", "um", 1e6, drop.series(path, 0),
                      drop.series(path, 1)});
  };
  const auto add_force = [&](const std::string& id, const std::string& title, const std::string& path) {
    if (!drop.has(path)) return;
    Signal signal{"force-" + id, title, "amplitude", "N", 1., drop.series(path, 0), {}};
    const auto [low, high] = std::minmax_element(signal.y.values.begin(), signal.y.values.end());
    if (*high > *low) list.push_back(std::move(signal));
  };
  for (const auto& entry : drop.parameters().bearings) {
    const std::string path = "/bearings/" + entry.name + "/";
    add_orbit(entry.name, entry.name, path + "orbit");
    if (entry.touchdown())
      add_force(entry.name, entry.name + ": spectrum of the contact force", path + "contact_force");
    else if (entry.linear())
      add_force(entry.name, entry.name + ": spectrum of the support's force, y", path + "support_force");
  }
  for (const auto& [name, probe] : drop.parameters().rotor.probes)
    add_orbit("probe-" + name, name + " (probe)", "/probes/" + name + "/position");
  return list;
}

}  // namespace

ReportSpectra report_spectra(const RecordedDrop& drop) {
  ReportSpectra made{Json::array(), Json::array()};
  const TimeSeries spin = drop.series("/rotor/spin_speed");
  const double initial = spin.values.front() / two_pi;
  const double wanted = std::max(1000., 8. * std::abs(initial));
  std::size_t colour = 0;
  for (const Signal& signal : signals_of(drop)) {
    const Waterfall w = waterfall(signal.y, signal.z ? &*signal.z : nullptr, drop.parameters().output.interval, wanted);
    if (w.amplitude.empty()) continue;
    const auto largest = w.largest();
    if (!(*std::max_element(largest.begin(), largest.end()) > 0.)) continue;
    made.charts.push_back(spectrum_chart(signal, w, initial, colour++ % 7));
    made.waterfalls.push_back(waterfall_json(signal, w, spin));
  }
  return made;
}

}  // namespace rotordrop
