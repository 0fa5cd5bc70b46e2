#include "base/wide_vectors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <optional>

#include "base/errors.h"

namespace rotordrop {
namespace {

constexpr const char* names[] = {"base", "v3", "v4", "v4-newton"};  // in the order of VectorLevel

bool machine_has(VectorLevel level) {
#if defined(__x86_64__) && defined(__clang__)  // clang 14 knows features only, not levels
  __builtin_cpu_init();
  const bool has_v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                      __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
  if (level >= VectorLevel::v4)
    return has_v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl");
  if (level == VectorLevel::v3) return has_v3;
#elif defined(__x86_64__)
  __builtin_cpu_init();
  if (level >= VectorLevel::v4) return __builtin_cpu_supports("x86-64-v4");
  if (level == VectorLevel::v3) return __builtin_cpu_supports("x86-64-v3");
#endif
  return level == VectorLevel::base;
}

bool has_slow_roots() {
#if defined(__x86_64__)
  return __builtin_cpu_is("intel");
#else
  return false;
#endif
}

std::optional<VectorLevel> level_called(const std::string& name) {
  const auto found = std::find(std::begin(names), std::end(names), name);
  if (found == std::end(names)) return {};
  return static_cast<VectorLevel>(found - std::begin(names));
}

VectorLevel chosen() {
  if (const char* asked = std::getenv("ROTORDROP_ISA"))
    if (const auto level = level_called(asked); level && machine_has(*level)) return *level;
  if (machine_has(VectorLevel::v4)) return has_slow_roots() ? VectorLevel::v4_newton : VectorLevel::v4;
  return machine_has(VectorLevel::v3) ? VectorLevel::v3 : VectorLevel::base;
}

}  // namespace

const VectorLevel vector_level = chosen();

std::string name_of(VectorLevel level) { return names[static_cast<std::size_t>(level)]; }

void check_vector_level() {
  const char* asked = std::getenv("ROTORDROP_ISA");
  if (!asked) return;
  const auto level = level_called(asked);
  if (!level)
    throw InputError({"ROTORDROP_ISA", 0, 0}, "\"" + std::string(asked) + "\" is no instruction set.",
                     fmt::format("Allowed: {}.", fmt::join(names, ", ")));
  if (!machine_has(*level))
    throw InputError({"ROTORDROP_ISA", 0, 0}, "this machine does not have the instruction set " + name_of(*level) + ".",
                     "It has " + name_of(chosen()) + "; leave ROTORDROP_ISA out to have the best there is.");
}

}  // namespace rotordrop
