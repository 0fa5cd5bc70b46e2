#pragma once
// Texts that shells and `man` read, from the declarations of the commands and of the parameters.
#include <string>
#include <vector>

#include "base/parameters/declaration.h"

namespace CLI {
class App;
}

namespace rotordrop {

/// A script that completes commands, options, files, keys of --set and the words that such a key takes.
/// @param shell     "bash", "zsh" or "fish"
/// @param sections  declarations of the keys that --set takes
[[nodiscard]] std::string completion_script(const CLI::App& app, const std::string& shell,
                                            const std::vector<ErasedSection>& sections);

/// A manual page in the format of man(7).
/// @param topic  empty: the program; the name of a command; "case": the parameters of a case
/// @throws InputError for an unknown topic
[[nodiscard]] std::string manual_page(const CLI::App& app, const std::string& topic,
                                      const std::vector<ErasedSection>& sections);

}  // namespace rotordrop
