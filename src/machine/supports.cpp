#include "machine/supports.h"

#include <algorithm>
#include <mutex>
#include <stdexcept>

#include "base/parameters/declared_keys.h"

namespace rotordrop {
namespace {

/// Kinds of ours that need nothing but their keys: support_kind_of("NAME", section, make).
std::vector<SupportKind> own_kinds() { return {}; }

struct Registry {
  std::mutex lock;
  std::vector<SupportKind> kinds = own_kinds();
};
Registry& registry() {
  static Registry kinds;
  return kinds;
}

bool is_known(const std::string& type) {
  const auto& kinds = registry().kinds;
  return type == "touchdown" || type == "linear" || type == "magnet" ||
         std::any_of(kinds.begin(), kinds.end(), [&](const SupportKind& other) { return other.type == type; });
}

/// With the registry's lock.
void require_sound(const SupportKind& kind) {
  if (const auto fault = fault_of_name("a kind of support", kind.type); !fault.empty())
    throw std::invalid_argument(fault);
  if (is_known(kind.type)) throw std::invalid_argument("there is a kind of support \"" + kind.type + "\" already");
  if (!kind.section || !kind.read)
    throw std::invalid_argument("the kind of support \"" + kind.type +
                                "\" has no keys, or nothing reads them: make it by support_kind_of()");
  if (const std::string fault = fault_of_keys(*kind.section, {"type"}); !fault.empty())
    throw std::invalid_argument("kind of support \"" + kind.type + "\": " + fault);
}

}  // namespace

std::vector<SupportKind> support_kinds() {
  const std::lock_guard guard(registry().lock);
  return registry().kinds;
}

void check_support_kind(const SupportKind& kind) {
  const std::lock_guard guard(registry().lock);
  require_sound(kind);
}

void add_support_kind(SupportKind kind) {
  const std::lock_guard guard(registry().lock);
  require_sound(kind);
  registry().kinds.push_back(std::move(kind));
}

}  // namespace rotordrop
