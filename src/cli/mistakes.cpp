#include "cli/mistakes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "base/parameters/suggestion.h"
#include "base/quantity_list.h"
#include "io/text/parameter_keys.h"

namespace rotordrop {
namespace {

std::vector<std::string> names_of_commands(const CLI::App& app) {
  std::vector<std::string> names;
  for (const auto* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

std::vector<std::string> names_of_options(const CLI::App& command) {
  std::vector<std::string> names;
  for (const auto* option : command.get_options())
    for (const auto& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::string did_you_mean(const std::string& guess) {
  return guess.empty() ? "" : fmt::format("Did you mean {}?  ", guess);
}

/// Of a command line without a command: the word that should have been one.
std::string about_command(const CLI::App& app, const std::vector<std::string>& arguments) {
  const auto known = names_of_commands(app);
  const auto word = std::find_if(arguments.begin(), arguments.end(), [](const auto& a) { return !a.starts_with("-"); });
  if (word == arguments.end())
    return fmt::format("error: no command is given.\n       Commands: {}.\n", fmt::join(known, ", "));
  if (std::filesystem::path(*word).extension() == ".toml")
    return fmt::format("error: no command is given for {}.\n       To run it: rotordrop run {}   Commands: {}.\n",
                       *word, shell_quoted(*word), fmt::join(known, ", "));
  // A part of a name is meant as the name: "critical" for critical-speeds.
  std::string guess = closest_name(*word, known);
  for (const auto& name : known)
    if (guess.empty() && word->size() > 2 && (name.starts_with(*word) || word->starts_with(name))) guess = name;
  return fmt::format("error: there is no command \"{}\".\n       {}Commands: {}.\n", *word, did_you_mean(guess),
                     fmt::join(known, ", "));
}

bool ends_assignment(const std::string& word) {
  if (word.starts_with("--") || std::filesystem::path(word).extension() == ".toml") return true;
  return word.size() == 2 && word[0] == '-' && std::isalpha(static_cast<unsigned char>(word[1]));
}

/// How the words that follow each --set belong together; only those that the shell took apart.
std::string about_overrides(const std::vector<std::string>& arguments, const std::vector<ErasedSection>& sections) {
  std::string text;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    std::string whole;
    std::size_t n_words = 0;
    if (arguments[i].starts_with("--set=")) {
      whole = arguments[i].substr(std::string_view("--set=").size());
      n_words = 1;
    } else if (arguments[i] == "--set" || arguments[i] == "-set") {
      n_words = arguments[i] == "-set" ? 1 : 0;  // worth a word even if the rest is right
    } else {
      continue;
    }
    const std::size_t first = i;
    while (i + 1 < arguments.size() && !ends_assignment(arguments[i + 1])) {
      whole += (whole.empty() ? "" : " ") + arguments[++i];
      ++n_words;
    }
    if (n_words < 2) continue;
    std::string forms;
    for (const auto& part : assignments_in(whole)) {
      // KEY = VALUE, KEY VALUE and KEY: VALUE.
      auto end = part.find('=');
      if (end == std::string::npos) end = part.find_first_of(" :");
      if (end == std::string::npos) continue;
      const std::string key = part.substr(0, part.find_last_not_of(" :", end - 1) + 1);
      const std::string form = right_form(sections, key, std::string_view(part).substr(end + 1));
      forms += (forms.empty() ? "" : " ") + (form.empty() ? "--set " + shell_quoted(part) : form);
    }
    if (forms.empty()) continue;
    std::vector<std::string> given(arguments.begin() + static_cast<std::ptrdiff_t>(first),
                                   arguments.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    text += fmt::format(
        "error: {}: --set takes one word for the shell, KEY=VALUE without spaces or in quotes.\n"
        "       Write it as: {}\n",
        fmt::join(given, " "), forms);
  }
  return text;
}

bool begins_with_number(const std::string& word) {
  const auto first = word.find_first_not_of("+-.");
  return first != std::string::npos && first < 3 && std::isdigit(static_cast<unsigned char>(word[first]));
}

/// The option whose value the shell took apart at spaces, from the option to the word; empty if there is none.
std::vector<std::string> value_around(const CLI::App& command, const std::vector<std::string>& arguments,
                                      const std::string& word) {
  for (auto end = arguments.end(); end != arguments.begin(); --end) {
    if (*(end - 1) != word) continue;
    auto begin = end;
    while (begin != arguments.begin() && (!(begin - 1)->starts_with("-") || begins_with_number(*(begin - 1)))) --begin;
    if (begin == arguments.begin()) return {};
    const auto* option = command.get_option_no_throw(*(begin - 1));
    if (!option || option->get_items_expected_max() == 0) return {};
    std::vector<std::string> words(begin - 1, end);
    while (words.size() > 1 && std::filesystem::path(words.back()).extension() == ".toml") words.pop_back();
    if (words.size() > 2) return words;  // else the word is the option's value
  }
  return {};
}

/// "0 rpm, 100 rpm" of words such as "0 rpm" and "100 rpm", or "0", "rpm", "100" and "rpm".
std::string list_of(const std::vector<std::string>& words) {
  std::string list;
  for (const auto& word : words) {
    const bool begins = begins_with_number(word) && !list.empty() && !list.ends_with(",");
    list += (begins ? ", " : list.empty() ? "" : " ") + word;
  }
  return list;
}

/// What to write instead of an option and the words of its value.
std::string about_value(const CLI::App& command, const std::vector<std::string>& words) {
  const std::string given = fmt::format("{}", fmt::join(words, " "));
  const std::vector<std::string> values(words.begin() + 1, words.end());
  const auto& option = words[0];
  const bool is_list = option == "--map" || option == "--speeds" || option == "--times";
  if (is_list)
    return fmt::format(
        "error: {}: a list must be in quotes, with commas between its entries.\n       Write it as: {} {}\n", given,
        option, shell_quoted(list_with_units(list_of(values))));
  const std::string type = command.get_option(option)->get_type_name();
  const bool is_path = type == "DIR" || type == "FILE";
  if (!is_path && std::count_if(values.begin(), values.end(), begins_with_number) > 1)
    return fmt::format("error: {}: {} takes one value.\n       Its usage: rotordrop {} --help\n", given, option,
                       command.get_name());
  return fmt::format("error: {}: a value with spaces must be in quotes.\n       Write it as: {} {}\n", given, option,
                     shell_quoted(fmt::format("{}", fmt::join(values, " "))));
}

/// Words that a command does not know, each with what may be meant.
std::string about_words(const CLI::App& command, const std::vector<std::string>& arguments) {
  auto unknown = command.remaining();
  const auto place = [&](const auto& word) { return std::find(arguments.begin(), arguments.end(), word); };
  std::stable_sort(unknown.begin(), unknown.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
  std::string text;
  if (!unknown.empty() && !unknown.back().starts_with("-"))
    if (const auto words = value_around(command, arguments, unknown.back()); !words.empty())
      return about_value(command, words);
  for (const auto& word : unknown) {
    if (word.starts_with("-") && word.size() > 1) {
      const auto known = names_of_options(command);
      const std::string name = word.substr(0, word.find('='));
      text += fmt::format("error: {} has no option {}.\n       {}Options: {}.\n", command.get_name(), name,
                          did_you_mean(closest_name(name, known)), fmt::join(known, ", "));
    } else if (word.find('=') != std::string::npos && command.get_option_no_throw("--set")) {
      text += fmt::format("error: {}: a parameter is set with --set.\n       Write it as: --set {}\n", word,
                          shell_quoted(word));
    } else {
      text += fmt::format("error: {}: {} does not know what to do with this word.\n       Its usage: {} --help\n", word,
                          command.get_name(), "rotordrop " + command.get_name());
    }
  }
  return text;
}

}  // namespace

std::string explained(const CLI::App& app, const CLI::ParseError& error, const std::vector<std::string>& arguments,
                      const std::vector<ErasedSection>& sections) {
  const auto chosen = app.get_subcommands();
  if (!arguments.empty() && arguments[0].starts_with("-") && app.remaining_size() > 0)
    return fmt::format(
        "error: {}: options of a command stand behind it.\n       Write it as: rotordrop COMMAND CASE {} ...\n",
        arguments[0], arguments[0]);
  if (chosen.empty()) return about_command(app, arguments);
  const CLI::App& command = *chosen.front();
  if (command.get_option_no_throw("--set"))
    if (const auto text = about_overrides(arguments, sections); !text.empty()) return text;
  if (command.remaining_size() > 0) return about_words(command, arguments);
  return fmt::format("error: {}: {}.\n       Its usage: rotordrop {} --help\n", command.get_name(), error.what(),
                     command.get_name());
}

namespace {

/// KEY="VALUE" as KEY=VALUE, which is read alike: no advice.
std::string without_quotes(const std::string& assignment) {
  const auto quote = assignment.find('"');
  const bool is_quoted = quote != std::string::npos && quote > 0 && assignment[quote - 1] == '=' &&
                         quote + 1 < assignment.size() && assignment.find('"', quote + 1) + 1 == assignment.size();
  return is_quoted ? assignment.substr(0, quote) + assignment.substr(quote + 1, assignment.size() - quote - 2)
                   : assignment;
}

}  // namespace

InputError with_right_forms(const InputError& error, const std::vector<std::string>& overrides,
                            const std::vector<ErasedSection>& sections) {
  // Each one once: a long list may have a fault in every entry. One that is very long nobody reads twice.
  constexpr std::size_t longest_form = 2000;
  struct Form {
    std::string by_key, by_assignment, form;
  };
  std::vector<Form> forms;
  for (const auto& assignment : overrides) {
    auto equals = assignment.find('=');
    if (equals == std::string::npos) equals = assignment.find(':');  // KEY: VALUE
    if (equals == std::string::npos) continue;
    if (assignment.find_first_not_of(" \t", equals + 1) == std::string::npos) continue;
    if (assignment.size() > longest_form) continue;
    const std::string key = assignment.substr(0, equals);
    const std::string form = right_form(sections, key, std::string_view(assignment).substr(equals + 1));
    const bool is_as_given =
        form == "--set " + shell_quoted(assignment) || form == "--set " + shell_quoted(without_quotes(assignment));
    if (!form.empty() && !is_as_given) forms.push_back({"--set " + key, "--set " + assignment, form});
  }
  Faults faults;
  for (Fault fault : error.faults()) {
    for (const auto& [by_key, by_assignment, form] : forms)
      if (fault.where.file == by_key || fault.where.file == by_assignment)
        fault.advice += (fault.advice.empty() ? "" : "\n") + fmt::format("Write it as: {}", form);
    faults.add(std::move(fault));
  }
  return InputError(faults);
}

}  // namespace rotordrop
