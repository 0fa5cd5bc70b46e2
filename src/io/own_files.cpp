#include "io/own_files.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <system_error>

#include "base/errors.h"
#include "io/checkpoint.h"

namespace rotordrop {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(fs::symlink_status(path, ignored));
}

std::string beginning(const fs::path& file, std::size_t n) {
  std::ifstream stream(file, std::ios::binary);
  std::string text(n, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(n));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return text;
}

bool holds(const fs::path& path, const char* mark) {
  if (!is_file(path)) return false;
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  return text.find(mark) != std::string::npos;
}

/// HDF5 writes the attributes of a file behind its superblock, so that a file whose rest is damaged is known as well.
bool is_own_hdf5(const std::string& text) {
  // A comparison of version 0.1 has no name of the program.
  return text.starts_with("\x89HDF\r\n\x1a\n") &&
         (text.find("rotordrop ") != std::string::npos || text.find("temperatures of the bores") != std::string::npos);
}

bool is_own_json(const std::string& text) {
  // Version 0.1 did not write its name.
  constexpr std::array<std::string_view, 3> first_version{"{\n  \"case\": \"", "{\n  \"study\": \"",
                                                          "{\n  \"run\": {\n    \"directory\": \""};
  return text.find("\"program\": \"rotordrop ") != std::string::npos ||
         std::any_of(first_version.begin(), first_version.end(), [&](auto words) { return text.starts_with(words); });
}

bool is_own_journal(const std::string& text) { return text.find(R"( {"header":"{\"study\":\")") == 16; }

/// Tables of a study: its points, and the measured series of its fit.
bool is_own_csv(const std::string& text) {
  const auto header = text.substr(0, text.find('\n'));
  return (header.starts_with("point,") && header.find(",status,") != std::string::npos) ||
         header.starts_with("# measured series in SI: number, unit");
}

}  // namespace

bool is_own_results(const fs::path& file) {
  if (!is_file(file)) return false;
  const std::string text = beginning(file, 16384);
  if (file.extension() == ".h5") return is_own_hdf5(text);
  if (file.extension() == ".csv") return is_own_csv(text);
  return file.extension() == ".journal" ? is_own_journal(text) : is_own_json(text);
}

std::string name_of_study(const fs::path& directory) {
  using Json = nlohmann::json;
  const fs::path journal = directory / "study.journal";
  if (!is_own_results(journal)) return "";
  std::string line;
  std::ifstream file(journal);
  std::getline(file, line);
  const Json record = Json::parse(line.substr(line.find(' ')), nullptr, false);
  if (!record.is_object() || !record.contains("header") || !record["header"].is_string()) return "";
  const Json header = Json::parse(record["header"].get<std::string>(), nullptr, false);
  const bool has_name = header.is_object() && header.contains("name") && header["name"].is_string();
  return has_name ? header["name"].get<std::string>() : "";
}

bool is_hollow(const fs::path& file) {
  if (!is_file(file)) return false;
  const std::string text = beginning(file, 4096);
  return std::all_of(text.begin(), text.end(), [](char c) { return c == '\0'; });
}

bool is_own_page(const fs::path& file) { return holds(file, R"(<main id="page"></main>)"); }

bool is_own_diagram(const fs::path& file) { return holds(file, ".spin{stroke:"); }

void write_page(const fs::path& file, const std::string& page) {
  std::error_code ignored;
  if (fs::exists(fs::symlink_status(file, ignored)) && !is_own_page(file))
    throw InputError({file.string()}, "this file is no page of the program; it is left as it is.",
                     "Give the page another name.");
  write_text_atomically(file, page);
}

bool is_written_parameters(const fs::path& file) {
  std::ifstream text(file);
  int n_values = 0, n_origins = 0;
  for (std::string line; std::getline(text, line);) {
    if (line.find(" = ") == std::string::npos || line.starts_with('#')) continue;
    ++n_values;
    n_origins += line.find("  # from ") != std::string::npos || line.find("  # default") != std::string::npos ? 1 : 0;
  }
  return n_values > 0 && n_origins == n_values;
}

}  // namespace rotordrop
