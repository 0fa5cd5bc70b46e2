#pragma once

#include "base/errors.h"
#include "base/node.h"
#include "base/parameters/declaration.h"

#include <string>
#include <string_view>
#include <vector>

/// What a reader of tables reports: keys that are not known or missing, entries that are no tables.
namespace rotordrop {

/// Where a reader stands in the input.
struct ReadContext {
  std::string path = {};                        ///< "bearings.TB1"; empty at the top level
  const SectionDeclaration* root = nullptr;     ///< searched for keys that are known elsewhere
  const std::string* also_known_key = nullptr;  ///< a key that the table may have besides those of its section

  std::string name_of(std::string_view key) const;  ///< "bearings.TB1.rows"
};

namespace detail {
// Whether a node is an array (list) or a table (tables, variants) with enough entries.
bool is_readable_list(const Node&, const Declaration&, const std::string& name, Faults&);
bool is_readable_map(const Node&, const Declaration&, const std::string& name, Faults&);

bool is_readable_table(const Node&, const std::string& path, Faults&);
void report_unknown_keys(const Node& table, const SectionDeclaration&, const ReadContext&, Faults&);
void report_missing_keys(const Node& table, const std::vector<const Declaration*>& missing,
                         const std::string& if_incomplete, const ReadContext&, Faults&);
void report_unknown_defaults(const Node& table, const Declaration&, const ReadContext&, Faults&);
void report_unknown_variant(const Node::Entry&, const Node& among, const Declaration&, const ReadContext&, Faults&);
// Faults about a value that [bearings] gives to every bearing are named after [bearings], once.
void add_without_repeating_defaults(const Faults& from_one_table, const Node& defaults,
                                    const std::string& path_of_table, const std::string& path_of_defaults, Faults&);
}  // namespace detail

}  // namespace rotordrop
