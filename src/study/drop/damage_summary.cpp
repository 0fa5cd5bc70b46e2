#include "study/drop/damage_summary.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "study/drop/drop_summary.h"
#include "study/json_number.h"
#include "study/limit_verdict.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

Json fatigue_json(const FatigueShare& f) {
  return {{"share", f.share},
          {"rows", f.rows},
          {"by_cycles", f.by_cycles},
          {"by_rolling", f.by_rolling},
          {"rating", f.rating},
          {"largest_cycle", f.largest_cycle},
          {"equivalent_cycles", f.equivalent_cycles},
          {"load_over_rating", f.load_over_rating}};
}

/// Whole drops; null if there is no end to them.
Json drops_of(double share) {
  constexpr double most = 1e15;
  if (!(share > 1. / most)) return nullptr;
  // A share of exactly 1/n allows n drops, whatever its roundoff.
  return static_cast<long long>(std::floor(1. / share * (1. + 1e-12)));
}

std::string fatigue_basis(const std::optional<FatigueShare>& f) {
  if (!f) return "contact fatigue: not assessed, the bearing's dynamic load rating C is not given";
  std::string text = fmt::format(
      "contact fatigue: ISO 281, C = {:.4g} kN, p = 3, L10 (90 % reliability), summed by Palmgren-Miner; of each row "
      "the "
      "larger of two counts: cycles of every ball's load by rainflow (ASTM E1049), and turns under the balls' loads",
      f->rating * 1e-3);
  if (f->load_over_rating > 0.5)
    text +=
        fmt::format("; the largest ball load is {:.3g} times that under C, ISO 281 holds to 0.5", f->load_over_rating);
  return text;
}

/// Of a bearing that the rotor did not touch, whose preload says nothing about drops, or not to the end of its impact. Names stay, for limits on them.
Json not_assessed(const std::string& reason, const std::optional<FatigueShare>& fatigue, const TouchdownParameters& p) {
  const std::string why = ": not assessed, " + reason;
  Json shares = nullptr;
  if (fatigue) {
    shares = fatigue_json(*fatigue);
    for (auto& value : shares)
      if (value.is_array())
        std::fill(value.begin(), value.end(), Json(nullptr));
      else
        value = nullptr;
  }
  return {{"assessed", false},
          {"static_safety", nullptr},
          {"pressure_is_void", nullptr},
          {"required_static_safety", p.required_static_safety},
          {"fatigue", shares},
          {"wear_share", nullptr},
          {"rubs_on_shoulder", nullptr},
          {"allowed_drops", nullptr},
          {"governed_by", "nothing"},
          {"why", reason},
          {"basis", {"static safety" + why, "contact fatigue" + why, "wear" + why}}};
}

/// Numbers of the rows whose contact ellipses reached over the raceway's edge.
std::vector<std::size_t> rows_over_the_edge(const BearingSummary& b) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < b.n_rows; ++row)
    if (b.scalars.row_truncation[row].largest > 0.) rows.push_back(row + 1);
  return rows;
}

}  // namespace

Json damage_json(const BearingSummary& b, const std::optional<FatigueShare>& fatigue, const TouchdownParameters& p) {
  if (!has_touched(b.scalars)) return not_assessed(untouched, fatigue, p);
  if (ends_in_first_contact(b.scalars)) return not_assessed(in_first_contact, fatigue, p);
  const double safety = static_safety(b.scalars.contact_pressure.value);
  const Json wear = b.local ? wear_json(*b.local) : Json::object();
  const double wear_drops = number_at(wear, "/drops_until_limit");
  const double wear_share = std::isfinite(wear_drops) ? 1. / wear_drops : 0.;
  const double fatigue_share = fatigue ? fatigue->share : 0.;
  // Shoulders wear, too, but that is not computed: the bore's wear is not the bearing's then.
  const bool is_on_shoulder = std::isfinite(b.scalars.first_shoulder_contact_time);
  const bool has_wear = b.local && !is_on_shoulder;
  const bool is_safe = safety >= p.required_static_safety;
  // Where ellipses reach over the edge the safety is lower: enough of it is not known, too little is.
  const auto edge = rows_over_the_edge(b);
  const bool is_unknown = is_safe && (!edge.empty() || is_on_shoulder);
  Json j;
  j["assessed"] = true;
  j["static_safety"] = json_number(safety);
  j["pressure_is_void"] = !edge.empty();
  j["required_static_safety"] = p.required_static_safety;
  j["fatigue"] = fatigue ? fatigue_json(*fatigue) : Json(nullptr);
  j["wear_share"] = has_wear ? Json(wear_share) : Json(nullptr);
  j["rubs_on_shoulder"] = is_on_shoulder;
  j["allowed_drops"] = is_unknown ? Json(nullptr) : is_safe ? drops_of(std::max(fatigue_share, wear_share)) : Json(0);
  j["governed_by"] = !is_safe                       ? Json("static safety")
                     : j["allowed_drops"].is_null() ? Json("nothing")
                     : wear_share >= fatigue_share  ? Json("wear")
                                                    : Json("fatigue");
  j["basis"] = {fmt::format("static safety: (4.2 GPa over the largest contact pressure of a ball) cubed, ISO 76; at "
                            "least {:.4g} required{}",
                            p.required_static_safety,
                            edge.empty() ? ""
                                         : fmt::format("; void: contact ellipses of row {} reach over the raceway's "
                                                       "edge, where the pressure is higher",
                                                       fmt::join(edge, " and "))),
                fatigue_basis(fatigue),
                has_wear ? fmt::format("wear: Archard, until contact.wear_depth_limit = {:.4g} um, every drop at the "
                                       "same place",
                                       number_at(wear, "/depth_limit") * 1e6)
                : is_on_shoulder ? "wear: not assessed, the rotor rubs on a shoulder, whose wear is not computed"
                                 : "wear: not assessed"};
  return j;
}

bool is_assessed(const Json& d) { return d.value("assessed", true); }

// Summaries of earlier versions do not have it.
bool is_pressure_void(const Json& d) { return d.contains("pressure_is_void") && d["pressure_is_void"] == true; }
bool rubs_on_shoulder(const Json& d) { return d.contains("rubs_on_shoulder") && d["rubs_on_shoulder"] == true; }

std::string damage_text(const Json& d, std::size_t indent) {
  if (!is_assessed(d))
    return fmt::format("{:{}}damage per drop: not assessed, {}\n", "", indent, d.value("why", untouched));
  std::string text = fmt::format("{:{}}damage per drop: static safety ", "", indent);
  const bool is_void = is_pressure_void(d);
  text += d["static_safety"].is_null()
              ? "unloaded"
              : fmt::format("{}{:.3g}{}", is_void ? "below " : "", d["static_safety"].get<double>(),
                            is_void ? " (ellipses over the edge)" : "");
  text += d["fatigue"].is_null() ? ", fatigue not assessed (no C)"
                                 : fmt::format(", fatigue {:.2g} of L10", d["fatigue"]["share"].get<double>());
  text += d["wear_share"].is_null() ? (rubs_on_shoulder(d) ? ", wear of shoulders not assessed" : ", wear not assessed")
                                    : fmt::format(", wear {:.2g} of its limit", d["wear_share"].get<double>());
  const bool has_fatigue = !d["fatigue"].is_null(), has_wear = !d["wear_share"].is_null();
  if (d["allowed_drops"].is_null())
    text += (has_fatigue || has_wear) && !is_void && !rubs_on_shoulder(d) ? "; allowed drops: no limit found"
                                                                          : "; allowed drops: not assessed";
  else
    text += fmt::format("; allowed drops: {} ({})", d["allowed_drops"].get<long long>(),
                        d["governed_by"].get<std::string>());
  return text + "\n";
}

}  // namespace rotordrop
