#include "io/hdf5/field_reader.h"

#include <zlib.h>

#include <boost/archive/iterators/binary_from_base64.hpp>
#include <boost/archive/iterators/dataflow_exception.hpp>
#include <boost/archive/iterators/transform_width.hpp>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <string_view>

#include "base/errors.h"

namespace rotordrop {
namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError({path.string(), 0, 0}, "the file cannot be read");
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

[[noreturn]] void refuse(const fs::path& file, const std::string& why) {
  throw InputError({file.string(), 0, 0}, "this is not a rotordrop field: " + why,
                   "Run the case again, or remove its folder of fields.");
}

std::string from_base64(std::string_view text, const fs::path& file) {
  using namespace boost::archive::iterators;
  using Bytes = transform_width<binary_from_base64<std::string_view::const_iterator>, 8, 6>;
  text = text.substr(0, text.find('='));
  // Whole bytes only: the bits behind the last one are padding.
  std::string bytes(text.size() * 6 / 8, '\0');
  try {
    std::copy_n(Bytes(text.begin()), bytes.size(), bytes.begin());
  } catch (const dataflow_exception&) {
    refuse(file, "its data are not base64");
  }
  return bytes;
}

std::uint32_t integer_at(const std::string& bytes, std::size_t i) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + 4 * i, 4);
  return value;
}

/// Head: number of blocks, their size, the last one's, then the packed size of each. Head and blocks are base64 by themselves.
std::string unpacked(std::string_view text, const fs::path& file) {
  if (text.size() < 24) refuse(file, "an array is cut off");
  const std::string first = from_base64(text.substr(0, 8), file);
  if (first.size() < 4) refuse(file, "an array is damaged");
  const std::size_t n_blocks = integer_at(first, 0), n_head = 4 * (3 + n_blocks);
  const std::size_t n_coded = 4 * ((n_head + 2) / 3);
  if (n_coded > text.size()) refuse(file, "an array is cut off");
  const std::string head = from_base64(text.substr(0, n_coded), file), packed = from_base64(text.substr(n_coded), file);
  if (head.size() < n_head) refuse(file, "an array is damaged");
  std::string bytes;
  std::size_t at = 0;
  for (std::size_t k = 0; k < n_blocks; ++k) {
    const std::size_t n_packed = integer_at(head, 3 + k), last = integer_at(head, 2);
    uLongf n = k + 1 == n_blocks && last > 0 ? last : integer_at(head, 1);
    const std::size_t start = bytes.size();
    bytes.resize(start + n);
    if (at + n_packed > packed.size() ||
        uncompress(reinterpret_cast<Bytef*>(bytes.data() + start), &n,
                   reinterpret_cast<const Bytef*>(packed.data() + at), n_packed) != Z_OK)
      refuse(file, "an array is damaged");
    bytes.resize(start + n);
    at += n_packed;
  }
  return bytes;
}

template <class T>
std::vector<double> numbers(const std::string& bytes) {
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  return std::vector<double>(values.begin(), values.end());
}

std::string attribute(std::string_view tag, const std::string& name) {
  const auto at = tag.find(" " + name + "=\"");
  if (at == std::string_view::npos) return "";
  const auto from = at + name.size() + 3;
  return std::string(tag.substr(from, tag.find('"', from) - from));
}

/// The array of that name in `text`, or the first one if the name is empty.
std::vector<double> array_in(std::string_view text, const std::string& name, const fs::path& file) {
  for (std::size_t at = text.find("<DataArray"); at != std::string_view::npos; at = text.find("<DataArray", at + 1)) {
    const auto end = text.find('>', at), close = text.find("</DataArray>", at);
    if (end == std::string_view::npos || close == std::string_view::npos || close < end) break;
    const auto tag = text.substr(at, end - at);
    if (!name.empty() && attribute(tag, "Name") != name) continue;
    std::string content(text.substr(end + 1, close - end - 1));
    std::erase_if(content, [](unsigned char c) { return std::isspace(c); });
    const std::string bytes = unpacked(content, file), type = attribute(tag, "type");
    if (type == "Float64") return numbers<double>(bytes);
    if (type == "Float32") return numbers<float>(bytes);
    if (type == "Int32") return numbers<std::int32_t>(bytes);
    if (type == "UInt32") return numbers<std::uint32_t>(bytes);
    if (type == "Int64") return numbers<std::int64_t>(bytes);
    if (type == "UInt64") return numbers<std::uint64_t>(bytes);
    if (type == "UInt8") return numbers<std::uint8_t>(bytes);
    refuse(file, "an array is of type " + type);
  }
  refuse(file, name.empty() ? "it has no points" : "it has no \"" + name + "\"");
}

}  // namespace

std::vector<FieldFile> list_fields(const fs::path& pvd) {
  const std::string text = content_of(pvd);
  const std::regex entry("<DataSet timestep=\"([^\"]+)\"[^>]* file=\"([^\"]+)\"/>");
  std::vector<FieldFile> files;
  for (auto found = std::sregex_iterator(text.begin(), text.end(), entry); found != std::sregex_iterator(); ++found)
    files.push_back({std::stod((*found)[1]), pvd.parent_path() / (*found)[2].str()});
  return files;
}

TemperatureField read_field(const fs::path& vtu) {
  const std::string text = content_of(vtu);
  const auto points_at = text.find("<Points>");
  if (points_at == std::string::npos) refuse(vtu, "it has no points");
  const std::vector<double> points = array_in(std::string_view(text).substr(points_at), "", vtu);
  const std::vector<double> corners = array_in(text, "connectivity", vtu), types = array_in(text, "types", vtu),
                            body = array_in(text, "body", vtu);
  TemperatureField field;
  field.rise = array_in(text, "temperature rise [K]", vtu);
  const std::size_t n = field.rise.size();
  if (points.size() != 3 * n || corners.size() != 4 * types.size() ||
      (body.size() != n && body.size() != types.size()) ||
      std::any_of(types.begin(), types.end(), [](double type) { return type != 9.; }) ||
      std::any_of(corners.begin(), corners.end(), [n](double i) { return !(i >= 0. && i < static_cast<double>(n)); }))
    refuse(vtu, "its cells are not quadrilaterals, or arrays do not fit together");
  for (std::size_t i = 0; i < n; ++i) {
    field.x.push_back(points[3 * i]);
    field.r.push_back(points[3 * i + 1]);
  }
  for (std::size_t cell = 0; cell < types.size(); ++cell) {
    std::array<std::uint32_t, 4> around{};
    for (std::size_t k = 0; k < 4; ++k) around[k] = static_cast<std::uint32_t>(corners[4 * cell + k]);
    field.cells.push_back(around);
    field.body.push_back(static_cast<int>(body[body.size() == n ? around[0] : cell]));
  }
  return field;
}

}  // namespace rotordrop
