#include <fmt/format.h>

#include "base/errors.h"
#include "base/memory.h"
#include "case/built_machine.h"
#include "cli/commands.h"
#include "cli/progress_line.h"
#include "cli/signals.h"
#include "study/rerun/rerun.h"

namespace rotordrop {

int rerun_command(const RerunCommand& command) {
  make_heap_ready(heap_of_a_drop);
  RecordedInput input = read_recorded_input(command.file);
  Case& c = input.drop_case;
  if (c.parameters.thermal.models.size() > 1) make_heap_ready(heap_of_a_comparison);
  c.parameters.run.second_opinion = false;  // of the same drop it would be the same
  RunOptions options;
  options.directory =
      command.directory.empty() ? std::filesystem::path("out") / (c.name + "-rerun") : command.directory;
  std::error_code ignored;
  if (std::filesystem::equivalent(options.directory, input.file.parent_path(), ignored))
    throw InputError({"--output", 0, 0}, "this is the directory of the drop that is to be run again.",
                     "Choose another with -o DIR.");
  options.force = command.force;
  options.in_lanes = input.in_lanes;
  options.stop = &caught_signal();
  options.tell = [](const std::string& text) { fmt::print(stderr, "note: {}\n", text); };
  ProgressLine line;
  if (line.is_shown() && !command.quiet) options.report = [&](const Progress& p) { line.show(p); };
  BuiltMachine built(c);
  options.elements = &built.elements();
  catch_signals();
  FinishedDrop result;
  try {
    result = run_drop(c, built.machine(), options);
  } catch (...) {
    line.finish();
    throw;
  }
  line.finish();
  if (!result.completed) {
    fmt::print(stderr, "interrupted at t = {:.6g} s; results so far are in {}\n", result.end_time,
               options.directory.string());
    return 128 + static_cast<int>(caught_signal());
  }
  const BitComparison comparison = compare_bits(input.file, options.directory / "results.h5");
  if (!command.quiet) fmt::print("{}results in {}\n", summary_text(result.summary), options.directory.string());
  fmt::print("{}", rerun_text(input, comparison));
  return comparison.differences.empty() ? 0 : not_as_asked;
}

}  // namespace rotordrop
