#pragma once

#include "base/errors.h"
#include "base/node.h"
#include "base/parameters/declaration.h"
#include "base/parameters/declare.h"
#include "base/parameters/options.h"
#include "base/parameters/table_reader.h"
#include "base/parameters/value_reader.h"

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// Parameters are declared next to the code that uses them: a Section<T> binds keys of an input table to the members of
/// a plain struct T, with unit, range, default, source and a sentence. From the same declarations come the reader
/// (Section::read), the annotated defaults, the schema and the resolved parameters (io/text/parameter_writers.h).
namespace rotordrop {

namespace detail {
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
                                             const Text& options) {
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
  Section& list(std::string key, std::vector<U> T::*member, Section<U> section, const Nested& options = {}) {
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
  Section& table(std::string key, U T::*member, Section<U> section, const Nested& options = {}) {
    Declaration declaration = detail::declare(std::move(key), Declaration::Kind::table, options, section.erased());
    declaration.required = true;  // of its keys those without a default are
    return add(std::move(declaration), [member, section](const Node& node, const Declaration& d,
                                                         const ReadContext& here, T& target, Faults& faults) {
      target.*member = section.read(node, faults, {.path = here.name_of(d.key), .root = here.root});
    });
  }
  /// One table that may be absent.
  template <class U>
  Section& table(std::string key, std::optional<U> T::*member, Section<U> section, const Nested& options = {}) {
    return add(
        detail::declare(std::move(key), Declaration::Kind::table, options, section.erased()),
        [member, section](const Node& node, const Declaration& d, const ReadContext& here, T& target, Faults& faults) {
          target.*member = section.read(node, faults, {.path = here.name_of(d.key), .root = here.root});
        });
  }
  /// One table that may be absent, whose keys are declared elsewhere: read(table, here, target, faults).
  Section& table(std::string key, ErasedSection section,
                 std::function<void(const Node&, const ReadContext&, T&, Faults&)> read, const Nested& options = {}) {
    return add(detail::declare(std::move(key), Declaration::Kind::table, options, std::move(section)),
               [read = std::move(read)](const Node& node, const Declaration& d, const ReadContext& here, T& target,
                                        Faults& faults) {
                 read(node, {.path = here.name_of(d.key), .root = here.root}, target, faults);
               });
  }
  /// Named tables, in the order of the file.
  template <class U>
  Section& tables(std::string key, std::vector<std::pair<std::string, U>> T::*member, Section<U> section,
                  const Nested& options = {}) {
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
  Section& variants(std::string key, std::string tag_key, std::vector<Variant<T>> alternatives,
                    const Variants& options = {}) {
    std::vector<VariantDeclaration> declared;
    for (const auto& alternative : alternatives) declared.push_back(alternative.declaration);
    return add(detail::declare(std::move(key), options, std::move(tag_key), std::move(declared)),
               [alternatives = std::move(alternatives)](const Node& node, const Declaration& d, const ReadContext& here,
                                                        T& target, Faults& faults) {
                 read_variants(alternatives, node, d, here, target, faults);
               });
  }
  /// A key with a reader of its own: read(node, target, faults).
  Section& custom(std::string key, const Custom& options, std::function<void(const Node&, T&, Faults&)> read) {
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

  /// Advice where many keys are missing at once.
  Section& if_incomplete(std::string advice) {
    declared_.if_incomplete = std::move(advice);
    return *this;
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
    std::vector<const Declaration*> missing;
    for (std::size_t i = 0; i < readers_.size(); ++i) {
      const Declaration& d = declared_.declarations[i];
      if (const Node* given = table.find(d.key))
        readers_[i](*given, d, here, target, faults);
      else if (d.fallback)
        readers_[i](*d.fallback, d, here, target, faults);
      else if (d.kind == Declaration::Kind::table && d.required)
        readers_[i](Node::table(table.where()), d, here, target, faults);
      else if (d.required)
        missing.push_back(&d);
    }
    detail::report_missing_keys(table, missing, declared_.if_incomplete, here, faults);
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
        detail::report_unknown_variant(entry, node, d, map, faults);
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
