#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

#include "base/errors.h"
#include "base/memory.h"
#include "base/parameters/declaration.h"
#include "base/wide_vectors.h"
#include "case/case.h"
#include "cli/command_line.h"
#include "cli/commands.h"
#include "cli/mistakes.h"
#include "cli/no_memory.h"
#include "cli/option_values.h"
#include "io/read_files.h"
#include "study/heat/heat_run.h"

namespace {

enum ExitCode { done = 0, run_failed = 1, bad_input = 2 };

/// Declarations of all keys that some command takes with --set.
std::vector<rotordrop::ErasedSection> sections_of_keys() {
  auto sections = rotordrop::case_sections();
  for (auto& section : rotordrop::heat_sections()) sections.push_back(std::move(section));
  return sections;
}

int run_program(int argc, char** argv) {
  using namespace rotordrop;
  check_vector_level();
  CLI::App app("Drop of a magnetically levitated rotor onto its touchdown bearings.", "rotordrop");
  app.require_subcommand(1);
  app.set_version_flag("--version", version_text);  // asks HDF5, which has to begin for that

  const std::vector<OfferedCommand> offered = offer_commands(app);
  add_checks_of_values(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      app.exit(error);
      return done;
    }
    fmt::print(stderr, "{}", explained(app, error, {argv + 1, argv + argc}, sections_of_keys()));
    return bad_input;
  }
  const auto* set = app.get_subcommands().front()->get_option_no_throw("--set");
  const auto overrides = set ? set->results() : std::vector<std::string>{};
  try {
    for (const OfferedCommand& one : offered)
      if (one.command->parsed()) return one.run();
    return bad_input;
  } catch (const InputError& error) {
    throw with_right_forms(error, overrides, sections_of_keys());
  }
}

/// What names and permissions make impossible is for the user to change; the rest is the machine's.
int exit_code_of(const std::error_code& error) {
  for (const auto by_name :
       {std::errc::filename_too_long, std::errc::too_many_symbolic_link_levels, std::errc::permission_denied,
        std::errc::operation_not_permitted, std::errc::read_only_file_system, std::errc::not_a_directory,
        std::errc::is_a_directory, std::errc::file_exists})
    if (error == by_name) return bad_input;
  return run_failed;
}

int run_guarded(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const rotordrop::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return bad_input;
  } catch (const rotordrop::SolverError& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return run_failed;
  } catch (const rotordrop::PartError& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return run_failed;
  } catch (const std::filesystem::filesystem_error& error) {
    fmt::print(stderr, "error: {}: {}.\n       Check the name and the permissions.\n", error.path1().string(),
               error.code().message());
    return exit_code_of(error.code());
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "{}", rotordrop::no_memory);
    return run_failed;
  } catch (const std::system_error& error) {
    fmt::print(stderr, "error: {}.\n", error.what());
    return run_failed;
  } catch (const std::exception& error) {
    fmt::print(stderr,
               "error: {}\n       This is a bug in the program, not an error in the input; please report it with the "
               "parameter file.\n",
               error.what());
    return run_failed;
  }
}

/// What is said on standard error may get lost, for it is full or closed; the command goes on all the same.
void let_standard_error_fail() {
  if (::fcntl(STDERR_FILENO, F_GETFD) < 0 && ::open("/dev/null", O_WRONLY) < 0) return;
  cookie_io_functions_t functions{};
  functions.write = [](void*, const char* text, std::size_t size) {
    for (std::size_t at = 0; at < size;) {
      const ssize_t written = ::write(STDERR_FILENO, text + at, size - at);
      if (written <= 0 && errno != EINTR) break;
      if (written > 0) at += static_cast<std::size_t>(written);
    }
    return static_cast<ssize_t>(size);
  };
  std::FILE* const forgiving = ::fopencookie(nullptr, "w", functions);
  if (!forgiving) return;
  std::setvbuf(forgiving, nullptr, _IONBF, 0);
  stderr = forgiving;
}

/// Where memory is short, libraries would fail at the end of the process: they make threads to end their own.
int leave(int code) {
  if (code == run_failed && rotordrop::memory_left() < rotordrop::memory_of_libraries) std::_Exit(code);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  let_standard_error_fail();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is a failed write, which is reported
  std::set_terminate(rotordrop::end_without_handler);
  rotordrop::protect_inputs();
  const int code = run_guarded(argc, argv);
  // Only closing tells whether all of it was written.
  errno = 0;
  if (std::ferror(stdout) != 0 || std::fclose(stdout) != 0) {
    fmt::print(stderr, "error: standard output cannot be written: {}.\n",
               errno != 0 ? std::generic_category().message(errno) : "an earlier write failed");
    return leave(code == done ? run_failed : code);
  }
  return leave(code);
}
