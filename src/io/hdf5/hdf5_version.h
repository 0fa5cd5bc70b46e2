#pragma once
#include <string>

namespace rotordrop {

/// "1.10.8".
std::string hdf5_version();

}  // namespace rotordrop
