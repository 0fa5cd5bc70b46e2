#include "bearing/support/linear_support.h"

#include <utility>

namespace rotordrop {

LinearSupport::LinearSupport(std::string name, const Matrix& stiffness, const Matrix& damping)
    : name_(std::move(name)), stiffness_(stiffness), damping_(damping) {}

std::vector<Observable> LinearSupport::observables() const {
  return {{"support_force", "N", "force of the linear support on the rotor", 2, {"y", "z"}}};
}

void LinearSupport::evaluate(const SupportInput& input, std::span<const double>, std::span<double>, std::span<double>,
                             SupportOutput& out) const {
  const Motion& journal = input.journal;
  const Matrix &K = stiffness_, &C = damping_;
  const double damper_y = C[0][0] * journal.velocity_y + C[0][1] * journal.velocity_z;
  const double damper_z = C[1][0] * journal.velocity_y + C[1][1] * journal.velocity_z;
  const double k_a = 0.5 * (K[0][1] - K[1][0]);
  out.force_on_rotor = {};
  out.force_on_rotor.y = -K[0][0] * journal.y - K[0][1] * journal.z - damper_y;
  out.force_on_rotor.z = -K[1][0] * journal.y - K[1][1] * journal.z - damper_z;
  out.heat = {};
  out.energy_gradient = {};
  out.other_dissipation = journal.velocity_y * damper_y + journal.velocity_z * damper_z;
  out.prescribed_work = -k_a * (journal.velocity_y * journal.z - journal.velocity_z * journal.y);
  if (!out.observed.empty()) {
    out.observed[0] = out.force_on_rotor.y;
    out.observed[1] = out.force_on_rotor.z;
  }
}

double LinearSupport::energy(const SupportInput& input, std::span<const double>) const {
  const double y = input.journal.y, z = input.journal.z;
  return 0.5 * (stiffness_[0][0] * y * y + (stiffness_[0][1] + stiffness_[1][0]) * y * z + stiffness_[1][1] * z * z);
}

}  // namespace rotordrop
