#pragma once
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "analysis/watch/bearing_scalars.h"
#include "analysis/watch/probe_watch.h"
#include "analysis/watch/support_watch.h"
#include "machine/machine.h"
#include "model/observer.h"

namespace rotordrop {

/// Rows that carry a load in less than this part of the time cannot be kept rolling, and need not: they are no reason to warn.
inline constexpr double relevant_loaded_share = 0.1;

/// What a warning of skidding is about.
struct SkidVerdict {
  FollowedDemand demand;           ///< of the rows that carry loads together; of the worst one if others carry none
  std::optional<std::size_t> row;  ///< the one with most of it, from 0; none if no row carries a load
};
[[nodiscard]] SkidVerdict skid_verdict(const BearingScalars& bearing, std::size_t n_rows);

/// Follows every touchdown bearing of a machine through its step observables.
class DropScalars final : public Observer {
 public:
  explicit DropScalars(const Machine& machine);
  void step(const Step& step) override;
  /// @param step values of machine.step_observables() at t, at every observed step
  void follow(double t, std::span<const double> step);
  void pack(PackedValues& to) const override;
  void unpack(const PackedValues& from) override;
  [[nodiscard]] std::size_t size() const { return scalars_.size(); }
  [[nodiscard]] const BearingScalars& of(std::size_t bearing) const { return scalars_[bearing]; }
  /// Index of a bearing among the machine's supports.
  [[nodiscard]] std::size_t support(std::size_t bearing) const { return columns_[bearing].support; }
  /// Of any bearing, in the bore or on a shoulder [N].
  [[nodiscard]] double largest_contact_force() const;
  /// Whether a bearing's inner ring takes axial loads from the rotor.
  [[nodiscard]] bool is_free(std::size_t bearing) const { return columns_[bearing].axial_force.has_value(); }
  [[nodiscard]] std::size_t n_rows(std::size_t bearing) const { return columns_[bearing].n_rows; }
  [[nodiscard]] const std::string& name(std::size_t bearing) const { return names_[bearing]; }
  [[nodiscard]] const ProbeWatch& probes() const { return probes_; }
  [[nodiscard]] const SupportWatch& supports() const { return supports_; }

  /// Has somebody else follow the bearings from the next step on, and hands them over (ScalarsInLanes).
  [[nodiscard]] std::span<const BearingScalars> let_go() {
    are_followed_elsewhere_ = true;
    return scalars_;
  }
  /// Takes them back.
  void take_back(std::vector<BearingScalars> bearings) {
    are_followed_elsewhere_ = false;
    scalars_ = std::move(bearings);
  }
  [[nodiscard]] const std::vector<BearingColumns>& columns() const { return columns_; }

 private:
  std::vector<std::string> names_;
  std::vector<BearingColumns> columns_;
  std::vector<BearingScalars> scalars_;
  bool are_followed_elsewhere_ = false;
  ProbeWatch probes_;
  SupportWatch supports_;
};

}  // namespace rotordrop
