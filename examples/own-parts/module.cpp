// The parts of this folder as a module, which the installed program loads: run.parts = ["own-parts.so"].
#include "parts.h"

ROTORDROP_PARTS(add_parts)
