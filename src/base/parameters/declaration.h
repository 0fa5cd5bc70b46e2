#pragma once

#include "base/node.h"
#include "base/parameters/range.h"
#include "base/units.h"

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// What is declared about keys, without the types that they fill. The writers of defaults, schema and resolved parameters
/// need no more (io/text/parameter_writers.h).
namespace rotordrop {

struct SectionDeclaration;
using ErasedSection = std::shared_ptr<const SectionDeclaration>;

struct VariantDeclaration {
  std::string tag;  ///< "touchdown"
  ErasedSection section;
  bool takes_defaults = false;  ///< keys directly in the parent table are defaults for tables of this variant
};

/// What is declared about one key; all that the writers of defaults, schema and resolved parameters need.
struct Declaration {
  enum class Kind {
    quantity,
    integer,
    boolean,
    text,
    choice,
    quantities,  ///< a list of quantities, min_count..max_count of them
    matrix,      ///< 2 x 2 quantities
    function,    ///< pairs [argument, quantity]
    list,        ///< array of tables, each as `nested`
    table,       ///< one table as `nested`
    tables,      ///< named tables, each as `nested`
    variants,    ///< named tables, each as the variant that its key `tag_key` selects
    custom
  };
  std::string key;
  Kind kind = Kind::custom;
  std::string unit = {};
  std::string argument_unit = {};
  QuantityKind quantity_kind = QuantityKind::plain;
  Range range = {};
  Range usual = {};  ///< part of it; values outside are warned of
  Range usual_argument = {};
  bool required = false;
  std::optional<Node> fallback = {};
  std::string source = {};
  std::string help = {};
  std::vector<std::string> choices = {};
  std::size_t min_count = 0;
  std::size_t max_count = std::numeric_limits<std::size_t>::max();
  ErasedSection nested = {};
  std::string tag_key = {};
  std::optional<std::string> fallback_tag = {};
  std::vector<VariantDeclaration> variants = {};
  std::string accepts = {};
  std::vector<std::string> json_types = {};
};

struct SectionDeclaration {
  std::string name;  ///< key of its table; empty for the top level of a file
  std::string help;
  std::vector<Declaration> declarations;
  std::string if_incomplete = {};  ///< advice where many keys are missing

  const Declaration* find(std::string_view key) const;
};

/// Of a table of variants (`[bearings]`): whether an entry is a default for the named tables, rather than one of them.
bool is_variant_default(const Declaration& variants, const Node::Entry& entry);
/// The keys directly in a table of variants that are defaults for its named tables of the chosen variant.
Node variant_defaults(const Node& table, const VariantDeclaration& chosen);
/// Which variant a named table is, or nullptr; looks at its tag key, then at the declared fallback.
const VariantDeclaration* variant_of(const Declaration& variants, const Node& named_table);

}  // namespace rotordrop
