#include "case/modules/parts_modules.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <cstdint>
#include <cstdlib>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/errors.h"
#include "base/utf8.h"
#include "case/modules/cut_off.h"
#include "case/modules/load_module.h"
#include "case/program_files.h"
#include "machine/others/guarded_parts.h"
#include "machine/parts_module.h"

namespace rotordrop {
namespace {

namespace fs = std::filesystem;

constexpr const char* how_to_build = "docs/how-to/extending.md tells how a module of parts is made and built.";

/// Collects what a module adds; the program takes it over when all of it is there.
class Collected final : public PartsRegistry {
 public:
  explicit Collected(std::string file) : file_(std::move(file)) {}
  void add(SupportKind kind) override { supports_.push_back(guarded(std::move(kind), file_)); }
  void add(ThermalKind kind) override { thermal_.push_back(guarded(std::move(kind), file_)); }
  [[nodiscard]] bool is_empty() const { return supports_.empty() && thermal_.empty(); }
  /// All or none: a case that names the module again finds it as it was.
  void hand_over() {
    for (const auto& kind : supports_) check_support_kind(kind);
    for (const auto& kind : thermal_) check_thermal_kind(kind);
    require_different(supports_, &SupportKind::type);
    require_different(thermal_, &ThermalKind::name);
    for (auto& kind : supports_) add_support_kind(std::move(kind));
    for (auto& kind : thermal_) add_thermal_kind(std::move(kind));
  }

 private:
  template <class Kind>
  static void require_different(const std::vector<Kind>& kinds, std::string Kind::*name) {
    std::set<std::string> known;
    for (const auto& kind : kinds)
      if (!known.insert(kind.*name).second) throw std::invalid_argument("it adds \"" + kind.*name + "\" twice");
  }
  std::string file_;
  std::vector<SupportKind> supports_;
  std::vector<ThermalKind> thermal_;
};

/// Throws unless the module was built for this program; adds its parts.
void add_parts_of(void* module, const std::string& file, const SourcePosition& where) {
  auto* const interface = reinterpret_cast<PartsInterface*>(address_in(module, parts_interface_name));
  auto* const add_parts = reinterpret_cast<AddParts*>(address_in(module, add_parts_name));
  if (!interface || !add_parts)
    throw InputError(where, fmt::format("{} is not a module of parts: it has no ROTORDROP_PARTS(...).", file),
                     how_to_build);
  if (const std::string theirs = interface(), ours = parts_interface(); theirs != ours)
    throw InputError(
        where, fmt::format("{} was built for another version of the program.", file),
        fmt::format("It is for \"{}\", this is \"{}\". Build it again against this installation.", theirs, ours));
  Collected parts(file);
  try {
    add_parts(parts);
    if (parts.is_empty()) throw std::invalid_argument("it adds no part");
    parts.hand_over();
  } catch (const std::exception& error) {
    throw InputError(where,
                     fmt::format("{} cannot add its parts: {}.", file,
                                 is_utf8(error.what()) ? error.what() : "its message is no UTF-8"),
                     how_to_build);
  } catch (...) {
    throw InputError(where, fmt::format("{} cannot add its parts: it threw what is no std::exception.", file),
                     how_to_build);
  }
}

/// The file that a name in run.parts means; none if it is not there.
std::optional<fs::path> found(const fs::path& name, const fs::path& folder) {
  std::error_code ignored;
  std::vector<fs::path> places = {name.is_absolute() ? name : folder / name};
  if (!name.has_parent_path()) places.push_back(module_file(name.string()));
  for (const auto& place : places)
    if (fs::is_regular_file(place, ignored)) return fs::absolute(place).lexically_normal();
  return {};
}

/// What tells whether a file is still the one that it was.
struct FileIdentity {
  dev_t device = 0;
  ino_t number = 0;
  off_t size = 0;
  std::int64_t seconds = 0, nanoseconds = 0;  // of its last change
  bool operator==(const FileIdentity&) const = default;
};

FileIdentity identity_of(const fs::path& file) {
  struct stat found {};
  if (stat(file.c_str(), &found) != 0) return {};
  return {found.st_dev, found.st_ino, found.st_size, found.st_mtim.tv_sec, found.st_mtim.tv_nsec};
}

}  // namespace

void load_parts_module(const fs::path& file, const SourcePosition& where) {
  static std::mutex lock;
  static std::map<std::string, FileIdentity> loaded;
  const std::lock_guard guard(lock);
  std::error_code error;
  const fs::path real = fs::canonical(file, error);
  if (error) throw InputError(where, fmt::format("there is no module {}: {}.", file.string(), error.message()));
  if (const auto known = loaded.find(real.string()); known != loaded.end()) {
    if (known->second == identity_of(real)) return;
    throw InputError(where, fmt::format("the module {} has changed since this process loaded it.", file.string()),
                     "A process keeps what it loaded: start it (Python, a notebook's kernel) again.");
  }
  if (is_cut_off(real))
    throw InputError(where, fmt::format("the module {} is not whole: it ends before its tables do.", file.string()),
                     "Copy or build it again.");
  const FileIdentity identity = identity_of(real);
  std::string why;
  void* const module = load_module(real, Symbols::at_once, why);
  if (!module)
    throw InputError(where, fmt::format("the module {} cannot be loaded: {}.", file.string(), why), how_to_build);
  add_parts_of(module, file.string(), where);
  loaded.emplace(real.string(), identity);
}

void load_parts_of_environment() {
  const char* listed = std::getenv("ROTORDROP_PARTS");
  std::string rest = listed ? listed : "";
  while (!rest.empty()) {
    const auto end = rest.find(':');
    if (const std::string file = rest.substr(0, end); !file.empty()) load_parts_module(file, {"ROTORDROP_PARTS", 0, 0});
    rest = end == std::string::npos ? "" : rest.substr(end + 1);
  }
}

void load_parts_of_case(Node& tree, const fs::path& working_folder) {
  Node* run = tree.find("run");
  Node* parts = run && run->is_table() ? run->find("parts") : nullptr;
  if (!parts || !parts->is_array()) return;  // a fault of the case, found when its keys are read
  for (Node& name : parts->items()) {
    if (!name.is_text() || name.text().empty()) continue;
    const SourcePosition where = name.where();
    const fs::path folder = where.line == 0 ? working_folder : fs::path(where.file.text()).parent_path();
    const auto file = found(name.text(), folder);
    if (!file)
      throw InputError(
          where, fmt::format("run.parts: there is no file \"{}\".", name.text()),
          fmt::format("Looked for {}{}.", (folder / name.text()).string(),
                      fs::path(name.text()).has_parent_path() ? "" : " and " + module_file(name.text()).string()));
    load_parts_module(*file, where);
    name = Node(file->string(), where);
  }
}

}  // namespace rotordrop
