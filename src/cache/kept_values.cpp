#include "cache/kept_values.h"

#include <zlib.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <tuple>
#include <vector>

#include "io/checkpoint.h"
#include "io/text/input_file.h"

namespace rotordrop {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view mark = "rotordrop cache 1\n";
constexpr std::string_view ending = ".kept";
constexpr std::uintmax_t folder_limit = 256u << 20u;  // [bytes]: some hundred sections

std::uint32_t checksum(std::string_view bytes) {
  return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

/// @returns values in the text of a file; none of a damaged one
std::map<std::string, std::string_view> values_in(std::string_view text) {
  std::map<std::string, std::string_view> values;
  if (!text.starts_with(mark)) return values;
  try {
    plain::Reader reader(text.substr(mark.size()));
    std::uint32_t sum = 0;
    reader.get(sum);
    if (sum != checksum(text.substr(mark.size() + sizeof sum))) return values;
    std::vector<std::string> names;
    std::vector<std::string_view> bytes;
    reader.get(names);
    reader.get(bytes);
    if (names.size() != bytes.size()) return {};
    for (std::size_t i = 0; i < names.size(); ++i) values.emplace(std::move(names[i]), bytes[i]);
  } catch (const std::out_of_range&) {
    values.clear();
  }
  return values;
}

}  // namespace

fs::path cache_folder() {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return std::string(value ? value : "");
  };
  fs::path folder;
  if (const auto chosen = variable("ROTORDROP_CACHE"); !chosen.empty()) {
    if (chosen == "off") return {};
    folder = chosen;
  } else if (const auto base = variable("XDG_CACHE_HOME"); !base.empty()) {
    folder = fs::path(base) / "rotordrop";
  } else if (const auto home = variable("HOME"); !home.empty()) {
    folder = fs::path(home) / ".cache" / "rotordrop";
  } else {
    return {};
  }
  std::error_code error;
  fs::create_directories(folder, error);
  return fs::is_directory(folder, error) ? folder : fs::path();
}

void shrink_cache(const fs::path& folder, std::uintmax_t limit) {
  std::error_code error;
  std::vector<std::tuple<fs::file_time_type, std::uintmax_t, fs::path>> files;
  std::uintmax_t size = 0;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() != ending || !entry.is_regular_file(error)) continue;
    files.emplace_back(entry.last_write_time(error), entry.file_size(error), entry.path());
    size += std::get<1>(files.back());
  }
  std::sort(files.begin(), files.end());
  for (const auto& [time, bytes, path] : files) {
    if (size <= limit) break;
    fs::remove(path, error);
    size -= bytes;
  }
}

KeptValues::KeptValues(const fs::path& folder, const std::string& content) {
  if (folder.empty()) return;
  file_ = folder / (content + std::string(ending));
  try {
    text_ = read_input_file(file_, {}, folder_limit);
  } catch (const InputError&) {  // there is none yet, or it cannot be read
  }
  values_ = values_in(text_);
  std::error_code error;
  if (!values_.empty()) fs::last_write_time(file_, fs::file_time_type::clock::now(), error);  // used last
}

KeptValues::~KeptValues() {
  try {
    save();
  } catch (...) {  // a cache that cannot be written is none
  }
}

void KeptValues::keep(const std::string& name, std::string bytes) {
  values_[name] = added_.emplace_back(std::move(bytes));
  is_changed_ = true;
}

void KeptValues::save() {
  if (!is_changed_ || file_.empty()) return;
  is_changed_ = false;
  std::vector<std::string> names, bytes;
  for (const auto& [name, value] : values_) {
    names.push_back(name);
    bytes.emplace_back(value);
  }
  plain::Writer content;
  content.add(names);
  content.add(bytes);
  plain::Writer sum;
  sum.add(checksum(content.bytes()));
  try {
    write_text_atomically(file_, std::string(mark) + sum.bytes() + content.bytes());
    shrink_cache(file_.parent_path(), folder_limit);
  } catch (const std::exception&) {  // a full disk, a folder that was removed
  }
}

}  // namespace rotordrop
