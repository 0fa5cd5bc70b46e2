#include "io/hdf5/guarded_write.h"

#include <algorithm>

#include <sys/stat.h>

#include "io/hdf5/file_bytes.h"

namespace rotordrop::hdf5 {

namespace {

constexpr std::uint64_t page = 4096;  // the smallest of any system
constexpr std::array<unsigned char, 8> begin_of_mark{'t', 'o', 'r', 'n', 'c', 'o', 'p', 'y'};

/// Bytes from `address` to the end of its page.
std::uint64_t rest_of_page(std::uint64_t address) { return page - address % page; }

}  // namespace

/// The last multiple of its size before the end of the file, so that a mark never goes over a page's end.
std::uint64_t TornBlock::mark_position(std::uint64_t file_size) {
  const std::uint64_t size = Mark{}.size();
  return file_size < size ? 0 : file_size / size * size - size;
}

/// Begin, address and size of the block, check sum of it, check sum of the mark itself.
TornBlock::Mark TornBlock::mark_of(std::uint64_t address, std::span<const unsigned char> content) {
  Mark mark{};
  std::copy(begin_of_mark.begin(), begin_of_mark.end(), mark.begin());
  put_number(mark, 8, address, 8);
  put_number(mark, 16, content.size(), 8);
  put_number(mark, 24, lookup3(content), 4);
  put_number(mark, 28, lookup3(std::span(mark).first(28)), 4);
  return mark;
}

bool write_whole(int descriptor, std::uint64_t address, std::span<const unsigned char> bytes, std::uint64_t end_of_use,
                 std::uint64_t file_size) {
  const std::uint64_t mark_at = TornBlock::mark_position(file_size);
  const bool is_in_one_page = bytes.size() <= rest_of_page(address);
  if (is_in_one_page || mark_at < bytes.size() || mark_at - bytes.size() < end_of_use)
    return write_bytes(descriptor, address, bytes);
  const TornBlock::Mark mark = TornBlock::mark_of(address, bytes), no_mark{};
  // Copy, then mark: a copy that is itself torn has no mark.
  return write_bytes(descriptor, mark_at - bytes.size(), bytes) && write_bytes(descriptor, mark_at, mark) &&
         write_bytes(descriptor, address, bytes) && write_bytes(descriptor, mark_at, no_mark);
}

std::optional<TornBlock> TornBlock::find(int descriptor) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) return std::nullopt;
  TornBlock block;
  block.mark_at_ = mark_position(static_cast<std::uint64_t>(status.st_size));
  if (!read_bytes(descriptor, block.mark_at_, block.mark_) ||
      !std::equal(begin_of_mark.begin(), begin_of_mark.end(), block.mark_.begin()) ||
      number_at(block.mark_, 28, 4) != lookup3(std::span(block.mark_).first(28)))
    return std::nullopt;
  block.address_ = number_at(block.mark_, 8, 8);
  const std::uint64_t size = number_at(block.mark_, 16, 8), first = rest_of_page(block.address_);
  if (size <= first || size > block.mark_at_ || block.address_ > block.mark_at_ - size) return std::nullopt;
  block.content_.resize(size);
  std::vector<unsigned char> there(size);
  if (!read_bytes(descriptor, block.mark_at_ - size, block.content_) ||
      number_at(block.mark_, 24, 4) != lookup3(block.content_) || !read_bytes(descriptor, block.address_, there))
    return std::nullopt;
  // Nothing of it was written if its first page is another, all of it if there is no difference.
  const bool has_begun =
      std::equal(there.begin(), there.begin() + static_cast<std::ptrdiff_t>(first), block.content_.begin());
  if (!has_begun || there == block.content_) return std::nullopt;
  return block;
}

void TornBlock::mend(int descriptor, std::uint64_t address, std::span<unsigned char> read) const {
  const std::uint64_t from = std::max(address, address_),
                      to = std::min(address + read.size(), address_ + content_.size());
  if (from >= to) return;
  Mark now{};
  if (!read_bytes(descriptor, mark_at_, now) || now != mark_) return;
  std::copy_n(content_.begin() + static_cast<std::ptrdiff_t>(from - address_), to - from,
              read.begin() + static_cast<std::ptrdiff_t>(from - address));
}

}  // namespace rotordrop::hdf5
