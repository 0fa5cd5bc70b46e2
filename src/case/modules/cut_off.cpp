#include "case/modules/cut_off.h"

#include <elf.h>

#include <cstdint>
#include <cstring>
#include <fstream>

namespace rotordrop {
namespace {

/// Reads an object as it lies in the file. @returns false if the file ends before
template <class Object>
bool read_at(std::ifstream& file, std::uint64_t at, Object& object) {
  file.clear();
  file.seekg(static_cast<std::streamoff>(at));
  return static_cast<bool>(file.read(reinterpret_cast<char*>(&object), sizeof object));
}

}  // namespace

bool is_cut_off(const std::filesystem::path& path) {
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(path, error);
  std::ifstream file(path, std::ios::binary);
  Elf64_Ehdr header{};
  if (error || !file) return false;
  if (!read_at(file, 0, header)) {
    unsigned char magic[SELFMAG] = {};
    return read_at(file, 0, magic) && std::memcmp(magic, ELFMAG, SELFMAG) == 0;
  }
  if (std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0 || header.e_ident[EI_CLASS] != ELFCLASS64) return false;
  const auto is_beyond = [size](std::uint64_t from, std::uint64_t length) {
    return from > size || length > size - from;
  };
  if (is_beyond(header.e_shoff, std::uint64_t{header.e_shnum} * header.e_shentsize)) return true;
  for (std::uint64_t k = 0; k < header.e_phnum; ++k) {
    Elf64_Phdr segment{};
    if (!read_at(file, header.e_phoff + k * header.e_phentsize, segment)) return true;
    if (segment.p_type == PT_LOAD && is_beyond(segment.p_offset, segment.p_filesz)) return true;
  }
  return false;
}

}  // namespace rotordrop
