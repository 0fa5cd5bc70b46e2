#include "study/drop/local_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/facts/thermal_report.h"
#include "study/drop/bore_report.h"
#include "study/json_number.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

/// Nine digits: rows within a step are interpolated, and a resumed run's differ from an uninterrupted one's by roundoff.
Json number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::strtod(fmt::format("{:.9g}", value).c_str(), nullptr);
}

}  // namespace

void add_local_report(const RecordedDrop& drop, const std::string& bearing, const TouchdownParameters& parameters,
                      Json& summary) {
  const auto& p = drop.parameters();
  const LocalRub rub = local_rub(rub_record(drop, bearing), local_rub_settings(p, bearing, parameters));
  const bool hertz = p.thermal.rub_band == RubBand::hertz;
  const bool one = p.thermal.local_share == LocalShare::one_temperature;
  const char *one_name = "one-temperature", *heated_name = "as-heated";
  const char* band = hertz ? "hertz" : "fixed";
  const char* other_band = hertz ? "fixed" : "hertz";
  const auto replay = [](const LocalRise& r, const char* share, const char* of_band) {
    return Json{{"share", share},
                {"band", of_band},
                {"bore_rise", number(r.bore)},
                {"rotor_rise", number(r.rotor)},
                {"share_to_ring", number(r.share_to_ring)}};
  };
  const LocalRise& s = rub.stated;
  const double first = summary.value("first_contact_time", Json()).is_number()
                           ? summary["first_contact_time"].get<double>()
                           : std::numeric_limits<double>::infinity();
  summary["local"] = {{"bore_rise", number(s.bore)},
                      {"bore_rise_low", number(rub.bore_rise_low)},
                      {"bore_rise_high", number(rub.bore_rise_high)},
                      {"bore_rise_time", number(s.time)},
                      {"rotor_rise", number(s.rotor)},
                      {"surface_difference", number(s.difference_then)},
                      {"share_to_ring", number(s.share_to_ring)},
                      {"share_to_ring_then", number(s.share_then)},
                      {"band_length_then", number(2. * s.half_width)},
                      {"half_space_valid", !(s.time > first + rub.valid_until)},
                      {"replays", Json::array({replay(s, one ? one_name : heated_name, band),
                                               replay(rub.other_share, one ? heated_name : one_name, band),
                                               replay(rub.other_band, one ? one_name : heated_name, other_band),
                                               replay(rub.other_both, one ? heated_name : one_name, other_band),
                                               replay(rub.by_speeds, "by-speeds", band)})}};
  const Wear& w = rub.wear;
  const double deepest = std::max(w.bore_depth, w.rotor_depth);
  summary["wear"] = {
      {"bore_depth", number(w.bore_depth)},
      {"rotor_depth", number(w.rotor_depth)},
      {"bore_mean_depth", number(w.bore_mean_depth)},
      {"rotor_mean_depth", number(w.rotor_mean_depth)},
      {"sliding_work", number(w.sliding_work)},
      {"depth_limit", p.contact.wear_depth_limit},
      {"drops_until_limit", deepest > 0. ? number(p.contact.wear_depth_limit / deepest) : Json(nullptr)}};
}

std::string local_text(const std::string& bearing, const Json& b) {
  if (!b.contains("local") || !b["local"]["bore_rise_time"].is_number()) return {};
  const auto value = [&](const char* part, const char* key) { return b[part][key].get<double>(); };
  std::string text = fmt::format(
      "{:{}}local temperature rise where they rub: bore {:.0f} K at {:.4g} ms (bounds {:.0f} to {:.0f} K), rotor "
      "{:.0f} K\n",
      "", bearing.size() + 2, value("local", "bore_rise"), value("local", "bore_rise_time") * 1e3,
      value("local", "bore_rise_low"), value("local", "bore_rise_high"), value("local", "rotor_rise"));
  if (b["wear"]["drops_until_limit"].is_number())
    text +=
        fmt::format("{:{}}wear per drop, estimated: bore {:.2g} um, rotor {:.2g} um; {:.2g} drops until {:.3g} um\n",
                    "", bearing.size() + 2, value("wear", "bore_depth") * 1e6, value("wear", "rotor_depth") * 1e6,
                    value("wear", "drops_until_limit"), value("wear", "depth_limit") * 1e6);
  return text;
}

}  // namespace rotordrop
