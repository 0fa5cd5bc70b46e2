#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/node.h"
#include "base/parameters/declaration.h"

namespace rotordrop {

/// One step of a key: "unbalance[0]" is the key unbalance and its entry 0.
struct KeyStep {
  std::string key;
  std::vector<std::size_t> entries;  ///< counted from 0
};

/// Steps of a key such as "rotor.unbalance[0].me". @throws InputError at `where` if the text is no key
std::vector<KeyStep> steps_of(const std::string& key, const SourcePosition& where);

/// What is declared about a key of a case.
struct DeclaredKey {
  std::string name;         ///< as given
  ErasedSection root;       ///< keeps the declaration alive
  Declaration declaration;  ///< of the key; of a list of numbers for one of its entries
  bool is_entry = false;    ///< one number of a list
  std::string unit;         ///< SI; empty if none is declared
  QuantityKind quantity = QuantityKind::plain;

  [[nodiscard]] bool is_quantity() const;  ///< takes a number with a unit
};

/// Finds what is declared about a key of a case. @throws InputError at `where` for an unknown key, with what may be meant
DeclaredKey declared_key(const std::string& key, const Node& tree, const SourcePosition& where);

/// The value of a key in a tree, or the declared default of a key that the tree lacks; none if there is neither.
std::optional<Node> value_of_key(const DeclaredKey& key, const Node& tree);

/// Sets a key, also an entry of a list: "rotor.initial_offset[0]". A list that the tree lacks begins as its declared default.
/// @throws InputError at `where` if there is no such key or entry
void set_key(Node& tree, const std::string& key, Node value, const SourcePosition& where);

}  // namespace rotordrop
