#include "machine/others/declared_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "base/units.h"
#include "base/utf8.h"
#include "bearing/touchdown_bearing.h"
#include "machine/others/declared_heat.h"
#include "thermal/circuit/thermal_network.h"

namespace rotordrop {
namespace {

/// Names of one kind that a part brings along, each once.
class DeclaredNames {
 public:
  /// @param of  the part in messages: "bearings.X"
  DeclaredNames(std::string of, SourcePosition where, Faults& faults)
      : of_(std::move(of)), where_(std::move(where)), faults_(faults) {}

  /// @param what  "state", "series", "ledger"
  bool add(const std::string& what, const std::string& name) {
    if (name.empty()) return refuse(fmt::format("the name of a {} is empty.", what));
    if (!is_utf8(name)) return refuse(fmt::format("the name of a {} is no UTF-8.", what));
    const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
    if (std::any_of(name.begin(), name.end(), is_control))
      return refuse(fmt::format("the name of a {} holds a control character.", what));
    if (!known_.insert(name).second) return refuse(fmt::format("{} \"{}\" stands twice.", what, name));
    return true;
  }
  /// A dataset below the part's group.
  bool add_dataset(const std::string& what, const std::string& name) {
    const std::string path = "/" + name + "/";
    for (const char* part : {"//", "/./", "/../"})
      if (!name.empty() && path.find(part) != std::string::npos)
        return refuse(fmt::format("{} \"{}\" cannot be the name of a dataset.", what, name),
                      "No part of it between slashes may be empty, \".\" or \"..\".");
    for (const std::string& known : known_) {
      const std::string other = "/" + known + "/";
      if (path.starts_with(other) != other.starts_with(path))
        return refuse(fmt::format("{} \"{}\" and \"{}\" cannot both be datasets.", what, known, name),
                      "One would lie in the other: give one of them another name.");
    }
    return add(what, name);
  }
  /// What is written beside a name.
  bool add_words(const std::string& what, const std::string& name, const std::string& unit,
                 const std::string& long_name) {
    if (!is_utf8(long_name)) return refuse(fmt::format("the long name of {} \"{}\" is no UTF-8.", what, name));
    if (!is_utf8(unit) || !is_unit(unit))
      return refuse(fmt::format("the unit of {} \"{}\" is not known.", what, name),
                    "Units are written as in \"N m\", \"W/(m K)\" or \"kg/m3\"; a number has \"1\".");
    return true;
  }
  bool refuse(const std::string& message, const std::string& advice = "") {
    faults_.add(where_, fmt::format("{}: {}", of_, message), advice);
    return false;
  }

 private:
  std::string of_;
  SourcePosition where_;
  Faults& faults_;
  std::set<std::string> known_;
};

void check_states(const std::vector<StateEntry>& entries, DeclaredNames names) {
  for (const StateEntry& entry : entries)
    if (names.add("state", entry.name) && names.add_words("state", entry.name, entry.unit, entry.long_name) &&
        !(entry.scale > 0. && std::isfinite(entry.scale)))
      names.refuse(fmt::format("the scale of state \"{}\" must be larger than 0 and is {}.", entry.name, entry.scale),
                   "It is the state's typical size, of which the tolerance is a part.");
}

/// Programs know series by dots for slashes, and next to each other their times.
bool check_dataset(const std::string& what, const std::string& name, DeclaredNames& names) {
  if (!names.add_dataset(what, name)) return false;
  if (name.find('.') != std::string::npos)
    return names.refuse(fmt::format("{} \"{}\" cannot have a dot in its name.", what, name),
                        "Dots stand for slashes where series are looked up: use _ or /.");
  const std::string last = name.substr(name.rfind('/') + 1);
  if (last == "time" || last == "detail_time" || last == "windows_time")
    return names.refuse(fmt::format("{} \"{}\" cannot be called so.", what, name),
                        "time, detail_time and windows_time are the times of series: choose another name.");
  return true;
}

/// The names of datasets have _ for spaces.
std::string with_underscores(std::string name) {
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

void check_ledgers(const Support& support, DeclaredNames names) {
  // Those that the machine keeps.
  for (const char* kept : {"rub_heat", "rub_heat_into_ring", "inner_heat", "outer_heat", "other_dissipation",
                           "prescribed_work", "growth_work"})
    names.add("ledger", kept);
  if (!support.heat_port().empty()) names.add("ledger", "heat_into_port");
  for (std::size_t row = 1; row <= support.n_heated_rows(); ++row)
    for (const char* race : {"inner", "outer"}) names.add("ledger", fmt::format("row_{}_{}_heat", row, race));
  for (const StateEntry& entry : support.ledger_entries())
    if (check_dataset("ledger", with_underscores(entry.name), names))
      names.add_words("ledger", entry.name, entry.unit, entry.long_name);
}

/// Of one series at one instant: more are a mistake, and fill the memory.
constexpr std::size_t most_numbers = 1'000'000;

/// Columns are what programs call numbers by.
void check_columns(const Observable& o, DeclaredNames& names) {
  if (o.size == 0 || (!o.columns.empty() && o.columns.size() != o.size)) {
    names.refuse(fmt::format("series \"{}\" has {} numbers and {} names of columns.", o.name, o.size, o.columns.size()),
                 "Give it one number at least, and a name for each, or none.");
    return;
  }
  if (o.size > most_numbers) {
    names.refuse(fmt::format("series \"{}\" has {} numbers, and at most {} are taken.", o.name, o.size, most_numbers));
    return;
  }
  if (!std::all_of(o.columns.begin(), o.columns.end(), [](const std::string& column) { return is_utf8(column); })) {
    names.refuse(fmt::format("the name of a column of series \"{}\" is no UTF-8.", o.name));
    return;
  }
  std::vector<std::string> columns = o.columns;
  std::sort(columns.begin(), columns.end());
  if (const auto twice = std::adjacent_find(columns.begin(), columns.end()); twice != columns.end())
    names.refuse(fmt::format("series \"{}\" has two columns \"{}\".", o.name, *twice), "Give each a name of its own.");
}

void check_series(const std::vector<Observable>& list, DeclaredNames& names) {
  for (const Observable& o : list)
    if (check_dataset("series", o.name, names) && names.add_words("series", o.name, o.unit, o.long_name))
      check_columns(o, names);
}

/// What is known by its balls' force is followed like a touchdown bearing, and asked for all of this.
void check_kinds(const std::vector<Observable>& list, DeclaredNames& names) {
  using K = Observed;
  const auto find = [&](K kind) {
    return std::find_if(list.begin(), list.end(), [kind](const Observable& o) { return o.kind == kind; });
  };
  const auto ball_force = find(K::ball_force);
  if (ball_force == list.end()) return;
  const std::size_t n_rows = ball_force->size;
  if (n_rows > TouchdownBearing::max_rows) {
    names.refuse(fmt::format("series \"{}\" has {} rows of balls, and a bearing has at most {}.", ball_force->name,
                             n_rows, TouchdownBearing::max_rows));
    return;
  }
  std::string missing;
  struct Needed {
    K kind;
    const char* name;
    std::size_t size;
    bool has_columns = false;
  };
  for (const auto& [kind, name, size, has_columns] :
       {Needed{K::ball_force, "ball_force", n_rows, true}, Needed{K::orbit, "orbit", 2, true},
        Needed{K::penetration, "penetration", 1}, Needed{K::clearance, "clearance", 1},
        Needed{K::contact_force, "contact_force", 1}, Needed{K::spin_lag, "spin_lag", 1},
        Needed{K::contact_pressure, "contact_pressure", n_rows, true}, Needed{K::ring_speed, "ring_speed", 1},
        Needed{K::load_torque, "load_torque", 1}, Needed{K::spin_torque, "spin_torque", 1},
        Needed{K::rub_heat_rate, "rub_heat_rate", 1}, Needed{K::inner_heat_rate, "inner_heat_rate", 1},
        Needed{K::outer_heat_rate, "outer_heat_rate", 1}, Needed{K::growth, "growth", growth_surfaces.size(), true},
        Needed{K::preload, "preload", 1}, Needed{K::centrifugal_force, "centrifugal_force", 1},
        Needed{K::ellipse_truncation, "ellipse_truncation", n_rows, true},
        Needed{K::skid_demand, "skid_demand", n_rows, true},
        Needed{K::gyroscopic_demand, "gyroscopic_demand", n_rows, true}})
    if (const auto found = find(kind);
        found == list.end() || found->size != size || (has_columns && found->columns.empty()))
      missing += fmt::format("{}{}{}", missing.empty() ? "" : ", ", name, size == 1 ? "" : fmt::format("[{}]", size));
  if (!missing.empty())
    names.refuse(
        fmt::format("series \"{}\" is of the kind Observed::ball_force, and series of these kinds are missing, "
                    "of another size, or without names of columns: {}.",
                    ball_force->name, missing),
        "What has ball forces is followed like a touchdown bearing, and must give what that gives; or leave "
        "the kind out.");
}

}  // namespace

void check_declared(const Support* support, const std::string& name, const SourcePosition& where, Faults& faults) {
  DeclaredNames names("bearings." + name, where, faults);
  if (!support) {
    names.refuse("nothing was made by its kind.");
    return;
  }
  if (support->name() != name || support->results_path() != "/bearings/" + name) {
    names.refuse("its name() or results_path() is not that of its table.",
                 "name() returns what its kind's maker is given; results_path() stays as it is inherited.");
    return;
  }
  check_states(support->state_entries(), names);
  check_ledgers(*support, names);
  const auto step = support->observables();
  check_series(step, names);
  check_series(support->detailed_observables(), names);
  check_kinds(step, names);
}

void check_declared(const ThermalModel* model, const ThermalKind& kind, std::size_t n_places,
                    const SourcePosition& where, Faults& faults) {
  DeclaredNames names("thermal model \"" + kind.name + "\"", where, faults);
  if (!model) {
    names.refuse("nothing was made by its kind.");
    return;
  }
  const auto refuse = [&](const std::string& what, const std::string& advice) { names.refuse(what, advice); };
  check_ring_states(*model, kind, n_places, refuse);
  const bool is_ours = kind.meshes_sections || (kind.is_circuit && dynamic_cast<const ThermalNetwork*>(model));
  if (is_ours) return;
  check_states(model->state_entries(), names);
  check_series(model->observables(), names);
  check_heat(*model, n_places, refuse);
}

}  // namespace rotordrop
