#pragma once
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "machine/machine.h"
#include "machine/machine_parameters.h"

namespace rotordrop {

/// How far the outer rings of touchdown bearings moved in their supports.
class SupportWatch {
 public:
  explicit SupportWatch(const Machine& machine);
  void follow(double t, std::span<const double> step);
  /// `support` of a bearing in summary.json; null if it is no touchdown bearing of the case.
  [[nodiscard]] nlohmann::ordered_json summary(const Machine& machine, const MachineParameters& parameters,
                                               const std::string& bearing, std::span<const double> y) const;
  /// For checkpoints.
  [[nodiscard]] std::size_t packed_size() const { return 3 * scalars_.size(); }
  void pack(std::vector<double>& to) const;
  void unpack(std::span<const double> values);

 private:
  struct Scalars {
    double travel = 0, time = std::numeric_limits<double>::quiet_NaN();  // [m], [s]
    double stored = 0;                                                   // [J]
  };
  struct Columns {
    std::string name;
    std::size_t support = 0, position = 0, energy = 0;
    bool has_energy = false;
  };
  std::vector<Columns> columns_;
  std::vector<Scalars> scalars_;
};

/// A line for the screen, from `support` of a bearing's summary; empty for springs that are within their limit.
[[nodiscard]] std::string support_text(const std::string& name, const nlohmann::ordered_json& support);

}  // namespace rotordrop
