#pragma once

// The keys of bearings.NAME.support: what carries the outer ring.
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/parameters/section.h"
#include "laws/support/support_law.h"

namespace rotordrop {

struct RibbonGeometryParameters {
  int waves = 0;
  double pitch = 0, height = 0, thickness = 0, strip_width = 0, interference = 0, modulus = 0, poisson_ratio = 0,
         friction_coefficient = 0, stick_length = 0;
};
struct RibbonLoopParameters {
  std::vector<std::array<double, 2>> loading, unloading;
};
/// By numbers, by a measured loop or by geometry: one of the three.
struct RibbonParameters {
  std::optional<double> stiffness, slip_force, stick_stiffness;
  double damping = 0;
  std::optional<RibbonLoopParameters> loop;
  std::optional<RibbonGeometryParameters> geometry;
};

enum class ElastomerModel { maxwell, kelvin_voigt };
struct ElastomerParameters {
  ElastomerModel model = ElastomerModel::maxwell;
  std::vector<std::array<double, 2>> storage, loss;  ///< frequency [Hz], modulus [Pa]
  double shape_factor = 0;
  std::optional<double> frequency;
  double fit_tolerance = 0;
};

struct SqueezeFilmParameters {
  double viscosity = 0, clearance = 0;
  std::optional<double> radius, length;
  bool cavitates = true;
};

struct StopParameters {
  double gap = 0, stiffness = 0, lambda = 0;
};

/// A law, along both axes or along one; film and stop are round and belong to a law along both.
struct SupportLawParameters {
  std::string type;
  std::optional<double> K_y, K_z, C_y, C_z;
  std::optional<RibbonParameters> ribbon;
  std::optional<ElastomerParameters> elastomer;
  std::optional<SqueezeFilmParameters> squeeze_film;
  std::optional<StopParameters> stop;
};
struct SupportParameters : SupportLawParameters {
  double mass = 0;
  std::optional<double> travel_limit;
  std::optional<SupportLawParameters> z;  ///< the law along z, if it is another one
};
Section<SupportParameters> support_section();

/// What a law takes from the bearing around it.
struct SupportSurroundings {
  double outer_radius = 0, width = 0;  ///< of the outer ring [m]
};

/// Whether springs and dampers alone, K_y to C_z, carry the outer ring.
[[nodiscard]] bool is_plain(const SupportParameters& support);
/// Whether a ribbon, an elastomer or an oil film carries the ring, along y at the least: the housing does not hold it against growing then.
[[nodiscard]] bool is_soft(const SupportParameters& support);
/// The law; none for a plain support.
[[nodiscard]] std::shared_ptr<const SupportLaw> support_law(const SupportParameters& support,
                                                            const SupportSurroundings& around);
/// The round stop that acts in any direction: the support's own, or the metal where a squeeze film ends.
[[nodiscard]] std::optional<StopParameters> acting_stop(const SupportParameters& support);
/// What a law is, in a sentence; empty for a plain support.
[[nodiscard]] std::string support_words(const SupportParameters& support, const SupportSurroundings& around);

}  // namespace rotordrop
