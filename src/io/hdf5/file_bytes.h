#pragma once
// Private to this room: bytes at places of a file, and numbers in them as HDF5 writes them.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace rotordrop::hdf5 {

/// The check sum of HDF5's metadata: lookup3 by Bob Jenkins (public domain), of at least one byte.
[[nodiscard]] std::uint32_t lookup3(std::span<const unsigned char> bytes);

/// Numbers of up to eight bytes, the lowest first.
void put_number(std::span<unsigned char> bytes, std::size_t at, std::uint64_t value, std::size_t n_bytes);
[[nodiscard]] std::uint64_t number_at(std::span<const unsigned char> bytes, std::size_t at, std::size_t n_bytes);

/// Writes all bytes. @returns false with errno set if the system does not
[[nodiscard]] bool write_bytes(int descriptor, std::uint64_t address, std::span<const unsigned char> bytes);

/// Reads up to the end of the file. @returns how many bytes there were; nothing, with errno set, if the system does not read
[[nodiscard]] std::optional<std::size_t> read_up_to(int descriptor, std::uint64_t address,
                                                    std::span<unsigned char> bytes);
/// Whether all of them were there.
[[nodiscard]] bool read_bytes(int descriptor, std::uint64_t address, std::span<unsigned char> bytes);

}  // namespace rotordrop::hdf5
