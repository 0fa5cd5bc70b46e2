#pragma once
#include <string>

#include "laws/contact.h"
#include "model/probe.h"
#include "model/support.h"

namespace rotordrop {

/// The rotor touching a stationary part: the contact of a probe. The part is rigid and round, and does not turn.
///
/// With e the rotor's centre from the part's axis, n = e/|e| and t = x cross n: penetration delta = |e| - clearance, normal force
/// N = K delta (1 + 1.5 lambda delta'), never negative, on the rotor along -n; friction mu N along -t against the slip omega r + e' . t.
/// Books: the elastic energy, the loss of damping and of friction. No state. Heat warms nothing. Valid: small clearance beside the radius.
class ProbeContact final : public Support {
 public:
  /// @param radius  of the rotor's surface [m]
  ProbeContact(Probe probe, const HuntCrossley& contact, CoulombFriction friction, double radius);

  /// Offsets in its own ledgers.
  enum Ledger : std::size_t { contact_impulse, contact_damping, contact_friction, n_ledger };

  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] std::string results_path() const override { return "/" + name_; }
  [[nodiscard]] std::vector<StateEntry> state_entries() const override { return {}; }
  [[nodiscard]] std::vector<StateEntry> ledger_entries() const override;
  [[nodiscard]] std::vector<Observable> observables() const override;
  void initial_state(std::span<double>) const override {}
  void evaluate(const SupportInput& input, std::span<const double> y, std::span<double> dydt,
                std::span<double> ledger_rates, SupportOutput& out) const override;
  [[nodiscard]] double energy(const SupportInput& input, std::span<const double> y) const override;

 private:
  std::string name_;
  Probe probe_;
  HuntCrossley contact_;
  CoulombFriction friction_;
  double radius_;
};

}  // namespace rotordrop
