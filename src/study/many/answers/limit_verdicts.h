#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "case/limits.h"
#include "study/many/study_table.h"

namespace rotordrop {

/// What the drops of a study say of its limits.
class LimitVerdicts {
 public:
  explicit LimitVerdicts(const StudyTable& table);

  /// Whether the drop of a point breaks a limit; nothing where that cannot be told: the drop is not done, touched nothing, has no such result, or its
  /// pressures are void. @param limit  resolved
  [[nodiscard]] std::optional<bool> breaks(const Limit& limit, std::size_t point) const;

  /// Drops that ended before the rotor touched anything.
  [[nodiscard]] std::size_t n_without_contact() const;

 private:
  const StudyTable& table_;
  std::vector<std::vector<std::pair<std::string, double>>> told_;  ///< numbers of contact and truncation, by point
};

}  // namespace rotordrop
