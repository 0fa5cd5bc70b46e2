#pragma once
#include <filesystem>
#include <string_view>

#include "case/case.h"

namespace rotordrop {

/// Reads and checks the text of a case that is in no file. @throws InputError with all faults
/// @param folder  where files that it names, such as its base, are looked for
/// @param name    what the case is called, also in messages
Case read_case_text(std::string_view text, const std::filesystem::path& folder, const std::string& name = "case",
                    const std::vector<std::string>& overrides = {});

}  // namespace rotordrop
