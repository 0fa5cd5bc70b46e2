#include "base/version.h"

#include "rotordrop_git_revision.h"

namespace rotordrop {

const char* version() { return ROTORDROP_VERSION; }
const char* program_name() { return "rotordrop " ROTORDROP_VERSION; }
const char* git_revision() { return ROTORDROP_GIT_REVISION; }

}  // namespace rotordrop
