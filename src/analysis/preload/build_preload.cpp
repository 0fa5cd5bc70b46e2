#include "analysis/preload/build_preload.h"

#include "machine/build_machine.h"
#include "thermal/circuit/network_part.h"

namespace rotordrop {
namespace {

std::size_t place_of(const MachineParameters& p, const std::string& name) {
  std::size_t place = 0;
  for (const auto& entry : p.bearings) {
    if (entry.name == name) break;
    place += entry.touchdown() != nullptr;
  }
  return place;
}

}  // namespace

std::unique_ptr<TouchdownRunning> build_running_bearing(const MachineParameters& p, const std::string& name,
                                                        double speed, const FindRest& find, double preload_factor) {
  TouchdownParameters b = touchdown_of(p, name);
  b.preload *= preload_factor;
  return std::make_unique<TouchdownRunning>(
      p, name, b, BearingState{cold_growth(p, b, speed), speed, preload_load(p.preload)}, find);
}

std::unique_ptr<PreloadLoop> build_preload_loop(const MachineParameters& p, const Node& case_node,
                                                const std::string& name, const FindRest& find,
                                                const PreloadVariation& variation,
                                                std::shared_ptr<const ThermalModel> section) {
  auto running = build_running_bearing(p, name, variation.speed * preload_speed(p), find, variation.preload);
  if (section) return std::make_unique<PreloadLoop>(std::move(section), std::move(running), 1, 0, p.run.ambient);
  Faults faults;
  auto part = part_around(network_data(p, case_node, faults), place_of(p, name));
  faults.throw_if_any();
  scale_cooling(part.data, variation.cooling);
  const std::size_t n_places = part.data.places.size();
  return std::make_unique<PreloadLoop>(std::make_shared<ThermalNetwork>(part.data), std::move(running), n_places,
                                       part.place, p.run.ambient);
}

PreloadLimits preload_limits(const PreloadParameters& s) { return {s.temperature_limit, s.pressure_limit}; }

}  // namespace rotordrop
