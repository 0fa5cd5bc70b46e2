#include "study/rub/local_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/facts/thermal_report.h"
#include "study/json_number.h"
#include "study/rub/bore_report.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

/// Nine digits: rows within a step are interpolated, and a resumed run's differ from an uninterrupted one's by roundoff.
Json number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::strtod(fmt::format("{:.9g}", value).c_str(), nullptr);
}

/// Drops of this wear until the depth limit; NaN without wear.
double drops_until_limit(const LocalSummary& local) {
  const double deepest = std::max(local.rub.wear.bore_depth, local.rub.wear.rotor_depth);
  return deepest > 0. ? local.depth_limit / deepest : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

LocalSummary local_summary(const RecordedDrop& drop, const std::string& bearing, const TouchdownParameters& parameters,
                           const FirstContact& first) {
  const auto& p = drop.parameters();
  LocalSummary s;
  const RubRecord record = rub_record(drop, bearing);
  const LocalRubSettings settings = local_rub_settings(p, bearing, parameters);
  s.rub = local_rub(record, settings);
  s.is_by_hertz = p.thermal.rub_band == RubBand::hertz;
  s.is_one_temperature = p.thermal.local_share == LocalShare::one_temperature;
  const double start = std::isfinite(first.start) ? first.start : std::numeric_limits<double>::infinity();
  s.is_half_space_valid = !(s.rub.stated.time > start + s.rub.valid_until);
  // A light ring chatters in contacts shorter than rows, which does not matter if the impact as a whole has enough of them.
  if (p.output.interval > 0.1 * (first.end - first.start))
    s.change_by_fewer_rows = change_without_every_second_row(record, settings, s.rub);
  s.depth_limit = p.contact.wear_depth_limit;
  return s;
}

Json local_json(const LocalSummary& local) {
  const LocalRub& rub = local.rub;
  const char *one_name = "one-temperature", *heated_name = "as-heated";
  const char* share = local.is_one_temperature ? one_name : heated_name;
  const char* other_share = local.is_one_temperature ? heated_name : one_name;
  const char* band = local.is_by_hertz ? "hertz" : "fixed";
  const char* other_band = local.is_by_hertz ? "fixed" : "hertz";
  const auto replay = [](const LocalRise& r, const char* of_share, const char* of_band) {
    return Json{{"share", of_share},
                {"band", of_band},
                {"bore_rise", number(r.bore)},
                {"rotor_rise", number(r.rotor)},
                {"share_to_ring", number(r.share_to_ring)}};
  };
  const LocalRise& s = rub.stated;
  const double roundoff = 1e-12 * s.bore;  // all that is left where both surfaces have one temperature
  return {{"bore_rise", number(s.bore)},
          {"bore_rise_low", number(rub.bore_rise_low)},
          {"bore_rise_high", number(rub.bore_rise_high)},
          {"bore_rise_time", number(s.time)},
          {"rotor_rise", number(s.rotor)},
          {"surface_difference", number(s.difference_then <= roundoff ? 0. : s.difference_then)},
          {"share_to_ring", number(s.share_to_ring)},
          {"share_to_ring_then", number(s.share_then)},
          {"band_length_then", number(2. * s.half_width)},
          {"half_space_valid", local.is_half_space_valid},
          {"replays",
           Json::array({replay(s, share, band), replay(rub.other_share, other_share, band),
                        replay(rub.other_band, share, other_band), replay(rub.other_both, other_share, other_band),
                        replay(rub.by_speeds, "by-speeds", band)})}};
}

Json wear_json(const LocalSummary& local) {
  const Wear& w = local.rub.wear;
  return {{"bore_depth", number(w.bore_depth)},
          {"rotor_depth", number(w.rotor_depth)},
          {"bore_mean_depth", number(w.bore_mean_depth)},
          {"rotor_mean_depth", number(w.rotor_mean_depth)},
          {"sliding_work", number(w.sliding_work)},
          {"depth_limit", local.depth_limit},
          {"drops_until_limit", number(drops_until_limit(local))}};
}

std::string local_text(const std::string& bearing, const LocalSummary& local, bool rubs_on_shoulder) {
  const LocalRise& s = local.rub.stated;
  const int indent = static_cast<int>(bearing.size()) + 2;
  std::string text;
  if (std::isfinite(s.time))
    text = fmt::format(
        "{:{}}local temperature rise where they rub{}: bore {:.0f} K at {:.4g} ms (bounds {:.0f} to {:.0f} K), rotor "
        "{:.0f} K\n",
        "", indent, rubs_on_shoulder ? " in the bore" : "", s.bore, s.time * 1e3, local.rub.bore_rise_low,
        local.rub.bore_rise_high, s.rotor);
  if (const double drops = drops_until_limit(local); std::isfinite(s.time) && std::isfinite(drops))
    text +=
        fmt::format("{:{}}wear per drop, estimated: bore {:.2g} um, rotor {:.2g} um; {:.2g} drops until {:.3g} um{}\n",
                    "", indent, local.rub.wear.bore_depth * 1e6, local.rub.wear.rotor_depth * 1e6, drops,
                    local.depth_limit * 1e6, rubs_on_shoulder ? " in the bore" : "");
  if (rubs_on_shoulder)
    text += fmt::format("{:{}}local temperature and wear of the shoulders are not computed\n", "", indent);
  return text;
}

}  // namespace rotordrop
