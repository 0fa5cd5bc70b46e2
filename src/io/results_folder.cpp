#include "io/results_folder.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <regex>
#include <string>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/errors.h"
#include "io/own_files.h"
#include "io/read_files.h"

namespace rotordrop {
namespace {

namespace fs = std::filesystem;

/// A directory with one of these, if the program wrote it, is one of results.
constexpr std::array results{"results.h5",    "summary.json", "preload.h5", "preload.json",
                             "study.journal", "study.h5",     "study.json", "shard.h5"};
/// What goes before new results are written: the old summary of a new run would be wrong.
constexpr std::array outdated{"summary.json", "comparison.json", "comparison.h5", "measured.json", "study.journal",
                              "study.h5",     "study.csv",       "study.json",    "shard.h5",      "measured.csv"};
constexpr std::array pages{"measured.html", "report.html"};
/// What else is written over.
constexpr std::array replaced{"results.h5", "preload.h5", "preload.json", "study.toml", "case.toml", "parameters.toml"};
/// What shows that a directory is a study's.
constexpr std::array of_study{"study.journal", "study.h5", "study.json", "shard.h5"};
constexpr std::array folders{"checkpoints", "failed", "fields"};

std::string reason(int error) { return std::generic_category().message(error); }

/// Whether there is something by this name, be it a link that leads nowhere.
bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(fs::symlink_status(path, ignored));
}

/// What was being written when a run was killed.
bool is_left_over(const std::string& name) {
  static const std::regex pattern(
      R"((results|comparison|preload)\.h5(\.resuming|(\.resuming)?\.[0-9]+\.new)|)"
      R"(((summary|comparison|preload)\.json|parameters\.toml|report\.html|study\.(h5|csv|json|toml)|shard\.h5|case\.toml|measured\.csv)\.writing)");
  return std::regex_match(name, pattern);
}

bool holds_study(const fs::path& directory) {
  return std::any_of(of_study.begin(), of_study.end(),
                     [&](const char* name) { return is_own_results(directory / name); });
}

/// Names of results that someone else's files have. What a power cut left empty is the program's where its other files are. Only studies write
/// tables (.csv), study.toml and case.toml, and the latter two cannot be told from other inputs but by the study beside them. No study writes
/// parameters.toml.
void require_no_others(const fs::path& directory, ResultsFolder::Results kind) {
  const bool is_study = kind == ResultsFolder::Results::of_study, has_study = holds_study(directory);
  const bool is_ours = holds_results(directory) || is_written_parameters(directory / "parameters.toml");
  const auto is_someone_elses = [&](const fs::path& file) {
    if (!is_there(file) || (is_ours && is_hollow(file))) return false;
    if (file.filename() == "parameters.toml") return !is_study && !is_written_parameters(file);
    if (file.extension() == ".toml") return is_study && !has_study;
    return !is_own_results(file) && (is_study || file.extension() != ".csv");
  };
  const auto require = [&](const char* name) {
    const fs::path file = directory / name;
    if (is_someone_elses(file))
      throw InputError({file.string()}, "results would replace this file, but the program did not write it.",
                       "It is left as it is. Choose another directory with -o DIR, or give the file another name.");
  };
  for (const char* name : outdated) require(name);
  for (const char* name : replaced)
    if (holds_results(directory) || fs::path(name).extension() != ".toml") require(name);
}

/// What results would be written over, or into, in a directory that holds none.
std::vector<const char*> names_without_results(const fs::path& directory) {
  std::vector<const char*> names(folders.begin(), folders.end());
  for (const char* name : {"case.toml", "study.toml", "study.csv", "comparison.json", "comparison.h5"})
    names.push_back(name);
  if (!is_written_parameters(directory / "parameters.toml")) names.push_back("parameters.toml");
  return names;
}

/// Files of a folder whose names match; the folder too if that leaves it empty. A link to a folder is not followed.
void remove_files(const fs::path& folder, const std::regex& names) {
  std::error_code error;
  if (!fs::is_directory(fs::symlink_status(folder, error))) return;
  for (const auto& file : fs::directory_iterator(folder, error))
    if (std::regex_match(file.path().filename().string(), names) && !fs::is_directory(file.symlink_status(error)))
      fs::remove(file.path(), error);
  fs::remove(folder, error);  // of a directory: only if it is empty
}

const std::regex& checkpoint_names() {
  static const std::regex names(R"(checkpoint-[0-9]+\.h5(\.writing)?)");
  return names;
}

void require_not_read(const fs::path& file) {
  if (was_read(file))
    throw InputError({file.string()}, "this file is what the command reads, and results would replace it.",
                     "Choose another directory with -o DIR.");
}

/// @throws InputError if results would replace what the command has read; parameters.toml that a run wrote is the same again
void require_no_inputs(const fs::path& directory) {
  for (const char* name : outdated) require_not_read(directory / name);
  for (const char* name : pages) require_not_read(directory / name);
  for (const fs::path name : replaced)
    if (name != "parameters.toml" || !is_written_parameters(directory / name)) require_not_read(directory / name);
}

void remove_results(const fs::path& directory) {
  std::error_code error;
  for (const char* name : outdated)
    if (is_own_results(directory / name) || is_hollow(directory / name)) fs::remove(directory / name, error);
  for (const char* name : pages)
    if (is_own_page(directory / name)) fs::remove(directory / name, error);
  static const std::regex journals(R"(rank-[0-9]+\.journal)");
  for (const auto& file : fs::directory_iterator(directory, error))
    if (std::regex_match(file.path().filename().string(), journals) && file.is_regular_file(error))
      fs::remove(file.path(), error);
  remove_files(directory / "checkpoints", checkpoint_names());
  remove_files(directory / "failed", checkpoint_names());
  remove_files(directory / "fields", std::regex(R"(.+(\.pvd(\.writing)?|-[0-9]+\.vtu(\.part)?))"));
}

void remove_left_over(const fs::path& directory) {
  std::error_code error;
  for (const auto& file : fs::directory_iterator(directory, error))
    if (is_left_over(file.path().filename().string()) && file.is_regular_file(error)) fs::remove(file.path(), error);
}

}  // namespace

bool holds_results(const fs::path& directory) {
  return std::any_of(results.begin(), results.end(),
                     [&](const char* file) { return is_own_results(directory / file); });
}

ResultsFolder::ResultsFolder(fs::path directory, Existing existing, Results kind) : directory_(std::move(directory)) {
  const SourcePosition where{directory_.string(), 0, 0};
  const bool has_results = holds_results(directory_);
  if (has_results && existing == Existing::refuse)
    throw InputError(
        where, "the directory holds results already",
        "Choose another with -o DIR, replace them with --force, or go on with --resume if the run was interrupted.");
  if (existing == Existing::replace && kind != Results::of_study && holds_study(directory_)) {
    const std::string name = name_of_study(directory_);
    throw InputError(where,
                     name.empty() ? "the directory holds a study" : "the directory holds the study \"" + name + "\"",
                     "Only a study replaces it with --force. Choose another directory with -o DIR.");
  }
  std::error_code error;
  fs::create_directories(directory_, error);
  if (error) throw InputError(where, "the directory cannot be made: " + error.message());
  lock_ = ::open(directory_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ < 0 || ::access(directory_.c_str(), W_OK | X_OK) != 0) {
    const int why = errno;
    if (lock_ >= 0) ::close(lock_);
    throw InputError(where, "the directory cannot be written into: " + reason(why), "Choose another with -o DIR.");
  }
  // File systems without locks are used without.
  if (::flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    ::close(lock_);
    throw InputError(where, "another run is writing into the directory",
                     "Choose another with -o DIR, or wait for its end.");
  }
  try {
    if (has_results && existing == Existing::replace) require_no_inputs(directory_);
    if (existing != Existing::resume) require_no_others(directory_, kind);
    if (!has_results)
      for (const char* name : names_without_results(directory_))
        if (is_there(directory_ / name) && existing != Existing::resume)
          throw InputError(where, std::string("the directory holds \"") + name + "\", but no results of this program",
                           "It is left as it is. Choose another directory with -o DIR.");
    if (has_results && existing == Existing::replace) remove_results(directory_);
    remove_left_over(directory_);
  } catch (...) {
    ::close(lock_);
    throw;
  }
}

ResultsFolder::~ResultsFolder() { ::close(lock_); }

void ResultsFolder::require_there() const {
  struct stat mine {
  }, there{};
  if (::fstat(lock_, &mine) != 0 || ::stat(directory_.c_str(), &there) != 0 || mine.st_ino != there.st_ino ||
      mine.st_dev != there.st_dev)
    throw SolverError("the directory " + directory_.string() +
                      " was removed or replaced while results were written into it; they are lost.");
}

void ResultsFolder::remove_checkpoints() const { remove_files(directory_ / "checkpoints", checkpoint_names()); }

}  // namespace rotordrop
