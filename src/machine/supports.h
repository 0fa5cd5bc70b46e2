#pragma once
// The kinds of support that a machine can have. A new kind of ours is its own files in bearing/support/ and one line in own_kinds() (supports.cpp);
// one from outside registers itself with add_support_kind().
#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "base/parameters/section.h"
#include "bearing/support/linear_support_parameters.h"
#include "bearing/support/magnet_support.h"
#include "bearing/touchdown_parameters.h"
#include "model/support.h"

namespace rotordrop {

/// A support of a registered kind. It gives off no heat to the thermal models: what it dissipates is "other dissipation".
struct OtherSupport {
  int node = 0;
  std::function<std::unique_ptr<Support>(const std::string& name)> make;
};

/// A kind of support that a program adds to those of the library.
struct SupportKind {
  std::string type;
  ErasedSection section;
  std::function<OtherSupport(const Node& table, const ReadContext& here, Faults& faults)> read;
};

/// Those added so far, in their order.
std::vector<SupportKind> support_kinds();

/// @throws std::invalid_argument if add_support_kind() would
void check_support_kind(const SupportKind& kind);

/// @throws std::invalid_argument if the type is known already or cannot be one, if the kind has no keys or nothing reads them, or keys cannot be so
void add_support_kind(SupportKind kind);

/// A kind from its keys and what makes it.
/// @param section  the table's keys; P has a member `int node`, filled from a key of its own
/// @param make     (const std::string& name, const P&) -> std::unique_ptr<Support>; called once for each machine
template <class P, class Make>
SupportKind support_kind_of(const std::string& type, const Section<P>& section, Make make) {
  return {type, section.erased(), [section, make](const Node& table, const ReadContext& here, Faults& faults) {
            const P p = section.read(table, faults, here);
            return OtherSupport{p.node, [make, p](const std::string& name) { return make(name, p); }};
          }};
}

/// Lets cases say `type = "..."` in a table of [bearings]. Call it before a case is read. Arguments as of support_kind_of().
/// @throws std::invalid_argument likewise
template <class P, class Make>
void add_support_kind(const std::string& type, const Section<P>& section, Make make) {
  add_support_kind(support_kind_of(type, section, std::move(make)));
}

/// One table of [bearings].
struct SupportEntry {
  std::string name;
  std::variant<TouchdownParameters, LinearSupportParameters, MagnetParameters, OtherSupport> parameters;

  [[nodiscard]] int node() const {
    return std::visit([](const auto& p) { return p.node; }, parameters);
  }
  [[nodiscard]] const TouchdownParameters* touchdown() const { return std::get_if<TouchdownParameters>(&parameters); }
  [[nodiscard]] const LinearSupportParameters* linear() const {
    return std::get_if<LinearSupportParameters>(&parameters);
  }
  [[nodiscard]] const MagnetParameters* magnet() const { return std::get_if<MagnetParameters>(&parameters); }
  [[nodiscard]] const OtherSupport* other() const { return std::get_if<OtherSupport>(&parameters); }
};

/// Declares the key "bearings" of a case: named tables by `type`, read into a std::vector<SupportEntry> member.
template <class T>
void declare_bearings(Section<T>& section, std::vector<SupportEntry> T::*member) {
  std::vector<Variant<T>> alternatives = {
      variant<T>("touchdown", touchdown_section(),
                 [member](T& target, const std::string& name, TouchdownParameters p) {
                   (target.*member).push_back({name, std::move(p)});
                 },
                 {.takes_defaults = true}),
      variant<T>("linear", linear_support_section(),
                 [member](T& target, const std::string& name, const LinearSupportParameters& p) {
                   (target.*member).push_back({name, p});
                 },
                 {}),
      variant<T>("magnet", magnet_section(),
                 [member](T& target, const std::string& name, const MagnetParameters& p) {
                   (target.*member).push_back({name, p});
                 },
                 {})};
  for (const SupportKind& kind : support_kinds())
    alternatives.push_back({{kind.type, kind.section, false},
                            [member, read = kind.read](const std::string& name, const Node& table,
                                                       const ReadContext& here, T& target, Faults& faults) {
                              (target.*member).push_back({name, read(table, here, faults)});
                            }});
  section.variants("bearings", "type", std::move(alternatives),
                   {.help = "Supports of the rotor by name. Keys set directly in [bearings] apply to all touchdown "
                            "bearings that do not set them."});
}

}  // namespace rotordrop
