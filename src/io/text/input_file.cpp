#include "io/text/input_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/parameters/suggestion.h"
#include "io/read_files.h"

namespace rotordrop {

namespace {

struct Descriptor {
  int number = -1;
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
};

/// 'Did you mean "drop.toml"?  ' of a file that is not there; empty if nothing there has nearly its name.
std::string near_name(const std::filesystem::path& path) {
  const auto named = [](const std::filesystem::path& meant) {
    return fmt::format("Did you mean \"{}\"?  ", meant.string());
  };
  std::error_code ignored;
  const std::filesystem::path with_ending = path.string() + ".toml";
  if (std::filesystem::exists(with_ending, ignored)) return named(with_ending);
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  std::vector<std::string> names;
  constexpr std::size_t most = 1000;
  for (std::filesystem::directory_iterator file(folder, ignored), end; file != end && names.size() < most;
       file.increment(ignored))
    if (file->path().extension() == path.extension()) names.push_back(file->path().filename().string());
  const std::string close = closest_name(path.filename().string(), names);
  return close.empty() ? "" : named(path.parent_path() / close);
}

}  // namespace

std::string read_input_file(const std::filesystem::path& path, const SourcePosition& named_at, std::size_t largest) {
  const SourcePosition where = named_at.is_known() ? named_at : SourcePosition{path.string()};
  const auto refuse = [&](const std::string& why, const std::string& advice) {
    throw InputError(where, fmt::format("file \"{}\" cannot be read{}.", path.string(), why), advice);
  };
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    const int error = errno;
    refuse(": " + std::generic_category().message(error),
           (error == ENOENT ? near_name(path) : "") + "Check its name and permissions.");
  }
  if (!S_ISREG(status.st_mode))
    refuse(S_ISDIR(status.st_mode) ? ": it is a directory" : ": it is a device or a pipe", "Give a regular file.");
  if (static_cast<std::size_t>(status.st_size) > largest)
    refuse(fmt::format(": it has {} bytes, more than the {} that such a file may have", status.st_size, largest),
           "Check its name.");
  Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
  if (file.number < 0) refuse(": " + std::generic_category().message(errno), "Check its name and permissions.");
  std::string content(static_cast<std::size_t>(status.st_size), '\0');
  std::size_t size = 0;
  while (size < content.size()) {
    const ssize_t n = ::read(file.number, content.data() + size, content.size() - size);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) refuse(": " + std::generic_category().message(errno), "Check the disk.");
    if (n == 0) break;
    size += static_cast<std::size_t>(n);
  }
  content.resize(size);
  remember_read(path);
  return content;
}

void require_printable_key(std::string_view key, const SourcePosition& where) {
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
  if (std::any_of(key.begin(), key.end(), is_control))
    throw InputError(where, "this key holds a control character, such as a line break.",
                     "Names become parts of datasets and files: use letters, digits, - and _.");
}

void require_table_size(std::size_t n_keys, const SourcePosition& where) {
  if (n_keys > longest_table)
    throw InputError(where, fmt::format("this table has {} keys; at most {} are read.", n_keys, longest_table),
                     "Check whether this is the file that was meant.");
}

void require_shallow_toml(std::string_view text, const std::string& file) {
  std::size_t line = 1, dots = 0, depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"' || c == '\'') {  // texts, of one or of several lines, are passed over
      const std::string three(3, c);
      const bool is_long = text.substr(i, 3) == three;
      std::size_t end = i + (is_long ? 3 : 1);
      for (; end < text.size(); ++end) {
        if (text[end] == '\n') {
          ++line;
          if (!is_long) break;
        }
        if (text[end] == '\\' && c == '"')
          ++end;
        else if (is_long ? text.substr(end, 3) == three : text[end] == c)
          break;
      }
      i = is_long ? end + 2 : end;
      continue;
    }
    if (c == '#') {
      while (i + 1 < text.size() && text[i + 1] != '\n') ++i;
    } else if (c == '.') {
      ++dots;
    } else if (c == '[' || c == '{') {
      ++depth;
      dots = 0;
    } else if (c == ']' || c == '}') {
      depth -= depth > 0 ? 1 : 0;
      dots = 0;
    } else if (c == '\n' || c == '=' || c == ',') {
      line += c == '\n' ? 1 : 0;
      dots = 0;
    }
    if (dots > deepest_input || depth > deepest_input)
      throw InputError({file, static_cast<int>(line), 1},
                       fmt::format("tables or arrays are nested more than {} deep here.", deepest_input),
                       "No case needs that; check the file.");
  }
}

}  // namespace rotordrop
