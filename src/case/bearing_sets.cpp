#include "case/bearing_sets.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

#include "base/units.h"
#include "io/text/toml_reader.h"

namespace rotordrop {

bool is_from_catalogue(const Node& value, const std::string& entry) {
  const auto file = std::filesystem::path(value.where().file.text()).lexically_normal();
  const auto end = (std::filesystem::path("/bearings") / (entry + ".toml")).lexically_normal();
  return ("/" + file.generic_string()).ends_with(end.generic_string());  // also of a path that begins in the folder
}

namespace {

/// What a catalogue's entry says of one bearing and a case of all of a set.
struct OfSet {
  const char *key, *unit;
  double exponent;  ///< of the number of bearings
};
constexpr std::array<OfSet, 5> of_all = {{{"width", "m", 1.},
                                          {"ring_mass", "kg", 1.},
                                          {"ring_spin_inertia", "kg m2", 1.},
                                          {"C0", "N", 1.},
                                          {"C", "N", 0.7}}};

/// A value of a table in SI; nothing where its reader says what is wrong.
std::optional<double> in_si(const Node& value, const OfSet& of) {
  if (value.is_number()) return value.number();
  const auto read = convert_to_si(value.is_text() ? value.text() : "", of.unit, kind_of(of.unit), of.key);
  return read ? std::optional(read.value) : std::nullopt;
}

/// A catalogue's value for all bearings of a set, in SI.
void multiply(Node& bearing, const std::string& entry, const OfSet& of, double count) {
  const Node* value = bearing.find(of.key);
  if (!value || !is_from_catalogue(*value, entry)) return;
  const auto of_one = in_si(*value, of);
  if (!of_one) return;
  const SourcePosition where = position_of(bearing, of.key);
  bearing.set(of.key, Node(*of_one * std::pow(count, of.exponent), value->where()), where);
}

void make_set(const std::string& name, Node& bearing, Faults& faults) {
  const Node* given = bearing.find("count");
  if (!given || !given->is_number()) return;
  const double count = given->number();
  if (!(count >= 2. && count <= 8. && count == std::floor(count))) return;  // the range is that of the key
  const Node* catalogue = bearing.find("catalogue");
  if (!catalogue || !catalogue->is_text()) {
    faults.add(given->where(),
               fmt::format("bearings.{}.count = {:.0f} makes a set of a catalogue bearing, but "
                           "bearings.{}.catalogue is not given.",
                           name, count, name),
               "Name one, or write rows, width, ring_mass, ring_spin_inertia and C0 of the whole set.");
    return;
  }
  const std::string entry = catalogue->text();
  if (const Node* rows = bearing.find("rows"); rows && rows->is_number()) {
    if (is_from_catalogue(*rows, entry)) {
      const SourcePosition where = position_of(bearing, "rows");
      const auto of_set = static_cast<std::int64_t>(std::lround(rows->number() * count));
      bearing.set("rows", Node(of_set, rows->where()), where);
    } else if (std::fmod(rows->number(), count) != 0.) {
      faults.add(rows->where(),
                 fmt::format("bearings.{}.rows = {:.0f}, but count = {:.0f} bearings have {:.0f} rows or a multiple.",
                             name, rows->number(), count, count),
                 "Leave rows out: count sets it.");
    }
  }
  for (const OfSet& of : of_all) multiply(bearing, entry, of, count);
}

/// A whole number of a table; 1 if it has none.
int count_of(const Node& table, const char* key) {
  const Node* value = table.find(key);
  return value && value->is(Node::Kind::integer) ? static_cast<int>(value->integer()) : 1;
}

bool has_contact_angle(const Node& bearing) {
  const Node* angle = bearing.find("contact_angle");
  if (!angle) return false;
  if (angle->is_number()) return angle->number() > 0.;
  const auto read = convert_to_si(angle->is_text() ? angle->text() : "", "rad", QuantityKind::angle);
  return read && read.value > 0.;
}

/// Whether `count` is keep_set()'s.
bool is_count_of_base(const Node& bearing) {
  const Node *count = bearing.find("count"), *catalogue = bearing.find("catalogue");
  return count && catalogue && count->is_number() && count->where() == catalogue->where();
}

void look_at_kept_set(const std::string& name, const Node& bearing, std::vector<Fault>& warnings) {
  const Node& catalogue = *bearing.find("catalogue");
  const int count = count_of(bearing, "count");
  if (count == 1)
    warnings.push_back(
        {catalogue.where(),
         fmt::format("bearings.{}.catalogue = \"{}\" is one bearing, and replaces a set of several rows.", name,
                     catalogue.text()),
         "Write count = 1 beside it if that is meant, or count = 2 for a pair."});
  else
    warnings.push_back(
        {catalogue.where(),
         fmt::format("bearings.{}.catalogue = \"{}\" is laid over a set of {} rows: taken as a set of {}.", name,
                     catalogue.text(), count_of(bearing, "rows"), count),
         fmt::format("Write count = {} beside it, or count = 1 for one bearing.", count)});
}

/// The file of a bearing's entry, by what the bearing has of it; empty if there is nothing.
std::filesystem::path entry_file(const Node& bearing, const std::string& entry) {
  for (const Node::Entry& value : bearing.entries())
    if (is_from_catalogue(value.value, entry)) return value.value.where().file.text();
  return {};
}

/// Values of one bearing that a case gives for a set.
void look_at_given_values(const std::string& name, const Node& bearing, std::vector<Fault>& warnings) {
  constexpr double most_apart = 0.15;  // estimate: rings of other makers or variants, where a set has twice as much
  const Node* catalogue = bearing.find("catalogue");
  const int count = count_of(bearing, "count");
  if (!catalogue || !catalogue->is_text() || count < 2) return;
  const std::string& entry = catalogue->text();
  const auto is_given = [&](const OfSet& of) {
    const Node* value = bearing.find(of.key);
    return value && !is_from_catalogue(*value, entry);
  };
  if (std::none_of(of_all.begin(), of_all.end(), is_given)) return;
  const auto file = entry_file(bearing, entry);
  if (file.empty()) return;
  const Node one = read_toml(file);
  for (const OfSet& of : of_all) {
    const Node *given = bearing.find(of.key), *of_entry = one.find(of.key);
    if (!is_given(of) || !of_entry) continue;
    const auto value = in_si(*given, of), of_one = in_si(*of_entry, of);
    if (!value || !of_one || std::fabs(*value - *of_one) > most_apart * *of_one) continue;
    warnings.push_back(
        {given->where(),
         fmt::format("bearings.{}.{} = {:.4g} {} is about that of one bearing of the catalogue ({}, {:.4g} {}), but "
                     "count = {}.",
                     name, of.key, *value, of.unit, entry, *of_one, of.unit, count),
         fmt::format(
             "It is of all {} bearings together: leave it out, since count makes it from the catalogue, or give "
             "the set's.",
             count)});
  }
}

}  // namespace

void keep_set(Node& bearing, const Node& under) {
  const Node* catalogue = bearing.find("catalogue");
  if (!catalogue || !catalogue->is_text() || bearing.has("count") || under.has("count")) return;
  if (const Node* rows = bearing.find("rows"); rows && !is_from_catalogue(*rows, catalogue->text())) return;
  const int rows = count_of(bearing, "rows"), rows_under = count_of(under, "rows");
  if (rows < 1 || rows_under <= rows) return;
  const bool stays = has_contact_angle(bearing) && rows_under % rows == 0;
  const SourcePosition where = catalogue->where();
  bearing.set("count", Node(stays ? rows_under / rows : 1, where), where);
}

void look_for_single_entries(const Node& tree, std::vector<Fault>& warnings) {
  const Node* bearings = tree.find("bearings");
  if (!bearings || !bearings->is_table()) return;
  for (const Node::Entry& named : bearings->entries()) {
    const Node& bearing = named.value;
    const Node* catalogue = bearing.is_table() ? bearing.find("catalogue") : nullptr;
    const Node* rows = bearing.is_table() ? bearing.find("rows") : nullptr;
    if (bearing.is_table() && is_count_of_base(bearing)) look_at_kept_set(named.key, bearing, warnings);
    if (bearing.is_table()) look_at_given_values(named.key, bearing, warnings);
    if (!catalogue || !catalogue->is_text() || !rows || !rows->is_number() || bearing.has("count")) continue;
    const std::string& entry = catalogue->text();
    if (is_from_catalogue(*rows, entry)) continue;
    std::string of_one;
    std::filesystem::path file;
    for (const char* key : {"width", "ring_mass", "ring_spin_inertia", "C0"})
      if (const Node* value = bearing.find(key); value && is_from_catalogue(*value, entry)) {
        of_one += (of_one.empty() ? "" : ", ") + std::string(key);
        file = value->where().file.text();
      }
    if (of_one.empty()) continue;
    const Node read = read_toml(file);
    const Node* own_rows = read.find("rows");
    if (!own_rows || !own_rows->is_number() || rows->number() <= own_rows->number()) continue;
    const double times = rows->number() / own_rows->number();
    warnings.push_back({rows->where(),
                        fmt::format("bearings.{}.rows = {:.0f}, but {} are those of one bearing of the catalogue ({}).",
                                    named.key, rows->number(), of_one, entry),
                        fmt::format("Write count = {:.3g} instead of rows = {:.0f}, or give them of the whole set.",
                                    times, rows->number())});
  }
}

void make_sets(Node& tree, Faults& faults) {
  Node* bearings = tree.find("bearings");
  if (!bearings || !bearings->is_table()) return;
  for (auto& entry : bearings->entries())
    if (entry.value.is_table()) make_set(entry.key, entry.value, faults);
}

}  // namespace rotordrop
