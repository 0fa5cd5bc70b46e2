// For sanitized tests that load PETSc: what Open MPI and hwloc leave behind when a process ends is no leak of ours. Their modules are unloaded by then,
// so only the frames above tell whose memory it was.
extern "C" const char* __lsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier)
  return "leak:libmpi.so\nleak:libopen-pal.so\nleak:libopen-rte.so\nleak:libhwloc.so\n";
}
extern "C" const char* __asan_default_options() {  // NOLINT(bugprone-reserved-identifier)
  return "fast_unwind_on_malloc=0:print_suppressions=0";
}
