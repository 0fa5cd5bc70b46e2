#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/parameters/declaration.h"

namespace rotordrop {

/// One parameter as `--set` takes it.
struct ParameterKey {
  std::string path;  ///< "run.end_time"; "bearings.NAME.rows", where NAME stands for the name of any table
  const Declaration* declaration;
};

/// Every key of the declarations that takes one value, in their order. A key that [bearings] may give to all bearings
/// comes twice, with and without NAME; lists of tables come as one key.
[[nodiscard]] std::vector<ParameterKey> parameter_keys(const std::vector<ErasedSection>& sections);

/// A word as a POSIX shell takes it: in quotes if it needs them.
[[nodiscard]] std::string shell_quoted(const std::string& word);

/// The option that sets a key as its writer most likely meant it, ready for the shell:
/// --set 'rotor.initial_offset=["1 um", "2 um"]'.
///
/// Typographic and unpaired quotes are taken away, and texts within lists are quoted. A value in a key that takes a list
/// gets brackets, a number in a key that takes a text gets quotes. Empty if nothing is clear.
/// @param sections  declarations that know the key; may be empty
/// @param value     as given, without the key
[[nodiscard]] std::string right_form(const std::vector<ErasedSection>& sections, const std::string& key,
                                     std::string_view value);

/// Whether a text holds a further assignment behind its value: "0.05,run.end_time=1", "0.05 run.end_time=1". Returns the
/// parts; one part for an ordinary assignment.
[[nodiscard]] std::vector<std::string> assignments_in(std::string_view text);

}  // namespace rotordrop
