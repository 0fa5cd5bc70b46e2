#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "study/report/packed.h"
#include "study/report/report.h"
#include "study/report/section_picture.h"
#include "study/rub/impact.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

/// The recorded field next to an instant, and whose it is.
struct Choice {
  FieldFile field;
  std::vector<std::string> next_to;
};

std::vector<Choice> chosen(const std::vector<FieldFile>& files, const std::vector<Instant>& instants) {
  std::vector<Choice> list;
  for (const auto& instant : instants) {
    const auto& next = *std::min_element(files.begin(), files.end(), [&](const FieldFile& a, const FieldFile& b) {
      return std::fabs(a.time - instant.time) < std::fabs(b.time - instant.time);
    });
    const std::string name = fmt::format("{} ({:.6g} ms)", instant.name, instant.time * 1e3);
    const auto found =
        std::find_if(list.begin(), list.end(), [&](const Choice& c) { return c.field.file == next.file; });
    if (found == list.end())
      list.push_back({next, {name}});
    else
      found->next_to.push_back(name);
  }
  std::sort(list.begin(), list.end(), [](const Choice& a, const Choice& b) { return a.field.time < b.field.time; });
  return list;
}

double in_mm(double metres) { return std::round(metres * 1e6) * 1e-3; }

}  // namespace

Json report_fields(const RecordedDrop& drop) {
  // All pictures together stay below two megabytes.
  constexpr std::size_t all_points = 1'200'000, most_points = 150'000;
  const std::size_t n_pictures = 3 * std::max<std::size_t>(drop.bearings().size(), 1);
  Json list = Json::array();
  for (const auto& [name, parameters] : drop.bearings()) {
    const auto pvd = drop.directory() / "fields" / (name + ".pvd");
    if (!std::filesystem::exists(pvd)) continue;
    const auto files = list_fields(pvd);
    if (files.empty()) continue;
    const double end = drop.series("/energy/mechanical").times.back();
    auto instants = instants_of(first_impact(drop, name), end, {0.5 * end});
    for (auto& instant : instants)
      if (instant.time == 0.5 * end) instant.name = "middle";
    Json bearing = {{"name", name}, {"ambient", drop.parameters().run.ambient - 273.15}, {"pictures", Json::array()}};
    for (const auto& choice : chosen(files, instants)) {
      const TemperatureField field = read_field(choice.field.file);
      const SectionPicture picture = picture_of(field, std::min(most_points, all_points / n_pictures));
      if (bearing["pictures"].empty()) {
        bearing["x"] = {in_mm(picture.x_low), in_mm(picture.x_high)};
        bearing["r"] = {in_mm(picture.r_low), in_mm(picture.r_high)};
        bearing["columns"] = picture.columns;
        bearing["rows"] = picture.rows;
        bearing["edges"] = Json::array();
        for (const auto& edge : body_edges(field))
          for (const double end_of : edge) bearing["edges"].push_back(in_mm(end_of));
      }
      bearing["pictures"].push_back({{"time", choice.field.time * 1e3},
                                     {"next_to", choice.next_to},
                                     {"low", picture.low},
                                     {"high", picture.high},
                                     {"levels", base64(picture.levels)}});
    }
    list.push_back(std::move(bearing));
  }
  return list;
}

}  // namespace rotordrop
