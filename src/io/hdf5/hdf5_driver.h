#pragma once
// Private to this room: the file driver under result files.

#include <filesystem>
#include <string_view>

#include "io/hdf5/hdf5_handle.h"

namespace rotordrop::hdf5 {

/// Property list for a new result file that any program can open at any time, also with plain `h5py.File(path, "r")`, and also after the
/// writer was killed.
///
/// HDF5 marks a file that is being written in its superblock, refuses to open it as long as the mark is there, and refuses to read beyond
/// the end of file that the superblock announces. Of what is written in SWMR mode neither is necessary: that mode orders all writes so
/// that the file is sound at every instant. This driver therefore never lets the mark reach the disk, and it announces an end of file
/// that is always ahead of what is in use (the file is half as long again, which takes no room on disk until it is filled; closing cuts
/// it to its length). It takes no locks. That order does not cover a write that a kill ends halfway: see guarded_write.h.
[[nodiscard]] Handle access_for_writing();

/// Where a kill has left a block of the file half written, has it read as it was meant.
void mend_while_reading(hid_t access, const std::filesystem::path& path);

/// Has the system bring what was written to the disk. @throws SolverError "WHAT: reason"
void sync(hid_t file, std::string_view what);

}  // namespace rotordrop::hdf5
