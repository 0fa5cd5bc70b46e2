#pragma once
#include <ctime>

namespace rotordrop {

/// CPU time that this process has used [s].
inline double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace rotordrop
