#include "machine/supports.h"

#include <algorithm>
#include <stdexcept>

namespace rotordrop {
namespace {

std::vector<SupportKind>& registered() {
  static std::vector<SupportKind> kinds;
  return kinds;
}

}  // namespace

const std::vector<SupportKind>& support_kinds() { return registered(); }

void add_support_kind(SupportKind kind) {
  const bool is_known = kind.type == "touchdown" || kind.type == "linear" || kind.type == "magnet" ||
                        std::any_of(registered().begin(), registered().end(),
                                    [&](const SupportKind& other) { return other.type == kind.type; });
  if (is_known) throw std::invalid_argument("there is a kind of support \"" + kind.type + "\" already");
  registered().push_back(std::move(kind));
}

}  // namespace rotordrop
