#pragma once
#include <array>
#include <string>
#include <vector>

#include "model/section_plan.h"
#include "thermal/section/shaft_steps.h"

namespace rotordrop {

/// The section of a touchdown bearing in its housing. All rows sit in one inner and one outer ring: bearings side by side are joined, which
/// for a symmetric pair changes nothing, since no heat crosses the plane between mirror images. x counts from the middle of the bearing.
///
/// Groove arcs (docs/theory/model.md, section 3) about their centres, with n = (direction sin phi, cos phi) from inner to outer contact:
///   inner   (x, d_m/2) + (r_in - d/2) n,   radius r_in  = f_in d
///   outer   (x, d_m/2) - (r_out - d/2) n,  radius r_out = f_out d
/// Radial clearance, some 20 um, is left out: the grooves stand as if balls touched both.
struct BearingSectionData {
  struct Row {
    double x = 0;          ///< of the ball centres [m]
    double direction = 1;  ///< side to which the outer contact leans: +1 or -1
  };
  std::vector<Row> rows;                           ///< with rising x
  double ball_diameter = 0, pitch_diameter = 0;    ///< d, d_m [m]
  std::array<double, 2> conformity{0.52, 0.52};    ///< f_in, f_out
  double contact_angle = 0;                        ///< phi [rad]
  double width = 0;                                ///< of both rings, all rows [m]
  double inner_bore = 0, inner_shoulder = 0;       ///< diameters [m]
  double outer_shoulder = 0, outer_outside = 0;    ///< diameters [m]
  double housing_outside = 0, housing_length = 0;  ///< diameter, length [m]; its bore is the outer ring's outside
  double strip_half_width = 0;                     ///< a: half the arc length that the contact ellipses sweep [m]
  /// Part of the groove's depth that the shoulder away from the load keeps, with a contact angle; 1: it is not relieved.
  /// Spindle bearings have the outer ring's open on one side, so that balls and cage go in; 0.4 is an estimate from drawings.
  double inner_relief = 1, outer_relief = 0.4;
  double shaft_radius = 0, shaft_length = 0;  ///< [m]; 0: the shaft is not meshed
  double shaft_bore_radius = 0;               ///< of a hollow shaft [m]
  std::vector<ShaftStep> shaft_steps;         ///< shaft beside the bearing, from it outwards; of a meshed shaft
};

struct SectionSizes {
  double surface_cell = 25e-6;  ///< thickness of cells on bore and strips [m]
  double largest_cell = 2e-3;   ///< [m]
  double refinement = 1;        ///< all sizes are divided by this
  double growth = 1.6;          ///< largest ratio of neighbouring cells within a block, at refinement 1
};

/// What is wrong with the dimensions; `key` is the parameter of the bearing that it is best blamed on. Where shoulder diameters are not given
/// apart, that of a ring stands in its ring diameters.
struct SectionFault {
  std::string key, message, advice;
};
std::vector<SectionFault> faults_of_section(const BearingSectionData& data);

/// Bodies inner_ring, outer_ring, housing, and shaft if it has a radius, with its steps. @throws std::invalid_argument with the first of the faults
SectionPlan plan_bearing_section(const BearingSectionData& data, const SectionSizes& sizes);

}  // namespace rotordrop
