#pragma once
#include <filesystem>

namespace rotordrop {

/// Whether a directory holds results of any command that writes a directory of them. Files of others by such names are none.
bool holds_results(const std::filesystem::path& directory);

/// The directory into which a command writes its results, and the only place that knows which files in it are the program's own. While it
/// lives no other process can write results there.
///
/// Nothing of anyone else is removed: in a directory without results nothing at all is, and in one with results only files by the names
/// that the program gives them, and folders that this leaves empty.
class ResultsFolder {
 public:
  enum class Existing {
    refuse,   ///< results that are there are a fault
    replace,  ///< they are removed
    resume    ///< they are kept
  };
  /// What is written: a study has files that no other command writes, and is replaced by a study alone.
  enum class Results { of_study, others };
  /// As options say it.
  static Existing existing_results(bool resume, bool force) {
    return resume ? Existing::resume : force ? Existing::replace : Existing::refuse;
  }
  /// Makes the directory if it does not exist.
  /// @throws InputError if it cannot be made or written into, if another process writes into it, if it holds results that must not be
  /// replaced, or if it holds files or folders of someone else by the names that results need
  ResultsFolder(std::filesystem::path directory, Existing existing, Results kind = Results::others);
  ResultsFolder(const ResultsFolder&) = delete;
  ResultsFolder& operator=(const ResultsFolder&) = delete;
  ~ResultsFolder();

  /// @throws SolverError if the directory was removed or replaced meanwhile: what is written now would lie elsewhere
  void require_there() const;
  /// Those from which an interrupted run is resumed.
  void remove_checkpoints() const;

 private:
  std::filesystem::path directory_;
  int lock_ = -1;
};

}  // namespace rotordrop
