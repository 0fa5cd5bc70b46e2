#include "case/case.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <mutex>
#include <unordered_map>

#include "base/parameters/suggestion.h"
#include "case/bearing_sets.h"
#include "case/case_family.h"
#include "case/case_text.h"
#include "case/catalogue.h"
#include "case/keys/case_keys.h"
#include "case/keys/entry_settings.h"
#include "case/modules/parts_modules.h"
#include "case/plausibility.h"
#include "case/program_files.h"
#include "case/rotor_file.h"
#include "case/slips/kinds_of_files.h"
#include "io/text/parameter_writers.h"
#include "io/text/toml_reader.h"
#include "machine/balance.h"
#include "machine/build_machine.h"
#include "machine/check_machine.h"

namespace rotordrop {
namespace {

namespace fs = std::filesystem;

Section<OutputParameters> output_section() {
  using P = OutputParameters;
  Section<P> s("output", "What is written, and how often.");
  s.quantity(
      "interval", &P::interval,
      {.unit = "s",
       .range = at_least(1e-7),
       .fallback = "50 us",
       .help = "Time between rows of the series in results.h5. Peaks in the summary are followed between rows, too."});
  s.quantity("detail_interval", &P::detail_interval,
             {.unit = "s",
              .range = at_least(1e-7),
              .fallback = "1 ms",
              .help = "Time between rows of the detailed series: the load of every ball."});
  s.quantity(
      "longest_interval", &P::longest_interval,
      {.unit = "s",
       .range = positive(),
       .help = "Time between rows of the series while nothing changes; detailed series become coarse in the same "
               "ratio. A 20000th of the latest end if not given, so that long runs keep files of sensible size; "
               "never less than output.interval, so that runs up to 1 s have evenly spaced rows by default. Set "
               "it to output.interval for evenly spaced rows in any run."});
  s.quantity("change", &P::change,
             {.range = between(0, 1),
              .fallback = "0.02",
              .source = "estimate: two line widths of a figure",
              .help = "A contact force, rotor position or ring speed has changed if it differs from its value in the "
                      "last row by more than this part of its largest magnitude so far. While something changes rows "
                      "come every output.interval."});
  s.quantity("checkpoint_interval", &P::checkpoint_interval,
             {.unit = "s",
              .range = positive(),
              .usual = between(0.01, 3600),
              .fallback = "10 s",
              .help = "Wall time between checkpoints; `rotordrop run --resume` continues from the last one."});
  return s;
}

Section<CaseParameters> declared_case_section() {
  using P = CaseParameters;
  Section<P> s("", "A rotor drop.");
  s.text("title", &P::title,
         {.help = "Title of the case, one line, for its readers: the screen, summary.json and the report show it."});
  s.text("note", &P::note,
         {.help = "Remark on the case, for its readers, of any length: summary.json and the report show it."});
  s.check([](const P& c, const Node& table, Faults& faults) {
    if (c.title && std::any_of(c.title->begin(), c.title->end(), [](unsigned char x) { return x < 0x20 || x == 0x7f; }))
      faults.add(position_of_value(table, "title"), "title has a line break or another control character.",
                 "Write one line; longer remarks belong in `note`.");
  });
  s.table<RunParameters>("run", &P::run, run_section());
  s.table<RotorParameters>("rotor", &P::rotor, rotor_section());
  s.table<ContactParameters>("contact", &P::contact, contact_section());
  declare_bearings<P>(s, &P::bearings);
  s.tables<MaterialParameters>(
      "materials", &P::materials, material_section(),
      {.source = "Neisi, Heikkinen & Sopanen 2019, table 3, Poisson columns swapped back",
       .help = "Materials by name. Those given here add to, or replace, the built-in steel (E 200 GPa, nu 0.30, "
               "rho 7800 kg/m3, k 70 W/(m K), c 510 J/(kg K), alpha 11.8e-6 1/K) and Si3N4 (315 GPa, 0.26, 3200, 35, "
               "673, 3.2e-6)."});
  s.table<ThermalParameters>("thermal", &P::thermal, thermal_section());
  s.table<StaticsParameters>("statics", &P::statics, statics_section());
  s.table<PreloadParameters>("preload", &P::preload, preload_section());
  s.table<PrescribedHeatParameters>("heat", &P::heat, prescribed_heat_section());
  s.table<IntegrationParameters>("integration", &P::integration, integration_section());
  s.table<OutputParameters>("output", &P::output, output_section());
  s.custom(
      "limits",
      {.accepts = "results, each with max or min",
       .json_types = {"object"},
       .help = "What a run is to stay within: RESULT = { max = \"6 kN\" }, { min = 1 } or both. RESULT is a number "
               "of summary.json, such as bearings.TB1.peak_contact_force; * stands for any text without a dot. "
               "The summary says which limits are met, and how much of each is used (docs/how-to/limits.md)."},
      [](const Node& node, P& target, Faults& faults) { read_limits(node, target.limits, faults); });
  return s;
}

/// Declared once, and again when parts of others have brought keys of their own.
struct CaseSection {
  Section<CaseParameters> section = declared_case_section();
  ErasedSection erased = section.erased();
};
std::shared_ptr<const CaseSection> case_section() {
  load_parts_of_environment();
  static std::mutex lock;
  static std::shared_ptr<const CaseSection> kept;
  static std::pair<std::size_t, std::size_t> n_kept;  // parts are never taken away
  const std::lock_guard guard(lock);
  const std::pair n{support_kinds().size(), thermal_kinds().size()};
  if (!kept || n != n_kept) kept = std::make_shared<const CaseSection>();
  n_kept = n;
  return kept;
}

/// Where a file named in the parameters is: beside the file that names it, or in `folder` where no file names it.
fs::path resolve_path(const Node& text, const fs::path& folder) {
  const auto& where = text.where();
  return (where.line == 0 ? folder : fs::path(where.file.text()).parent_path()) / text.text();
}

/// Stands for a geometry that cannot be read, so that the faults of everything else are found, too: it has every node that a case may name.
Node any_geometry() {
  constexpr int n_nodes = 1000;
  Node::Array nodes, elements;
  for (int id = 1; id <= n_nodes; ++id) nodes.push_back(Node::table({{"id", id}, {"x", 0.01 * id}}));
  for (int id = 1; id < n_nodes; ++id) elements.push_back(Node::table({{"n1", id}, {"n2", id + 1}, {"od", 0.1}}));
  return Node::table({{"material", Node::table({{"E", 2e11}, {"nu", 0.3}, {"rho", 7800.}})},
                      {"nodes", Node::array(std::move(nodes))},
                      {"elements", Node::array(std::move(elements))}});
}

/// Reads a file that a case names.
using ReadFile = std::function<Node(const fs::path&)>;

void load_rotor_geometry(Node& tree, const fs::path& folder, const ReadFile& read, Faults& faults) {
  Node* rotor = tree.find("rotor");
  if (!rotor || !rotor->is_table()) return;
  const Node* geometry = rotor->find("geometry");
  if (!geometry || !geometry->is_text()) return;
  const fs::path path = resolve_path(*geometry, folder);
  const SourcePosition key = position_of(*rotor, "geometry");
  std::error_code error;
  const auto status = fs::status(path, error);
  if (!fs::exists(status)) {
    const std::string& name = geometry->text();
    if (std::any_of(name.begin(), name.end(), [](unsigned char c) { return c < 0x20; })) {
      faults.add(geometry->where(), "rotor.geometry is not the name of a file: it holds a line break or the like.",
                 "In double quotes \\n and \\r mean one. In names of files write / for \\.");
      rotor->set("geometry", any_geometry(), key);
      return;
    }
    faults.add(geometry->where(), fmt::format("rotor.geometry = \"{}\": there is no such file.", name),
               fmt::format("Looked for {}{}.", path.string(),
                           status.type() == fs::file_type::none ? " (" + error.message() + ")" : ""));
    rotor->set("geometry", any_geometry(), key);
    return;
  }
  try {
    rotor->set("geometry", read(path), key);
  } catch (const InputError& fault) {
    faults.add(fault.faults());
    rotor->set("geometry", any_geometry(), key);
  }
}

/// A file is beside the one that names it, wherever the case is read from later.
void complete_path(Node* table, const char* key, const fs::path& folder) {
  const Node* file = table && table->is_table() ? table->find(key) : nullptr;
  if (!file || !file->is_text()) return;
  const SourcePosition where = position_of(*table, key);
  table->set(key, Node(fs::absolute(resolve_path(*file, folder)).lexically_normal().string(), file->where()), where);
}
void complete_paths(Node& tree, const fs::path& folder) {
  Node* thermal = tree.find("thermal");
  complete_path(thermal, "recorded", folder);
  complete_path(thermal && thermal->is_table() ? thermal->find(fe_name) : nullptr, "mesh", folder);
  Node* heat = tree.find("heat");
  Node* sources = heat && heat->is_table() ? heat->find("source") : nullptr;
  if (sources && sources->is_array())
    for (Node& source : sources->items()) complete_path(&source, "recorded", folder);
}

/// Parameters, such as "contact.air_gap" or "rotor.unbalance[0].me", by the places of their keys and values.
using ParametersByPlace = std::unordered_map<std::string, std::string>;
void collect_places(const Node& node, const std::string& path, ParametersByPlace& found) {
  const auto collect = [&](const Node& value, const SourcePosition& key, const std::string& own) {
    for (const auto& where : {key, value.where()})
      if (where.is_known()) found.emplace(to_string(where), own);
    collect_places(value, own, found);
  };
  if (node.is_table())
    for (const Node::Entry& entry : node.entries())
      collect(entry.value, entry.where, path.empty() ? entry.key : path + "." + entry.key);
  if (node.is_array())
    for (std::size_t i = 0; i < node.items().size(); ++i)
      collect(node.items()[i], node.items()[i].where(), fmt::format("{}[{}]", path, i));
}

/// Adds the parameters that faults are about, where a place tells them.
void add_keys(std::vector<Fault>& faults, const Node& tree) {
  constexpr std::string_view set = "--set ";
  ParametersByPlace places;
  if (!faults.empty()) collect_places(tree, "", places);
  for (Fault& fault : faults)
    // Tables that a setting has made stand at its place, too.
    if (fault.key.empty())
      fault.key = fault.where.file.text().starts_with(set)  ? fault.where.file.text().substr(set.size())
                  : places.contains(to_string(fault.where)) ? places.at(to_string(fault.where))
                                                            : "";
}

}  // namespace

std::vector<ErasedSection> case_sections() { return {case_section()->erased}; }

namespace {

/// What lies over a case's file.
struct Layers {
  const std::vector<Setting>& settings;
  fs::path folder = {};  ///< of files that are named there
};

/// What is done to each layer before it is laid over its base.
void complete_layer(Node& tree, const fs::path& file, const Node& base, LayerNotes& notes) {
  load_catalogue_bearings(tree, file, base, notes);
  spell_limits(tree, base, notes.faults);
}

/// Puts settings, files that the tree names, and built-in materials into a tree.
void complete_tree(Node& tree, const fs::path& file, const Layers& layers, const ReadFile& geometry,
                   LayerNotes& notes) {
  const auto& settings = layers.settings;
  Node over = Node::table(tree.where());
  const auto apply_to = [&](Node& to) {
    for (const Setting& setting : settings)
      if (!names_entry(setting)) apply_setting(to, setting);
  };
  apply_to(over);
  complete_layer(over, file, tree, notes);
  apply_to(tree);  // finds out whether each can be set
  spell_set_limits(tree);
  tree = merged(tree, over);
  drop_replaced_limits(tree);
  load_parts_of_case(tree, layers.folder);  // before the keys are declared, which are theirs, too
  load_common_catalogue(tree, file, notes.faults);
  set_entries(tree, settings);
  make_sets(tree, notes.faults);
  load_rotor_geometry(tree, layers.folder, geometry, notes.faults);
  complete_paths(tree, layers.folder);
  // Built-in materials lie under those that the case gives.
  const Node* materials = tree.find("materials");
  if (!materials)
    tree.set("materials", default_materials());
  else if (materials->is_table())
    tree.set("materials", merged(default_materials(), *materials), position_of(tree, "materials"));
}

/// What is said about a sound case.
enum class Words { none, warnings, warnings_and_text };

void add_words(const ErasedSection& declaration, Words words, Case& result) {
  if (words == Words::none) return;
  for (auto& warning : look_for_slips(*declaration, result.parameters, result.tree))
    result.warnings.push_back(std::move(warning));
  look_for_single_entries(result.tree, result.warnings);
  add_keys(result.warnings, result.tree);
  if (words == Words::warnings_and_text) result.resolved = resolve({declaration}, result.tree);
}

/// @param read  the tree of `file` with its bases
Case case_of(const fs::path& file, const Layers& layers, const std::function<Node(LayerNotes&)>& read,
             const ReadFile& geometry = read_geometry, Words words = Words::warnings_and_text) {
  Case result;
  result.file = file;
  result.name = file.stem().string();
  if (std::any_of(result.name.begin(), result.name.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }))
    throw InputError({file.string(), 0, 0}, "the name of this file holds a control character, such as a line break.",
                     "The case is called as the file: use letters, digits, - and _.");
  try {
    LayerNotes notes;
    Faults& faults = notes.faults;
    result.tree = read(notes);
    require_kind(result.tree, file, FileKind::drop);
    complete_tree(result.tree, file, layers, geometry, notes);
    const auto section = case_section();
    result.parameters = section->section.read(result.tree, faults);
    // What follows looks at several sections together, and so needs each of them sound.
    check_size(result.parameters, result.tree, faults);
    faults.throw_if_any();
    check_machine(result.parameters, result.tree, faults);
    check_length(result.parameters, result.tree, faults);
    check_output(result.parameters, result.tree, faults);
    faults.throw_if_any();
    if (result.parameters.rotor.balance_grade)
      result.parameters.rotor.unbalance = unbalance_by_grade(result.parameters);
    result.warnings = std::move(notes.warnings);
    add_words(section->erased, words, result);
    return result;
  } catch (const InputError& error) {
    std::vector<Fault> faults = error.faults();
    add_keys(faults, result.tree);
    throw InputError::with(std::move(faults));
  }
}

std::vector<Setting> settings_of(const std::vector<std::string>& overrides) {
  std::vector<Setting> settings;
  for (const auto& assignment : overrides) settings.push_back(read_setting(assignment));
  return settings;
}

CompleteLayer completing(LayerNotes& notes) {
  return [&notes](Node& tree, const fs::path& file, const Node& base) { complete_layer(tree, file, base, notes); };
}

/// A tree of no file, laid over its base.
Node with_base(Node tree, const fs::path& file, const fs::path& folder, LayerNotes& notes) {
  const CompleteLayer complete = completing(notes);
  const Node* base = tree.find("base");
  if (!base) {
    complete(tree, file, Node::table());
    return tree;
  }
  if (!base->is_text())
    throw InputError(base->where(), fmt::format("base is {}; it must be the name of a file.", kind_name(*base)));
  const Node under = read_toml(resolve_path(*base, folder), complete);
  tree.erase("base");
  complete(tree, file, under);
  return merged(under, tree);
}

Node read_named_toml(const fs::path& file, const CompleteLayer& complete) {
  look_for_file(file);
  return read_toml(file, complete);
}

}  // namespace

Case read_case(const fs::path& file, const std::vector<std::string>& overrides) {
  return case_of(file, {settings_of(overrides)},
                 [&](LayerNotes& notes) { return read_named_toml(file, completing(notes)); });
}

Case read_case_text(std::string_view text, const fs::path& folder, const std::string& name,
                    const std::vector<std::string>& overrides) {
  const fs::path file = folder / (name + ".toml");
  return case_of(file, {settings_of(overrides)},
                 [&](LayerNotes& notes) { return read_toml_text(text, file, completing(notes)); });
}

Case read_given_case(const GivenCase& given, const std::vector<Setting>& settings) {
  return case_of(given.file, {settings, given.folder}, [&](LayerNotes& notes) {
    if (given.tree) return with_base(*given.tree, given.file, given.folder, notes);
    return given.text ? read_toml_text(*given.text, given.file, completing(notes))
                      : read_named_toml(given.file, completing(notes));
  });
}

CaseFamily::CaseFamily(const fs::path& file) : file_(file) {
  LayerNotes notes;
  tree_ = read_named_toml(file, completing(notes));
  notes.faults.throw_if_any();
}

Case CaseFamily::read(const std::vector<std::string>& overrides, bool has_warnings) const {
  const auto geometry = [this](const fs::path& file) {
    const std::lock_guard guard(lock_);
    const auto found = geometries_.find(file);
    return found != geometries_.end() ? found->second : geometries_.emplace(file, read_geometry(file)).first->second;
  };
  return case_of(
      file_, {settings_of(overrides)}, [this](LayerNotes&) { return tree_; }, geometry,
      has_warnings ? Words::warnings : Words::none);
}

std::vector<std::string> chosen_touchdowns(const Case& c, const std::string& bearing) {
  const auto known = touchdown_names(c.parameters);
  if (bearing.empty()) return known;
  if (std::find(known.begin(), known.end(), bearing) != known.end()) return {bearing};
  throw InputError({"--bearing", 0, 0}, fmt::format("the case has no touchdown bearing \"{}\".", bearing),
                   suggestion(bearing, known, fmt::format("Its touchdown bearings: {}.", fmt::join(known, ", "))));
}

}  // namespace rotordrop
