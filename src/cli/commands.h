#pragma once
// The program's commands; each returns its exit code.
#include <filesystem>
#include <string>
#include <vector>

#include "base/errors.h"

namespace rotordrop {

struct Case;

/// Tells what is unusual in a case. @throws InputError if `strict` and there is any
void tell_warnings(const std::vector<Fault>& warnings, bool strict = false);
/// As read_case(), and tells its warnings.
Case read_case_and_tell(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                        bool strict = false);

struct RunCommand {
  std::filesystem::path file, directory;
  std::vector<std::string> overrides;
  bool force = false, resume = false, quiet = false, strict = false;
  bool accept = false;    ///< fail if a limit of the case is not met
  bool in_lanes = false;  ///< as a study in lanes computes it
};
int run_command(const RunCommand& command);
/// Exit code of a command that came to its end, but not to what was asked to hold.
inline constexpr int not_as_asked = 3;

struct RerunCommand {
  std::filesystem::path file, directory;
  bool force = false, quiet = false;
};
/// A recorded drop once more; whether its bits are the same.
int rerun_command(const RerunCommand& command);
/// @param strict  whether warnings about the case are faults
int check_command(const std::filesystem::path& file, const std::vector<std::string>& overrides, bool strict);
/// Kinds of input files.
enum class InputKind { drop, heat, study };
int defaults_command(InputKind kind);
int schema_command(InputKind kind);
struct NewCommand {
  std::filesystem::path directory, shaft;
  bool is_own = false;
};
int new_command(const NewCommand& command);

struct HeatCommand {
  std::filesystem::path file, directory;
  std::vector<std::string> overrides;
  bool force = false, quiet = false;
};
int heat_command(const HeatCommand& command);

struct CalibrateCommand {
  std::filesystem::path file, output;
  std::vector<std::string> overrides;
  std::string until;
  bool force = false, quiet = false;
};
/// The circuits of a case fitted to its finite elements, into a parameter file.
int calibrate_command(const CalibrateCommand& command);

struct CompareCommand {
  std::filesystem::path directory, against, measured, output;
  std::string tolerance, floor, growth_tolerance, times, band_length;  ///< as given; empty: default
  bool force = false, quiet = false;
};
int compare_command(const CompareCommand& command);

struct ReportCommand {
  std::filesystem::path directory, output;
  bool force = false, quiet = false;
};
int report_command(const ReportCommand& command);

struct MeshCommand {
  std::filesystem::path file, output;
  std::vector<std::string> overrides;
  std::string bearing, format = "4.1";
  bool force = false, quiet = false;
};
int mesh_command(const MeshCommand& command);

struct ModesCommand {
  std::filesystem::path file, shapes;
  std::vector<std::string> overrides;
  std::string speeds;
  bool json = false;
  std::size_t n_modes = 10;
};
int modes_command(const ModesCommand& command);

struct CriticalSpeedsCommand {
  std::filesystem::path file, diagram;
  std::vector<std::string> overrides;
  std::string up_to, stiffness, map;  ///< as given; empty: default
  bool json = false, force = false;
};
int critical_speeds_command(const CriticalSpeedsCommand& command);

struct StaticsCommand {
  std::filesystem::path file;
  std::vector<std::string> overrides;
  std::string bearing;
  bool json = false;
};
int statics_command(const StaticsCommand& command);

struct PreloadCommand {
  std::filesystem::path file, directory, results;
  std::vector<std::string> overrides;
  std::string bearing;
  bool json = false, force = false, quiet = false;
};
int preload_command(const PreloadCommand& command);

/// What the reference drop takes from the heap, and with finite elements beside the circuit and the comparison of both [bytes].
inline constexpr std::size_t heap_of_a_drop = 10'000'000, heap_of_a_comparison = 26'000'000;

/// "rotordrop 0.2.0 (revision ...; SUNDIALS ..., HDF5 ...)".
std::string version_text();

}  // namespace rotordrop
