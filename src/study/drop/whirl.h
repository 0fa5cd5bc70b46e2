#pragma once
#include <complex>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

// Whirl of the rotor in a touchdown bearing: which way, how fast and for how long the point of contact runs around the bore.
namespace rotordrop {

class RecordedDrop;

/// The rotor's path in one bearing, all of one length [n].
struct ContactOrbit {
  std::span<const double> time;         ///< [s], rising
  std::span<const double> y, z;         ///< rotor centre from the bearing's centre [m]
  std::span<const double> penetration;  ///< of rotor and bore [m]; above zero: contact
  std::span<const double> spin_speed;   ///< of the rotor, positive from +y towards +z [rad/s]
};

struct WhirlOptions {
  /// Whirl speed is a mean over this time [s]: longer than an impact (3 ms in the reference case), shorter than half a swing at the bore's bottom
  /// (16 ms there). A contact lost for longer ends a whirl.
  double window = 5e-3;
  /// Slower than this is rest [rad/s]: a turn a second.
  double slowest = 6.283185307179586;
  /// Time between rows while the rotor moves [s]; none: the longest between any two. Rows are farther apart while nothing changes.
  std::optional<double> row_interval = {};
};

enum class WhirlDirection { none, forward, backward };
std::string to_string(WhirlDirection direction);

/// A stretch of motion around the bearing's centre in one direction over a full turn at least; it begins and ends in contact.
struct WhirlStretch {
  WhirlDirection direction = WhirlDirection::none;
  double start = 0, end = 0;  ///< [s]
  double turns = 0;           ///< > 0
  double contact_time = 0;    ///< [s]
  double fastest = 0;         ///< largest mean speed over one whole turn, > 0 [rad/s]
  bool is_full_rub = false;   ///< contact never lost over a whole turn
  [[nodiscard]] double frequency() const { return turns / (end - start); }  ///< [Hz]
};

struct ContactWhirl {
  /// At each sample, positive from +y towards +z [rad/s]: 2 * area swept in contact / (integral of r^2 dt in contact), both over the window; NaN
  /// without contact in it. Weighing by r^2 keeps a passage near the centre from counting as a leap of the angle.
  std::vector<double> speed;
  std::vector<WhirlStretch> stretches;                         ///< in the order of time
  double contact_time = 0;                                     ///< [s]
  double forward_time = 0, backward_time = 0;                  ///< of contact that moves so, swinging included [s]
  double backward_whirl_time = 0;                              ///< of contact in stretches of backward whirl [s]
  double fastest_resolved = 0;                                 ///< a quarter turn between samples [rad/s]
  [[nodiscard]] const WhirlStretch* longest() const;           ///< of all, by turns; null if there is none
  [[nodiscard]] const WhirlStretch* fastest_backward() const;  ///< null if there is none
  [[nodiscard]] bool has_full_backward_rub() const;
};

/// Backward is against the rotor's spin. A rotor that swings or rests in the bore does not whirl: a stretch turns by 2 pi or more.
/// @throws std::invalid_argument if the lengths differ
ContactWhirl find_whirl(const ContactOrbit& orbit, const WhirlOptions& options = {});

/// Smallest speed at the bottom of a bore at rest with which a sliding rotor goes all around it backward without losing contact [rad/s]; 0 if it
/// does so from rest.
///
/// Point mass on a circle of radius c under gravity, friction mu N along its way while the surfaces slide. With a from the bottom and
/// u = c a'^2 / g:  du/da - 2 mu u = 2 (mu cos a - sin a)  (the equation of the angle at which a rotor set down turns), so
///   u = A cos a + B sin a + (u_0 - A) exp(2 mu a),  B = 6 mu / (1 + 4 mu^2),  A = (2 - 4 mu^2) / (1 + 4 mu^2).
/// N = m g (u + cos a) has dN/da = 2 mu N - 3 m g sin a, so that it can only touch zero at the top, where u = 1:
///   u_0 = A + (1 + A) exp(-2 pi mu).   For mu = 0 that is 5, the loop the loop.
/// Valid: rigid bore, rotor free but for gravity, rub still sliding. Faster whirl is limited by compliance and damping (below).
double full_rub_speed(double friction_coefficient, double air_gap, double gravity);
/// Smallest friction coefficient with which a full backward rub arises from rest at the bottom; independent of mass, gap and gravity.
double full_rub_friction();

/// Smallest ratio of friction to normal force with which contact all around the bore persists at a whirl speed W; infinity if no friction does.
///
/// @param receptance  D(W) = rotor's displacement over the force on it + stator's over the force on it, at the contact, for forces that turn with W
///                    [m/N], complex: displacement y + i z = D (force y + i z), so that damping gives Im D the sign of -W
///
/// Spin positive, so that backward whirl has W < 0 and damping gives Im D > 0. With the contact at the angle W t the force on the rotor is
/// -N (1 + i m) exp(i W t): N > 0, and m the ratio of friction to normal force, against the surface's sliding. The rotor's centre is c exp(i W t) from
/// the stator's, so c = -D N (1 + i m), or
///   N = -c / ((1 + m^2) Re D),   m = -Im D / Re D.
/// N > 0 needs Re D < 0. Contact that rolls (-W c = spin speed * radius) needs m <= mu, contact that slides has m = mu: |Im D| <= -mu Re D.
/// Where less than mu would do, sliding speeds the whirl up; where more is needed, it slows down. A free rotor on a rigid stator, D = -1/(m_r W^2),
/// needs none at any speed.
/// Source: equilibrium of interacting receptances after Black (1968), J. Mech. Eng. Sci. 10, 1-12; signs derived here.
/// Valid: circular orbit, isotropic rotor and stator, gravity and unbalance small beside the contact force.
double friction_that_sustains_whirl(std::complex<double> receptance);

/// Paths of the series that recorded_whirl() reads.
std::vector<std::string> series_of_whirl(const std::string& bearing);
/// Whirl in a touchdown bearing of a drop; NaN rows and live files are cut.
ContactWhirl recorded_whirl(const RecordedDrop& drop, const std::string& bearing, const WhirlOptions& options = {});

/// What a summary tells of a bearing's whirl.
struct WhirlSummary {
  std::optional<WhirlStretch> longest;           ///< by turns; none: no whirl over a whole turn
  std::optional<double> largest_backward_speed;  ///< of sustained backward whirl [rad/s]
  double contact_time = 0;                       ///< [s]
  double forward_time = 0, backward_time = 0;    ///< of contact that moves so [s]
  double backward_whirl_time = 0;                ///< of contact in sustained backward whirl [s]
  bool has_full_rub = false;                     ///< backward, without losing contact over a turn
  double fastest_resolved = 0;                   ///< [rad/s]
  double friction_coefficient = 0;               ///< of the case
  double friction_from_rest = 0;                 ///< with which a full rub arises from rest
  double speed_at_bottom = 0;                    ///< with which it arises at the case's friction [rad/s]
};
WhirlSummary whirl_summary(const RecordedDrop& drop, const std::string& bearing);
/// The entry `whirl` of a bearing in summary.json.
nlohmann::ordered_json whirl_json(const WhirlSummary& whirl);
/// A line for the screen; empty unless the bearing saw sustained backward whirl.
std::string whirl_text(const std::string& bearing, const WhirlSummary& whirl);

}  // namespace rotordrop
