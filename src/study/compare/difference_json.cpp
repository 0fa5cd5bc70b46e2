#include "study/compare/difference_json.h"

#include "study/json_number.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

/// Times up to which the worst difference is reported [s]: the same in every run that lasts so long.
constexpr double time_scales[] = {1e-3, 3e-3, 10e-3, 30e-3, 0.1, 0.3, 1., 3., 10., 30., 100., 300., 1000.};

Json by_time_json(const Difference& d) {
  Json j = Json::array();
  const auto add = [&](double until) {
    const auto worst = d.worst_until(until);
    j.push_back({{"until", until}, {"difference", worst.difference}, {"time", worst.time}, {"usage", worst.usage}});
  };
  const double begin = d.series.times.front(), end = d.series.times.back();
  for (const double until : time_scales)
    if (until >= begin && until <= end) add(until);
  if (j.empty() || j.back()["until"].get<double>() < end) add(end);
  return j;
}

}  // namespace

Json difference_json(const TimeSeries& first, const TimeSeries& second, const Tolerance& tolerance, const Names& names,
                     const std::vector<Instant>& instants) {
  const Difference d = difference_of(first, second, tolerance);
  Json j = {{"tolerance", tolerance.floor},         {"tolerance_part", tolerance.part},
            {"largest_difference", d.largest},      {"largest_difference_time", d.largest_time},
            {"beyond_from", json_number(d.beyond)}, {"within_from", json_number(d.within)},
            {"time_beyond", d.time_beyond},         {"end", d.series.times.back()},
            {"by_time", by_time_json(d)},           {"at", Json::array()}};
  for (const auto& [name, t] : instants)
    j["at"].push_back({{"instant", name},
                       {"time", t},
                       {names.first, first.at(t)},
                       {names.second, second.at(t)},
                       {"difference", second.at(t) - first.at(t)}});
  return j;
}

}  // namespace rotordrop
