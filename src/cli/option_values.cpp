#include "cli/option_values.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace rotordrop {
namespace {

/// A line break in a name is most often a slip of quotes.
CLI::Validator is_name() {
  return CLI::Validator(
      [](std::string& word) {
        const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
        return std::any_of(word.begin(), word.end(), is_control)
                   ? "the name holds a control character, such as a line break"
                   : "";
      },
      "");
}

CLI::Validator is_given(const char* otherwise) {
  return CLI::Validator(
      [otherwise](std::string& word) { return word.find_first_not_of(" \t") == std::string::npos ? otherwise : ""; },
      "");
}

/// Options and arguments that name files or folders, by what help and completion call them.
std::vector<std::pair<std::string, std::string>> types_of_paths(const std::string& command) {
  const bool has_folder = command == "run" || command == "rerun" || command == "heat" || command == "preload";
  return {{"case", "CASE"},    {"directory", "DIR"}, {"results", command == "rerun" ? "FILE" : "DIR"},
          {"against", "DIR"},  {"measured", "FILE"}, {"shapes", "FILE"},
          {"diagram", "FILE"}, {"from", "FILE"},     {"output", has_folder ? "DIR" : "FILE"}};
}

std::vector<CLI::App*> commands_of(CLI::App& app) {
  return app.get_subcommands([](CLI::App*) { return true; });
}

/// Of a command and of the commands below it.
void refuse_empty_values(CLI::App& command, const std::vector<std::string>& names_of_paths) {
  for (auto* option : command.get_options()) {
    // An empty --set is answered with a form of a parameter setting.
    if (option->get_items_expected_max() == 0 || option->get_single_name() == "set") continue;
    const bool is_path =
        std::find(names_of_paths.begin(), names_of_paths.end(), option->get_single_name()) != names_of_paths.end();
    const char* const otherwise = is_path || option->get_positional() ? "the name is empty"
                                  : option->get_required()            ? "the value is empty"
                                                           : "the value is empty; write one, or leave the option out";
    option->transform(is_given(otherwise));  // before the checks that it has
  }
  for (auto* below : commands_of(command)) refuse_empty_values(*below, names_of_paths);
}

}  // namespace

void add_checks_of_values(CLI::App& app) {
  for (auto* command : commands_of(app)) {
    std::vector<std::string> names;
    for (const auto& [name, type] : types_of_paths(command->get_name())) {
      names.push_back(name);
      for (auto* option : command->get_options())
        if (option->get_single_name() == name) option->type_name(type)->check(is_name());
    }
    refuse_empty_values(*command, names);
  }
}

}  // namespace rotordrop
