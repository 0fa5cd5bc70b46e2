#pragma once
#include <string>

namespace rotordrop {

/// What the processor calls itself, "AMD EPYC 7B13"; "unknown" if the system does not say. Another one may choose other instructions, and so round
/// otherwise.
[[nodiscard]] std::string processor_name();

}  // namespace rotordrop
