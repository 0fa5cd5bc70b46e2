#pragma once
// rotordrop study and its parts; each returns its exit code.
#include <filesystem>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace rotordrop {

struct StudyCommand {
  std::filesystem::path file, directory;
  std::vector<std::string> overrides;
  std::string shard;
  unsigned jobs = 0;
  bool dry_run = false, resume = false, force = false, quiet = false;
};
int study_command(const StudyCommand& command);

struct StudyJoinCommand {
  std::vector<std::filesystem::path> directories;
  std::filesystem::path output;
  bool is_virtual = false, force = false, quiet = false;
};
int study_join_command(const StudyJoinCommand& command);

struct StudyRerunCommand {
  std::filesystem::path directory, output;
  std::size_t point = 0;
  bool force = false, quiet = false;
};
/// The full run of one point, with its report.
int study_rerun_command(const StudyRerunCommand& command);

struct StudyReportCommand {
  std::filesystem::path directory, output;
  bool force = false, quiet = false;
};
int study_report_command(const StudyReportCommand& command);

/// `rotordrop study ...` as it stands on the command line: adds the command, runs what it was given.
class StudyCommands {
 public:
  explicit StudyCommands(CLI::App& app);
  [[nodiscard]] int run() const;

 private:
  CLI::App *study_, *join_, *rerun_, *report_;
  StudyCommand study_command_;
  StudyJoinCommand join_command_;
  StudyRerunCommand rerun_command_;
  StudyReportCommand report_command_;
};

}  // namespace rotordrop
