#pragma once
// Answers to command lines that cannot be understood: what was meant, and how to write it.
#include <string>
#include <vector>

#include "base/errors.h"
#include "base/parameters/declaration.h"

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace rotordrop {

/// What to tell about a command line that does not parse: an unknown command or option with the one that may be meant,
/// and a --set that the shell took apart with its right form.
/// @param arguments  without the program's name
/// @param sections   declarations of the keys that --set takes
[[nodiscard]] std::string explained(const CLI::App& app, const CLI::ParseError& error,
                                    const std::vector<std::string>& arguments,
                                    const std::vector<ErasedSection>& sections);

/// The same faults; those about a value given with --set also say how to write it, if it can be written otherwise.
/// @param overrides  such as "contact.friction_coefficient=0.05"
[[nodiscard]] InputError with_right_forms(const InputError& error, const std::vector<std::string>& overrides,
                                          const std::vector<ErasedSection>& sections);

}  // namespace rotordrop
