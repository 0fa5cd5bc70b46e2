#include "io/hdf5/file_bytes.h"

#include <array>
#include <bit>
#include <cerrno>

#include <unistd.h>

namespace rotordrop::hdf5 {

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

std::uint64_t number_at(std::span<const unsigned char> bytes, std::size_t at, std::size_t n_bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < n_bytes; ++i) value |= std::uint64_t{bytes[at + i]} << (8 * i);
  return value;
}

void put_number(std::span<unsigned char> bytes, std::size_t at, std::uint64_t value, std::size_t n_bytes) {
  for (std::size_t i = 0; i < n_bytes; ++i) bytes[at + i] = static_cast<unsigned char>(value >> (8 * i));
}

std::optional<std::size_t> read_up_to(int descriptor, std::uint64_t address, std::span<unsigned char> bytes) {
  std::size_t size = 0;
  while (size < bytes.size()) {
    const ssize_t n = ::pread(descriptor, bytes.data() + size, bytes.size() - size, static_cast<off_t>(address + size));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return std::nullopt;
    if (n == 0) break;
    size += static_cast<std::size_t>(n);
  }
  return size;
}

bool read_bytes(int descriptor, std::uint64_t address, std::span<unsigned char> bytes) {
  return read_up_to(descriptor, address, bytes) == bytes.size();
}

}  // namespace rotordrop::hdf5
