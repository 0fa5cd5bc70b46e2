#include "study/many/search/fit_evaluation.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "io/checkpoint.h"
#include "io/text/input_file.h"
#include "study/many/answers/statistics.h"

namespace rotordrop {
namespace {

constexpr const char* file_name = "measured.csv";

const PointSeries* find(const std::vector<PointSeries>& series, const std::string& path) {
  const auto found = std::find_if(series.begin(), series.end(), [&](const auto& s) { return s.path == path; });
  return found == series.end() ? nullptr : &*found;
}

}  // namespace

std::vector<std::string> series_of_study(const Study& study) {
  auto paths = study.keep_series;
  if (study.fit)
    for (const auto& m : study.fit->measured)
      if (std::find(paths.begin(), paths.end(), m.keys.series) == paths.end()) paths.push_back(m.keys.series);
  return paths;
}

std::string measured_path(std::size_t k) { return fmt::format("/measured/{}", k + 1); }

void show_measured(const Study& study, PointResult& result) {
  if (!study.fit || !result.is_done) return;
  std::vector<PointSeries> shown;
  for (std::size_t k = 0; k < study.fit->measured.size(); ++k) {
    const Measured& m = study.fit->measured[k];
    const PointSeries* series = find(result.series, m.keys.series);
    if (!series) throw SolverError("a drop has no series " + m.keys.series);
    const auto column = static_cast<std::size_t>(m.keys.component);
    if (column >= series->width)
      throw InputError({},
                       fmt::format("measured.component = {}: {} has {} columns.", column, m.keys.series, series->width),
                       "Columns count from 0.");
    if (!m.unit.empty() && !is_same_unit(m.unit, series->unit))
      throw InputError({}, fmt::format("{} is in {}, but the measured values of {} are in {}.", m.keys.series,
                                       series->unit, m.keys.file, m.unit));
    TimeSeries quantity{series->time, {}};
    for (std::size_t i = 0; i < series->time.size(); ++i)
      quantity.values.push_back(series->values[i * series->width + column]);
    if (quantity.times.empty()) continue;  // of a drop that was stopped at once
    const double end = quantity.times.back(), needed = last_compared(m);
    if (needed > end + 1e-9 * std::fabs(end)) {  // every drop of a fit is compared at the same times
      result.is_done = false;
      result.reason = fmt::format(
          "it ends at {:.6g} s, but {} is compared until {:.6g} s; let drops run on, or set until of the measurement",
          end, m.name, needed);
      continue;
    }
    shown.push_back({measured_path(k), series->unit, series->long_name, 1, m.data.times, sensed(quantity, m)});
  }
  std::erase_if(result.series, [&](const PointSeries& s) {
    return std::find(study.keep_series.begin(), study.keep_series.end(), s.path) == study.keep_series.end();
  });
  for (auto& s : shown) result.series.push_back(std::move(s));
}

Eigen::VectorXd residuals_of(const Fit& fit, const std::vector<PointSeries>& series) {
  std::vector<double> all;
  for (std::size_t k = 0; k < fit.measured.size(); ++k) {
    const Measured& m = fit.measured[k];
    const PointSeries* shown = find(series, measured_path(k));
    if (!shown || shown->values.size() < m.data.values.size()) return {};
    double scale = m.deviation ? *m.deviation : deviation_of(m.data.values);
    if (!(scale > 0.)) scale = 1.;
    for (std::size_t i = 0; i < m.data.values.size(); ++i) all.push_back((shown->values[i] - m.data.values[i]) / scale);
  }
  return Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

void write_measured(const std::vector<Measured>& measured, const std::filesystem::path& directory) {
  std::string text =
      "# measured series in SI: number, unit, deviation of the noise (empty: not given), time [s], value\n";
  for (std::size_t k = 0; k < measured.size(); ++k)
    for (const auto* part : {&measured[k].data, &measured[k].after_end})
      for (std::size_t i = 0; i < part->times.size(); ++i)
        text += fmt::format("{},{},{},{},{}\n", k, measured[k].unit,
                            measured[k].deviation ? fmt::format("{}", *measured[k].deviation) : "", part->times[i],
                            part->values[i]);
  write_text_atomically(directory / file_name, text);
}

void read_measured_of(const std::filesystem::path& directory, std::vector<Measured>& measured) {
  std::istringstream in(read_input_file(directory / file_name));
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::istringstream parts(line);
    std::string number, unit, deviation, time, value;
    std::getline(parts, number, ',');
    std::getline(parts, unit, ',');
    std::getline(parts, deviation, ',');
    std::getline(parts, time, ',');
    std::getline(parts, value, ',');
    const auto k = static_cast<std::size_t>(std::strtoul(number.c_str(), nullptr, 10));
    if (k >= measured.size()) continue;
    measured[k].unit = unit;
    if (!deviation.empty()) measured[k].deviation = std::strtod(deviation.c_str(), nullptr);
    measured[k].data.times.push_back(std::strtod(time.c_str(), nullptr));
    measured[k].data.values.push_back(std::strtod(value.c_str(), nullptr));
  }
}

}  // namespace rotordrop
