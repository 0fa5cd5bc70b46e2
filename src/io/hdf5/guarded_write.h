#pragma once
// Private to this room: blocks of a file that a kill must not leave half old, half new.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rotordrop::hdf5 {

/// Writes a block whole even if the process is killed within the write. The system copies a write page by page (4 KiB) and ends it between
/// two pages when a SIGKILL waits. A block that goes over a page's end is therefore written first as a copy to the end of the file, of
/// which `end_of_use` says how much is in use; the copy is struck out afterwards. Without room for it the block is written as it is.
/// @param file_size  size of the file [bytes]
/// @returns false with errno set if the system does not write
[[nodiscard]] bool write_whole(int descriptor, std::uint64_t address, std::span<const unsigned char> bytes,
                               std::uint64_t end_of_use, std::uint64_t file_size);

/// A block that a kill has left half written, as it was meant.
class TornBlock {
 public:
  /// @returns nothing if the file has none
  [[nodiscard]] static std::optional<TornBlock> find(int descriptor);

  /// Puts the meant bytes into what was read from `address` on, unless the file has gone on since: it may be of a living process.
  void mend(int descriptor, std::uint64_t address, std::span<unsigned char> read) const;

 private:
  using Mark = std::array<unsigned char, 32>;
  TornBlock() = default;
  std::uint64_t mark_at_ = 0, address_ = 0;
  Mark mark_{};
  std::vector<unsigned char> content_;

  friend bool write_whole(int, std::uint64_t, std::span<const unsigned char>, std::uint64_t, std::uint64_t);
  [[nodiscard]] static std::uint64_t mark_position(std::uint64_t file_size);
  [[nodiscard]] static Mark mark_of(std::uint64_t address, std::span<const unsigned char> content);
};

}  // namespace rotordrop::hdf5
