#pragma once

#include "base/node.h"
#include "base/parameters/range.h"
#include "base/units.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

/// What a declaration can say: the options of the member functions of Section. A missing `fallback` makes a key required,
/// unless the member is a std::optional (then the key may be absent). Fallbacks are written as a user would write them:
/// "250 um", "0.1".
namespace rotordrop {

struct Quantity {
  std::string unit = "1";
  std::optional<QuantityKind> kind = {};  ///< default: kind_of(unit); needed for a temperature difference only
  Range range = {};
  Range usual = {};  ///< in the field; a value outside is allowed, but most often a slip
  std::optional<std::string> fallback = {};
  std::string source = {};
  std::string help = {};
};
struct QuantityList {
  std::string unit = "1";
  std::optional<QuantityKind> kind = {};
  Range range = {};                        ///< of every entry
  Range usual = {};                        ///< likewise
  std::vector<std::string> fallback = {};  ///< {"0.52", "0.52"}
  std::size_t min_count = 0;  ///< of a std::vector; if 0, an absent key without fallback means an empty list
  std::string source = {};
  std::string help = {};
};
struct QuantityMatrix {
  std::string unit = "1";
  std::optional<QuantityKind> kind = {};
  Range range = {};                                     ///< of every entry
  Range usual = {};                                     ///< likewise
  std::vector<std::vector<std::string>> fallback = {};  ///< {{"1", "0"}, {"0", "1"}}
  std::string source = {};
  std::string help = {};
};
/// Pairs [argument, value] with rising arguments; a single value stands for a constant and is read as one pair at
/// argument 0.
struct QuantityFunction {
  std::string unit = "1";
  std::optional<QuantityKind> kind = {};
  std::string argument_unit = "s";
  Range range = {};                                       ///< of every value
  Range usual = {};                                       ///< likewise
  Range usual_argument = {};                              ///< of every argument that is not 0
  std::vector<std::array<std::string, 2>> fallback = {};  ///< {{"0 s", "0 N m"}, {"1 s", "2 N m"}}
  std::string source = {};
  std::string help = {};
};
struct Integer {
  Range range = {};
  std::optional<int> fallback = {};
  std::string source = {};
  std::string help = {};
};
struct Boolean {
  std::optional<bool> fallback = {};
  std::string source = {};
  std::string help = {};
};
struct Text {
  std::optional<std::string> fallback = {};
  std::string source = {};
  std::string help = {};
};
/// Of lists and maps of sub-tables. They are empty when absent, unless `min_count` or `fallback` says otherwise.
struct Nested {
  std::size_t min_count = 0;
  std::optional<Node> fallback = {};  ///< an array of tables, or a table of tables
  std::string source = {};
  std::string help = {};
};
struct Variants {
  std::optional<std::string> fallback = {};  ///< the variant of a table that does not set the key which selects it
  std::size_t min_count = 0;
  std::string source = {};
  std::string help = {};
};
/// Of a key with a reader of its own.
struct Custom {
  std::string unit = "";                     ///< for the documentation
  std::string accepts = "";                  ///< for the documentation: "a number, or [x, y, z]"
  std::vector<std::string> json_types = {};  ///< "number", "string", "array", "object", "boolean"; empty: any
  std::optional<Node> fallback = {};
  bool required = false;  ///< without a fallback: whether it is a fault to leave the key out
  std::string source = {};
  std::string help = {};
};

}  // namespace rotordrop
