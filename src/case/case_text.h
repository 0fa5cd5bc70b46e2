#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "case/case.h"
#include "io/text/toml_reader.h"

namespace rotordrop {

/// Reads and checks the text of a case that is in no file. @throws InputError with all faults
/// @param folder  where files that it names, such as its base, are looked for
/// @param name    what the case is called, also in messages
Case read_case_text(std::string_view text, const std::filesystem::path& folder, const std::string& name = "case",
                    const std::vector<std::string>& overrides = {});

/// A case as a program gives it: by the text of a file, by values, or by a file's name alone.
struct GivenCase {
  std::filesystem::path file;  ///< read if there is no text or tree; files that a text names are looked for beside it
  std::optional<std::string> text;  ///< TOML
  std::optional<Node> tree;         ///< values
  std::filesystem::path folder;  ///< where files are looked for that values or settings name; empty: the working folder
};
/// Reads and checks it. @throws InputError with all faults
/// @param settings  laid over it, in their order
Case read_given_case(const GivenCase& given, const std::vector<Setting>& settings);

}  // namespace rotordrop
