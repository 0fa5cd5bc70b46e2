#pragma once
// Owners of what SUNDIALS allocates. What they refer to must be destroyed after them: the context is declared first.
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#include <sundials/sundials_nvector.h>

#include <memory>
#include <type_traits>

namespace rotordrop {

template <auto destroy>
struct SundialsDeleter {
  template <class T>
  void operator()(T* object) const {
    destroy(object);
  }
};
struct SundialsContextDeleter {
  void operator()(SUNContext context) const { SUNContext_Free(&context); }
};

using OwnedContext = std::unique_ptr<std::remove_pointer_t<SUNContext>, SundialsContextDeleter>;
using OwnedVector = std::unique_ptr<std::remove_pointer_t<N_Vector>, SundialsDeleter<N_VDestroy>>;
using OwnedMatrix = std::unique_ptr<std::remove_pointer_t<SUNMatrix>, SundialsDeleter<SUNMatDestroy>>;
using OwnedLinearSolver = std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, SundialsDeleter<SUNLinSolFree>>;

/// @returns nothing if SUNDIALS cannot be started
inline OwnedContext new_sundials_context() {
  SUNContext context = nullptr;
  if (SUNContext_Create(nullptr, &context) != 0) return nullptr;
  return OwnedContext(context);
}

}  // namespace rotordrop
