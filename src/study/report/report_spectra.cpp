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
  if (!is_two_sided) return "frequency";
  if (spin == 0.) return "frequency (positive: from +y to +z)";
  return std::string("frequency (positive: ") + (spin < 0. ? "backward)" : "forward)");
}

/// Straight lines between rows a distance d apart weigh a vibration of frequency f with sinc(f d)^2.
constexpr double two_percent = 0.055;  ///< f d at which this is 0.99, the other per cent being the window's
constexpr double ten_percent = 0.178;  ///< f d at which it is 0.90

std::string words_of_rows(const Waterfall& w) {
  const double d = w.row_distance;
  if (d <= 1.001 * w.interval)
    return fmt::format("Samples are {:.3g} µs apart; motion faster than {:.6g} Hz would fold back.", w.interval * 1e6,
                       0.5 / w.interval);
  return fmt::format(
      "Rows are up to {:.3g} µs apart, with straight lines between them: a sine of {:.4g} Hz is up to "
      "10 % too low, and motion faster than {:.4g} Hz would fold back.",
      d * 1e6, ten_percent / d, 0.5 / d);
}

/// " 92 % of the drop is left out, at 0.5 to 6 s: rows are more than 250 µs apart there.": empty if nothing is.
std::string words_of_rest(const Waterfall& w, double duration) {
  constexpr std::size_t most_named = 3;
  if (w.uncovered.empty()) return "";
  double missing = 0.;
  std::string where;
  for (std::size_t k = 0; k < w.uncovered.size(); ++k) {
    const auto& [from, to] = w.uncovered[k];
    missing += to - from;
    if (k < most_named) where += fmt::format("{}{:.4g} to {:.4g} s", k == 0 ? "" : ", ", from, to);
  }
  if (w.uncovered.size() > most_named) where += fmt::format(" and {} times more", w.uncovered.size() - most_named);
  const bool is_coarse = w.places.size() < w.place_times.size();
  return fmt::format(" {:.3g} % of the drop is left out, at {}: {}.", 100. * missing / duration, where,
                     is_coarse ? fmt::format("rows are more than {:.3g} µs apart there (output.longest_interval)",
                                             w.longest_allowed * 1e6)
                               : "the segments do not reach all of it");
}

/// With two digits, not above the value.
double two_digits_down(double value) {
  const double unit = std::pow(10., std::floor(std::log10(value)) - 1.);
  return std::floor(value / unit * (1. + 1e-9)) * unit;
}

std::string words_of_none(const Waterfall& w) {
  return fmt::format(
      "No spectra: every segment of {:.4g} ms has rows more than {:.3g} µs apart, which cannot hold the "
      "frequencies of interest. A run with output.longest_interval = \"{:.3g} us\" would have them.",
      w.segment * 1e3, w.longest_allowed * 1e6, 1e6 * two_digits_down(w.longest_allowed));
}

/// @param duration  of the drop [s]
std::string words(const Waterfall& w, double duration) {
  const bool is_even = w.row_distance <= 1.001 * w.interval;
  return fmt::format(
      "Amplitudes, 0-peak, of {} segments of {:.4g} ms: Hann window, mean of the segment taken away, filled up with "
      "zeros to four times its length; a steady sine shows its amplitude within {}. Lines closer than {:.3g} Hz run "
      "into one. {}{}",
      w.times.size(), w.segment * 1e3,
      is_even ? std::string("1 %") : fmt::format("2 % up to {:.3g} Hz", two_percent / w.row_distance), 2. / w.segment,
      words_of_rows(w), words_of_rest(w, duration));
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
  Json marks = Json::array();
  if (spin != 0.) marks.push_back({{"x", signal.z ? spin : std::abs(spin)}, {"name", "1x"}});
  if (spin != 0. && signal.z) marks.push_back({{"x", -spin}, {"name", "-1x"}});
  return {{"id", "spectrum-" + signal.id},
          {"section", "Spectra"},
          {"title", signal.title},
          {"x", {{"label", frequency_label(signal.z.has_value(), spin)}, {"unit", "Hz"}}},
          {"y", {{"label", signal.quantity}, {"unit", signal.unit}, {"log", true}}},
          {"note", words(w, signal.y.times.back() - signal.y.times.front()) +
                       (spin != 0. ? " 1x: spin frequency of the rotor at the start." : "")},
          {"marks", marks},
          {"lines",
           {line("largest of all segments", w.largest(), 0), line("root mean square of the segments", w.mean(), 2)}}};
}

/// A waterfall's picture: rows from the first to the last segment, evenly spaced in time.
struct Picture {
  std::size_t per_row = 1;                      ///< segments whose largest amplitudes are one row
  std::vector<double> times;                    ///< [n_rows] middles [s]
  std::vector<std::vector<double>> amplitudes;  ///< [n_rows][n_frequencies]; empty where all segments are left out
};
Picture picture_of(const Waterfall& w) {
  constexpr std::size_t most_rows = 120;
  Picture p;
  const std::size_t first = w.places.front(), n = w.places.back() + 1 - first;
  p.per_row = (n + most_rows - 1) / most_rows;
  const std::size_t n_rows = (n + p.per_row - 1) / p.per_row;
  const double step = w.place_times.size() > 1 ? w.place_times[1] - w.place_times[0] : 0.;
  for (std::size_t row = 0; row < n_rows; ++row)
    p.times.push_back(w.place_times[first] +
                      (static_cast<double>(row * p.per_row) + 0.5 * static_cast<double>(p.per_row - 1)) * step);
  p.amplitudes.resize(n_rows);
  for (std::size_t k = 0; k < w.places.size(); ++k) {
    auto& row = p.amplitudes[(w.places[k] - first) / p.per_row];
    row.resize(w.frequencies.size(), 0.);
    for (std::size_t i = 0; i < row.size(); ++i) row[i] = std::max(row[i], w.amplitude[k][i]);
  }
  return p;
}

Json waterfall_json(const Signal& signal, const Waterfall& w, const TimeSeries& spin) {
  const auto all = w.largest();
  const double largest = *std::max_element(all.begin(), all.end());
  std::vector<std::uint8_t> levels;
  const std::size_t n = group_of(w), columns = (w.frequencies.size() + n - 1) / n;
  const double step = w.frequencies.size() > 1 ? w.frequencies[1] - w.frequencies[0] : 1.;
  const double low = w.frequencies.front() + 0.5 * static_cast<double>(n - 1) * step;
  const Picture picture = picture_of(w);
  Json missing = Json::array();
  for (std::size_t row = 0; row < picture.amplitudes.size(); ++row) {
    if (picture.amplitudes[row].empty()) {
      missing.push_back(row);
      levels.insert(levels.end(), columns, 0);
      continue;
    }
    for (const double a : grouped(w, picture.amplitudes[row]).amplitudes) {
      const double part = a > 0. ? 1. + std::log10(a / largest) / decades : 0.;
      levels.push_back(static_cast<std::uint8_t>(std::lround(255. * std::clamp(part, 0., 1.))));
    }
  }
  std::vector<double> spins;
  for (const double t : picture.times) spins.push_back(std::abs(spin.at(t)) / two_pi);
  return {{"id", "waterfall-" + signal.id},
          {"title", signal.title + ", over time"},
          {"quantity", signal.quantity},
          {"unit", signal.unit},
          {"largest", largest * signal.scale},
          {"decades", decades},
          {"times", rounded(picture.times, 1e3, 6)},
          {"per_row", picture.per_row},
          {"missing", missing},
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
  ReportSpectra made{Json::array(), Json::array(), ""};
  const TimeSeries spin = drop.series("/rotor/spin_speed");
  const double initial = spin.values.front() / two_pi;
  const double wanted = std::max(1000., 8. * std::abs(initial));
  std::size_t colour = 0;
  for (const Signal& signal : signals_of(drop)) {
    const Waterfall w = waterfall(signal.y, signal.z ? &*signal.z : nullptr, drop.parameters().output.interval, wanted);
    if (w.amplitude.empty()) {
      if (!w.place_times.empty()) made.note = words_of_none(w);
      continue;
    }
    const auto largest = w.largest();
    if (!(*std::max_element(largest.begin(), largest.end()) > 0.)) continue;
    made.charts.push_back(spectrum_chart(signal, w, initial, colour++ % 7));
    made.waterfalls.push_back(waterfall_json(signal, w, spin));
  }
  return made;
}

}  // namespace rotordrop
