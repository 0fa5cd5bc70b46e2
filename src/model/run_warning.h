#pragma once
#include <array>
#include <limits>
#include <string>
#include <string_view>

// What a run warns of: results beyond what its models or its numerics are good for, and states that a user should know of.
namespace rotordrop {

/// A kind of warning; its code is the name in files.
struct WarningKind {
  const char* code;
  const char* unit;     ///< of `worst` and `limit`
  const char* meaning;  ///< what is counted, and beyond what
  bool is_guarded;      ///< found while the run goes on; the others are found at its end
};
inline constexpr std::array warning_kinds{
    WarningKind{"energy-residual", "1",
                "rows in which the mechanical energy not accounted for is more than 0.1 % of the energy moved", true},
    WarningKind{"heat-residual", "1", "rows in which a thermal model's heat not accounted for is more than 0.1 %",
                true},
    WarningKind{"heat-port", "1",
                "rows in which the heat that a support put into a thermal model is below 0 or above what the support "
                "dissipated, by more than 0.1 %",
                true},
    WarningKind{
        "step-collapse", "s",
        "times that the step becomes shorter than a thousandth of the longest one that is allowed, the first 20 "
        "steps left out",
        true},
    WarningKind{"ball-load", "Pa",
                "times that a contact pressure of a row exceeds 4.2 GPa, where ISO 76 expects a permanent indentation "
                "of 0.0001 of the ball's diameter",
                true},
    WarningKind{"ellipse-truncated", "1", "times that a row's contact ellipses reach over its raceway's edge", true},
    WarningKind{"penetration", "m",
                "times that rotor and bore overlap by more than half the air gap: contact laws of a narrow contact do "
                "not hold",
                true},
    WarningKind{"gap-closed", "m", "times that growth by heat and speed closes the air gap", true},
    WarningKind{"temperature", "K", "times that a part's mean or surface exceeds its material's temperature_limit",
                true},
    WarningKind{"fit-open", "1", "times that the fit of the outer ring in its housing opens or would have to pull",
                true},
    WarningKind{"support-travel", "m", "times that an outer ring moves beyond its support's travel_limit", true},
    WarningKind{"probe-touched", "m", "times that the rotor moves beyond the clearance at a probe", true},
    WarningKind{"no-contact", "s", "runs that end before the rotor touches a touchdown bearing", false},
    WarningKind{"tilt", "rad",
                "runs that end with the rotor tilted by more than 0.1 rad: its motion is that of small tilts", false},
    WarningKind{"recorded-growth", "s",
                "runs that go on after the growth that thermal.recorded holds, which then stays as it was", false},
    WarningKind{"window-error", "m", "windows that leave more than thermal.fe.window_tolerance", false},
    WarningKind{"response-error", "1", "reduced finite elements whose response to heat is off by more than 5 %", false},
    WarningKind{"coarse-rows", "1",
                "bearings whose local temperatures and depths of wear change by more than 5 % where only every second "
                "row is taken",
                false},
    WarningKind{"local-temperature", "K",
                "bores, and rotors with a journal of its own, whose local temperature under the rub exceeds their "
                "material's temperature_limit",
                false},
    WarningKind{"wear", "m", "surfaces that wear by more than contact.wear_depth_limit in this drop", false},
    WarningKind{"skidding", "1",
                "rows whose balls friction cannot keep rolling during more than 5 % of the ring's speed changes",
                false},
    WarningKind{"pivoting", "1", "bearings whose balls' gyroscopic moments require more friction than there is", false},
    WarningKind{"centrifugal-force", "1",
                "bearings with ball_model = \"quasi-static\" whose balls' centrifugal forces exceed a tenth of their "
                "loads",
                false},
    WarningKind{"backward-whirl", "rad/s", "bearings in which the rotor whirls backward for a full turn or more",
                false},
};
[[nodiscard]] inline const WarningKind* find_warning_kind(std::string_view code) {
  for (const auto& kind : warning_kinds)
    if (code == kind.code) return &kind;
  return nullptr;
}

/// Mechanical energy or heat not accounted for, over that moved: smaller steps or tolerances leave less.
inline constexpr double residual_limit = 1e-3;
/// Overlap of rotor and bore over the air gap. Overlapping circles touch over +- arccos(c / (c + delta)), 48 deg at a half: laws of a contact that is
/// narrow against its radius (Hertz) are off there. Estimate.
inline constexpr double penetration_limit = 0.5;
/// Tilt of the rotor [rad]: its motion takes sin a = a and cos a = 1, which are off by a^2/6 and a^2/2, 0.2 and 0.5 % here.
inline constexpr double tilt_limit = 0.1;
/// Error of a reduced model's response to heat: what `compare` tolerates of a temperature.
inline constexpr double response_error_limit = 0.05;

/// Change of a local temperature or a depth of wear by leaving out every second row, about the error by rows as they are: that of the laws is larger.
inline constexpr double change_by_rows_limit = 0.05;

/// Something of one kind that a run met at one place.
struct RunWarning {
  static constexpr double never = std::numeric_limits<double>::quiet_NaN();
  const WarningKind* kind = nullptr;
  std::string place = {};     ///< bearing or probe; empty: the whole machine
  std::string part = {};      ///< "row 1", "inner ring"; empty: all of it
  long count = 1;             ///< as the kind counts
  double worst = 0;           ///< in the kind's unit
  double limit = 0;           ///< likewise
  double time = never;        ///< of the worst [s]; never: not of one instant
  double first_time = never;  ///< [s]
  double duration = never;    ///< in all [s]
};

}  // namespace rotordrop
