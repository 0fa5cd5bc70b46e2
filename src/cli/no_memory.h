#pragma once
#include <string_view>

namespace rotordrop {

inline constexpr std::string_view no_memory =
    "error: there is not enough memory for this.\n       Choose a coarser mesh, fewer rows of results or a shorter "
    "input, or a machine with more memory.\n";

/// For std::set_terminate(): a library whose functions may not throw (toml++) ends the process where it finds no memory; it does so with these
/// words and exit code 1.
[[noreturn]] void end_without_handler();

}  // namespace rotordrop
