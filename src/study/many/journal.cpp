#include "study/many/journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

#include "io/sha256.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

Json numbers(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(std::isfinite(value) ? Json(value) : Json(nullptr));
  return list;
}
std::vector<double> numbers_of(const Json& list) {
  std::vector<double> values;
  values.reserve(list.size());
  for (const auto& value : list)
    values.push_back(value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>());
  return values;
}

PointRecord record_of(const Json& line) {
  PointRecord record;
  record.point = line.at("point").get<std::size_t>();
  record.is_done = line.at("done").get<bool>();
  record.reason = line.at("reason").get<std::string>();
  record.cpu_time = line.at("cpu").get<double>();
  record.layout = line.at("layout").get<std::size_t>();
  record.values = numbers_of(line.at("values"));
  if (line.contains("at")) record.at = numbers_of(line["at"]);
  if (line.contains("series"))
    for (const auto& s : line["series"])
      record.series.push_back({s.at("path"), s.at("unit"), s.at("long_name"), s.at("width"), numbers_of(s.at("time")),
                               numbers_of(s.at("values"))});
  return record;
}

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// The next sound line of a journal; none: it ends, or is damaged from here on.
std::optional<Json> next_line(std::istream& in, std::size_t& bytes) {
  std::string line;
  if (!std::getline(in, line) || in.eof()) return {};  // no line break: its writer was killed
  constexpr std::size_t n = check_sum_digits;
  if (line.size() < n + 2 || line[n] != ' ' || check_sum(std::string_view(line).substr(n + 1)) != line.substr(0, n))
    return {};
  Json json = Json::parse(line.begin() + n + 1, line.end(), nullptr, false);
  if (json.is_discarded()) return {};
  bytes = line.size() + 1;
  return json;
}

/// The header that begins a journal. @throws InputError
std::string header_in(std::istream& in, const std::filesystem::path& file, std::size_t& bytes) {
  if (!in) throw InputError({file.string(), 0, 0}, "there is no such file, or it cannot be read.");
  const auto line = next_line(in, bytes);
  if (!line || !line->is_object() || !line->contains("header") || !(*line)["header"].is_string())
    throw InputError({file.string(), 0, 0}, "this is not the journal of a study, or its beginning is damaged.");
  return (*line)["header"];
}

[[noreturn]] void not_written(const std::filesystem::path& file) {
  throw SolverError(file.string() + " cannot be written: " + std::generic_category().message(errno) +
                    ".\n       Finished points are kept. Go on with --resume when there is room.");
}

}  // namespace

PointResult result_of(const PointRecord& record, const std::vector<std::vector<std::string>>& layouts) {
  PointResult result;
  result.is_done = record.is_done;
  result.reason = record.reason;
  result.series = record.series;
  result.at = record.at;
  for (std::size_t i = 0; i < record.values.size(); ++i)
    result.scalars.emplace_back(layouts[record.layout][i], record.values[i]);
  return result;
}

Journal::Content Journal::read(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  Content content;
  std::size_t bytes = 0;
  content.header = header_in(in, file, bytes);
  content.valid_bytes = bytes;
  while (const auto json = next_line(in, bytes)) {
    try {
      if (json->contains("names")) {
        content.layouts.push_back(json->at("names").get<std::vector<std::string>>());
      } else {
        PointRecord record = record_of(*json);
        if (record.is_done &&
            (record.layout >= content.layouts.size() || content.layouts[record.layout].size() != record.values.size()))
          break;
        const std::size_t point = record.point;
        content.records.insert_or_assign(point, std::move(record));
      }
    } catch (const Json::exception&) {
      break;
    }
    content.valid_bytes += bytes;
  }
  return content;
}

std::string Journal::header_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::size_t bytes = 0;
  return header_in(in, file, bytes);
}

Journal::Journal(std::filesystem::path file, const std::string& header) : file_(std::move(file)) {
  handle_ = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (handle_ < 0) not_written(file_);
  write_line(Json{{"header", header}}.dump());
  sync();
}

Journal::Journal(std::filesystem::path file, const Content& content)
    : file_(std::move(file)), layouts_(content.layouts) {
  handle_ = ::open(file_.c_str(), O_WRONLY | O_CLOEXEC);
  if (handle_ < 0 || ::ftruncate(handle_, static_cast<off_t>(content.valid_bytes)) != 0 ||
      ::lseek(handle_, 0, SEEK_END) < 0)
    not_written(file_);
}

Journal::~Journal() {
  if (handle_ >= 0) ::close(handle_);
}

void Journal::write_line(const std::string& json) {
  const std::string line = check_sum(json) + " " + json + "\n";
  for (std::size_t at = 0; at < line.size();) {
    const ssize_t n = ::write(handle_, line.data() + at, line.size() - at);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) not_written(file_);
    at += static_cast<std::size_t>(n);
  }
}

void Journal::append(std::size_t point, const PointResult& result, double cpu_time) {
  std::vector<std::string> names;
  std::vector<double> values;
  for (const auto& [name, value] : result.scalars) {
    names.push_back(name);
    values.push_back(value);
  }
  Json line{{"point", point}, {"done", result.is_done}, {"reason", result.reason}, {"cpu", cpu_time}};
  Json series = Json::array();
  for (const auto& s : result.series)
    series.push_back({{"path", s.path},
                      {"unit", s.unit},
                      {"long_name", s.long_name},
                      {"width", s.width},
                      {"time", numbers(s.time)},
                      {"values", numbers(s.values)}});
  if (!result.at.empty()) line["at"] = numbers(result.at);
  const std::scoped_lock lock(lock_);
  auto layout = std::find(layouts_.begin(), layouts_.end(), names);
  if (layout == layouts_.end()) {
    write_line(Json{{"names", names}}.dump());
    layouts_.push_back(names);
    layout = layouts_.end() - 1;
  }
  line["layout"] = layout - layouts_.begin();
  line["values"] = numbers(values);
  if (!series.empty()) line["series"] = std::move(series);
  write_line(line.dump(-1, ' ', false, Json::error_handler_t::replace));
  if (now() - last_sync_ > 1.) sync();
}

void Journal::sync() {
  if (::fdatasync(handle_) != 0 && errno != EINVAL) not_written(file_);
  last_sync_ = now();
}

}  // namespace rotordrop
