#pragma once

#include "base/parameters/declaration.h"
#include "base/parameters/options.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

/// Declarations made from the options of Section's member functions.
namespace rotordrop {

namespace detail {
// Checks a new declaration (unit known, fallback readable, key new) and completes it. A mistake here is ours:
// std::logic_error.
void add_declaration(SectionDeclaration&, Declaration);

Declaration declare(std::string key, const Quantity&, bool is_optional);
Declaration declare(std::string key, const QuantityList&, std::optional<std::size_t> fixed_count, bool is_optional);
Declaration declare(std::string key, const QuantityMatrix&, bool is_optional);
Declaration declare(std::string key, const QuantityFunction&, bool is_optional);
Declaration declare(std::string key, const Integer&, bool is_optional);
Declaration declare(std::string key, const Boolean&, bool is_optional);
Declaration declare(std::string key, const Text&, std::vector<std::string> choices, bool is_optional);
Declaration declare(std::string key, Declaration::Kind, const Nested&, ErasedSection nested);
Declaration declare(std::string key, const Variants&, std::string tag_key, std::vector<VariantDeclaration>);
Declaration declare(std::string key, const Custom&);

}  // namespace detail

}  // namespace rotordrop
