#pragma once
// Checkpoints: all that a run needs to go on, written so that a killed program or a full disk never leaves less than before.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rotordrop {

/// What a run needs to go on from a time.
struct Checkpoint {
  double time = 0;            ///< [s]
  std::vector<double> state;  ///< [n_state], SI
  std::map<std::string, std::vector<double>>
      extras;                            ///< what is not in the state: "window/TB2", "integrator"; any size
  std::string parameter_digest;          ///< tells whether the parameters are the same
  std::vector<std::string> entry_names;  ///< [n_state] names of the state's entries, from StateLayout

  bool operator==(const Checkpoint&) const = default;
};

/// Writes DIRECTORY/checkpoint-000123.h5 under the next free number, then removes all but the newest `keep`. The directory is made
/// if it does not exist. The file is complete and on the disk when it gets its name.
/// @param keep  >= 1; two or more, so that one can be damaged
/// @return the path of the new file
/// @throws SolverError if it cannot be written
std::filesystem::path write_checkpoint(const std::filesystem::path& directory, const Checkpoint& checkpoint,
                                       std::size_t keep = 3);

/// @throws InputError if the file is missing, cut off or altered
[[nodiscard]] Checkpoint read_checkpoint(const std::filesystem::path& path);

/// Refuses a checkpoint of another case; the message says which entries differ.
/// @param path     of the checkpoint, for the message
/// @param differs  asked for which parameters differ, if some do; empty if that is not known
/// @throws InputError
void require_same_case(const std::filesystem::path& path, const Checkpoint& checkpoint,
                       const std::string& parameter_digest, const std::vector<std::string>& entry_names,
                       const std::function<std::string()>& differs = {});

struct FoundCheckpoint {
  std::filesystem::path path;            ///< empty if none was found
  std::optional<Checkpoint> checkpoint;  ///< the newest that can be read
  std::vector<std::string> skipped;      ///< for each newer one that could not be read: path and reason
};

/// Whether a directory holds a checkpoint, readable or not.
[[nodiscard]] bool holds_checkpoint(const std::filesystem::path& directory);

/// The newest checkpoint in a directory that can be read; unreadable ones are skipped and named. No directory: nothing found.
/// @param older_than  a checkpoint of the directory: only those that were written before it
[[nodiscard]] FoundCheckpoint newest_valid_checkpoint(const std::filesystem::path& directory,
                                                      const std::filesystem::path& older_than = {});

/// Replaces a file's content (text or any bytes) in one step: whoever opens `path` sees the old or the new content, never a part,
/// even if the program is killed or the disk is full. @throws InputError if its name or place forbids it, SolverError else
void write_text_atomically(const std::filesystem::path& path, std::string_view text);
/// Before others write a file: makes its folder, and finds out whether a file can be made there.
/// @throws InputError if names or permissions forbid it, SolverError for other reasons
void require_writable(const std::filesystem::path& path);

/// Has the system bring a closed file to the disk; false if it could not, such as when the disk is full.
[[nodiscard]] bool is_on_disk(const std::filesystem::path& path);

}  // namespace rotordrop
