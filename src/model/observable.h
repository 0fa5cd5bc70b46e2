#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "model/ports.h"

namespace rotordrop {

/// What a reported number is, for whoever looks for it: names are for people and files.
enum class Observed {
  other,
  // Of a bearing that catches the rotor, as TouchdownBearing reports them:
  orbit,
  penetration,
  clearance,
  contact_force,
  slip_speed,
  spin_lag,
  ball_force,
  contact_pressure,
  ring_speed,
  load_torque,
  spin_torque,
  rub_heat_rate,
  inner_heat_rate,
  outer_heat_rate,
  growth,
  preload,
  centrifugal_force,
  ellipse_truncation,
  skid_demand,
  gyroscopic_demand,
  axial_position,
  axial_force,
  shoulder_force,
  // Of a thermal model, absolute:
  temperature,
  inner_ring_temperature,  ///< mean of an inner ring
  housing_fit_open,        ///< part of the outer ring's fit in its housing that is open, or would have to pull
  // Of the machine:
  energy_moved,     ///< mechanical energy dissipated, or work done on the machine
  energy_residual,  ///< mechanical energy not accounted for
  heat_deposited,
  heat_residual  ///< of one thermal model, its place
};

/// A quantity that a part can report: becomes a dataset of the results.
struct Observable {
  std::string name;                       ///< dataset name, e.g. "contact_force"
  std::string unit;                       ///< UDUNITS text of the SI unit
  std::string long_name;                  ///< what it is, in a sentence
  std::size_t size = 1;                   ///< numbers per instant
  std::vector<std::string> columns = {};  ///< names of the columns if size > 1
  Observed kind = Observed::other;
  std::string place = {};  ///< bearing that it belongs to; a support's own is filled in by the machine
};

/// Where the numbers of one begin in a row of the list; nothing if none has that name.
[[nodiscard]] inline std::optional<std::size_t> column_of(const std::vector<Observable>& list,
                                                          const std::string& name) {
  std::size_t at = 0;
  for (const auto& o : list) {
    if (o.name == name) return at;
    at += o.size;
  }
  return {};
}

/// Where the numbers of an observable stand in a row.
struct ObservedColumns {
  std::size_t first = 0, size = 0;
  std::string place;
};

/// All of a list that are one quantity, in a row that holds the list's numbers from `first` on.
[[nodiscard]] inline std::vector<ObservedColumns> columns_of(const std::vector<Observable>& list, Observed kind,
                                                             std::size_t first = 0) {
  std::vector<ObservedColumns> found;
  for (const auto& o : list) {
    if (o.kind == kind) found.push_back({first, o.size, o.place});
    first += o.size;
  }
  return found;
}

/// A quantity of one place. @returns nothing if the list has none
[[nodiscard]] inline std::optional<ObservedColumns> columns_of(const std::vector<Observable>& list, Observed kind,
                                                               const std::string& place) {
  for (auto& columns : columns_of(list, kind))
    if (columns.place == place) return columns;
  return {};
}

/// Growth of the surfaces of a bearing.
[[nodiscard]] inline Observable growth_observable(const std::string& name, const std::string& long_name) {
  return {name,
          "m",
          long_name,
          growth_surfaces.size(),
          {growth_surface_names.begin(), growth_surface_names.end()},
          Observed::growth};
}

/// How many numbers a list of observables writes.
[[nodiscard]] inline std::size_t observed_size(const std::vector<Observable>& list) {
  std::size_t size = 0;
  for (const auto& o : list) size += o.size;
  return size;
}

}  // namespace rotordrop
