#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "base/errors.h"
#include "base/parameters/suggestion.h"
#include "base/parameters/wording.h"
#include "base/version.h"
#include "cli/completion.h"
#include "io/text/parameter_keys.h"
#include "io/text/parameter_writers.h"

namespace rotordrop {
namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

/// Text as man(7) takes it: hyphens that can be copied, no line that looks like a request.
std::string roff(const std::string& text) {
  std::string result;
  bool is_line_begin = true;
  for (const char c : text) {
    if (is_line_begin && (c == '.' || c == '\'')) result += "\\&";
    is_line_begin = c == '\n';
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else if (c == '\'')
      result += "\\(aq";
    else if (c == '^')
      result += "\\(ha";
    else if (c == '~')
      result += "\\(ti";
    else
      result += c;
  }
  return result;
}

std::string heading(const std::string& name, int section) {
  std::string upper = name;
  std::transform(upper.begin(), upper.end(), upper.begin(), [](unsigned char c) { return std::toupper(c); });
  return fmt::format(
      ".\\\" Made by rotordrop man; it follows the program's own declarations.\n.TH {} {} \"\" \"rotordrop {}\" "
      "\"{}\"\n",
      roff(upper), section, version(), section == 1 ? "User Commands" : "File Formats");
}

std::string names_of(const CLI::Option& option) {
  std::string names;
  for (const auto& name : option.get_snames()) names += (names.empty() ? "\\fB\\-" : ", \\fB\\-") + roff(name) + "\\fR";
  for (const auto& name : option.get_lnames())
    names += (names.empty() ? "\\fB\\-\\-" : ", \\fB\\-\\-") + roff(name) + "\\fR";
  if (option.get_items_expected_max() > 0) names += " \\fI" + roff(option.get_type_name()) + "\\fR";
  return names;
}

constexpr std::string_view exit_status = R"(.SH EXIT STATUS
.TP
.B 0
success
.TP
.B 1
the run failed
.TP
.B 2
bad input: the command line or the case
.TP
.B 130
interrupted with Ctrl\-C (143: by SIGTERM, 129: its terminal was closed)
)";

std::string page_of_command(const CLI::App& command) {
  const std::string name = "rotordrop-" + command.get_name();
  std::string text = heading(name, 1);
  text += fmt::format(".SH NAME\n{} \\- {}\n.SH SYNOPSIS\n.B rotordrop {}\n", roff(name),
                      roff(command.get_description()), roff(command.get_name()));
  for (const auto* option : command.get_options())
    if (option->get_positional())
      text += option->get_required() ? fmt::format(".I {}\n", roff(option->get_type_name()))
                                     : fmt::format(".RI [ {} ]\n", roff(option->get_type_name()));
  text += ".RI [ OPTIONS ]\n";
  text += fmt::format(".SH DESCRIPTION\n{}\n.SH OPTIONS\n", roff(command.get_description()));
  for (const auto* option : command.get_options()) {
    const std::string head =
        option->get_positional() ? "\\fI" + roff(option->get_type_name()) + "\\fR" : names_of(*option);
    text += fmt::format(".TP\n{}\n{}\n", head, roff(option->get_description()));
  }
  text += exit_status;
  return text + ".SH SEE ALSO\n.BR rotordrop (1),\n.BR rotordrop\\-case (5)\n";
}

std::string page_of_program(const CLI::App& app) {
  std::string text = heading("rotordrop", 1);
  text += fmt::format(".SH NAME\nrotordrop \\- {}\n.SH SYNOPSIS\n.B rotordrop\n.I COMMAND\n.RI [ ARGUMENTS ]\n",
                      roff(app.get_description()));
  text += fmt::format(".SH DESCRIPTION\n{}\n.SH COMMANDS\n", roff(app.get_description()));
  for (const auto* command : commands_of(app))
    text += fmt::format(".TP\n\\fBrotordrop\\-{}\\fR(1)\n{}\n", roff(command->get_name()),
                        roff(command->get_description()));
  text += exit_status;
  text +=
      ".SH ENVIRONMENT\n.TP\n.B ROTORDROP_PARAMS\na folder whose bearings/ is searched before the program's own "
      "catalogue\n.TP\n.B ROTORDROP_PARTS\nmodules with supports and thermal models of others, with : between them\n";
  return text + ".SH SEE ALSO\n.BR rotordrop\\-case (5)\n";
}

std::string page_of_case(const std::vector<ErasedSection>& sections) {
  std::string text = heading("rotordrop-case", 5);
  text +=
      ".SH NAME\nrotordrop\\-case \\- parameters of a rotor drop\n.SH DESCRIPTION\nA case is a TOML file. It lists "
      "what "
      "differs from its\n.IR base ,\nanother case. A quantity is a number in SI units or a text with a unit, such as "
      "\"250 um\" or \"15200 rpm\". NAME stands for a name of your choice. The same keys set a value for one "
      "run:\n.PP\n"
      ".EX\nrotordrop run case.toml \\-\\-set \\(aqrun.initial_speed=8000 rpm\\(aq\n.EE\n.SH PARAMETERS\n";
  for (const auto& key : parameter_keys(sections)) {
    const Declaration& d = *key.declaration;
    text += fmt::format(".TP\n.B {}\n{}\nType: {}.\n", roff(key.path), roff(d.help), roff(type_text(d)));
    if (d.fallback) text += fmt::format("Default: {}.\n", roff(toml_value(*d.fallback)));
    if (!d.source.empty()) text += fmt::format("Source: {}.\n", roff(d.source));
  }
  return text + ".SH SEE ALSO\n.BR rotordrop (1),\n.BR rotordrop\\-run (1)\n";
}

}  // namespace

std::string manual_page(const CLI::App& app, const std::string& topic, const std::vector<ErasedSection>& sections) {
  if (topic.empty()) return page_of_program(app);
  if (topic == "case") return page_of_case(sections);
  std::vector<std::string> known;
  for (const auto* command : commands_of(app)) {
    if (command->get_name() == topic) return page_of_command(*command);
    known.push_back(command->get_name());
  }
  known.emplace_back("case");
  throw InputError({"man", 0, 0}, fmt::format("there is no page on \"{}\".", topic),
                   suggestion(topic, known, fmt::format("Pages: {}.", fmt::join(known, ", "))));
}

}  // namespace rotordrop
