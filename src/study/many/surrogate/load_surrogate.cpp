#include <dlfcn.h>

#include <filesystem>

#include "base/errors.h"
#include "case/program_files.h"
#include "study/many/surrogate/surrogate.h"

namespace rotordrop {

MakeSurrogate* surrogate_maker() {
  static MakeSurrogate* const make = [] {
    const auto file = module_file("rotordrop_surrogate.so");
    if (!std::filesystem::exists(file))
      throw InputError({}, "this program was built without its surrogate module, which [surrogate] needs",
                       "Install libopenturns-dev and build again, or remove [surrogate].");
    // Local: OpenTURNS brings a solver that shows names of MPI's functions.
    void* const handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!handle) throw SolverError("the surrogate module cannot be loaded: " + std::string(dlerror()));
    auto* const found = reinterpret_cast<MakeSurrogate*>(dlsym(handle, make_surrogate_name));
    if (!found)
      throw SolverError("the surrogate module " + file.string() + " belongs to another version of the program");
    return found;
  }();
  return make;
}

}  // namespace rotordrop
