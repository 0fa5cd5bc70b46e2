#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "machine/heat/local_rub.h"

// Local temperature and wear of rotor and bore, for every run: summary, screen.
namespace rotordrop {

class RecordedDrop;
struct TouchdownParameters;

/// Local temperatures and wear of one bearing, and how they were computed.
struct LocalSummary {
  LocalRub rub;
  bool is_by_hertz = true;  ///< length of the band: Hertz's, or fixed
  bool is_one_temperature =
      true;  ///< share of the heat: so that both surfaces have one temperature, or as in the thermal models
  bool is_half_space_valid = true;  ///< at the time of the largest rise heat has not crossed the ring's wall
  double depth_limit = 0;           ///< of wear [m]
};
/// @param first_contact_time  [s]; NaN: never
LocalSummary local_summary(const RecordedDrop& drop, const std::string& bearing, const TouchdownParameters& parameters,
                           double first_contact_time);
/// The entries `local` and `wear` of a bearing in summary.json.
nlohmann::ordered_json local_json(const LocalSummary& local);
nlohmann::ordered_json wear_json(const LocalSummary& local);
/// Lines for the screen; empty without a rub.
std::string local_text(const std::string& bearing, const LocalSummary& local);

}  // namespace rotordrop
