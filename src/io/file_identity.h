#pragma once
#include <compare>
#include <cstdint>
#include <filesystem>
#include <optional>

namespace rotordrop {

/// Which file is at a path, however much is added to it: device, number, and birth where the file system knows it, since numbers are given again.
struct FileIdentity {
  std::uint64_t device = 0, number = 0;
  std::int64_t born_seconds = 0, born_nanoseconds = 0;
  auto operator<=>(const FileIdentity&) const = default;
};

/// Nothing where there is no regular file.
std::optional<FileIdentity> identity_of(const std::filesystem::path& file);

}  // namespace rotordrop
