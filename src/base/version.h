#pragma once

namespace rotordrop {

/// "0.2.0".
const char* version();
/// "rotordrop 0.2.0", as results name it.
const char* program_name();
/// Short git revision that the program was built from, "+" behind it if files were changed since; "unknown" outside a checkout.
const char* git_revision();

}  // namespace rotordrop
