#include "io/sha256.h"

// The functions without OpenSSL's machinery of providers, whose start takes a millisecond.
#define OPENSSL_SUPPRESS_DEPRECATED
#include <fmt/format.h>
#include <openssl/sha.h>

#include <array>
#include <cctype>
#include <fstream>
#include <vector>

#include "base/errors.h"
#include "io/text/comments.h"

namespace rotordrop {

namespace {

class Sha256 {
 public:
  Sha256() { SHA256_Init(&context_); }
  void add(std::string_view bytes) { SHA256_Update(&context_, bytes.data(), bytes.size()); }
  std::string digest() {
    std::array<unsigned char, SHA256_DIGEST_LENGTH> digest{};
    SHA256_Final(digest.data(), &context_);
    std::string text;
    for (const unsigned byte : digest) text += fmt::format("{:02x}", byte);
    return text;
  }

 private:
  SHA256_CTX context_{};
};

}  // namespace

std::string sha256_of(std::string_view bytes) {
  Sha256 sha;
  sha.add(bytes);
  return sha.digest();
}

std::string check_sum(std::string_view bytes) { return sha256_of(bytes).substr(0, check_sum_digits); }

std::string sha256_of_toml(std::string_view text) {
  std::string significant;
  significant.reserve(text.size());
  char quote = 0;
  bool is_escaped = false;
  for (const char c : without_comments(text)) {
    if (quote == 0 && (c == '"' || c == '\''))
      quote = c;
    else if (c == '\n' || (c == quote && !is_escaped))
      quote = 0;
    is_escaped = quote == '"' && c == '\\' && !is_escaped;
    if (quote != 0 || !std::isspace(static_cast<unsigned char>(c))) significant += c;
  }
  return sha256_of(significant);
}

std::string sha256_of_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  Sha256 sha;
  std::vector<char> part(std::size_t{1} << 16U);
  while (file.read(part.data(), static_cast<std::streamsize>(part.size())) || file.gcount() > 0)
    sha.add({part.data(), static_cast<std::size_t>(file.gcount())});
  if (!file.eof()) throw InputError({path.string(), 0, 0}, "the file cannot be read");
  return sha.digest();
}

}  // namespace rotordrop
