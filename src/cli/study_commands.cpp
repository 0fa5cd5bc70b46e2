#include "cli/study_commands.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "base/version.h"
#include "cli/commands.h"
#include "cli/output_files.h"
#include "cli/signals.h"
#include "io/checkpoint.h"
#include "io/own_files.h"
#include "io/text/parameter_keys.h"
#include "study/many/answers/study_report.h"
#include "study/many/answers/study_summary.h"
#include "study/many/ranks/ranks.h"
#include "study/many/search/search_run.h"
#include "study/many/search/search_space.h"
#include "study/many/study_folder.h"
#include "study/many/study_run.h"

namespace rotordrop {
namespace {

std::string duration(double seconds) {
  if (!std::isfinite(seconds)) return "?";
  if (seconds < 100.) return fmt::format("{:.2g} s", seconds);
  if (seconds < 6000.) return fmt::format("{:.0f} min", seconds / 60.);
  return fmt::format("{:.3g} h", seconds / 3600.);
}

std::string size_text(double bytes) {
  if (bytes < 1e6) return fmt::format("{:.2g} kB", std::max(1., bytes * 1e-3));
  return bytes < 1e9 ? fmt::format("{:.2g} MB", bytes * 1e-6) : fmt::format("{:.2g} GB", bytes * 1e-9);
}

std::string progress_text(const StudyProgress& p) {
  std::string text = fmt::format("{} of {} drops, {} failed", p.done + p.failed, p.total, p.failed);
  if (!p.making.empty()) text += "  |  " + p.making;
  if (p.per_second > 0.)
    text += fmt::format("  |  {:.3g} per second, about {} left", p.per_second, duration(p.time_left));
  if (!p.best_name.empty() && std::isfinite(p.best))
    text += fmt::format("  |  smallest {} {:.4g}", p.best_name, p.best);
  return text;
}

/// "2/4": shard 2 of 4.
std::pair<std::size_t, std::size_t> parse_shard(const std::string& text) {
  if (text.empty()) return {1, 1};
  const auto slash = text.find('/');
  std::size_t shard = 0, n = 0;
  const auto read = [](std::string_view part, std::size_t& to) {
    const auto done = std::from_chars(part.data(), part.data() + part.size(), to);
    return done.ec == std::errc() && done.ptr == part.data() + part.size();
  };
  const std::string_view all(text);
  if (slash == std::string::npos || !read(all.substr(0, slash), shard) || !read(all.substr(slash + 1), n) ||
      shard < 1 || shard > n)
    throw InputError({"--shard", 0, 0}, fmt::format("\"{}\" is not a shard.", text),
                     "Write I/N with I from 1 to N, such as --shard 2/4.");
  return {shard, n};
}

std::string again(const StudyCommand& command, const std::filesystem::path& directory) {
  std::string text =
      fmt::format("rotordrop study {} -o {}", shell_quoted(command.file.string()), shell_quoted(directory.string()));
  for (const auto& assignment : command.overrides) text += " --set " + shell_quoted(assignment);
  if (!command.shard.empty()) text += " --shard " + command.shard;
  return text + " --resume";
}

nlohmann::ordered_json read_summary(const std::filesystem::path& file) {
  std::ifstream in(file);
  return nlohmann::ordered_json::parse(in);
}

std::string header(const Study& study, const Design& design) {
  if (study.is_search()) {
    const SearchSpace space(study);
    return fmt::format(
        "rotordrop {} ({})   study {} of case {}\nsearch over {} parameter{}: at most {} x {} evaluations of {} drop{} "
        "each\n",
        version(), git_revision(), study.name, study.base.name, space.n_dimensions(),
        space.n_dimensions() == 1 ? "" : "s", study.n_searches(), study.evaluations_of_search(), space.n_drops(),
        space.n_drops() == 1 ? "" : "s");
  }
  return fmt::format("rotordrop {} ({})   study {} of case {}\n{} design, {} row{}{}: {} drops of {} parameter{}\n",
                     version(), git_revision(), study.name, study.base.name, name_of(study.design.kind), design.n_rows,
                     design.n_rows == 1 ? "" : "s",
                     study.n_replicates > 1 ? fmt::format(" with {} replicates", study.n_replicates) : "",
                     n_points(study, design), study.drawn().size(), study.drawn().size() == 1 ? "" : "s");
}

/// @throws InputError
void refuse_search_of_ranks(const Study& study) {
  if (study.is_search())
    throw InputError({"mpirun", 0, 0}, "a search runs in one process: each of its points follows from earlier ones.",
                     "Start it without mpirun; --jobs is the number of drops at the same time.");
}

int study_command_of(const StudyCommand& command, Ranks* ranks) {
  StudyOptions options;
  std::tie(options.shard, options.n_shards) = parse_shard(command.shard);
  Study study = read_study(command.file, command.overrides);
  tell_warnings(study.base.warnings);
  if (ranks) refuse_search_of_ranks(study);
  if (study.is_search() && !command.shard.empty())
    throw InputError({"--shard", 0, 0},
                     "a search cannot be divided into shards: each of its points follows from earlier ones.",
                     "Start it without --shard; --jobs is the number of drops at the same time.");
  const Design design = study.is_search() ? SearchSpace(study).corners() : make_design(study);
  options.directory = command.directory.empty() ? std::filesystem::path("out") / study.name : command.directory;
  options.n_workers = command.jobs;
  options.force = command.force;
  options.resume = command.resume;
  options.tell = [](const std::string& text) { fmt::print(stderr, "note: {}\n", text); };
  tell_warnings(check_points(study, design, command.jobs));
  const ProbedResults results = probe_results(study, design, options.evaluate);
  if (const auto note = choose_lanes(study, design); !note.empty()) options.tell(note);
  if (!command.quiet) fmt::print("{}", header(study, design));
  std::fflush(stdout);
  if (command.dry_run) {
    StudyEstimate estimate = estimate_study(study, design, results, options.evaluate);
    if (study.is_search()) {
      const double most =
          static_cast<double>(study.n_searches() * study.evaluations_of_search() * SearchSpace(study).n_drops()) /
          static_cast<double>(estimate.n_points);
      fmt::print(
          "{} and corners of the ranges are valid cases; {} results of each drop are kept\nat most {} of CPU and {} "
          "of results\n",
          study.minimise && !takes_start(study.minimise->method) ? "middle" : "start", results.names.size(),
          duration(most * estimate.cpu_time), size_text(most * estimate.bytes));
      return 0;
    }
    fmt::print("every point is a valid case; {} results of each are kept\nabout {} of CPU{} and {} of results\n",
               results.names.size(), duration(estimate.cpu_time),
               study.lanes ? " one by one, a third to two thirds of it in lanes," : "", size_text(estimate.bytes));
    return 0;
  }
  options.ranks = ranks;
  options.stop = &caught_signal();
  catch_signals();
  const bool is_shown = isatty(STDERR_FILENO) != 0 && !command.quiet;
  if (is_shown)
    options.report = [](const StudyProgress& p) {
      fmt::print(stderr, "\r\033[K{}", progress_text(p));
      std::fflush(stderr);
    };
  const StudyOutcome outcome = study.is_search() ? run_search(study, options) : run_study(study, design, options);
  if (ranks) ranks->leave(outcome.is_anyone_lost);
  if (is_shown) fmt::print(stderr, "\n");
  for (const auto& note : outcome.notes) options.tell(note);
  if (!outcome.is_complete) {
    if (outcome.is_stopped) {
      fmt::print(stderr,
                 "stopped after a failed drop, for on_failure = \"stop\"; its reason is in {}. Go on with: {}\n",
                 (options.directory / "study.journal").string(), again(command, options.directory));
      return 1;
    }
    fmt::print(stderr, "interrupted after {} drops; go on with: {}\n", outcome.done + outcome.failed,
               again(command, options.directory));
    return 128 + static_cast<int>(*options.stop);
  }
  if (options.n_shards == 1 && renew_page(options.directory) && !command.quiet)
    fmt::print("{} is made again\n", (options.directory / "report.html").string());
  if (command.quiet) return 0;
  if (options.n_shards == 1)
    fmt::print("{}", study_text(study, read_summary(options.directory / "study.json")));
  else
    fmt::print("shard {} of {}: {} drops done, {} failed; join the shards with `rotordrop study join`\n", options.shard,
               options.n_shards, outcome.done, outcome.failed);
  fmt::print("{:.3g} s, cores idle {:.2g} % of it; results in {}\n", outcome.wall_time, 100. * outcome.idle_share,
             options.directory.string());
  return 0;
}

/// What a rank other than 0 does; rank 0 tells what there is to tell.
int study_command_of_rank(const StudyCommand& command, Ranks& ranks) {
  StudyOptions options;
  std::tie(options.shard, options.n_shards) = parse_shard(command.shard);
  Study study = read_study(command.file, command.overrides);
  refuse_search_of_ranks(study);
  const Design design = make_design(study);
  options.directory = command.directory.empty() ? std::filesystem::path("out") / study.name : command.directory;
  options.n_workers = command.jobs;
  options.ranks = &ranks;
  probe_results(study, design, options.evaluate);
  choose_lanes(study, design);
  options.stop = &caught_signal();
  catch_signals();
  const StudyOutcome outcome = run_as_rank(study, design, options);
  ranks.leave(outcome.is_anyone_lost);
  return outcome.is_complete ? 0 : 1;
}

}  // namespace

int study_command(const StudyCommand& asked) {
  Ranks* const ranks = asked.dry_run ? nullptr : ranks_of_this_process();
  if (!ranks) return study_command_of(asked, nullptr);
  StudyCommand command = asked;
  if (command.jobs == 0) command.jobs = 1;  // mpirun gives each rank a core
  try {
    return ranks->rank() == 0 ? study_command_of(command, ranks) : study_command_of_rank(command, *ranks);
  } catch (const std::exception&) {
    // Before the work begins rank 0 tells all that it does not: they leave together, and only rank 0 fails, which says why. Later, and where
    // rank 0 finds no fault, nobody waits for this one.
    const bool is_begun = ranks->has_begun() || ranks->begin(false);
    ranks->leave(is_begun);
    if (is_begun || ranks->rank() == 0) throw;
    return 0;
  }
}

int study_join_command(const StudyJoinCommand& command) {
  const std::size_t missing = join_shards(command.directories, command.output, command.force, command.is_virtual);
  if (missing > 0)
    fmt::print(
        stderr,
        "warning: {} points are in no shard; their status is 2. Finish the shards with --resume and join again with "
        "--force.\n",
        missing);
  if (!command.quiet) {
    fmt::print("{}results in {}\n",
               study_text(read_study_of(command.output), read_summary(command.output / "study.json")),
               command.output.string());
  }
  return missing > 0 ? 1 : 0;
}

int study_rerun_command(const StudyRerunCommand& command) {
  const Study study = read_study_of(command.directory);
  const bool may_have_second_tries = study.on_failure == FailurePolicy::retry;
  auto content = study.is_search() || may_have_second_tries ? Journal::read(command.directory / "study.journal")
                                                            : Journal::Content{};
  const Design design = design_of(study, content);
  const std::size_t n = n_points(study, design);
  if (command.point >= n)
    throw InputError({"--point", 0, 0}, fmt::format("the study has no point {}.", command.point),
                     fmt::format("Its points are 0 to {}.", n - 1));
  RunCommand run;
  run.file = command.directory / "case.toml";
  run.directory = command.output.empty() ? command.directory / fmt::format("point-{}", command.point) : command.output;
  const auto found = content.records.find(command.point);
  const bool is_second_try =
      may_have_second_tries && found != content.records.end() && found->second.is_done && !found->second.reason.empty();
  const StudyPoint point = point_of(study, design, command.point);
  run.overrides = is_second_try ? overrides_of_second_try(study, point) : point.overrides;
  run.force = command.force;
  run.quiet = command.quiet;
  run.in_lanes = study.lanes && !study.is_search() && !is_second_try;
  const int code = run_command(run);
  if (code != 0) return code;
  ReportCommand report;
  report.directory = run.directory;
  report.force = command.force;
  report.quiet = command.quiet;
  return report_command(report);
}

int study_report_command(const StudyReportCommand& command) {
  const auto file = command.output.empty() ? command.directory / "report.html" : command.output;
  // By its usual name a page of ours is written again: the study may have gone on.
  if (!(command.output.empty() && is_own_page(file))) require_new(file, command.force);
  require_page_or_nothing(file);
  require_writable(file);
  write_text_atomically(file, study_report_page(study_report_data(command.directory)));
  if (!command.quiet) fmt::print("{}\n", file.string());
  return 0;
}

StudyCommands::StudyCommands(CLI::App& app) {
  study_ =
      app.add_subcommand("study", "Many drops of one case: what is varied, limits and answers stand in a study file.");
  study_->require_subcommand(0, 1);
  study_->add_option("study", study_command_.file, "Study file");
  study_->add_option("-o,--output", study_command_.directory, "Directory for the results; default out/STUDY");
  study_->add_option("--set", study_command_.overrides, "Override a parameter of the case in every drop")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  study_->add_option("--jobs", study_command_.jobs, "Drops at the same time; default: one per core")
      ->check(CLI::Range(1, 4096));
  study_->add_option("--shard", study_command_.shard, "Compute part I of N only, such as 2/4");
  study_->add_flag("--dry-run", study_command_.dry_run, "Check every point; say how many, how long and how large");
  study_->add_flag("--resume", study_command_.resume, "Go on with an interrupted study");
  study_->add_flag("--force", study_command_.force, "Replace results that are in the directory");
  study_->add_flag("--quiet", study_command_.quiet, "Only messages about trouble");

  join_ = study_->add_subcommand("join", "Join the shards of a study.");
  join_->add_option("directories", join_command_.directories, "Directories of the shards")->required();
  join_->add_option("-o,--output", join_command_.output, "Directory for the results")->required();
  join_->add_flag("--virtual", join_command_.is_virtual,
                  "Leave results in the shards' files; study.h5 shows them as virtual datasets");
  join_->add_flag("--force", join_command_.force, "Replace results that are in the directory");
  join_->add_flag("--quiet", join_command_.quiet, "Only messages about trouble");

  report_ = study_->add_subcommand("report", "One HTML page of a study, with figures; it needs no other file.");
  report_->add_option("directory", report_command_.directory, "Directory of the study")->required();
  report_->add_option("-o,--output", report_command_.output, "File; default DIR/report.html");
  report_->add_flag("--force", report_command_.force, "Replace the file given with -o");
  report_->add_flag("--quiet", report_command_.quiet, "Only messages about trouble");

  rerun_ = study_->add_subcommand("rerun", "The full run of one point of a study, with its report.");
  rerun_->add_option("directory", rerun_command_.directory, "Directory of the study")->required();
  rerun_->add_option("--point", rerun_command_.point, "Number of the point, from 0")
      ->required()
      ->check(CLI::Validator(
          [](const std::string& text) {
            const bool is_number =
                !text.empty() && text.size() < 16 && text.find_first_not_of("0123456789") == std::string::npos;
            return is_number ? std::string() : "\"" + text + "\" is not the number of a point; they count from 0";
          },
          "", ""));
  rerun_->add_option("-o,--output", rerun_command_.output, "Directory; default DIR/point-N");
  rerun_->add_flag("--force", rerun_command_.force, "Replace results that are there");
  rerun_->add_flag("--quiet", rerun_command_.quiet, "Only messages about trouble");
}

int StudyCommands::run() const {
  if (join_->parsed()) return study_join_command(join_command_);
  if (report_->parsed()) return study_report_command(report_command_);
  if (rerun_->parsed()) return study_rerun_command(rerun_command_);
  if (study_command_.file.empty())
    throw InputError({"rotordrop study", 0, 0}, "no study file is given.",
                     "Write rotordrop study STUDY.toml, or rotordrop study join | report | rerun.");
  return study_command(study_command_);
}

}  // namespace rotordrop
