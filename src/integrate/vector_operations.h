#pragma once
#include <nvector/nvector_serial.h>

namespace rotordrop {

/// Replaces the serial vector's linear operations by vectorised ones that read every operand once; Debian builds SUNDIALS'
/// own without optimisation: they took a quarter of a run. Clones of the vector inherit them.
void use_vectorised_operations(N_Vector vector);

}  // namespace rotordrop
