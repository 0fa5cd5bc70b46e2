#include "integrate/sundials_version.h"

#include <sundials/sundials_version.h>

#include <array>

namespace rotordrop {

std::string sundials_version() {
  std::array<char, 64> text{};
  return SUNDIALSGetVersion(text.data(), static_cast<int>(text.size())) == 0 ? text.data() : "unknown";
}

}  // namespace rotordrop
