#pragma once
#include "case/case.h"

namespace rotordrop {

/// Looks for what single values cannot show: dimensions that do not fit each other, a rotor that cannot be, a surface that is too fast.
/// All of it can be computed, and most often is a slip: warnings, each with its reason.
/// @param section  the declaration by which the tree was read
[[nodiscard]] std::vector<Fault> look_for_slips(const SectionDeclaration& section, const CaseParameters& parameters,
                                                const Node& tree);

/// A speed that an option gives: a warning if the rotor's surface would be faster than surfaces are. @param speed  [rad/s]
[[nodiscard]] std::vector<Fault> look_at_speed(const CaseParameters& parameters, const std::string& option,
                                               double speed);

/// A support's stiffness that an option gives: a warning if it is larger than stiffnesses are. @param stiffness  [N/m]
[[nodiscard]] std::vector<Fault> look_at_stiffness(const std::string& option, double stiffness);

/// For `rotordrop preload`: warnings of keys that have no part in it, and, since it follows heat to the housings whatever the case's end is, of outer
/// rings in elastomers, ribbons or films whose resistance is that of a metal fit, unless look_for_slips() gives them.
[[nodiscard]] std::vector<Fault> look_at_preload(const CaseParameters& parameters, const Node& tree);

/// Faults of a rotor whose modes take more memory than there is, or days, and of too many supports.
void check_size(const CaseParameters& parameters, const Node& tree, Faults& faults);

/// Faults of a run that would not end in days.
void check_length(const CaseParameters& parameters, const Node& tree, Faults& faults);

/// Faults of what the case asks to be written.
void check_output(const CaseParameters& parameters, const Node& tree, Faults& faults);

}  // namespace rotordrop
