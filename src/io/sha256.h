#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace rotordrop {

/// SHA-256 (FIPS 180-4) as 64 hexadecimal digits, as the command sha256sum prints it.
std::string sha256_of(std::string_view bytes);
inline constexpr std::size_t check_sum_digits = 16;
/// Its first check_sum_digits: they find every changed byte and every missing end.
std::string check_sum(std::string_view bytes);
/// SHA-256 of a TOML text without its comments and without white space outside of quotes.
std::string sha256_of_toml(std::string_view text);
/// SHA-256 of a file's content. @throws InputError if it cannot be read
std::string sha256_of_file(const std::filesystem::path& path);

}  // namespace rotordrop
