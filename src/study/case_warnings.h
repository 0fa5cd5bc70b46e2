#pragma once
#include <string>
#include <vector>

#include "study/case.h"

namespace rotordrop {

/// What is valid in a case but leaves out an effect that the case has; a sentence each, with what to do.
std::vector<std::string> case_warnings(const Case& c);

}  // namespace rotordrop
