#pragma once
#include <string>

namespace rotordrop {

/// "6.4.1".
std::string sundials_version();

}  // namespace rotordrop
