#pragma once
// The commands as they stand on the command line: names, options and help.
#include <functional>
#include <vector>

namespace CLI {
class App;
}

namespace rotordrop {

/// A command of the program. What its options write to belongs to `run`.
struct OfferedCommand {
  const CLI::App* command;
  std::function<int()> run;  ///< returns the exit code
};

/// Adds all commands to the program, in the order of its help.
[[nodiscard]] std::vector<OfferedCommand> offer_commands(CLI::App& app);

}  // namespace rotordrop
