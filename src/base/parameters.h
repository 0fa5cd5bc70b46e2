#pragma once

#include "base/errors.h"
#include "base/node.h"
#include "base/units.h"

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

/// Parameters are declared next to the code that uses them: a Section<T> binds keys of an input table to the members of
/// a plain struct T, with unit, range, default, source and a sentence. From the same declarations come the reader
/// (Section::read), the annotated defaults, the schema and the resolved parameters (io/text/parameter_writers.h).
namespace rotordrop {

// ----------------------------------------------------------------------------------------------------------------
// ranges

/// Allowed values, in SI.
struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_is_open = false;
  bool upper_is_open = false;

  bool contains(double value) const;
  bool is_any() const;
  /// The same range without its lower or upper end: between(0, 1).without_upper() is [0, 1).
  Range without_lower() const;
  Range without_upper() const;
};
Range any();
Range positive();                   ///< > 0
Range at_least(double a);           ///< >= a
Range above(double a);              ///< > a
Range at_most(double b);            ///< <= b
Range below(double b);              ///< < b
Range between(double a, double b);  ///< a <= . <= b

/// "> 0 m", "between 0 and 1", ">= 0 and < 1", "any value".
std::string to_string(const Range& range, std::string_view unit = "1");

// -------------------------------------------------------------------------------------------- what a declaration can
// say

// Options of the member functions of Section. A missing `fallback` makes a key required, unless the member is a
// std::optional (then the key may be absent). Fallbacks are written as a user would write them: "250 um", "0.1".

struct Quantity {
  std::string unit = "1";
  std::optional<QuantityKind> kind = {};  ///< default: kind_of(unit); needed for a temperature difference only
  Range range = {};
  std::optional<std::string> fallback = {};
  std::string source = {};
  std::string help = {};
};
struct QuantityList {
  std::string unit = "1";
  std::optional<QuantityKind> kind = {};
  Range range = {};                        ///< of every entry
  std::vector<std::string> fallback = {};  ///< {"0.52", "0.52"}
  std::size_t min_count = 0;  ///< of a std::vector; if 0, an absent key without fallback means an empty list
  std::string source = {};
  std::string help = {};
};
struct QuantityMatrix {
  std::string unit = "1";
  std::optional<QuantityKind> kind = {};
  Range range = {};                                     ///< of every entry
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

// ------------------------------------------------------------------------------------------- declarations without a
// type

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

  const Declaration* find(std::string_view key) const;
};

/// "length, > 0 m", "integer, >= 1", "radial | equivalent": unit and range as documentation shows them.
std::string type_text(const Declaration& declaration);

/// The name closest to `word` among `names`, if it is close enough to be meant (Damerau-Levenshtein distance);
/// otherwise empty.
std::string closest_name(std::string_view word, const std::vector<std::string>& names);

/// Advice on a word that is none of `known`: `Did you mean "x"?` if one of them is close, then `rest`.
std::string suggestion(std::string_view word, const std::vector<std::string>& known, const std::string& rest);
/// Advice that ends with the list of all that is known.
std::string suggestion(std::string_view word, const std::vector<std::string>& known);

/// Of a table of variants (`[bearings]`): whether an entry is a default for the named tables, rather than one of them.
bool is_variant_default(const Declaration& variants, const Node::Entry& entry);
/// The keys directly in a table of variants that are defaults for its named tables of the chosen variant.
Node variant_defaults(const Node& table, const VariantDeclaration& chosen);
/// Which variant a named table is, or nullptr; looks at its tag key, then at the declared fallback.
const VariantDeclaration* variant_of(const Declaration& variants, const Node& named_table);

// ------------------------------------------------------------------------------- reading single values, for custom
// readers

/// Reads one quantity in SI; on a fault adds it and returns nothing. `name` is the full name for messages
/// ("run.gravity").
std::optional<double> read_quantity(const Node& node, const Quantity& quantity, const std::string& name,
                                    Faults& faults);
/// Reads an array of quantities with min_count to max_count entries.
std::optional<std::vector<double>> read_quantities(const Node& node, const Quantity& quantity, std::size_t min_count,
                                                   std::size_t max_count, const std::string& name, Faults& faults);

/// Where a reader stands in the input.
struct ReadContext {
  std::string path = {};                        ///< "bearings.TB1"; empty at the top level
  const SectionDeclaration* root = nullptr;     ///< searched for keys that are known elsewhere
  const std::string* also_known_key = nullptr;  ///< a key that the table may have besides those of its section

  std::string name_of(std::string_view key) const;  ///< "bearings.TB1.rows"
};

namespace detail {
// The readers of one value each report a fault and return nothing, or return the value.
std::optional<double> read_quantity(const Node&, const Declaration&, const std::string& name, Faults&);
std::optional<int> read_integer(const Node&, const Declaration&, const std::string& name, Faults&);
std::optional<bool> read_boolean(const Node&, const std::string& name, Faults&);
std::optional<std::string> read_text(const Node&, const Declaration&, const std::string& name, Faults&);
std::optional<std::vector<double>> read_quantities(const Node&, const Declaration&, const std::string& name, Faults&);
std::optional<std::array<std::array<double, 2>, 2>> read_matrix(const Node&, const Declaration&,
                                                                const std::string& name, Faults&);
std::optional<std::vector<std::array<double, 2>>> read_function(const Node&, const Declaration&,
                                                                const std::string& name, Faults&);
// Whether a node is an array (list) or a table (tables, variants) with enough entries.
bool is_readable_list(const Node&, const Declaration&, const std::string& name, Faults&);
bool is_readable_map(const Node&, const Declaration&, const std::string& name, Faults&);

bool is_readable_table(const Node&, const std::string& path, Faults&);
void report_unknown_keys(const Node& table, const SectionDeclaration&, const ReadContext&, Faults&);
void report_missing_key(const Node& table, const Declaration&, const ReadContext&, Faults&);
void report_unknown_defaults(const Node& table, const Declaration&, const ReadContext&, Faults&);
void report_unknown_variant(const Node::Entry&, const Declaration&, const ReadContext&, Faults&);
// Faults about a value that [bearings] gives to every bearing are named after [bearings], once.
void add_without_repeating_defaults(const Faults& from_one_table, const Node& defaults,
                                    const std::string& path_of_table, const std::string& path_of_defaults, Faults&);

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

template <class M>
struct IsOptional : std::false_type {};
template <class M>
struct IsOptional<std::optional<M>> : std::true_type {};
template <class M>
struct FixedCount {
  static std::optional<std::size_t> value() { return {}; }
};
template <std::size_t N>
struct FixedCount<std::array<double, N>> {
  static std::optional<std::size_t> value() { return N; }
};
template <class M>
struct FixedCount<std::optional<M>> : FixedCount<M> {};

inline void assign(const std::vector<double>& from, std::vector<double>& to) { to = from; }
template <std::size_t N>
void assign(const std::vector<double>& from, std::array<double, N>& to) {
  for (std::size_t i = 0; i < N; ++i) to[i] = from.at(i);
}
template <class M>
void assign(const std::vector<double>& from, std::optional<M>& to) {
  assign(from, to.emplace());
}
}  // namespace detail

// ---------------------------------------------------------------------------------------------------------------
// variants

template <class T>
class Section;

/// One alternative of Section::variants; make it with variant().
template <class T>
struct Variant {
  VariantDeclaration declaration;
  std::function<void(const std::string& name, const Node&, const ReadContext&, T&, Faults&)> read;
};
struct VariantOptions {
  bool takes_defaults = false;  ///< keys directly in the parent table are defaults for tables of this variant
};

/// A variant whose named tables are collected in a member of T, in the order of the file.
template <class T, class U>
Variant<T> variant(std::string tag, std::vector<std::pair<std::string, U>> T::*member, Section<U> section,
                   VariantOptions options = {});
/// A variant whose named tables are handed to add(T&, name, U).
template <class T, class U, class Add>
requires std::is_invocable_v<Add, T&, const std::string&, U> Variant<T> variant(std::string tag, Section<U> section,
                                                                                Add add, VariantOptions options = {});

// ----------------------------------------------------------------------------------------------------------------
// section

/// The keys of one input table and the members of T that they fill.
template <class T>
class Section {
 public:
  using Check = std::function<void(const T&, const Node& table, Faults&)>;
  /// `path` is the table's name for messages, "bearings.TB1".
  using NamedCheck = std::function<void(const T&, const Node& table, const std::string& path, Faults&)>;

  /// @param name  key of the table in the file; "" for the top level of a file
  /// @param help  one sentence
  explicit Section(std::string name, std::string help = "") : declared_{std::move(name), std::move(help), {}} {}

  /// A member of type double or std::optional<double>.
  template <class M>
  Section& quantity(std::string key, M T::*member, Quantity options) {
    static_assert(std::is_same_v<M, double> || std::is_same_v<M, std::optional<double>>);
    return value(detail::declare(std::move(key), options, detail::IsOptional<M>::value), member,
                 [](const Node& node, const Declaration& d, const std::string& name, Faults& faults) {
                   return detail::read_quantity(node, d, name, faults);
                 });
  }
  /// A member of type std::vector<double> or std::array<double, N>, or a std::optional of these.
  template <class M>
  Section& quantities(std::string key, M T::*member, QuantityList options) {
    return add(detail::declare(std::move(key), options, detail::FixedCount<M>::value(), detail::IsOptional<M>::value),
               [member](const Node& node, const Declaration& d, const ReadContext& here, T& target, Faults& faults) {
                 if (const auto read = detail::read_quantities(node, d, here.name_of(d.key), faults))
                   detail::assign(*read, target.*member);
               });
  }
  /// A member of type std::array<std::array<double, 2>, 2>, or a std::optional of it.
  template <class M>
  Section& matrix(std::string key, M T::*member, QuantityMatrix options) {
    return value(detail::declare(std::move(key), options, detail::IsOptional<M>::value), member, detail::read_matrix);
  }
  /// A member of type std::vector<std::array<double, 2>>, or a std::optional of it: pairs of argument (time) and value.
  template <class M>
  Section& function(std::string key, M T::*member, QuantityFunction options) {
    return value(detail::declare(std::move(key), options, detail::IsOptional<M>::value), member, detail::read_function);
  }
  /// A member of type int or std::optional<int>.
  template <class M>
  Section& integer(std::string key, M T::*member, Integer options) {
    static_assert(std::is_same_v<M, int> || std::is_same_v<M, std::optional<int>>);
    return value(detail::declare(std::move(key), options, detail::IsOptional<M>::value), member, detail::read_integer);
  }
  /// A member of type bool or std::optional<bool>.
  template <class M>
  Section& boolean(std::string key, M T::*member, Boolean options) {
    static_assert(std::is_same_v<M, bool> || std::is_same_v<M, std::optional<bool>>);
    return value(detail::declare(std::move(key), options, detail::IsOptional<M>::value), member,
                 [](const Node& node, const Declaration&, const std::string& name, Faults& faults) {
                   return detail::read_boolean(node, name, faults);
                 });
  }
  /// A member of type std::string or std::optional<std::string>.
  template <class M>
  Section& text(std::string key, M T::*member, Text options) {
    return value(detail::declare(std::move(key), options, {}, detail::IsOptional<M>::value), member, detail::read_text);
  }
  /// One of the given words; a member of type std::string or std::optional<std::string>.
  template <class M>
  Section& choice(std::string key, M T::*member, std::vector<std::string> words, Text options) {
    return value(detail::declare(std::move(key), options, std::move(words), detail::IsOptional<M>::value), member,
                 detail::read_text);
  }
  /// One of the given words, stored as what it stands for; a member of an enumeration type.
  template <class E>
  requires std::is_enum_v<E> Section& choice(std::string key, E T::*member,
                                             std::vector<std::pair<std::string, std::type_identity_t<E>>> words,
                                             Text options) {
    std::vector<std::string> names;
    for (const auto& word : words) names.push_back(word.first);
    return add(detail::declare(std::move(key), options, std::move(names), false),
               [member, words = std::move(words)](const Node& node, const Declaration& d, const ReadContext& here,
                                                  T& target, Faults& faults) {
                 const auto read = detail::read_text(node, d, here.name_of(d.key), faults);
                 for (const auto& [name, meaning] : words)
                   if (read == name) target.*member = meaning;
               });
  }

  /// An array of tables.
  template <class U>
  Section& list(std::string key, std::vector<U> T::*member, Section<U> section, Nested options = {}) {
    return add(
        detail::declare(std::move(key), Declaration::Kind::list, options, section.erased()),
        [member, section](const Node& node, const Declaration& d, const ReadContext& here, T& target, Faults& faults) {
          const std::string name = here.name_of(d.key);
          if (!detail::is_readable_list(node, d, name, faults)) return;
          (target.*member).clear();
          for (const Node& item : node.items()) {
            const std::string path = name + "#" + std::to_string((target.*member).size() + 1);
            (target.*member).push_back(section.read(item, faults, {.path = path, .root = here.root}));
          }
        });
  }
  /// One table. An absent table is read as an empty one, so its defaults hold.
  template <class U>
  Section& table(std::string key, U T::*member, Section<U> section, Nested options = {}) {
    Declaration declaration = detail::declare(std::move(key), Declaration::Kind::table, options, section.erased());
    declaration.required = true;  // of its keys those without a default are
    return add(std::move(declaration), [member, section](const Node& node, const Declaration& d,
                                                         const ReadContext& here, T& target, Faults& faults) {
      target.*member = section.read(node, faults, {.path = here.name_of(d.key), .root = here.root});
    });
  }
  /// One table that may be absent.
  template <class U>
  Section& table(std::string key, std::optional<U> T::*member, Section<U> section, Nested options = {}) {
    return add(
        detail::declare(std::move(key), Declaration::Kind::table, options, section.erased()),
        [member, section](const Node& node, const Declaration& d, const ReadContext& here, T& target, Faults& faults) {
          target.*member = section.read(node, faults, {.path = here.name_of(d.key), .root = here.root});
        });
  }
  /// Named tables, in the order of the file.
  template <class U>
  Section& tables(std::string key, std::vector<std::pair<std::string, U>> T::*member, Section<U> section,
                  Nested options = {}) {
    return add(
        detail::declare(std::move(key), Declaration::Kind::tables, options, section.erased()),
        [member, section](const Node& node, const Declaration& d, const ReadContext& here, T& target, Faults& faults) {
          const ReadContext map{.path = here.name_of(d.key), .root = here.root};
          if (!detail::is_readable_map(node, d, map.path, faults)) return;
          (target.*member).clear();
          for (const auto& entry : node.entries())
            (target.*member)
                .emplace_back(entry.key,
                              section.read(entry.value, faults, {.path = map.name_of(entry.key), .root = here.root}));
        });
  }
  /// Named tables of several kinds: the key `tag_key` of each says which. A key directly in the parent table that a
  /// variant with takes_defaults declares is a default for its tables; every other table in it is a named one.
  Section& variants(std::string key, std::string tag_key, std::vector<Variant<T>> alternatives, Variants options = {}) {
    std::vector<VariantDeclaration> declared;
    for (const auto& alternative : alternatives) declared.push_back(alternative.declaration);
    return add(detail::declare(std::move(key), options, std::move(tag_key), std::move(declared)),
               [alternatives = std::move(alternatives)](const Node& node, const Declaration& d, const ReadContext& here,
                                                        T& target, Faults& faults) {
                 read_variants(alternatives, node, d, here, target, faults);
               });
  }
  /// A key with a reader of its own: read(node, target, faults).
  Section& custom(std::string key, Custom options, std::function<void(const Node&, T&, Faults&)> read) {
    return add(detail::declare(std::move(key), options),
               [read = std::move(read)](const Node& node, const Declaration&, const ReadContext&, T& target,
                                        Faults& faults) { read(node, target, faults); });
  }

  /// A check over several parameters. It runs after all keys of the section were read without a faulty or missing
  /// value. position_of_value(table, "key") gives the place for a fault.
  Section& check(NamedCheck check) {
    checks_.push_back(std::move(check));
    return *this;
  }
  Section& check(Check check) {
    return this->check(NamedCheck([check](const T& target, const Node& table, const std::string&, Faults& faults) {
      check(target, table, faults);
    }));
  }

  const std::string& name() const { return declared_.name; }

  /// Reads a table; adds all faults that it finds. What is faulty keeps the value of a default-constructed T.
  T read(const Node& table, Faults& faults) const { return read(table, faults, {.path = declared_.name}); }
  T read(const Node& table, Faults& faults, ReadContext here) const {
    T target{};
    if (!detail::is_readable_table(table, here.path, faults)) return target;
    if (!here.root) here.root = &declared_;
    detail::report_unknown_keys(table, declared_, here, faults);
    const std::size_t n_faults_before = faults.size();
    for (std::size_t i = 0; i < readers_.size(); ++i) {
      const Declaration& d = declared_.declarations[i];
      if (const Node* given = table.find(d.key))
        readers_[i](*given, d, here, target, faults);
      else if (d.fallback)
        readers_[i](*d.fallback, d, here, target, faults);
      else if (d.kind == Declaration::Kind::table && d.required)
        readers_[i](Node::table(table.where()), d, here, target, faults);
      else if (d.required)
        detail::report_missing_key(table, d, here, faults);
    }
    if (faults.size() == n_faults_before)
      for (const auto& check : checks_) check(target, table, here.path, faults);
    return target;
  }

  /// The struct with all defaults. Throws an InputError if a key without default is required.
  T defaults() const {
    Faults faults;
    T target = read(Node::table(), faults);
    faults.throw_if_any();
    return target;
  }

  /// The declarations alone, for the writers.
  ErasedSection erased() const { return std::make_shared<const SectionDeclaration>(declared_); }

 private:
  using Reader = std::function<void(const Node&, const Declaration&, const ReadContext&, T&, Faults&)>;

  Section& add(Declaration declaration, Reader reader) {
    detail::add_declaration(declared_, std::move(declaration));
    readers_.push_back(std::move(reader));
    return *this;
  }
  template <class M, class ReadValue>
  Section& value(Declaration declaration, M T::*member, ReadValue read_value) {
    return add(std::move(declaration), [member, read_value](const Node& node, const Declaration& d,
                                                            const ReadContext& here, T& target, Faults& faults) {
      if (auto read = read_value(node, d, here.name_of(d.key), faults)) target.*member = *std::move(read);
    });
  }
  static void read_variants(const std::vector<Variant<T>>& alternatives, const Node& node, const Declaration& d,
                            const ReadContext& here, T& target, Faults& faults) {
    const ReadContext map{.path = here.name_of(d.key), .root = here.root, .also_known_key = &d.tag_key};
    if (!detail::is_readable_map(node, d, map.path, faults)) return;
    detail::report_unknown_defaults(node, d, map, faults);
    for (const auto& entry : node.entries()) {
      if (is_variant_default(d, entry) || !entry.value.is_table()) continue;
      const VariantDeclaration* chosen = variant_of(d, entry.value);
      if (!chosen) {
        detail::report_unknown_variant(entry, d, map, faults);
        continue;
      }
      const Node defaults = variant_defaults(node, *chosen);
      const Node completed = merged(defaults, entry.value);
      const std::string path = map.name_of(entry.key);
      Faults found;
      alternatives[static_cast<std::size_t>(chosen - d.variants.data())].read(
          entry.key, completed, {.path = path, .root = here.root, .also_known_key = &d.tag_key}, target, found);
      detail::add_without_repeating_defaults(found, defaults, path, map.path, faults);
    }
  }

  SectionDeclaration declared_;
  std::vector<Reader> readers_;
  std::vector<NamedCheck> checks_;
};

template <class T, class U>
Variant<T> variant(std::string tag, std::vector<std::pair<std::string, U>> T::*member, Section<U> section,
                   VariantOptions options) {
  return {{std::move(tag), section.erased(), options.takes_defaults},
          [member, section](const std::string& name, const Node& node, const ReadContext& here, T& target,
                            Faults& faults) { (target.*member).emplace_back(name, section.read(node, faults, here)); }};
}

template <class T, class U, class Add>
requires std::is_invocable_v<Add, T&, const std::string&, U> Variant<T> variant(std::string tag, Section<U> section,
                                                                                Add add, VariantOptions options) {
  return {{std::move(tag), section.erased(), options.takes_defaults},
          [add, section](const std::string& name, const Node& node, const ReadContext& here, T& target,
                         Faults& faults) { add(target, name, section.read(node, faults, here)); }};
}

}  // namespace rotordrop
