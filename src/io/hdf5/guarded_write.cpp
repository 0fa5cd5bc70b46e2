#include "io/hdf5/guarded_write.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstddef>

#include <sys/stat.h>
#include <unistd.h>

namespace rotordrop::hdf5 {

namespace {

constexpr std::uint64_t page = 4096;  // the smallest of any system
constexpr std::array<unsigned char, 8> begin_of_mark{'t', 'o', 'r', 'n', 'c', 'o', 'p', 'y'};

std::uint64_t number_at(std::span<const unsigned char> bytes, std::size_t at, std::size_t n_bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < n_bytes; ++i) value |= std::uint64_t{bytes[at + i]} << (8 * i);
  return value;
}

void put_number(std::span<unsigned char> bytes, std::size_t at, std::uint64_t value, std::size_t n_bytes) {
  for (std::size_t i = 0; i < n_bytes; ++i) bytes[at + i] = static_cast<unsigned char>(value >> (8 * i));
}

/// Bytes from `address` to the end of its page.
std::uint64_t rest_of_page(std::uint64_t address) { return page - address % page; }

bool read_whole(int descriptor, std::uint64_t address, std::span<unsigned char> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::pread(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(address));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(n));
    address += static_cast<std::uint64_t>(n);
  }
  return true;
}

}  // namespace

std::uint32_t lookup3(std::span<const unsigned char> bytes) {
  const std::size_t n = bytes.size();
  std::uint32_t a = 0xdeadbeefU + static_cast<std::uint32_t>(n), b = a, c = a;
  const auto add = [&](std::size_t at, std::size_t count) {
    std::array<std::uint32_t, 3> words{};
    for (std::size_t i = 0; i < count; ++i) words[i / 4] += static_cast<std::uint32_t>(bytes[at + i]) << (8 * (i % 4));
    a += words[0];
    b += words[1];
    c += words[2];
  };
  std::size_t at = 0;
  for (; n - at > 12; at += 12) {
    add(at, 12);
    a -= c, a ^= std::rotl(c, 4), c += b;
    b -= a, b ^= std::rotl(a, 6), a += c;
    c -= b, c ^= std::rotl(b, 8), b += a;
    a -= c, a ^= std::rotl(c, 16), c += b;
    b -= a, b ^= std::rotl(a, 19), a += c;
    c -= b, c ^= std::rotl(b, 4), b += a;
  }
  add(at, n - at);
  c ^= b, c -= std::rotl(b, 14);
  a ^= c, a -= std::rotl(c, 11);
  b ^= a, b -= std::rotl(a, 25);
  c ^= b, c -= std::rotl(b, 16);
  a ^= c, a -= std::rotl(c, 4);
  b ^= a, b -= std::rotl(a, 14);
  c ^= b, c -= std::rotl(b, 24);
  return c;
}

bool write_bytes(int descriptor, std::uint64_t address, std::span<const unsigned char> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::pwrite(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(address));
    if (n < 0 && errno == EINTR) continue;
    if (n == 0) errno = ENOSPC;
    if (n <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(n));
    address += static_cast<std::uint64_t>(n);
  }
  return true;
}

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
  if (!read_whole(descriptor, block.mark_at_, block.mark_) ||
      !std::equal(begin_of_mark.begin(), begin_of_mark.end(), block.mark_.begin()) ||
      number_at(block.mark_, 28, 4) != lookup3(std::span(block.mark_).first(28)))
    return std::nullopt;
  block.address_ = number_at(block.mark_, 8, 8);
  const std::uint64_t size = number_at(block.mark_, 16, 8), first = rest_of_page(block.address_);
  if (size <= first || size > block.mark_at_ || block.address_ > block.mark_at_ - size) return std::nullopt;
  block.content_.resize(size);
  std::vector<unsigned char> there(size);
  if (!read_whole(descriptor, block.mark_at_ - size, block.content_) ||
      number_at(block.mark_, 24, 4) != lookup3(block.content_) || !read_whole(descriptor, block.address_, there))
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
  if (!read_whole(descriptor, mark_at_, now) || now != mark_) return;
  std::copy_n(content_.begin() + static_cast<std::ptrdiff_t>(from - address_), to - from,
              read.begin() + static_cast<std::ptrdiff_t>(from - address));
}

}  // namespace rotordrop::hdf5
