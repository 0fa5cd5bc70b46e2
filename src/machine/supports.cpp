#include "machine/supports.h"

#include <algorithm>
#include <mutex>
#include <stdexcept>

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

}  // namespace

std::vector<SupportKind> support_kinds() {
  const std::lock_guard guard(registry().lock);
  return registry().kinds;
}

void add_support_kind(SupportKind kind) {
  const std::lock_guard guard(registry().lock);
  auto& kinds = registry().kinds;
  const bool is_known =
      kind.type == "touchdown" || kind.type == "linear" || kind.type == "magnet" ||
      std::any_of(kinds.begin(), kinds.end(), [&](const SupportKind& other) { return other.type == kind.type; });
  if (is_known) throw std::invalid_argument("there is a kind of support \"" + kind.type + "\" already");
  kinds.push_back(std::move(kind));
}

}  // namespace rotordrop
