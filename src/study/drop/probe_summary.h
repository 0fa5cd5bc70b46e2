#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/watch/probe_watch.h"

namespace rotordrop {

/// What a summary tells of one probe.
struct ProbeSummary {
  std::string name;
  int node = 0;
  double clearance = 0;  ///< [m]
  ProbeScalars scalars;
  struct Contact {
    double friction_heat = 0, damping = 0;  ///< [J]
  };
  std::optional<Contact> contact;
  [[nodiscard]] bool touches() const { return scalars.smallest_clearance() < 0.; }
};
[[nodiscard]] std::vector<ProbeSummary> probe_summaries(const Machine& machine, const ProbeWatch& watch,
                                                        std::span<const double> y);
/// `probes` of summary.json.
[[nodiscard]] nlohmann::ordered_json probes_json(const std::vector<ProbeSummary>& probes);
/// Lines for the screen.
[[nodiscard]] std::string probe_text(const std::vector<ProbeSummary>& probes);

}  // namespace rotordrop
