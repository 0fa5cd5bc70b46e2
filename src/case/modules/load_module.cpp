#include "case/modules/load_module.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <fstream>

#include "base/memory.h"
#include "case/program_files.h"

namespace rotordrop {

namespace fs = std::filesystem;

namespace {

/// Opens libraries behind a module, each after those that it needs. Then each looks for its symbols among its own few libraries, and not among all 200
/// behind the module, which saves a third of the time.
void open_libraries_behind(const fs::path& file) {
  std::ifstream list(file.string() + ".libraries");  // by cmake/list_libraries
  for (std::string name; std::getline(list, name);) static_cast<void>(dlopen(name.c_str(), RTLD_LAZY | RTLD_LOCAL));
}

}  // namespace

void* load_module(const fs::path& file, Symbols symbols, std::string& why) {
  // One that is not there, or no more, is no matter: what is needed opens with the module, or is told of then.
  if (symbols == Symbols::when_called) open_libraries_behind(file);
  void* const handle = dlopen(file.c_str(), (symbols == Symbols::at_once ? RTLD_NOW : RTLD_LAZY) | RTLD_LOCAL);
  if (handle) return handle;
  const char* said = dlerror();
  why = said ? said : "no reason given";
  return nullptr;
}

void* address_in(void* module, const char* function) { return dlsym(module, function); }

void* address_in_module(const Module& module, Symbols symbols, const char* function) {
  const fs::path file = module.file.empty() ? fs::path() : module_file(module.file);
  std::error_code ignored;
  if (file.empty() || !fs::exists(file, ignored))
    throw InputError({},
                     fmt::format("this program was built without {}, which {} needs", module.name, module.needed_by),
                     module.how_to_have);
  std::string why;
  void* const handle = load_module(file, symbols, why);
  if (!handle) throw SolverError(fmt::format("{} cannot be loaded: {}", module.name, why));
  // Libraries behind a module end the process where memory is short.
  if (const auto left = memory_left(); left < memory_of_libraries)
    throw SolverError(fmt::format("there is not enough memory for {}: {} are left (ulimit -v), it needs {} at least.",
                                  module.name, bytes_in_words(static_cast<double>(left)),
                                  bytes_in_words(static_cast<double>(memory_of_libraries))));
  void* const found = address_in(handle, function);
  if (!found)
    throw SolverError(fmt::format("{} {} belongs to another version of the program", module.name, file.string()));
  return found;
}

}  // namespace rotordrop
