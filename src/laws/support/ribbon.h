#pragma once
// Corrugated ribbons between an outer ring and its housing: springs and sliders from a measured loop, or from their geometry.
#include <array>
#include <string>
#include <vector>

#include "laws/support/support_laws.h"

namespace rotordrop {

/// A closed loop of force over displacement, as measured between two turns: both branches over the same range of displacement.
struct MeasuredLoop {
  std::vector<std::array<double, 2>> loading;    ///< displacement [m] rising, force [N]
  std::vector<std::array<double, 2>> unloading;  ///< the way back, listed with rising displacement too
};
/// Why a loop is none; empty if it is one.
[[nodiscard]] std::string fault_of(const MeasuredLoop& loop);
/// Work that the loop takes in one turn [J].
[[nodiscard]] double loop_area(const MeasuredLoop& loop);

/// Sliders and spring with the loop's shape, by Masing's rule: from a turn on, a branch follows the same curve whichever way it goes,
///
///   branch(d) = [F_load(x_1 + d) - F_load(x_1) + F_back(x_2) - F_back(x_2 - d)] / 2,   straight pieces of slopes s_1 >= s_2 >= ... >= s_n
///   slider j:  k_j = s_j - s_(j+1),  slips after the travel d_j from the turn: z_j = d_j / 2;   spring s_n
///
/// Rising slopes are levelled to their mean (pool adjacent violators). Reach and stiffness of each slider are corrected so that its soft onset
/// loses in this loop what the sharp slider would: the model's loop has the area of the levelled one.
/// Source: Masing (1926); Iwan (1966).
[[nodiscard]] RibbonSupport::Axis ribbon_from_loop(const MeasuredLoop& loop);

/// Loss of an axis in one closed turn between -x and x, after its first turns [J].
[[nodiscard]] double steady_loop_loss(const RibbonSupport::Axis& axis, double amplitude);

/// Ring of corrugations, each a shallow arch whose feet slide on the housing and whose crest slides on the ring.
struct RibbonGeometry {
  int n_waves = 0;
  double pitch = 0, height = 0, thickness = 0,
         width = 0;         ///< of a wave along the circumference, of the crest, of the strip, along the axis [m]
  double interference = 0;  ///< radial, that presses each wave [m]
  double modulus = 0, poisson_ratio = 0;  ///< of the strip [Pa], [-]
  double friction_coefficient = 0;
  double stick_length = 0;  ///< shortest travel over which friction builds up [m]
};
/// Radial stiffness of one wave whose feet slide freely [N/m].
///
///   k = E t^3 b / (2 l^3 (1 - nu^2)),   l = pitch / 2
///
/// Source: Heshmat, Walowit & Pinkus (1983), J. Lubr. Technol. 105, 647: bump foil of a gas bearing, compliance 2 s l^3 (1 - nu^2) / (E t^3) per area.
/// Valid: shallow waves, h << pitch.
[[nodiscard]] double wave_stiffness(const RibbonGeometry& geometry);
/// Along any direction across the axis, of waves evenly around the circumference that all stay pressed (travel below the interference):
///
///   spring        n k / 2
///   feet slide    a wave that flattens by d lengthens by 2 kappa d, kappa = pi^2 h / (4 pitch): friction mu N_0 kappa along its radius,
///                 behind the strip's own stiffness 4 kappa^2 E t b / pitch
///   crests slide  friction mu N_0 along the circumference, behind 4 E t b / pitch;   N_0 = k times the interference
///
/// Sums over the circumference: sum |cos| = sum |sin| = 2 n / pi. Friction that builds up within stick_length or less gets that length.
/// Valid: an estimate; friction follows the mounted load N_0, and neighbouring waves do not push each other.
[[nodiscard]] RibbonSupport::Axis ribbon_from_geometry(const RibbonGeometry& geometry);

}  // namespace rotordrop
