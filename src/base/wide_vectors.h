#pragma once
/// Compiles a function for several widths of vectors; the machine chooses when the program starts. For plain loops, marked "omp simd" if they
/// are to be reordered. Levels, not names of processors: those match the models of one maker only.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)
#define ROTORDROP_WIDE_VECTORS __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define ROTORDROP_WIDE_VECTORS
#endif
