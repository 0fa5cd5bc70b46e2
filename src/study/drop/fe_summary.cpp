#include "study/drop/fe_summary.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

/// Mean, lowest and highest temperature of a surface over time: its largest local rise, and the end.
Json surface_scalars(const std::vector<double>& v, const std::vector<double>& times, double zero) {
  const std::size_t n = std::min(v.size() / 3, times.size());
  if (n == 0) return nullptr;
  std::size_t hottest = 0;
  double highest_mean = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < n; ++i) {
    if (v[3 * i + 2] > v[3 * hottest + 2]) hottest = i;
    highest_mean = std::max(highest_mean, v[3 * i]);
  }
  return {{"mean_end", v[3 * (n - 1)] - zero},
          {"highest_mean", highest_mean - zero},
          {"highest", v[3 * hottest + 2] - zero},
          {"highest_time", times[hottest]}};
}

/// Pressure of the outer ring's fit [Pa], mean at the end and lowest of all nodes and times; the largest part of its area that pulled or was open.
void add_fit_scalars(const std::string& name, const std::vector<double>& v, Json& to) {
  if (name == "housing_fit_open") {
    to["largest_open"] = *std::max_element(v.begin(), v.end());
    return;
  }
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < v.size(); i += 2) lowest = std::min(lowest, v[i]);
  to["mean_pressure_end"] = v[v.size() - 2];
  to["lowest_pressure"] = lowest;
}

}  // namespace

Json fe_summary(const FiniteElements::Section& s, FeCoupling coupling, const RecordedDrop& drop) {
  const std::string prefix = (coupling == FeCoupling::windowed ? "/windows/" : "/fe/") + s.name + "/";
  const double zero = s.problem.initial_temperature;
  Json j;
  j["coupling"] = coupling == FeCoupling::reduced    ? "reduced"
                  : coupling == FeCoupling::windowed ? "windowed"
                                                     : "monolithic";
  j["unknowns"] = s.solver->statistics().unknowns;
  j["cells"] = s.solver->statistics().cells;
  if (coupling != FeCoupling::windowed) {
    j["modes"] = s.reduced.n_modes();
    for (const auto& port : s.reduced.ports) j["response_error"][port.name] = port.response_error;
    for (const auto* outputs : {&s.reduced.bodies, &s.reduced.nodes})
      for (const auto& output : *outputs) j["mean_response_error"][output.name] = output.response_error;
    j["largest_response_error"] = s.reduced.response_error;
    j["worst_response"] = s.reduced.worst_response;
  }
  j["heat_capacity"] = {{"inner_ring", s.adiabatic.inner_capacity},
                        {"outer_ring_and_housing", s.adiabatic.outer_capacity}};
  j["temperature_rise_end"] = Json::object();
  j["surface_rise"] = Json::object();
  for (const auto& path : drop.datasets()) {
    if (!path.starts_with(prefix)) continue;
    const std::string name = path.substr(prefix.size());
    const auto& series = drop.table(path);
    if (series.values.empty() || name.ends_with("growth")) continue;
    if (name.starts_with("housing_fit")) {
      add_fit_scalars(name, series.values, j["housing_fit"]);
      continue;
    }
    if (series.n_columns == 1)
      j["temperature_rise_end"][name] = series.values.back() - zero;
    else
      j["surface_rise"][name] = surface_scalars(series.values, drop.table(series.time_path).values, zero);
  }
  return j;
}

Json windows_summary(const WindowedSections::Report& r, const HeatEnergy& energy) {
  return {{"count", r.windows},
          {"shortest", r.shortest},
          {"longest", r.longest},
          {"mean", r.mean},
          {"tolerance", r.tolerance},
          {"beyond_tolerance", r.beyond_tolerance},
          {"largest_growth_error", r.largest_error},
          {"largest_growth_error_time", r.largest_error_time},
          {"largest_growth", r.largest_growth},
          {"cpu_time", r.cpu_time},
          {"heat_input", energy.input},
          {"heat_stored", energy.stored},
          {"heat_lost", energy.lost},
          {"heat_residual", energy.residual()}};
}

}  // namespace rotordrop
