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
  /// How much fewer rows would change (change_without_every_second_row()); 0 where the first contact has ten rows, which are enough.
  double change_by_fewer_rows = 0;
};
/// The first contact of a bearing [s]; NaN: never.
struct FirstContact {
  double start, end;
};
LocalSummary local_summary(const RecordedDrop& drop, const std::string& bearing, const TouchdownParameters& parameters,
                           const FirstContact& first);
/// The entries `local` and `wear` of a bearing in summary.json.
nlohmann::ordered_json local_json(const LocalSummary& local);
nlohmann::ordered_json wear_json(const LocalSummary& local);
/// Lines for the screen; empty without a rub.
/// @param rubs_on_shoulder  then the bore is not all that rubs, and the shoulders are not computed
std::string local_text(const std::string& bearing, const LocalSummary& local, bool rubs_on_shoulder);

}  // namespace rotordrop
