#pragma once
// What the program and a module of parts agree upon. A module is a shared object with supports and thermal models of others; it names the function that
// adds them in one line:
//
//   void add_parts(rotordrop::PartsRegistry& registry) { registry.add_support("snubber", snubber_section(), make_snubber); }
//   ROTORDROP_PARTS(add_parts)
#include <string>
#include <utility>

#include "base/version.h"
#include "machine/supports.h"
#include "thermal/heating/bearing_heat.h"
#include "thermal/thermal_kinds.h"

namespace rotordrop {

/// Takes the parts of a module. A module must not call add_support_kind() and the like: those that it is linked with are its own.
class PartsRegistry {
 public:
  PartsRegistry() = default;
  PartsRegistry(const PartsRegistry&) = delete;
  PartsRegistry& operator=(const PartsRegistry&) = delete;
  virtual ~PartsRegistry() = default;
  /// @throws std::invalid_argument if the name is taken or cannot be one
  virtual void add(SupportKind kind) = 0;
  virtual void add(ThermalKind kind) = 0;

  /// Arguments as of add_support_kind().
  template <class P, class Make>
  void add_support(const std::string& type, const Section<P>& section, Make make) {
    add(support_kind_of(type, section, std::move(make)));
  }
  /// Arguments as of add_thermal_kind().
  template <class P, class Make>
  void add_thermal_model(ThermalKind kind, const Section<P>& section, Make make) {
    add(thermal_kind_of(std::move(kind), section, std::move(make)));
  }
};

/// Adds parts to the program that is linked with this library: for programs of your own. Of no use in a module.
class LinkedParts final : public PartsRegistry {
 public:
  void add(SupportKind kind) override { add_support_kind(std::move(kind)); }
  void add(ThermalKind kind) override { add_thermal_kind(std::move(kind)); }
};

namespace {

/// What program and module must have in common, as text: version, compiler, and the sizes of what parts hand to each other. Each source makes its own:
/// an inline function's static variable would be one for all modules of a process, and say what the first of them was built for.
[[maybe_unused]] const char* parts_interface() {
  static const std::string text = [] {
    std::string all =
        std::string("rotordrop ") + version() + ", C++ ABI " + std::to_string(__GXX_ABI_VERSION) + ", sizes";
    for (const std::size_t size :
         {sizeof(SupportInput), sizeof(SupportOutput), sizeof(HeatInput), sizeof(Expansion), sizeof(StateEntry),
          sizeof(Observable), sizeof(SupportKind), sizeof(ThermalKind), sizeof(ThermalGeometry),
          sizeof(BearingCircuitData), sizeof(ThermalNetworkData), sizeof(Declaration)})
      all += " " + std::to_string(size);
    return all;
  }();
  return text.c_str();
}

}  // namespace

// Entry points of a module, and their names.
using PartsInterface = const char*();
using AddParts = void(PartsRegistry&);
inline constexpr const char *parts_interface_name = "rotordrop_parts_interface",
                            *add_parts_name = "rotordrop_add_parts";

}  // namespace rotordrop

/// Makes a shared object a module of parts. @param add_parts  void(rotordrop::PartsRegistry&)
#define ROTORDROP_PARTS(add_parts)                                                            \
  extern "C" const char* rotordrop_parts_interface() { return rotordrop::parts_interface(); } \
  extern "C" void rotordrop_add_parts(rotordrop::PartsRegistry& registry) { add_parts(registry); }
