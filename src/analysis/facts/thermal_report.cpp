#include "analysis/facts/thermal_report.h"

#include <cmath>
#include <numbers>

#include "bearing/contact_stiffness.h"
#include "machine/build_machine.h"

namespace rotordrop {

std::vector<LumpedBody> lumped_bodies(const MachineParameters& parameters, const std::string& name,
                                      const TouchdownParameters& bearing) {
  return lumped_bodies(circuit_data(parameters, name, bearing));
}

RubSurfaces rub_surfaces(const MachineParameters& parameters, const std::string& name,
                         const TouchdownParameters& bearing, double band_length) {
  const auto c = circuit_data(parameters, name, bearing);
  RubSurfaces s;
  s.bore = {bore_radius(bearing, parameters.contact), c.ring.conductivity, c.ring.volumetric_capacity(),
            0.5 * (c.inner_outside - c.inner_bore)};
  s.rotor_radius = c.journal_radius;
  s.rotor_conductivity = c.shaft.conductivity;
  s.rotor_capacity = c.shaft.volumetric_capacity();
  s.half_width = 0.5 * band_length;
  s.axial_width = rub_length(parameters, bearing);
  return s;
}

LocalRubSettings local_rub_settings(const MachineParameters& parameters, const std::string& name,
                                    const TouchdownParameters& bearing) {
  LocalRubSettings s;
  s.surfaces = rub_surfaces(parameters, name, bearing, parameters.thermal.rub_band_length);
  s.hertz_width_per_root = rub_half_width(parameters, bearing, 1.);
  s.by_hertz = parameters.thermal.rub_band == RubBand::hertz;
  s.is_one_temperature = parameters.thermal.local_share == LocalShare::one_temperature;
  s.bore_wear = parameters.contact.wear_coefficient_bore;
  s.rotor_wear = parameters.contact.wear_coefficient_rotor;
  if (bearing.shoulders.any()) s.largest_friction = largest_friction(parameters.contact);
  return s;
}

double rub_length(const MachineParameters& parameters, const TouchdownParameters& bearing) {
  const auto s = contact_stiffness(bearing, parameters.contact, touchdown_surroundings(parameters, bearing));
  return (s.is_ellipse ? 0.25 * std::numbers::pi : 1.) * s.length;
}

double rub_half_width(const MachineParameters& parameters, const TouchdownParameters& bearing, double force) {
  const auto s = contact_stiffness(bearing, parameters.contact, touchdown_surroundings(parameters, bearing));
  return s.half_width * std::sqrt(force / s.reference_force);
}

}  // namespace rotordrop
