#pragma once
#include "base/wide_vectors.h"

/// The function of this process's level among those that cmake/LaneEngine.cmake makes of one source: PREFIX_base, PREFIX_v3, PREFIX_v4 and
/// PREFIX_v4_newton.
#if defined(__x86_64__)
#define ROTORDROP_OF_LEVEL(PREFIX)                             \
  (vector_level == VectorLevel::v4_newton ? PREFIX##_v4_newton \
   : vector_level == VectorLevel::v4      ? PREFIX##_v4        \
   : vector_level == VectorLevel::v3      ? PREFIX##_v3        \
                                          : PREFIX##_base)
#else
#define ROTORDROP_OF_LEVEL(PREFIX) (PREFIX##_base)
#endif
