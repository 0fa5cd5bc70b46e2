#pragma once
#include <cstddef>
#include <vector>

#include "laws/heat/moving_band.h"

// Local temperature of a bore from what a drop recorded.
namespace rotordrop {

/// The rub of one bearing, row by row [n_rows].
struct RubRecord {
  std::vector<double> times;                                ///< [s]
  std::vector<double> joules_into_ring, joules_into_rotor;  ///< since the start [J]
  std::vector<double> contact_angle;                        ///< from ring centre to rotor centre, atan2(z, y) [rad]
  std::vector<double> ring_angle, rotor_angle;              ///< how far they have turned [rad]
  // Only for local_rub():
  std::vector<double> impulse;     ///< integral of the contact force [N s]
  std::vector<double> slip_speed;  ///< rotor's surface past the bore [m/s]
};

struct RubSurfaces {
  BoreSurface bore;
  double rotor_radius = 0;                            ///< [m]
  double rotor_conductivity = 0, rotor_capacity = 0;  ///< k [W/(m K)], rho c [J/(m3 K)]
  double half_width = 0;                              ///< of the contact along the surfaces [m]
  double axial_width = 0;                             ///< [m]
};

/// Rises over what the surfaces were before the drop [K], for heat that goes into half spaces. NaN where rotor and ring do not touch.
struct BoreHistory {
  std::vector<double> times;            ///< [s]; rows of the record, or fewer
  std::vector<double> largest_rise;     ///< of the hottest place around the bore
  std::vector<double> mean_rise;        ///< the same heat spread around the bore
  std::vector<double> rise_at_contact;  ///< of the bore under the contact's middle
  /// Largest under the contact on the rotor, whose surface passes at sliding speed: Jaeger's band that has moved since touching at the speed and with the heat of
  /// this interval.
  std::vector<double> rotor_flash;
  std::vector<double> arc;         ///< way of the contact over the bore since they touched [rad]; 0 apart
  std::vector<double> heated_arc;  ///< part of the bore that was ever rubbed [rad]
  std::vector<double> ring_turns;  ///< [1]
  double valid_until = 0;          ///< from the start of heating, until heat has crossed the ring's wall [s]
};

/// Rows of a record that are followed one by one unless said otherwise.
inline constexpr std::size_t most_followed_rows = 12000;

/// @param most_rows  rows that are followed one by one; of a longer record later ones are joined, as long as the contact moves over the bore by less
/// than a radian. Heat is kept.
BoreHistory bore_history(const RubRecord& record, const RubSurfaces& surfaces,
                         std::size_t most_rows = most_followed_rows);

/// Rows of a record to follow: all of one with `most` rows at most; of a longer one later rows are joined, see bore_history().
std::vector<std::size_t> rows_to_follow(const RubRecord& record, std::size_t most);

/// The same contact as Jaeger's band moving over a half space at constant speed with constant heat: largest rise at its end [K].
/// @param heat      into the bore during the contact [J]; @param duration  of it [s]; @param arc  way of the contact over the bore [rad]
double steady_band_rise(const RubSurfaces& surfaces, double heat, double duration, double arc);

}  // namespace rotordrop
