#pragma once
#include <filesystem>
#include <string>

#include "base/errors.h"

// Shared objects with a room or with parts of others. What is loaded stays loaded. Symbols are local: modules bring libraries of their own, among them
// another HDF5 than ours.
namespace rotordrop {

/// A module that comes with the program.
struct Module {
  std::string file;         ///< without its folder; empty: the program was built without it
  std::string name;         ///< for messages: "the MPI module"
  std::string needed_by;    ///< likewise: "[surrogate]"
  std::string how_to_have;  ///< advice where it is missing
};

enum class Symbols {
  when_called,  ///< many libraries, of which a run calls few functions
  at_once       ///< what is missing is told now, and not in the middle of a run
};

/// @return  the module's handle; null: it cannot be loaded, for the reason in `why`
void* load_module(const std::filesystem::path& file, Symbols symbols, std::string& why);

/// The address of a function of a loaded module; null if it has none of that name.
void* address_in(void* module, const char* function);

/// Loads a module of the program and finds a function in it.
/// @throws InputError if the program was built without it, SolverError if it cannot be loaded or is of another version
void* address_in_module(const Module& module, Symbols symbols, const char* function);

template <class Function>
Function* function_in_module(const Module& module, Symbols symbols, const char* function) {
  return reinterpret_cast<Function*>(address_in_module(module, symbols, function));
}

}  // namespace rotordrop
