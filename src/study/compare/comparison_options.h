#pragma once
#include <optional>
#include <string>
#include <vector>

namespace rotordrop {

/// Tolerance of temperatures: kelvin, or a part of the rise at the time.
struct TemperatureTolerance {
  double value = 0.05;
  bool is_part = true;
};
/// "5 %" or "0.5 K". @throws InputError
TemperatureTolerance parse_temperature_tolerance(const std::string& text);
/// "10 ms, 50 ms" to seconds. @throws InputError
std::vector<double> parse_instants(const std::string& text);
/// A length above zero, such as "0.1 um". @param option  how messages call it. @throws InputError
double parse_length(const std::string& text, const std::string& option);
/// The length of a rub contact, 1 um at least: surfaces are as rough, and local temperatures take a time that goes with one over it. @throws InputError
double parse_band_length(const std::string& text, const std::string& option);
/// A temperature difference above zero, such as "10 mK". @throws InputError
double parse_floor(const std::string& text);

struct ComparisonOptions {
  TemperatureTolerance temperature;
  double floor = 0.01;                    ///< smallest tolerance of temperatures that is a part of the rise [K]
  double growth = 0.1e-6;                 ///< tolerance of growths and clearances [m]
  std::vector<double> instants = {0.01};  ///< reported beside the first impact's peak and the end [s]
  std::optional<double>
      band_length;  ///< of the rub along the surface [m]; without it the case's thermal.rub_band_length
};

}  // namespace rotordrop
