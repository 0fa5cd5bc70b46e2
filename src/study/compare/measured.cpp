#include "study/compare/measured.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "base/parameters/suggestion.h"
#include "base/trimmed.h"
#include "base/units.h"
#include "io/hdf5/recorded_series.h"
#include "io/text/input_file.h"
#include "io/text/toml_reader.h"
#include "study/unit_scale.h"

namespace rotordrop {
namespace {

namespace fs = std::filesystem;

UnitScale scale_of(const std::string& unit, const SourcePosition& where) {
  if (const auto scale = scale_in_si(unit)) return *scale;
  throw InputError(
      where, fmt::format("\"{}\" is no unit of a series.", unit),
      "For example \"um\", \"N\", \"rpm\" or \"degC\". What stands in square brackets behind the name of a "
      "column is its unit, but for a number, as in \"orbit[0]\".");
}

struct Column {
  std::string name, unit;
  std::vector<double> values;
  std::string header = {};  ///< as the file has it
};

constexpr std::string_view blanks = " \t\r\"";

std::optional<double> number_of(const std::string& text) {
  double value = 0.;
  const char* begin = text.data() + (!text.empty() && text.front() == '+');
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || text.empty()) return {};
  return value;
}

/// Where the bracket opens that ends a text; npos if none does.
std::size_t opening_of(const std::string& text) {
  const char close = text.empty() ? ' ' : text.back(), open = close == ']' ? '[' : close == ')' ? '(' : ' ';
  int depth = 0;
  for (std::size_t i = text.size(); open != ' ' && i-- > 0;) {
    depth += (text[i] == close) - (text[i] == open);
    if (depth == 0) return i;
  }
  return std::string::npos;
}

/// "orbit [um]", "orbit[um]" and "orbit (um)" are a name and a unit; "orbit[0]" and "orbit (filtered)" are names.
Column named_column(const std::string& text) {
  const auto open = opening_of(text);
  if (open == std::string::npos) return {text, "", {}, text};
  const std::string name(trimmed(std::string_view(text).substr(0, open), blanks)),
      unit(trimmed(std::string_view(text).substr(open + 1, text.size() - open - 2), blanks));
  const bool is_index = unit.find_first_not_of("0123456789") == std::string::npos;
  const bool is_told = text[open] == '[' && open > 0 && text[open - 1] == ' ';  // " [1]" is a unit, too
  if (!is_told && (is_index || (text[open] == '(' && !scale_in_si(unit)))) return {text, "", {}, text};
  return {name, unit, {}, text};
}

/// Numbers in columns, with a line of names or without; lines that begin with # are remarks.
std::vector<Column> read_table(const fs::path& file, const SourcePosition& where) {
  std::istringstream in(read_input_file(file, where));
  std::vector<Column> columns;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (const auto bare = trimmed(line, blanks); bare.empty() || bare.front() == '#') continue;
    const char separator = line.find(';') != std::string::npos    ? ';'
                           : line.find('\t') != std::string::npos ? '\t'
                                                                  : ',';
    std::vector<std::string> cells;
    // By hand, since getline() leaves out an empty cell at the end.
    for (std::size_t from = 0, to = 0; to != std::string::npos; from = to + 1) {
      to = line.find(separator, from);
      cells.emplace_back(trimmed(std::string_view(line).substr(from, to - from), blanks));
    }
    while (cells.size() > std::max<std::size_t>(columns.size(), 1) && cells.back().empty()) cells.pop_back();
    if (columns.empty() && !number_of(cells.front())) {
      for (const auto& cell : cells) columns.push_back(named_column(cell));
      continue;
    }
    if (columns.empty())
      for (std::size_t i = 0; i < cells.size(); ++i) columns.push_back({std::to_string(i), "", {}});
    if (cells.size() != columns.size())
      throw InputError({file.string(), number, 1},
                       fmt::format("this line has {} columns; the table has {}.", cells.size(), columns.size()));
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto value = cells[i].empty() ? std::numeric_limits<double>::quiet_NaN() : number_of(cells[i]);
      if (!value)
        throw InputError({file.string(), number, 1}, fmt::format("\"{}\" is not a number.", cells[i]),
                         "Columns are separated by commas, semicolons or tabs; decimals have a point.");
      columns[i].values.push_back(*value);
    }
  }
  if (columns.empty() || columns.front().values.empty())
    throw InputError(where.is_known() ? where : SourcePosition{file.string(), 0, 0},
                     fmt::format("{} holds no numbers.", file.string()));
  return columns;
}

bool is_hdf5(const fs::path& file) { return file.extension() == ".h5" || file.extension() == ".hdf5"; }

const Column& column_of(const std::vector<Column>& columns, const std::optional<std::string>& name,
                        std::size_t fallback, const fs::path& file, const SourcePosition& where) {
  std::vector<std::string> names;
  for (const auto& column : columns) {
    if (name && (column.name == *name || column.header == *name)) return column;
    names.push_back(column.name);
  }
  if (!name && fallback < columns.size()) return columns[fallback];
  throw InputError(where,
                   name ? fmt::format("{} has no column \"{}\".", file.string(), *name)
                        : fmt::format("{} has one column only; times and values are needed.", file.string()),
                   name ? suggestion(*name, names) : "");
}

Column dataset_of(const fs::path& file, const std::optional<std::string>& path, const char* key,
                  const SourcePosition& where) {
  if (!path)
    throw InputError(where, fmt::format("measured.{} is missing: which dataset of {} it is.", key, file.string()));
  auto [series, meaning] = read_series_with_meaning(file, *path);
  if (series.shape.size() != 1)
    throw InputError(where, fmt::format("dataset {} of {} is not a list of numbers.", *path, file.string()));
  return {*path, meaning.unit, std::move(series.values)};
}

/// A number in the values' unit, or a quantity: "1 um" also of values in millimetres.
double deviation_in_si(const std::string& given, const UnitScale& value, const std::string& unit,
                       const SourcePosition& where) {
  double si = 0.;
  if (const auto number = number_of(given)) {
    si = *number * std::fabs(value.factor);
  } else {
    const auto kind = kind_of(value.unit);
    const auto read = convert_to_si(given, value.unit,
                                    kind == QuantityKind::temperature ? QuantityKind::temperature_difference : kind,
                                    "measured.deviation");
    if (!read) throw InputError(where, read.error + ".", read.advice);
    si = read.value;
  }
  if (si > 0. && std::isfinite(si)) return si;
  throw InputError(
      where, fmt::format("measured.deviation = {} is out of range: it must be > 0.", given),
      fmt::format("It is the standard deviation of the noise, a number in the values' unit ({}) or such as "
                  "\"1 {}\".",
                  unit.empty() ? "SI" : unit, unit.empty() ? value.unit : unit));
}

Measured made(const MeasuredParameters& keys, const Column& times, const Column& values, const SourcePosition& where) {
  if (is_axis_of_times(keys.series))
    throw InputError(where, fmt::format("measured.series = \"{}\" holds the times of other series.", keys.series),
                     "Name what was measured, such as \"/bearings/TB1/orbit\".");
  Measured m = described(keys);
  const std::string unit = values.unit.empty() ? keys.unit : values.unit;
  const UnitScale time = scale_of(times.unit.empty() ? keys.time_unit : times.unit, where),
                  value = scale_of(unit, where);
  if (time.unit != "s" && !time.unit.empty())
    throw InputError(where,
                     fmt::format("\"{}\" is no unit of time.", times.unit.empty() ? keys.time_unit : times.unit));
  m.unit = value.unit;
  if (keys.deviation) m.deviation = deviation_in_si(*keys.deviation, value, unit, where);
  for (std::size_t i = 0; i < std::min(times.values.size(), values.values.size()); ++i) {
    const double t = time.zero + time.factor * times.values[i];
    if (!std::isfinite(t) || !std::isfinite(values.values[i]) || (keys.from && t < *keys.from) ||
        (keys.until && t > *keys.until))
      continue;
    if (!m.data.times.empty() && t <= m.data.times.back())
      throw InputError(
          where, fmt::format("the times of {} do not rise: {} s follows {} s.", keys.file, t, m.data.times.back()));
    m.data.times.push_back(t);
    m.data.values.push_back(value.zero + value.factor * values.values[i]);
  }
  if (m.data.times.size() < 3)
    throw InputError(where,
                     fmt::format("{} has {} numbers in the part that counts; 3 are needed at least.", keys.file,
                                 m.data.times.size()),
                     "See from and until.");
  return m;
}

void read_deviation(const Node& node, MeasuredParameters& p, Faults& faults) {
  if (node.is_text())
    p.deviation = node.text();
  else if (node.is_number())
    p.deviation = shortest(node.number());
  else
    faults.add(node.where(),
               fmt::format("measured.deviation is {}; it must be a number or a quantity.", kind_name(node)),
               "For example 0.8 in the values' unit, or \"0.8 um\".");
}

}  // namespace

Section<MeasuredParameters> measured_section() {
  using P = MeasuredParameters;
  Section<P> s("measured", "A measured quantity over time, and which series of a drop it is.");
  s.text("file", &P::file,
         {.help =
              "A table (CSV: commas, semicolons or tabs, one line of names or none) or an HDF5 file, beside this one."})
      .text("series", &P::series,
            {.help = "The dataset of results.h5 that was measured, such as \"/bearings/TB1/orbit\"."})
      .integer("component", &P::component,
               {.range = between(0, 100000),
                .fallback = 0,
                .help = "Column of that dataset, from 0: of orbits 0 is y and 1 is z."})
      .text("time", &P::time, {.help = "Column (or HDF5 dataset) of the times; the first one if left out."})
      .text("value", &P::value, {.help = "Column (or HDF5 dataset) of the values; the second one if left out."})
      .text("time_unit", &P::time_unit,
            {.fallback = "s",
             .help = "Of times whose column's name (or HDF5 attribute units) tells none, as in \"t [ms]\"."})
      .text("unit", &P::unit,
            {.fallback = "",
             .help = "Of values whose column's name (or HDF5 attribute units) tells none; SI if left out."})
      .custom("deviation",
              {.accepts = "a number in the values' unit, or a quantity",
               .json_types = {"number", "string"},
               .help = "Standard deviation of the noise: 0.8 in the values' unit, or \"0.8 um\". Left out: the "
                       "differences that remain tell it. Give it for all series or for none."},
              read_deviation)
      .quantity("bandwidth", &P::bandwidth,
                {.unit = "Hz", .range = positive(), .help = "Of the sensor, at -3 dB, as of a first-order low-pass."})
      .quantity(
          "delay", &P::delay,
          {.unit = "s",
           .range = any(),
           .fallback = "0 s",
           .help =
               "The measurement shows what was this much earlier; also the time of the release in the measurement."})
      .quantity("from", &P::from,
                {.unit = "s", .range = any(), .help = "Earlier values, in the measurement's time, do not count."})
      .quantity(
          "until", &P::until,
          {.unit = "s",
           .range = any(),
           .help =
               "Later values do not count. Bounces are chaotic: a fit needs the part before they forget the start."});
  return s;
}

Measured described(const MeasuredParameters& keys) {
  Measured m;
  m.keys = keys;
  m.name = fmt::format("{}[{}]", keys.series, keys.component);
  return m;
}

Measured read_measured(const MeasuredParameters& keys, const fs::path& folder, const SourcePosition& where) {
  const fs::path file = fs::path(keys.file).is_absolute() ? fs::path(keys.file) : folder / keys.file;
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored))
    throw InputError(where, fmt::format("measured.file = \"{}\": there is no such file.", file.string()));
  if (is_hdf5(file))
    return made(keys, dataset_of(file, keys.time, "time", where), dataset_of(file, keys.value, "value", where), where);
  const auto columns = read_table(file, where);
  return made(keys, column_of(columns, keys.time, 0, file, where), column_of(columns, keys.value, 1, file, where),
              where);
}

std::vector<Measured> read_measured_file(const fs::path& file) {
  const SourcePosition where{file.string(), 0, 0};
  std::vector<Measured> all;
  if (file.extension() == ".toml") {
    struct File {
      std::vector<MeasuredParameters> measured;
    };
    Section<File> section("", "Measured series.");
    section.list("measured", &File::measured, measured_section(), {.min_count = 1});
    const Node tree = read_toml(file);
    Faults faults;
    const File raw = section.read(tree, faults);
    faults.throw_if_any();
    for (std::size_t i = 0; i < raw.measured.size(); ++i)
      all.push_back(read_measured(raw.measured[i], file.parent_path(), tree.find("measured")->items()[i].where()));
    return all;
  }
  if (is_hdf5(file))
    throw InputError(where, "which datasets of this file are measured series is not told.",
                     "Name a TOML file with [[measured]] tables: file, time, value, series.");
  const auto columns = read_table(file, where);
  for (std::size_t i = 1; i < columns.size(); ++i) {
    MeasuredParameters keys;
    keys.file = file.string();
    keys.series = columns[i].name;
    keys.time_unit = "s";
    if (const auto open = keys.series.rfind('['); open != std::string::npos && keys.series.back() == ']') {
      keys.component =
          static_cast<int>(number_of(keys.series.substr(open + 1, keys.series.size() - open - 2)).value_or(0.));
      keys.series.resize(open);
    }
    if (keys.series.empty() || keys.series.front() != '/')
      throw InputError(where, fmt::format("column \"{}\" names no series.", columns[i].name),
                       "Columns after the first one, the time, are called such as \"/bearings/TB1/orbit[0] [um]\".");
    all.push_back(made(keys, columns.front(), columns[i], where));
  }
  if (all.empty()) throw InputError(where, "this table has times only.");
  return all;
}

void leave_out_after(Measured& m, double end, const SourcePosition& where) {
  auto& [times, values] = m.data;
  // A time of the end may be off by rounding, since units and the delay come in.
  const double last = end + 1e-9 * std::fabs(end);
  const auto n = std::partition_point(times.begin(), times.end(), [&](double t) { return t - m.keys.delay <= last; }) -
                 times.begin();
  if (n == 0)
    throw InputError(where,
                     fmt::format("none of the {} values of {} in {} was measured before the end of the drop, {:.6g} s: "
                                 "the first one is of {:.6g} s.",
                                 times.size(), m.name, m.keys.file, end, times.front() - m.keys.delay),
                     "Check the unit of the times, delay (the time of the release in the measurement) and "
                     "run.end_time.");
  m.after_end = {{times.begin() + n, times.end()}, {values.begin() + n, values.end()}};
  times.resize(static_cast<std::size_t>(n));
  values.resize(static_cast<std::size_t>(n));
}

std::string left_out_text(const Measured& m, double end) {
  const std::size_t n = m.after_end.times.size();
  if (n == 0) return "";
  return fmt::format("values of {} in {} after the end of the drop, {:.6g} s, are left out: {} of {}.", m.name,
                     m.keys.file, end, n, n + m.data.times.size());
}

bool is_axis_of_times(const std::string& series) {
  constexpr std::ptrdiff_t deepest = 2;  // "/GROUP/time"; what parts of others call so lies deeper
  return series.ends_with("/time") && std::count(series.begin(), series.end(), '/') <= deepest;
}

bool is_same_unit(const std::string& a, const std::string& b) {
  if (a == b) return true;
  if (!is_unit(a) || !is_unit(b)) return false;
  const auto one = convert_to_si("1 " + a, b, kind_of(b), "unit");
  return one && one.value == 1.;
}

double last_compared(const Measured& m) { return m.data.times.back() - m.keys.delay; }

std::vector<double> sensed(const TimeSeries& quantity, const Measured& by) {
  TimeSeries shown = quantity;
  if (by.keys.bandwidth) {
    // y' = (x - y) / tau with x straight between samples, solved exactly; at rest before the first sample.
    const double tau = 1. / (2. * std::numbers::pi * *by.keys.bandwidth);
    for (std::size_t i = 1; i < shown.times.size(); ++i) {
      const double h = quantity.times[i] - quantity.times[i - 1], decay = std::exp(-h / tau);
      const double slope = (quantity.values[i] - quantity.values[i - 1]) / h;
      shown.values[i] =
          quantity.values[i] - slope * tau + (shown.values[i - 1] - quantity.values[i - 1] + slope * tau) * decay;
    }
  }
  std::vector<double> values;
  for (const double t : by.data.times) values.push_back(shown.at(t - by.keys.delay));
  return values;
}

MeasuredDifference difference_of(const Measured& measured, const std::vector<double>& computed) {
  MeasuredDifference d;
  d.n = measured.data.values.size();
  const auto n = static_cast<double>(d.n);
  double mean = 0., squares = 0., about_mean = 0.;
  for (const double y : measured.data.values) mean += y / n;
  for (std::size_t i = 0; i < d.n; ++i) {
    const double y = measured.data.values[i], e = y - computed.at(i);
    squares += e * e;
    about_mean += (y - mean) * (y - mean);
    d.mean += e / n;
    if (std::fabs(e) >= std::fabs(d.largest)) {
      d.largest = e;
      d.largest_time = measured.data.times[i];
    }
  }
  d.rms = std::sqrt(squares / n);
  d.share = about_mean > 0. ? 1. - squares / about_mean : std::numeric_limits<double>::quiet_NaN();
  return d;
}

}  // namespace rotordrop
