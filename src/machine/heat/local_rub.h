#pragma once
#include <limits>
#include <optional>
#include <vector>

#include "machine/heat/bore_history.h"

// Local temperature and wear of bore and rotor where they rub, from what a drop recorded. No thermal model is needed.
namespace rotordrop {

struct LocalRubSettings {
  RubSurfaces surfaces;                  ///< their half width is that of the fixed band
  double hertz_width_per_root = 0;       ///< half width of Hertz's band over the root of the force [m N^(-1/2)]
  bool by_hertz = true;                  ///< the band of the stated value; the other one is a bound
  bool is_one_temperature = true;        ///< the share of the stated value; the share as recorded is a bound
  double bore_wear = 0, rotor_wear = 0;  ///< Archard's k = K/H [m2/N]
  /// Most that friction in the bore can be of the force there. What is recorded beyond is the shoulders' heat, which enters elsewhere. None: no shoulders.
  std::optional<double> largest_friction;
};

/// One replay of the rub: a band and a share.
struct LocalRise {
  double bore = 0, rotor = 0;                                ///< largest rise over what was before the drop [K]
  double time = std::numeric_limits<double>::quiet_NaN();    ///< of the bore's [s]; never: no rub
  double share_to_ring = 0;                                  ///< of all heat
  double share_then = 0;                                     ///< of the interval that ends at that time
  double half_width = 0;                                     ///< b at that time [m]
  double difference_then = 0;                                ///< |T_bore - T_rotor| under the band at that time [K]
  double heat = 0, heat_into_ring = 0, heat_into_rotor = 0;  ///< [J]
};

struct Wear {
  double sliding_work = 0;                           ///< integral of F_n |v_s| [J]: force times distance
  double bore_depth = 0, rotor_depth = 0;            ///< largest around the circumference [m]
  double bore_mean_depth = 0, rotor_mean_depth = 0;  ///< [m]
  double bore_volume = 0, rotor_volume = 0;          ///< sums over the cells [m3]
};

struct LocalRub {
  LocalRise stated;
  /// Share of the other kind, band of the other length, both, and the share by Blok and Jaeger's formula from the instant's speeds.
  LocalRise other_share, other_band, other_both, by_speeds;
  double bore_rise_low = 0, bore_rise_high = 0;  ///< smallest and largest bore rise of all five [K]
  double valid_until = 0;                        ///< after first contact, until heat has crossed the ring's wall [s]
  Wear wear;
};

/// @param most_rows  see bore_history(); of rows that are joined heat, impulse and wear are kept
LocalRub local_rub(const RubRecord& record, const LocalRubSettings& settings,
                   std::size_t most_rows = most_followed_rows);

/// By how much the stated rise of the bore, or a depth of wear, changes where only every second row is known, over its value: about what the distance
/// between rows costs, since their error goes with that distance.
/// @param of_all  what local_rub() makes of the same record, with as many rows followed one by one
double change_without_every_second_row(const RubRecord& record, const LocalRubSettings& settings,
                                       const LocalRub& of_all);

}  // namespace rotordrop
