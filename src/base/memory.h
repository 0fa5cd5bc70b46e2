#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

namespace rotordrop {

/// With less left, libraries of others end the process instead of telling it [bytes]. Measured of METIS, TBB and gmsh: below 60 MB.
inline constexpr std::uint64_t memory_of_libraries = 64'000'000;

/// Address space of this process [bytes]; 0: not known.
[[nodiscard]] std::uint64_t own_memory();
/// How much more of it the process may take (`ulimit -v`) [bytes]; the largest number if nothing limits it.
[[nodiscard]] std::uint64_t memory_left();

/// Large pages of x86-64, and of 64-bit ARM with small pages of 4 kB [bytes].
inline constexpr std::size_t large_page = std::size_t{2} << 20;

/// What the process can have at most: the machine's memory, or less if `ulimit -v` says so [bytes].
[[nodiscard]] std::uint64_t most_memory();

/// Touches room that the next allocations take, all of it at once and in large pages where the system has them: a first touch of each small page alone costs
/// several times as much (docs/performance.md). A hint: does nothing where the system cannot, or has no room.
/// @param bytes  at most 30 MB: the heap of glibc gives out no larger block
void make_heap_ready(std::size_t bytes);

/// "463 kB", "2.1 GB".
[[nodiscard]] std::string bytes_in_words(double bytes);

}  // namespace rotordrop
