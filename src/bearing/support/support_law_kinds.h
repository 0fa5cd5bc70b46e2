#pragma once

// Kinds of law of what carries an outer ring; they register themselves here.
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bearing/support/support_parameters.h"
#include "laws/support/maxwell_fit.h"
#include "laws/support/ribbon.h"
#include "laws/support/support_law.h"

namespace rotordrop {

/// A kind of law: what type = "..." stands for.
struct SupportLawKind {
  std::string type;
  bool has_springs = false;  ///< needs K_y to C_z
  bool is_round = false;     ///< acts in any direction, so not along z by itself
  /// Faults of the parameters; `path` is the table's name for messages.
  std::function<void(const SupportLawParameters&, const Node& table, const std::string& path, Faults&)> check;
  /// The law without film and stop, which support_law() puts around the laws of both axes.
  std::function<std::shared_ptr<const SupportLaw>(const SupportLawParameters&)> make;
  /// That law in a sentence for `check` and the report.
  std::function<std::string(const SupportLawParameters&)> describe;
};
/// Those known, in the order in which messages list them.
const std::vector<SupportLawKind>& support_law_kinds();

/// The kind of this name, or nullptr.
const SupportLawKind* law_kind(const std::string& type);
/// The fault of a key that a kind of law needs.
void add_missing_key(const Node& table, const std::string& path, const std::string& key, const std::string& type,
                     Faults& faults);

/// The axis of a ribbon by whatever of the three is given.
[[nodiscard]] RibbonSupport::Axis ribbon_axis(const RibbonParameters& ribbon);
/// The rows of an elastomer's tables, as stiffnesses.
[[nodiscard]] std::vector<DynamicStiffness> stiffness_table(const ElastomerParameters& elastomer);

}  // namespace rotordrop
