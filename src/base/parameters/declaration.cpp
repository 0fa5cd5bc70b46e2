#include "base/parameters/declaration.h"

#include <algorithm>

namespace rotordrop {

const Declaration* SectionDeclaration::find(std::string_view key) const {
  const auto found =
      std::find_if(declarations.begin(), declarations.end(), [&](const Declaration& d) { return d.key == key; });
  return found == declarations.end() ? nullptr : &*found;
}

bool is_variant_default(const Declaration& variants, const Node::Entry& entry) {
  return !entry.value.is_table() ||
         std::any_of(variants.variants.begin(), variants.variants.end(), [&](const VariantDeclaration& variant) {
           return variant.takes_defaults && variant.section->find(entry.key);
         });
}

Node variant_defaults(const Node& table, const VariantDeclaration& chosen) {
  Node defaults = Node::table(table.where());
  if (chosen.takes_defaults)
    for (const Node::Entry& entry : table.entries())
      if (chosen.section->find(entry.key)) defaults.set(entry);
  return defaults;
}

const VariantDeclaration* variant_of(const Declaration& variants, const Node& named_table) {
  const Node* given = named_table.find(variants.tag_key);
  std::optional<std::string> tag = variants.fallback_tag;
  if (given) tag = given->is_text() ? std::optional(given->text()) : std::nullopt;
  for (const VariantDeclaration& variant : variants.variants)
    if (variant.tag == tag) return &variant;
  return nullptr;
}

}  // namespace rotordrop
