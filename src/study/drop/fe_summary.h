#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "machine/heat/finite_elements.h"
#include "study/recorded_drop.h"

namespace rotordrop {

/// Hoop stresses, fit and raceways of a section with elastic growth at one instant.
struct ElasticState {
  double ring_speed = 0;                                                ///< [rad/s]
  SurfaceRange inner_ring_bore, outer_ring_outside, housing_bore;       ///< hoop stress [Pa]
  std::vector<AxialRadial> inner_raceway_growth, outer_raceway_growth;  ///< of every strip, since cold and standing [m]
  FitState fit;                                                         ///< outer ring in housing
};
/// Solves twice.
/// @param temperatures  the section's field [K]
/// @param speed         of the inner ring [rad/s]
ElasticState elastic_state(const FiniteElements::Section& section, std::span<const double> temperatures, double speed);
/// SI; docs/reference/results.md has the keys.
nlohmann::ordered_json elastic_state_json(const ElasticState& state);

using NamedValues = std::vector<std::pair<std::string, double>>;

/// Scalars of a bearing's finite-element model.
struct FeSummary {
  FeCoupling coupling = FeCoupling::reduced;
  std::size_t unknowns = 0, cells = 0;
  /// How well the modes of a reduced section answer heat.
  struct Reduction {
    std::size_t modes = 0;
    NamedValues port_errors, mean_errors;  ///< relative, of ports and of means
    double largest_error = 0;
    std::string worst;  ///< port and mean with that
  };
  std::optional<Reduction> reduction;
  double inner_capacity = 0, outer_capacity = 0;  ///< of inner ring; of outer ring and housing [J/K]
  NamedValues rises;                              ///< of means and nodes over ambient, at the end [K]
  /// Mean around a surface, and its hottest place.
  struct Surface {
    std::string name;
    bool has_rows = false;                               ///< or else nothing below is known
    double mean_end = 0, highest_mean = 0, highest = 0;  ///< rises over ambient [K]
    double highest_time = 0;                             ///< [s]
  };
  std::vector<Surface> surfaces;
  /// Of the outer ring's fit in its housing, where it was recorded.
  struct HousingFit {
    std::optional<double> largest_open;                        ///< part of its area that pulled or was open
    std::optional<double> mean_pressure_end, lowest_pressure;  ///< [Pa]; the latter of all nodes and times
  };
  std::optional<HousingFit> housing_fit;
  std::optional<ElasticState> elastic_end;  ///< of elastic growth

  [[nodiscard]] const Surface* surface(const std::string& surface_name) const;  ///< null if there is none
};
/// @param kind  the thermal model that the section belongs to
FeSummary fe_summary(const FiniteElements::Section& section, const ThermalKind& kind, FeCoupling coupling,
                     const RecordedDrop& drop);
nlohmann::ordered_json fe_json(const FeSummary& fe);

/// How the windows of a windowed coupling turned out.
nlohmann::ordered_json windows_json(const WindowedSections::Report& report, const HeatEnergy& energy);

}  // namespace rotordrop
