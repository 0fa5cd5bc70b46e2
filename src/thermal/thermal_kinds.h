#pragma once
// The thermal models that a case can name in thermal.models. One of ours is its own files in a folder beside this one and a line in thermal_kinds.cpp; one
// from outside registers itself with add_thermal_kind().
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/parameters/section.h"
#include "model/thermal_model.h"
#include "thermal/circuit/bearing_circuit.h"
#include "thermal/section/reduced_sections.h"

namespace rotordrop {

/// What a thermal model is made from. Its places are the touchdown bearings of the case, in their order.
struct ThermalGeometry {
  double ambient = 0;                        ///< [K]
  std::vector<BearingCircuitData> bearings;  ///< dimensions and materials [n_places]
  ThermalNetworkData circuits;               ///< their circuits, with the nodes and resistors that the case adds
  std::function<std::vector<ReducedSection>()> sections;  ///< their meshed sections, for kinds that mesh them
};
using MakeThermalModel = std::function<std::unique_ptr<ThermalModel>(const ThermalGeometry&)>;

/// A kind of thermal model: what cases and results call it, what is peculiar to it, and how it is made.
struct ThermalKind {
  std::string name =
      {};  ///< in thermal.models, thermal.driver, /growth/NAME and summary.json: letters, digits, _ and -
  std::string title = {};  ///< in sentences: "lumped thermal circuit"
  std::string word = {};   ///< where it is clear what is meant: "circuit"
  std::string mark = {};   ///< in legends and heads of tables: "FE"
  std::string group = {};  ///< of its temperatures in results.h5, "/thermal/"; /NAME/ for kinds of others
  /// Keys and ledgers without its name: "heat_lost" instead of "NAME_heat_lost", rises directly among a bearing's results. The circuit's alone.
  bool is_unmarked = false;
  bool is_circuit = false;  ///< has the nodes and resistors that thermal.node and thermal.resistor add
  bool meshes_sections =
      false;  ///< needs the finite-element room, follows [thermal.fe], may run in windows; not of others
  bool has_ring_states = false;     ///< its ThermalModel::ring_states() are not empty, which is checked
  MakeThermalModel make = {};       ///< of a kind without keys of its own
  ErasedSection section = nullptr;  ///< keys of its own, in the table [thermal.NAME]
  /// Reads that table; of a kind with keys.
  std::function<MakeThermalModel(const Node& table, const ReadContext& here, Faults& faults)> read = {};

  /// Before what results call heat of this model: "", "NAME_".
  [[nodiscard]] std::string prefix() const { return is_unmarked ? "" : name + "_"; }
};

/// All kinds, in the order in which they are listed, run and compared: the lumped circuit, the finite elements, those that were added.
std::vector<const ThermalKind*> thermal_kinds();
/// nullptr if no kind has that name. What it points to stays.
const ThermalKind* thermal_kind(const std::string& name);
std::vector<std::string> thermal_kind_names();

/// @throws std::invalid_argument if add_thermal_kind() would
void check_thermal_kind(const ThermalKind& kind);

/// Lets cases name a thermal model. Call it before a case is read.
/// @throws std::invalid_argument if the name is taken or cannot be one, nothing makes it, it claims what is ours alone, or keys cannot be so
void add_thermal_kind(ThermalKind kind);

/// A kind with keys of its own in a table [thermal.NAME].
/// @param section  the table's keys, for P
/// @param make     (const ThermalGeometry&, const P&) -> std::unique_ptr<ThermalModel>
template <class P, class Make>
ThermalKind thermal_kind_of(ThermalKind kind, const Section<P>& section, Make make) {
  kind.section = section.erased();
  kind.read = [section, make](const Node& table, const ReadContext& here, Faults& faults) -> MakeThermalModel {
    const P p = section.read(table, faults, here);
    return [make, p](const ThermalGeometry& geometry) { return make(geometry, p); };
  };
  return kind;
}

}  // namespace rotordrop
