#pragma once
#include <filesystem>

namespace rotordrop::hdf5 {

/// Reads all objects of a file in a process of its own, once for each file: HDF5 itself (1.10.8) may crash, or never end, on a file with a few
/// altered bytes of metadata. In a process with a sanitizer it does so, too, though slowly.
/// @throws DamagedFile if that process ends by a signal, or has to be ended
void require_readable(const std::filesystem::path& path);
/// Of a file that this process has made itself: it is not tried.
void know_readable(const std::filesystem::path& path);

/// The same, each time that it is called. @param patience  what HDF5 may need besides the time of reading [s]
void try_to_read(const std::filesystem::path& path, unsigned patience = 20);

}  // namespace rotordrop::hdf5
