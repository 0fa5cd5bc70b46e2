#include <pybind11/complex.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "base/units.h"
#include "python/bindings.h"
#include "python/values.h"
#include "python/watch.h"
#include "study/compare/comparison.h"
#include "study/modes/critical_speeds_report.h"
#include "study/modes/modes_report.h"
#include "study/preload/preload_run.h"
#include "study/statics/statics_report.h"

namespace rotordrop::python {
namespace py = pybind11;

namespace {

using Json = nlohmann::ordered_json;

py::array_t<double> array_of(const std::vector<double>& values) {
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

/// A quantity in the unit of SI. @throws InputError naming the argument
double to_si(const std::string& text, const std::string& unit, const std::string& argument) {
  const auto read = convert_to_si(text, unit, kind_of(unit), argument);
  if (!read) throw InputError({argument, 0, 0}, read.error, read.advice);
  return read.value;
}

py::dict dict_of(const WhirlModes& found, std::size_t n_modes) {
  py::list modes;
  for (std::size_t k = 0; k < std::min(n_modes, found.modes.size()); ++k) {
    const WhirlMode& mode = found.modes[k];
    py::dict one;
    one["frequency"] = mode.frequency;
    one["natural_frequency"] = mode.natural_frequency;
    one["damping_ratio"] = mode.damping_ratio;
    one["whirl"] = std::string(to_string(mode.whirl));
    one["shape"] = py::make_tuple(mode.v, mode.w);
    modes.append(one);
  }
  py::dict all;
  all["modes"] = modes;
  all["rigid_body_modes"] = found.n_rigid_body_modes;
  all["overdamped_modes"] = found.n_overdamped;
  all["diverging_modes"] = found.n_diverging;
  all["divergence_rate"] = found.divergence_rate;
  return all;
}

py::dict modes(const Case& c, const std::vector<double>& speeds, std::size_t n_modes) {
  ModesReport report;
  {
    const OthersMayRun others_may_run;
    report = find_modes(c, speeds);
  }
  py::list at_speeds;
  for (const auto& found : report.modes) at_speeds.append(dict_of(found, n_modes));
  py::dict all;
  all["supports"] = report.is_free_free ? "free-free" : "linear";
  all["left_out"] = report.left_out;
  all["node_positions"] = array_of(report.node_positions);
  all["speeds"] = at_speeds;
  return all;
}

py::object found_critical_speeds(const Case& c, double up_to, const std::optional<double>& stiffness,
                                 const std::vector<double>& map) {
  CriticalSpeedOptions options;
  options.up_to = up_to;
  options.stiffness = stiffness;
  options.map = map;
  Json found;
  {
    const OthersMayRun others_may_run;
    found = critical_speeds_json(c, critical_speeds(c.parameters, options), options);
  }
  return to_python(found);
}

py::object statics(const Case& c, const std::string& bearing) {
  Json found;
  {
    const OthersMayRun others_may_run;
    found = find_rest(c, bearing);
  }
  return to_python(found);
}

py::dict dict_of(const PreloadTable& table) {
  py::list channels;
  std::size_t column = 0;
  for (const Channel& channel : table.group.channels) {
    py::array_t<double> values({static_cast<py::ssize_t>(table.rows.size()), static_cast<py::ssize_t>(channel.size)});
    auto to = values.mutable_unchecked<2>();
    for (py::ssize_t i = 0; i < to.shape(0); ++i)
      for (py::ssize_t k = 0; k < to.shape(1); ++k)
        to(i, k) = table.rows[static_cast<std::size_t>(i)][column + static_cast<std::size_t>(k)];
    column += channel.size;
    channels.append(py::make_tuple(channel.path, channel.unit, channel.long_name, channel.columns, values));
  }
  py::dict result;
  result["axis"] = py::make_tuple(table.group.time_path, table.group.unit, table.group.long_name, array_of(table.axis));
  result["channels"] = channels;
  return result;
}

py::tuple preload(const Case& c, const std::string& bearing, const std::shared_ptr<RecordedDrop>& drop) {
  Json report;
  std::vector<PreloadTable> tables;
  {
    const OthersMayRun others_may_run;
    Watch watch;
    report = find_preload(c, bearing, drop.get(), tables, [&watch] { watch.look(); });
  }
  py::list list;
  for (const auto& table : tables) list.append(dict_of(table));
  return py::make_tuple(to_python(report), list);
}

/// Limits of a comparison, as on the command line; empty: default.
struct ComparisonTexts {
  std::string tolerance, floor, growth_tolerance, band_length;
};

py::object compare(const std::shared_ptr<RecordedDrop>& drop, const std::shared_ptr<RecordedDrop>& against,
                   const ComparisonTexts& texts, const std::optional<std::vector<double>>& instants) {
  ComparisonOptions options;
  if (!texts.tolerance.empty()) options.temperature = parse_temperature_tolerance(texts.tolerance);
  if (!texts.floor.empty()) options.floor = parse_floor(texts.floor);
  if (!texts.growth_tolerance.empty()) options.growth = parse_length(texts.growth_tolerance, "growth_tolerance");
  if (!texts.band_length.empty()) options.band_length = parse_band_length(texts.band_length, "band_length");
  if (instants) options.instants = *instants;
  Json report;
  {
    const OthersMayRun others_may_run;
    report = compare_models(*drop, against.get(), options).report;
  }
  return to_python(report);
}

}  // namespace

void add_analyses(py::module_& core) {
  core.def("is_unit", &is_unit, py::arg("unit"));
  core.def("to_si", &to_si, py::arg("text"), py::arg("unit"), py::arg("argument"));
  core.def("modes", &modes, py::arg("case"), py::arg("speeds"), py::arg("n_modes"));
  core.def("critical_speeds", &found_critical_speeds, py::arg("case"), py::arg("up_to"), py::arg("stiffness"),
           py::arg("map"));
  core.def("statics", &statics, py::arg("case"), py::arg("bearing"));
  core.def("preload", &preload, py::arg("case"), py::arg("bearing"), py::arg("drop"));
  core.def(
      "compare",
      [](const std::shared_ptr<RecordedDrop>& drop, const std::shared_ptr<RecordedDrop>& against,
         const std::string& tolerance, const std::string& floor, const std::string& growth_tolerance,
         const std::string& band_length, const std::optional<std::vector<double>>& instants) {
        return compare(drop, against, {tolerance, floor, growth_tolerance, band_length}, instants);
      },
      py::arg("drop"), py::arg("against"), py::arg("tolerance"), py::arg("floor"), py::arg("growth_tolerance"),
      py::arg("band_length"), py::arg("instants"));
}

}  // namespace rotordrop::python
