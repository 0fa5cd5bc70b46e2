#pragma once
// Checks of what is given for options and arguments, whatever the command.

namespace CLI {
class App;
}  // namespace CLI

namespace rotordrop {

/// Gives options and arguments that name files or folders their types for help and completion, and refuses names with control characters.
/// Refuses empty names and values of all commands: most often a shell's variable that was never set.
void add_checks_of_values(CLI::App& app);

}  // namespace rotordrop
