#pragma once
// The kinds of support that a machine can have. A new kind is its own files in bearing/ and one alternative here.
#include <string>
#include <variant>
#include <vector>

#include "base/parameters.h"
#include "bearing/linear_support_parameters.h"
#include "bearing/touchdown_parameters.h"

namespace rotordrop {

/// One table of [bearings].
struct SupportEntry {
  std::string name;
  std::variant<TouchdownParameters, LinearSupportParameters> parameters;

  [[nodiscard]] int node() const {
    return std::visit([](const auto& p) { return p.node; }, parameters);
  }
  [[nodiscard]] const TouchdownParameters* touchdown() const { return std::get_if<TouchdownParameters>(&parameters); }
  [[nodiscard]] const LinearSupportParameters* linear() const {
    return std::get_if<LinearSupportParameters>(&parameters);
  }
};

/// Declares the key "bearings" of a case: named tables by `type`, read into a std::vector<SupportEntry> member.
template <class T>
void declare_bearings(Section<T>& section, std::vector<SupportEntry> T::*member) {
  section.variants("bearings", "type",
                   {variant<T>("touchdown", touchdown_section(),
                               [member](T& target, const std::string& name, TouchdownParameters p) {
                                 (target.*member).push_back({name, std::move(p)});
                               },
                               {.takes_defaults = true}),
                    variant<T>("linear", linear_support_section(),
                               [member](T& target, const std::string& name, LinearSupportParameters p) {
                                 (target.*member).push_back({name, std::move(p)});
                               },
                               {})},
                   {.help = "Supports of the rotor by name. Keys directly in [bearings] hold for all touchdown "
                            "bearings that do not set them."});
}

}  // namespace rotordrop
