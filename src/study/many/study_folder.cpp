#include "study/many/study_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "base/version.h"
#include "io/checkpoint.h"
#include "io/own_files.h"
#include "io/results_folder.h"
#include "io/sha256.h"
#include "io/text/comments.h"
#include "study/many/answers/result_check.h"
#include "study/many/answers/study_report.h"
#include "study/many/answers/study_summary.h"
#include "study/many/common_values.h"
#include "study/many/search/fit_evaluation.h"
#include "study/many/study_table.h"

namespace rotordrop {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string digest_of(const Study& study, const Design& design) {
  std::string text = without_comments(study.base.resolved.text);
  for (const auto& d : study.derived) text += d.name + "=" + d.formula.text() + "\n";
  for (const auto& k : study.keep_results) text += "keep " + k + "\n";
  for (const auto& l : study.limits) text += "limit " + l.pattern + "\n";
  for (const auto& s : study.keep_series) text += "series " + s + "\n";
  if (study.choice) text += "choose " + study.choice->result + "\n";
  if (study.is_search()) text += without_comments(study.text);  // bounds of limits, too, decide where it goes
  for (const auto& name : study.surrogate_results) text += "surrogate " + name + "\n";
  if (study.fit)
    for (const auto& m : study.fit->measured)
      for (std::size_t i = 0; i < m.data.times.size(); ++i)
        text += fmt::format("{} {}\n", m.data.times[i], m.data.values[i]);
  text += fmt::format("on failure {}\n", static_cast<int>(study.on_failure));
  if (study.lanes) text += "lanes\n";
  std::string digest = sha256_of(text);
  const std::size_t n = n_points(study, design);
  std::string block;
  for (std::size_t i = 0; i < n; ++i) {
    for (const auto& assignment : point_of(study, design, i).overrides) block += assignment + "\n";
    if (block.size() > 1'000'000 || i + 1 == n) {
      digest = sha256_of(digest + block);
      block.clear();
    }
  }
  return digest;
}

std::string journal_header(const Study& study, const std::string& digest, std::size_t shard, std::size_t n_shards) {
  return Json{{"study", digest},         {"name", study.name},
              {"case", study.base.name}, {"program", std::string(version()) + " " + git_revision()},
              {"shard", shard},          {"shards", n_shards},
              {"lanes", study.lanes}}
      .dump();
}

void require_same_study(const fs::path& journal, const std::string& found, const std::string& expected) {
  if (found == expected) return;
  const Json a = Json::parse(found, nullptr, false), b = Json::parse(expected);
  const SourcePosition where{journal.string(), 0, 0};
  if (a.is_discarded() || a.value("study", "") != b["study"])
    throw InputError(where, "this is the journal of another study: its case, its points or what it keeps differ.",
                     "Choose another directory with -o DIR, or start anew with --force.");
  if (a["program"] != b["program"])
    throw InputError(where,
                     fmt::format("this journal was written by rotordrop {}, but this is {}.",
                                 a["program"].get<std::string>(), b["program"].get<std::string>()),
                     "Results of two versions are not mixed. Go on with the same version, or start anew with --force.");
  for (const char* name : {"name", "case"})
    if (a.value(name, "") != b[name])
      throw InputError(where,
                       fmt::format("this journal is of a {} by the name of {}, not {}.",
                                   std::string_view(name) == "case" ? "case" : "study", a.value(name, ""),
                                   b[name].get<std::string>()),
                       "Give the file its former name, choose another directory with -o DIR, or start anew with "
                       "--force.");
  throw InputError(where,
                   fmt::format("this journal is of shard {} of {}, not of shard {} of {}.", a["shard"].dump(),
                               a["shards"].dump(), b["shard"].dump(), b["shards"].dump()),
                   "Give each shard a directory of its own with -o DIR.");
}

namespace {

/// @throws InputError for the directory of a virtual join, whose series are in other files
void require_own_series(const Study& study, const fs::path& journal, const Journal::Content& content) {
  if (study.keep_series.empty()) return;
  for (const auto& [point, record] : content.records)
    if (record.is_done && record.series.empty())
      throw InputError({journal.string(), 0, 0},
                       "the series of this study are in the files of its shards: it was joined with --virtual.",
                       "Go on with a shard, or join without --virtual.");
}

}  // namespace

std::optional<Journal::Content> earlier_points(const Study& study, const StudyOptions& options,
                                               const std::string& header) {
  const fs::path file = options.directory / "study.journal";
  std::error_code error;
  if (options.resume && fs::exists(file, error)) {
    try {
      take_journals_of_ranks(options.directory, header);
      auto content = Journal::read(file);
      require_same_study(file, content.header, header);
      require_own_series(study, file, content);
      write_inputs(study, options.directory);  // bounds of limits may be others now
      return content;
    } catch (const InputError&) {
      // A program that was killed before its first line has left less than a header.
      if (fs::file_size(file, error) > header.size()) throw;
    }
  }
  if (options.force && !options.resume) remove_rerun_points(options.directory);
  if (options.resume && options.tell) options.tell("no point is finished yet: the study starts anew");
  write_inputs(study, options.directory);
  return {};
}

fs::path journal_of_rank(const fs::path& directory, int rank) {
  return directory / fmt::format("rank-{}.journal", rank);
}

namespace {

/// As journal_of_rank() calls them.
bool is_name_of_rank(std::string_view name) {
  constexpr std::string_view before = "rank-", after = ".journal";
  if (name.size() <= before.size() + after.size() || !name.starts_with(before) || !name.ends_with(after)) return false;
  name.remove_prefix(before.size());
  name.remove_suffix(after.size());
  return std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

void take_journals_of_ranks(const fs::path& directory, const std::string& header) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(directory)) {
    if (is_name_of_rank(entry.path().filename().string())) files.push_back(entry.path());
  }
  if (files.empty()) return;
  const fs::path own = directory / "study.journal";
  const auto before = Journal::read(own);
  Journal journal(own, before);
  std::error_code error;
  for (const auto& file : files) {
    Journal::Content content;
    try {
      content = Journal::read(file);
    } catch (const InputError&) {
      if (fs::file_size(file, error) > header.size()) throw;
      continue;  // killed before its first line
    }
    require_same_study(file, content.header, header);
    for (const auto& [point, record] : content.records)
      if (!before.records.contains(point)) journal.append(point, result_of(record, content.layouts), record.cpu_time);
  }
  journal.sync();
  for (const auto& file : files) fs::remove(file);
}

bool renew_page(const fs::path& directory) {
  const fs::path page = directory / "report.html";
  if (!is_own_page(page)) return false;
  write_text_atomically(page, study_report_page(study_report_data(directory)));
  return true;
}

void remove_rerun_points(const fs::path& directory) {
  std::vector<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(directory)) {
    const std::string name = entry.path().filename().string(), before = "point-";
    const bool is_number = name.size() > before.size() && name.starts_with(before) &&
                           name.find_first_not_of("0123456789", before.size()) == std::string::npos;
    if (is_number && fs::is_directory(entry.symlink_status()) && holds_results(entry.path()))
      folders.push_back(entry.path());
  }
  std::error_code ignored;
  for (const auto& folder : folders) {
    const bool has_parameters = is_written_parameters(folder / "parameters.toml");
    const bool has_series = is_own_results(folder / "results.h5");
    try {
      const ResultsFolder emptied(folder, ResultsFolder::Existing::replace);
    } catch (const InputError&) {
      continue;  // someone else's files are among them
    }
    if (has_series) fs::remove(folder / "results.h5", ignored);
    if (has_parameters) fs::remove(folder / "parameters.toml", ignored);
    fs::remove(folder, ignored);  // only if that left it empty
  }
}

void write_inputs(const Study& study, const fs::path& directory) {
  write_text_atomically(directory / "study.toml", study.text);
  std::vector<std::string> varied;
  for (const auto& parameter : study.parameters)
    for (const auto& key : parameter.keys) varied.push_back(key.name);
  write_text_atomically(directory / "case.toml", text_with_common_values(study.base, varied));
  if (study.fit) write_measured(study.fit->measured, directory);
}

Study read_study_of(const fs::path& directory) {
  const fs::path file = directory / "study.toml", case_file = directory / "case.toml";
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored) || !fs::is_regular_file(case_file, ignored))
    throw InputError({directory.string(), 0, 0}, "the directory holds no study.",
                     "Name a directory that `rotordrop study` has written.");
  Study study = read_study(file, {}, case_file);
  // The files have names of the folder; what study and case were called stands in the journal.
  if (const fs::path journal = directory / "study.journal"; fs::is_regular_file(journal, ignored))
    if (const Json header = Json::parse(Journal::header_of(journal), nullptr, false); header.is_object()) {
      study.name = header.value("name", study.name);
      study.base.name = header.value("case", study.base.name);
      study.lanes = header.value("lanes", false);
    }
  return study;
}

namespace {

/// Journals of shards of one study.
struct JoinedShards {
  std::string digest, program;
  std::map<std::size_t, PointRecord> records;
  std::vector<std::vector<std::string>> layouts;
  std::vector<ShardFile> files;  ///< by their whole paths

  void add(const fs::path& directory, const fs::path& first_directory) {
    const fs::path file = directory / "study.journal";
    auto content = Journal::read(file);
    const Json header = Json::parse(content.header, nullptr, false);
    const std::string its = header.is_discarded() ? "" : header.value("study", "");
    if (digest.empty()) {
      digest = its;
      program = header.value("program", "");
    }
    if (its != digest || header.value("program", "") != program)
      throw InputError({file.string(), 0, 0},
                       its != digest ? "this shard is of another study than " + first_directory.string() + "."
                                     : "this shard was computed by another version of the program than " +
                                           first_directory.string() + ".");
    files.push_back({fs::absolute(directory).lexically_normal() / "shard.h5", header.value("shard", std::size_t{1}),
                     header.value("shards", std::size_t{1})});
    const std::size_t first = layouts.size();
    layouts.insert(layouts.end(), content.layouts.begin(), content.layouts.end());
    for (auto& [point, record] : content.records) {
      record.layout += first;
      records.insert_or_assign(point, std::move(record));
    }
  }
};

/// The files of shards as study.h5 in a folder names them. @throws InputError if a shard is unfinished, or given twice
std::vector<ShardFile> seen_from(const fs::path& output, std::vector<ShardFile> shards) {
  std::set<std::size_t> seen;
  for (auto& s : shards) {
    const SourcePosition where{s.file.parent_path().string(), 0, 0};
    if (!fs::is_regular_file(s.file))
      throw InputError(where, "this shard is not finished, or is the whole study: it has no file shard.h5.",
                       "Finish it with --resume, or join without --virtual.");
    if (s.n_shards != shards.front().n_shards)
      throw InputError(where,
                       fmt::format("this is one of {} shards, but the first directory holds one of {}.", s.n_shards,
                                   shards.front().n_shards),
                       "Join them without --virtual.");
    if (!seen.insert(s.shard).second)
      throw InputError(where, fmt::format("shard {} is given twice.", s.shard), "Name each shard once.");
    s.file = s.file.lexically_relative(fs::absolute(output).lexically_normal());
  }
  return shards;
}

}  // namespace

std::size_t join_shards(const std::vector<fs::path>& directories, const fs::path& output, bool force, bool is_virtual) {
  Study study = read_study_of(directories.front());
  if (study.is_search())
    throw InputError({directories.front().string(), 0, 0},
                     "the study in this directory searches: it has no shards, and nothing to join.");
  const Design design = make_design(study);
  JoinedShards shards;
  for (const auto& directory : directories) shards.add(directory, directories.front());
  const auto virtual_files = is_virtual ? seen_from(output, shards.files) : std::vector<ShardFile>{};
  const ResultsFolder folder(output, ResultsFolder::existing_results(false, force), ResultsFolder::Results::of_study);
  if (force) remove_rerun_points(output);
  write_inputs(study, output);
  const StudyTable table = make_table(study, design, shards.records, shards.layouts);
  resolve_results(study, table);
  Journal joined(output / "study.journal", journal_header(study, shards.digest, 1, 1));
  for (auto& [point, record] : shards.records) {
    if (is_virtual) record.series.clear();
    joined.append(point, result_of(record, shards.layouts), record.cpu_time);
  }
  joined.sync();
  write_results(output, study, design, table, shards.digest, {}, virtual_files);
  return table.count(PointStatus::not_run);
}

}  // namespace rotordrop
