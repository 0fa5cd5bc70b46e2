#include "parts.h"

#include "ring_wall.h"
#include "snubber.h"

using namespace rotordrop;

void add_parts(PartsRegistry& registry) {
  registry.add_support("snubber", snubber_section(), [](const std::string& name, const SnubberParameters& p) {
    return std::make_unique<Snubber>(name, p);
  });
  registry.add_thermal_model({.name = "wall", .title = "ring walls", .mark = "walls"}, ring_wall_section(),
                             [](const ThermalGeometry& geometry, const RingWallParameters& p) {
                               return std::make_unique<RingWall>(geometry.bearings, geometry.ambient,
                                                                 static_cast<std::size_t>(p.shells));
                             });
}
