#pragma once
// What the parts of a case are looked at for: dimensions that do not fit each other, machines that cannot be.
#include <string>
#include <string_view>
#include <vector>

#include "case/case.h"

namespace rotordrop {

// Of the case's parameters, and of its tree for positions: each adds its warnings.
void look_at_rotor(const CaseParameters& p, const Node& tree, std::vector<Fault>& warnings);
void look_at_motion(const CaseParameters& p, const Node& tree, std::vector<Fault>& warnings);
void look_at_bearings(const CaseParameters& p, const Node& tree, std::vector<Fault>& warnings);
void look_at_fits(const CaseParameters& p, const Node& tree, std::vector<Fault>& warnings);
void look_at_supports(const CaseParameters& p, const Node& tree, std::vector<Fault>& warnings);
void look_at_magnets(const CaseParameters& p, const RigidBody& body, const Node& tree, std::vector<Fault>& warnings);

/// Bounds on the side where a result is good: a max of a static safety, a min of a force. Of a case or a study.
void look_at_limits(const std::vector<Limit>& limits, std::vector<Fault>& warnings);

/// Above it rings of steel burst: rho v^2 is 1.25 GPa at 400 m/s.
inline constexpr double fastest_surface = 400.;      // [m/s]
inline constexpr double standard_gravity = 9.80665;  // [m/s2]

/// Largest outside diameter of the shaft's elements [m]; 0 if it has none.
double largest_diameter(const RotorGeometry& geometry);

/// The end of the drop, or of `rotordrop heat` on the same case [s].
double latest_end_of_all(const CaseParameters& p);

/// Adds it unless it is there.
void warn(std::vector<Fault>& warnings, const SourcePosition& where, std::string message, std::string advice);
inline double mm(double metres) { return metres * 1e3; }
/// The table a, or a.b; what is around it if there is none.
const Node& table_at(const Node& tree, std::string_view a, std::string_view b = "");

}  // namespace rotordrop
