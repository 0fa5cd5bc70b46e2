#include "thermal/circuit/network_part.h"

#include <algorithm>
#include <set>

namespace rotordrop {

NetworkPart part_around(const ThermalNetworkData& network, std::size_t place) {
  std::set<std::string> reached;
  const auto reach_place = [&](const ThermalNetworkData::Place& p) {
    reached.insert({p.shaft_node, p.ring_node, p.inner_contact, p.outer_contact});
    if (!p.balls.empty()) reached.insert(p.balls);
  };
  const auto sits_on = [&](const ThermalNetworkData::Place& p) {
    return reached.contains(p.ring_node) || reached.contains(p.shaft_node) || reached.contains(p.inner_contact) ||
           reached.contains(p.outer_contact) || reached.contains(p.balls);
  };
  reach_place(network.places.at(place));
  for (std::size_t before = 0; before != reached.size();) {
    before = reached.size();
    for (const auto& r : network.resistors) {
      if (r.between == ambient_node || r.and_node == ambient_node) continue;
      if (reached.contains(r.between) || reached.contains(r.and_node)) reached.insert({r.between, r.and_node});
    }
    for (const auto& p : network.places)
      if (sits_on(p)) reach_place(p);
  }

  NetworkPart part;
  part.data.ambient = network.ambient;
  std::vector<std::size_t> new_place(network.places.size());
  for (std::size_t i = 0; i < network.places.size(); ++i) {
    if (!sits_on(network.places[i])) continue;
    new_place[i] = part.data.places.size();
    part.data.places.push_back(network.places[i]);
  }
  part.place = new_place[place];
  for (const auto& node : network.nodes)
    if (reached.contains(node.name)) part.data.nodes.push_back(node);
  for (auto r : network.resistors) {
    if (!reached.contains(r.between) && !reached.contains(r.and_node)) continue;
    if (r.law == ThermalNetworkData::Law::contact) r.place = new_place[r.place];
    part.data.resistors.push_back(r);
  }
  for (auto g : network.growths) {
    if (!reached.contains(g.node)) continue;
    g.place = new_place[g.place];
    part.data.growths.push_back(g);
  }
  return part;
}

void scale_cooling(ThermalNetworkData& network, double factor) {
  for (auto& r : network.resistors) {
    if (r.between != ambient_node && r.and_node != ambient_node) continue;
    r.resistance /= factor;
    r.R_apart /= factor;
    r.area *= factor;
  }
}

}  // namespace rotordrop
