#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "case/limits.h"
#include "study/limit_verdict.h"
#include "study/many/study_table.h"

namespace rotordrop {

/// Whether a drop breaks a limit; nothing where that cannot be told, for a reason.
struct LimitBreak {
  std::optional<bool> is_broken;
  std::string why;  ///< it is not known; empty if it is
};

/// What the drops of a study say of its limits.
class LimitVerdicts {
 public:
  /// @param limits  resolved
  LimitVerdicts(const StudyTable& table, const std::vector<Limit>& limits);

  /// Whether the drop of a point breaks a limit, one of those above.
  [[nodiscard]] LimitBreak breaks(const Limit& limit, std::size_t point) const;

  /// Drops that ended before the rotor touched anything.
  [[nodiscard]] std::size_t n_without_contact() const;

 private:
  const StudyTable& table_;
  std::vector<SummaryNumbers> told_;  ///< what verdicts need, by point
};

}  // namespace rotordrop
