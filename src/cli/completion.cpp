#include "cli/completion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "io/text/parameter_keys.h"

namespace rotordrop {
namespace {

/// What a shell offers for a word.
enum class Word { none, text, case_file, directory, file, parameter };

struct OptionWords {
  std::vector<std::string> short_names, long_names;  ///< without dashes
  std::string help;
  Word word = Word::none;
};
struct CommandWords {
  std::string name, help;
  std::vector<OptionWords> options;
  Word positional = Word::none;
  std::vector<std::string> choices;  ///< of the positional
};

Word word_of(const CLI::Option& option) {
  if (option.get_items_expected_max() == 0) return Word::none;
  const std::string type = option.get_type_name();
  if (type.starts_with("CASE")) return Word::case_file;
  if (type.starts_with("DIR")) return Word::directory;
  if (type.starts_with("FILE")) return Word::file;
  if (type.starts_with("KEY=VALUE")) return Word::parameter;
  return Word::text;
}

std::vector<CommandWords> commands_of(const CLI::App& app) {
  std::vector<CommandWords> commands;
  for (const auto* declared : app.get_subcommands([](const CLI::App*) { return true; })) {
    CommandWords command{declared->get_name(), declared->get_description(), {}, Word::none, {}};
    for (const auto* option : declared->get_options()) {
      if (option->get_positional())
        command.positional = word_of(*option);
      else
        command.options.push_back(
            {option->get_snames(), option->get_lnames(), option->get_description(), word_of(*option)});
    }
    if (command.name == "completion") command.choices = {"bash", "zsh", "fish"};
    if (command.name == "man") {
      for (const auto* other : app.get_subcommands([](const CLI::App*) { return true; }))
        command.choices.push_back(other->get_name());
      command.choices.emplace_back("case");
    }
    commands.push_back(std::move(command));
  }
  return commands;
}

/// In single quotes, as bash and zsh take them.
std::string in_quotes(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

struct KeyWords {
  std::string keys;                                                     ///< with spaces between
  std::vector<std::pair<std::string, std::vector<std::string>>> words;  ///< keys that take one of some words
};

KeyWords key_words(const std::vector<ErasedSection>& sections) {
  KeyWords result;
  for (const auto& key : parameter_keys(sections)) {
    result.keys += (result.keys.empty() ? "" : " ") + key.path;
    if (key.declaration->kind == Declaration::Kind::choice)
      result.words.emplace_back(key.path, key.declaration->choices);
    if (key.declaration->kind == Declaration::Kind::boolean)
      result.words.emplace_back(key.path, std::vector<std::string>{"true", "false"});
  }
  return result;
}

std::string all_names(const CommandWords& command) {
  std::string names;
  for (const auto& option : command.options) {
    for (const auto& name : option.short_names) names += (names.empty() ? "-" : " -") + name;
    for (const auto& name : option.long_names) names += (names.empty() ? "--" : " --") + name;
  }
  return names;
}

/// Options of all commands that are followed by such a word, as patterns of `case`.
std::string pattern_of(const std::vector<CommandWords>& commands, Word word) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const auto& command : commands)
    for (const auto& option : command.options)
      if (option.word == word) {
        for (const auto& name : option.short_names) add("-" + name);
        for (const auto& name : option.long_names) add("--" + name);
      }
  return fmt::format("{}", fmt::join(names, " | "));
}

std::string case_words(const KeyWords& keys, std::string_view line) {
  std::string text;
  for (const auto& [key, words] : keys.words) {
    std::string pattern = key;
    if (const auto name = pattern.find(".NAME."); name != std::string::npos) pattern.replace(name, 6, ".*.");
    text += fmt::format(fmt::runtime(line), pattern, fmt::join(words, " "));
  }
  return text;
}

constexpr std::string_view bash_functions = R"sh(
_rotordrop_choices() {
  case $1 in
@WORDS@  esac
}

# Keys of --set; NAME becomes the name that is being written: bearings.TB1.
_rotordrop_keys() {
  local named=NAME rest=${1#*.}
  [[ $1 == *.*.* ]] && named=${rest%%.*}
  printf '%s\n' ${_rotordrop_all_keys//NAME/$named}
}

_rotordrop_files() {  # KIND WORD
  compopt -o filenames 2>/dev/null
  case $1 in
    case) mapfile -t COMPREPLY < <(compgen -d -- "$2"; compgen -f -X '!*.toml' -- "$2") ;;
    directory) mapfile -t COMPREPLY < <(compgen -d -- "$2") ;;
    file) mapfile -t COMPREPLY < <(compgen -f -- "$2") ;;
  esac
}

_rotordrop() {
  local cur=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command= key= i
  COMPREPLY=()
  for ((i = 1; i < COMP_CWORD; i++)); do
    [[ ${COMP_WORDS[i]} != -* ]] && { command=${COMP_WORDS[i]}; break; }
  done
  if [[ -z $command ]]; then
    COMPREPLY=($(compgen -W "$_rotordrop_commands --help --version" -- "$cur"))
    return
  fi
  # bash takes "=" for a word of its own: KEY = VALUE.
  if [[ $before == "=" ]] && ((COMP_CWORD > 2)); then
    key=${COMP_WORDS[COMP_CWORD - 2]} before=${COMP_WORDS[COMP_CWORD - 3]}
  elif [[ $cur == "=" ]]; then
    key=$before before=${COMP_WORDS[COMP_CWORD - 2]} cur=
  fi
  [[ $key == --* ]] && before=$key key=
  cur=${cur#[\"\']} key=${key#[\"\']}
  case $before in
    --set)
      if [[ -n $key ]]; then
        COMPREPLY=($(compgen -W "$(_rotordrop_choices "$key")" -- "$cur"))
      else
        COMPREPLY=($(compgen -S = -W "$(_rotordrop_keys "$cur")" -- "$cur"))
        compopt -o nospace 2>/dev/null
      fi
      return ;;
@OPTIONS@  esac
  case $command in
@COMMANDS@  esac
}
complete -F _rotordrop rotordrop
)sh";

void replace(std::string& text, std::string_view mark, const std::string& by) {
  text.replace(text.find(mark), mark.size(), by);
}

std::string bash_script(const std::vector<CommandWords>& commands, const KeyWords& keys) {
  std::string names, options, by_command;
  for (const auto& command : commands) names += (names.empty() ? "" : " ") + command.name;
  for (const auto& [word, action] :
       {std::pair(Word::directory, "_rotordrop_files directory \"$cur\"; return"),
        std::pair(Word::file, "_rotordrop_files file \"$cur\"; return"), std::pair(Word::text, "return")})
    if (const auto pattern = pattern_of(commands, word); !pattern.empty())
      options += fmt::format("    {}) {} ;;\n", pattern, action);
  for (const auto& command : commands) {
    const std::string action = !command.choices.empty() ? fmt::format("COMPREPLY=($(compgen -W '{}' -- \"$cur\"))",
                                                                      fmt::join(command.choices, " "))
                               : command.positional == Word::case_file ? "_rotordrop_files case \"$cur\""
                               : command.positional == Word::directory ? "_rotordrop_files directory \"$cur\""
                                                                       : ":";
    by_command += fmt::format(
        "    {})\n      if [[ $cur == -* ]]; then COMPREPLY=($(compgen -W '{}' -- \"$cur\"))\n      else {}; fi ;;\n",
        command.name, all_names(command), action);
  }
  std::string functions(bash_functions);
  replace(functions, "@WORDS@", case_words(keys, "    {}) echo '{}' ;;\n"));
  replace(functions, "@OPTIONS@", options);
  replace(functions, "@COMMANDS@", by_command);
  return fmt::format(
      "# Completion of rotordrop for bash; made by `rotordrop completion bash`.\n_rotordrop_commands='{}'\n"
      "_rotordrop_all_keys='{}'\n{}",
      names, keys.keys, functions);
}

/// What _arguments of zsh offers for a word.
std::string zsh_action(Word word) {
  switch (word) {
    case Word::none:
      return "";
    case Word::text:
      return ":value: ";
    case Word::case_file:
      return ":case:_files -g \"*.toml\"";
    case Word::directory:
      return ":directory:_files -/";
    case Word::file:
      return ":file:_files";
    case Word::parameter:
      return ":parameter:_rotordrop_set";
  }
  return "";
}

std::string zsh_help(std::string text) {
  for (const char c : {'[', ']', ':'})
    for (auto at = text.find(c); at != std::string::npos; at = text.find(c, at + 2)) text.insert(at, 1, '\\');
  return text;
}

constexpr std::string_view zsh_functions = R"sh(
_rotordrop_choices() {
  case $1 in
@WORDS@  esac
}

# KEY=VALUE: keys, then the words that the key takes. NAME becomes the name that is being written.
_rotordrop_set() {
  local word=$PREFIX named=NAME rest
  if [[ $word == *=* ]]; then
    compset -P '*='
    compadd -- $(_rotordrop_choices ${word%%=*})
  else
    rest=${word#*.}
    [[ $word == *.*.* ]] && named=${rest%%.*}
    compadd -S = -- ${(s: :)${_rotordrop_all_keys//NAME/$named}}
  fi
}

_rotordrop() {
  local state
  _arguments -C '(-)'{-h,--help}'[print help]' '(-)--version[print the version]' '1: :->command' '*:: :->rest'
  case $state in
    command) _describe command _rotordrop_commands ;;
    rest)
      case $words[1] in
@COMMANDS@      esac ;;
  esac
}
if [ "$funcstack[1]" = "_rotordrop" ]; then _rotordrop "$@"; else compdef _rotordrop rotordrop; fi
)sh";

std::string zsh_script(const std::vector<CommandWords>& commands, const KeyWords& keys) {
  std::string names, by_command;
  for (const auto& command : commands) {
    names += "  " + in_quotes(command.name + ":" + zsh_help(command.help)) + "\n";
    by_command += fmt::format("        {}) _arguments", command.name);
    for (const auto& option : command.options) {
      const std::string repeat = option.word == Word::parameter ? "*" : "";
      const auto add = [&](const std::string& name) {
        by_command +=
            " \\\n          " + in_quotes(repeat + name + "[" + zsh_help(option.help) + "]" + zsh_action(option.word));
      };
      for (const auto& name : option.short_names) add("-" + name);
      for (const auto& name : option.long_names) add("--" + name);
    }
    if (!command.choices.empty())
      by_command += " \\\n          " + in_quotes(fmt::format("1:word:({})", fmt::join(command.choices, " ")));
    else if (command.positional != Word::none)
      by_command += " \\\n          " + in_quotes("1" + zsh_action(command.positional));
    by_command += " ;;\n";
  }
  std::string functions(zsh_functions);
  replace(functions, "@WORDS@", case_words(keys, "    {}) echo {} ;;\n"));
  replace(functions, "@COMMANDS@", by_command);
  return fmt::format(
      "#compdef rotordrop\n# Completion of rotordrop for zsh; made by `rotordrop completion zsh`.\n"
      "typeset -ga _rotordrop_commands=(\n{})\ntypeset -g _rotordrop_all_keys='{}'\n{}",
      names, keys.keys, functions);
}

constexpr std::string_view fish_functions = R"sh(
function __rotordrop_choices
  switch $argv[1]
@WORDS@  end
end

# KEY=VALUE: keys, then the words that the key takes. NAME becomes the name that is being written.
function __rotordrop_set
  set -l word (commandline -ct | string trim -c '"\'')
  if string match -q -- '*=*' $word
    set -l key (string replace -r '=.*' '' -- $word)
    for choice in (__rotordrop_choices $key)
      echo $key=$choice
    end
  else
    set -l named NAME
    set -l parts (string split . -- $word)
    test (count $parts) -gt 2; and set named $parts[2]
    for key in (string split ' ' -- $__rotordrop_all_keys)
      echo (string replace NAME $named -- $key)=
    end
  end
end

complete -c rotordrop -f
complete -c rotordrop -n __fish_use_subcommand -l help -d 'Print help'
complete -c rotordrop -n __fish_use_subcommand -l version -d 'Print the version'
)sh";

std::string fish_quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return result + "'";
}

std::string fish_script(const std::vector<CommandWords>& commands, const KeyWords& keys) {
  std::string functions(fish_functions), lines;
  std::string words;
  for (const auto& [key, choices] : keys.words) {
    std::string pattern = key;
    if (const auto name = pattern.find(".NAME."); name != std::string::npos) pattern.replace(name, 6, ".*.");
    words += fmt::format("    case '{}'\n      printf '%s\\n' {}\n", pattern, fmt::join(choices, " "));
  }
  replace(functions, "@WORDS@", words);
  for (const auto& command : commands) {
    lines += fmt::format("complete -c rotordrop -n __fish_use_subcommand -a {} -d {}\n", command.name,
                         fish_quoted(command.help));
    const std::string seen = fmt::format("complete -c rotordrop -n '__fish_seen_subcommand_from {}'", command.name);
    for (const auto& option : command.options) {
      lines += seen;
      for (const auto& name : option.short_names) lines += " -s " + name;
      for (const auto& name : option.long_names) lines += " -l " + name;
      lines += option.word == Word::directory   ? " -x -a '(__fish_complete_directories)'"
               : option.word == Word::file      ? " -r -F"
               : option.word == Word::parameter ? " -x -a '(__rotordrop_set)'"
               : option.word == Word::text      ? " -x"
                                                : "";
      lines += " -d " + fish_quoted(option.help) + "\n";
    }
    if (!command.choices.empty())
      lines += fmt::format("{} -a '{}'\n", seen, fmt::join(command.choices, " "));
    else if (command.positional == Word::case_file)
      lines += seen + " -k -a '(__fish_complete_suffix .toml)'\n";
    else if (command.positional == Word::directory)
      lines += seen + " -a '(__fish_complete_directories)'\n";
  }
  return fmt::format(
      "# Completion of rotordrop for fish; made by `rotordrop completion fish`.\n"
      "set -g __rotordrop_all_keys '{}'\n{}{}",
      keys.keys, functions, lines);
}

}  // namespace

std::string completion_script(const CLI::App& app, const std::string& shell,
                              const std::vector<ErasedSection>& sections) {
  const auto commands = commands_of(app);
  const auto keys = key_words(sections);
  if (shell == "bash") return bash_script(commands, keys);
  if (shell == "zsh") return zsh_script(commands, keys);
  return fish_script(commands, keys);
}

}  // namespace rotordrop
