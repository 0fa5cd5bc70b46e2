#include "study/modes/modes_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/quantity_list.h"
#include "base/rotation.h"
#include "io/checkpoint.h"
#include "io/hdf5/recorded_series.h"
#include "io/hdf5/recorder.h"

namespace rotordrop {
namespace {

std::size_t shown(const WhirlModes& modes, std::size_t n_modes) { return std::min(n_modes, modes.modes.size()); }

}  // namespace

std::vector<double> parse_speeds(const std::string& text) {
  const auto speeds = quantities_in(text, "--speeds", "rad/s", QuantityKind::angular_speed, "a speed");
  constexpr std::size_t most_speeds = 1000;  // of modes with all nodes: some minutes
  if (speeds.size() > most_speeds)
    throw InputError({"--speeds", 0, 0},
                     fmt::format("these are {} speeds; at most {} are taken.", speeds.size(), most_speeds),
                     "For a Campbell diagram use `rotordrop critical-speeds --up-to SPEED --diagram FILE`.");
  return speeds;
}

std::string supports_with_stiffness(const CaseParameters& parameters) {
  const auto& all = parameters.bearings;
  const bool has_linear = std::any_of(all.begin(), all.end(), [](const auto& one) { return one.linear(); });
  const bool has_magnets = std::any_of(all.begin(), all.end(), [](const auto& one) { return one.magnet(); });
  if (!has_magnets) return has_linear ? "linear supports" : "";
  return has_linear ? "linear supports and magnets" : "magnets";
}

std::string diverging_text(int n_diverging, double rate) {
  return fmt::format(
      "{} diverge{} without oscillation, growing by up to {:.4g} 1/s: the supports do not hold the rotor.\n",
      n_diverging == 1 ? "1 motion" : fmt::format("{} motions", n_diverging), n_diverging == 1 ? "s" : "", rate);
}

ModesReport find_modes(const Case& rotor_case, const std::vector<double>& speeds) {
  ModesReport report;
  report.speeds = speeds;
  report.modes = machine_modes(rotor_case.parameters, speeds);
  report.held_by = supports_with_stiffness(rotor_case.parameters);
  report.is_free_free = report.held_by.empty();
  report.left_out = supports_without_stiffness(rotor_case.parameters);
  report.node_positions = rotor_case.parameters.rotor.geometry.node_x;
  return report;
}

nlohmann::ordered_json to_json(const ModesReport& report, std::size_t n_modes) {
  nlohmann::ordered_json j;
  j["supports"] = report.is_free_free ? "free-free" : "linear";
  if (!report.left_out.empty()) j["left_out"] = report.left_out;
  j["speeds"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < report.speeds.size(); ++i) {
    nlohmann::ordered_json speed;
    speed["speed"] = report.speeds[i];
    speed["rigid_body_modes"] = report.modes[i].n_rigid_body_modes;
    speed["overdamped_modes"] = report.modes[i].n_overdamped;
    speed["diverging_modes"] = report.modes[i].n_diverging;
    speed["divergence_rate"] = report.modes[i].divergence_rate;
    speed["modes"] = nlohmann::ordered_json::array();
    for (std::size_t k = 0; k < shown(report.modes[i], n_modes); ++k) {
      const auto& mode = report.modes[i].modes[k];
      speed["modes"].push_back({{"frequency", mode.frequency},
                                {"natural_frequency", mode.natural_frequency},
                                {"damping_ratio", mode.damping_ratio},
                                {"whirl", std::string(to_string(mode.whirl))}});
    }
    j["speeds"].push_back(std::move(speed));
  }
  return j;
}

std::string to_table(const ModesReport& report, std::size_t n_modes) {
  std::string text = report.is_free_free ? "Natural modes, free-free (the case has no linear supports or magnets)\n"
                                         : fmt::format("Natural modes on the case's {}\n", report.held_by);
  text += left_out_text(report.left_out);
  for (std::size_t i = 0; i < report.speeds.size(); ++i) {
    text += fmt::format("\n{:.6g} rpm", report.speeds[i] * to_rpm);
    if (report.modes[i].n_rigid_body_modes > 0)
      text += fmt::format("   ({} rigid-body motions at 0 Hz left out)", report.modes[i].n_rigid_body_modes);
    text += fmt::format("\n  {:>4}  {:>12}  {:>10}  {}\n", "mode", "frequency", "damping", "whirl");
    for (std::size_t k = 0; k < shown(report.modes[i], n_modes); ++k) {
      const auto& mode = report.modes[i].modes[k];
      text += fmt::format("  {:>4}  {:>9.3f} Hz  {:>8.4f} %  {}\n", k + 1, mode.frequency, 100. * mode.damping_ratio,
                          to_string(mode.whirl));
    }
    if (report.modes[i].n_diverging > 0)
      text += "  " + diverging_text(report.modes[i].n_diverging, report.modes[i].divergence_rate);
  }
  return text;
}

void write_mode_shapes(const ModesReport& report, std::size_t n_modes, const std::filesystem::path& file) {
  // One series per speed; its rows are the modes, its axis their frequencies.
  std::vector<SeriesGroup> groups;
  const std::size_t n = report.node_positions.size();
  std::string speeds;
  for (std::size_t i = 0; i < report.speeds.size(); ++i) {
    const std::string at = fmt::format("/speed_{}/", i);
    speeds += fmt::format("{}speed_{}: {:.17g} rad/s", i ? "; " : "", i, report.speeds[i]);
    groups.push_back({at + "axis",
                      {{at + "frequency", "Hz", "damped natural frequency", 1, {}},
                       {at + "damping_ratio", "1", "damping ratio", 1, {}},
                       {at + "spin_speed", "rad/s", "spin speed of the rotor", 1, {}},
                       {at + "whirl", "1", "1 forward, -1 backward, 0 planar or mixed", 1, {}},
                       {at + "node_position", "m", "axial position of the nodes", n, {}},
                       {at + "shape_y_real", "1", "deflection along y, in phase", n, {}},
                       {at + "shape_y_imaginary", "1", "deflection along y, a quarter turn ahead", n, {}},
                       {at + "shape_z_real", "1", "deflection along z, in phase", n, {}},
                       {at + "shape_z_imaginary", "1", "deflection along z, a quarter turn ahead", n, {}}},
                      "1",
                      "number of the mode"});
  }
  // Earlier shapes may be replaced; what is something else by that name is not.
  std::error_code ignored;
  bool is_ours = !std::filesystem::exists(std::filesystem::symlink_status(file, ignored));
  try {
    is_ours = is_ours || read_attribute(file, "/", "content") == "mode shapes";
  } catch (const InputError&) {
  }
  if (!is_ours)
    throw InputError({file.string(), 0, 0}, "the file already exists, and it does not hold mode shapes.",
                     "Choose another with --shapes FILE.");
  require_writable(file);
  RecorderOptions options;
  options.overwrite = true;
  options.rows_per_chunk = 16;  // a few modes, not thousands of instants
  Recorder recorder(file, {{{"content", "mode shapes"}, {"speeds", speeds}}, {}}, groups, options);
  for (std::size_t i = 0; i < report.speeds.size(); ++i)
    for (std::size_t k = 0; k < shown(report.modes[i], n_modes); ++k) {
      const auto& mode = report.modes[i].modes[k];
      std::vector<double> row = {mode.frequency, mode.damping_ratio, report.speeds[i],
                                 mode.whirl == Whirl::forward    ? 1.
                                 : mode.whirl == Whirl::backward ? -1.
                                                                 : 0.};
      row.insert(row.end(), report.node_positions.begin(), report.node_positions.end());
      for (const auto* shape : {&mode.v, &mode.w})
        for (const bool real : {true, false})
          for (const auto& value : *shape) row.push_back(real ? value.real() : value.imag());
      recorder.append(i, static_cast<double>(k + 1), row);
    }
  recorder.close();
}

}  // namespace rotordrop
