#include "thermal/circuit/thermal_network.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <utility>

namespace rotordrop {
namespace {

using Data = ThermalNetworkData;

/// Names to indices; the surroundings are one past the last node.
class Names {
 public:
  explicit Names(const Data& data) {
    for (std::size_t i = 0; i < data.nodes.size(); ++i)
      if (!index_.emplace(data.nodes[i].name, i).second)
        throw std::invalid_argument("two thermal nodes are named \"" + data.nodes[i].name + "\"");
    index_.emplace(ambient_node, data.nodes.size());
  }
  [[nodiscard]] std::size_t operator()(const std::string& name) const {
    const auto found = index_.find(name);
    if (found == index_.end()) throw std::invalid_argument("there is no thermal node \"" + name + "\"");
    return found->second;
  }

 private:
  std::map<std::string, std::size_t> index_;
};

/// Elimination of the massless nodes: L_mm T_m = -L_mk T_k + H_m, with L the conductances' Laplacian, k the kept nodes and ambient.
struct Elimination {
  std::vector<std::size_t> massless;
  Eigen::MatrixXd weights;    // T_m from T of all nodes and ambient (zero columns for massless ones)
  Eigen::MatrixXd impedance;  // T_m from heat into massless nodes
  Eigen::MatrixXd laplacian;  // of all nodes and ambient, before elimination
};

Elimination eliminate(const Data& data, const Names& index) {
  const auto n = static_cast<Eigen::Index>(data.nodes.size());
  Elimination e;
  e.laplacian = Eigen::MatrixXd::Zero(n + 1, n + 1);
  for (const auto& r : data.resistors) {
    if (r.law != Data::Law::constant) continue;
    const auto a = static_cast<Eigen::Index>(index(r.between)), b = static_cast<Eigen::Index>(index(r.and_node));
    const double G = 1. / r.resistance;
    e.laplacian(a, a) += G;
    e.laplacian(b, b) += G;
    e.laplacian(a, b) -= G;
    e.laplacian(b, a) -= G;
  }
  for (std::size_t i = 0; i < data.nodes.size(); ++i)
    if (data.nodes[i].capacity == 0.) e.massless.push_back(i);
  const auto m = static_cast<Eigen::Index>(e.massless.size());
  Eigen::MatrixXd L_mm(m, m), L_mk = Eigen::MatrixXd::Zero(m, n + 1);
  for (Eigen::Index i = 0; i < m; ++i) {
    const auto row = static_cast<Eigen::Index>(e.massless[static_cast<std::size_t>(i)]);
    if (e.laplacian(row, row) <= 0.)
      throw std::invalid_argument("the massless thermal node \"" + data.nodes[static_cast<std::size_t>(row)].name +
                                  "\" has no constant resistor");
    L_mk.row(i) = e.laplacian.row(row);
    for (Eigen::Index j = 0; j < m; ++j) {
      const auto column = static_cast<Eigen::Index>(e.massless[static_cast<std::size_t>(j)]);
      L_mm(i, j) = e.laplacian(row, column);
      L_mk(i, column) = 0.;
    }
  }
  e.impedance = m > 0 ? Eigen::MatrixXd(L_mm.inverse()) : L_mm;
  e.weights = -e.impedance * L_mk;
  return e;
}

}  // namespace

ThermalNetwork::ThermalNetwork(ThermalNetworkData data) : data_(std::move(data)) {
  const Names index(data_);
  const std::size_t n = data_.nodes.size();
  const auto elimination = eliminate(data_, index);

  constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::vector<std::size_t> state_of(n + 1, none), massless_of(n + 1, none);
  for (std::size_t i = 0; i < n; ++i)
    if (data_.nodes[i].capacity > 0.) {
      state_of[i] = with_capacity_.size();
      with_capacity_.push_back(i);
      inverse_capacity_.push_back(1. / data_.nodes[i].capacity);
    }
  const std::size_t surroundings = with_capacity_.size();
  state_of[n] = surroundings;
  for (std::size_t i = 0; i < elimination.massless.size(); ++i) massless_of[elimination.massless[i]] = i;
  flows_ = LinearFlows(surroundings, data_.places.size());
  const auto watts_into = [&](std::size_t state) { return state == surroundings ? 1. : inverse_capacity_[state]; };

  // Conductances between kept nodes after elimination: the Schur complement's off-diagonal entries.
  for (std::size_t a = 0; a <= n; ++a)
    for (std::size_t b = a + 1; b <= n; ++b) {
      if (state_of[a] == none || state_of[b] == none) continue;
      const auto row = static_cast<Eigen::Index>(a), column = static_cast<Eigen::Index>(b);
      double G = -elimination.laplacian(row, column);
      for (std::size_t m = 0; m < elimination.massless.size(); ++m)
        G -= elimination.laplacian(row, static_cast<Eigen::Index>(elimination.massless[m])) *
             elimination.weights(static_cast<Eigen::Index>(m), column);
      if (!(G > 0.)) continue;
      for (const auto& [from, to] : {std::pair{state_of[a], state_of[b]}, std::pair{state_of[b], state_of[a]}}) {
        if (from == surroundings) continue;  // always at the ambient temperature
        flows_.by_rise(from, from) -= G * watts_into(from);
        flows_.by_rise(to, from) += G * watts_into(to);
      }
    }
  for (const auto& r : data_.resistors) {
    if (r.law == Data::Law::constant) continue;
    const std::size_t a = index(r.between), b = index(r.and_node);
    if (state_of[a] == none || state_of[b] == none)
      throw std::invalid_argument("a resistor that is not constant joins the massless thermal node \"" +
                                  (state_of[a] == none ? r.between : r.and_node) + "\"");
    law_links_.push_back({state_of[a], state_of[b], r.law, r.place, r.resistance, r.R_apart, r.area});
  }

  // A watt into a massless node leaves it towards its neighbours as the temperatures' weights say.
  const auto spread = [&](const std::string& name, std::vector<Term>& terms, double& lost) {
    const std::size_t node = index(name);
    lost = 0.;
    if (massless_of[node] == none) {
      if (node == n) throw std::invalid_argument("heat cannot enter the surroundings directly");
      terms.push_back({state_of[node], 1.});
      return;
    }
    const auto row = static_cast<Eigen::Index>(massless_of[node]);
    for (std::size_t k = 0; k <= n; ++k) {
      const double weight = elimination.weights(row, static_cast<Eigen::Index>(k));
      if (weight == 0.) continue;
      if (k == n)
        lost = weight;
      else
        terms.push_back({state_of[k], weight});
    }
  };
  for (std::size_t p = 0; p < data_.places.size(); ++p) {
    const auto& place = data_.places[p];
    std::size_t port = 0;
    for (const std::string* name : {&place.ring_node, &place.shaft_node, &place.inner_contact, &place.outer_contact}) {
      std::vector<Term> terms;
      double lost = 0.;
      spread(*name, terms, lost);
      for (const auto& term : terms) flows_.by_port(term.node, p, port) += term.factor * watts_into(term.node);
      flows_.by_port(surroundings, p, port++) += lost;
    }
  }

  // Contacts of rolling balls, each a massless node, or one with capacity that a user's circuit has instead.
  for (std::size_t p = 0; p < data_.places.size(); ++p) {
    const auto& place = data_.places[p];
    if (place.balls.empty()) continue;
    const std::size_t balls = index(place.balls);
    if (state_of[balls] == none || balls == n)
      throw std::invalid_argument("the balls' node \"" + place.balls + "\" needs a heat capacity");
    RollingBalls<double> r{p, state_of[balls], 1. / place.ball_factor, 0., 0., {}, {}, 0., 0., 0.};
    const std::array<std::size_t, 2> contact = {index(place.inner_contact), index(place.outer_contact)};
    spread(place.inner_contact, r.inner_of, r.inner_of_ambient);
    spread(place.outer_contact, r.outer_of, r.outer_of_ambient);
    const auto impedance = [&](std::size_t a, std::size_t b) {
      const std::size_t row = massless_of[a], column = massless_of[b];
      return row == none || column == none
                 ? 0.
                 : elimination.impedance(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
    };
    r.inner_inner = impedance(contact[0], contact[0]);
    r.inner_outer = impedance(contact[0], contact[1]);
    r.outer_outer = impedance(contact[1], contact[1]);
    for (const auto& other : data_.places) {
      if (&other == &place || other.balls.empty()) continue;
      for (const std::size_t own : contact)
        for (const auto* name : {&other.inner_contact, &other.outer_contact})
          if (impedance(own, index(*name)) != 0.)
            throw std::invalid_argument("massless nodes alone join contacts of rolling balls of two bearings");
    }
    rolling_.push_back(std::move(r));
  }

  for (const auto& g : data_.growths) {
    while (growths_.size() <= g.place) growths_.emplace_back();
    const std::size_t node = index(g.node);
    const auto surface = static_cast<std::size_t>(std::find(growth_surfaces.begin(), growth_surfaces.end(), g.surface) -
                                                  growth_surfaces.begin());
    if (massless_of[node] == none) {
      if (node != n) growths_[g.place].add(surface, state_of[node], g.coefficient);
      continue;
    }
    const auto row = static_cast<Eigen::Index>(massless_of[node]);
    for (std::size_t k = 0; k < n; ++k)
      if (const double weight = elimination.weights(row, static_cast<Eigen::Index>(k)); weight != 0.)
        growths_[g.place].add(surface, state_of[k], g.coefficient * weight);
  }

  shown_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    Shown& shown = shown_[i];
    shown.of_heat.assign(4 * data_.places.size(), 0.);
    if (massless_of[i] == none) {
      shown.of_temperature.push_back({state_of[i], 1.});
      continue;
    }
    const auto row = static_cast<Eigen::Index>(massless_of[i]);
    for (std::size_t k = 0; k <= n; ++k) {
      const double weight = elimination.weights(row, static_cast<Eigen::Index>(k));
      if (weight == 0.) continue;
      if (k == n)
        shown.of_ambient = weight;
      else
        shown.of_temperature.push_back({state_of[k], weight});
    }
    for (std::size_t p = 0; p < data_.places.size(); ++p) {
      const auto& place = data_.places[p];
      const std::array<const std::string*, 4> names = {&place.ring_node, &place.shaft_node, &place.inner_contact,
                                                       &place.outer_contact};
      for (std::size_t port = 0; port < 4; ++port)
        if (const std::size_t m = massless_of[index(*names[port])]; m != none)
          shown.of_heat[4 * p + port] = elimination.impedance(row, static_cast<Eigen::Index>(m));
    }
  }
}

std::vector<StateEntry> ThermalNetwork::state_entries() const {
  std::vector<StateEntry> entries;
  for (const std::size_t i : with_capacity_) entries.push_back({data_.nodes[i].name, "K", 1.});
  return entries;
}

void ThermalNetwork::initial_state(std::span<double> T) const {
  for (double& value : T) value = data_.ambient;
}

std::vector<std::string> ThermalNetwork::heat_ports() const {
  std::vector<std::string> names;
  for (const std::size_t i : with_capacity_) names.push_back(data_.nodes[i].name);
  return names;
}

void ThermalNetwork::add_heat(std::size_t port, double watts, std::span<double> dydt) const {
  dydt[port] += watts * inverse_capacity_[port];
}

std::vector<std::size_t> ThermalNetwork::ring_states() const {
  std::vector<std::size_t> states;
  for (const auto& place : data_.places)
    for (std::size_t k = 0; k < with_capacity_.size(); ++k)
      if (data_.nodes[with_capacity_[k]].name == place.ring_node) states.push_back(k);
  if (states.size() != data_.places.size()) throw std::invalid_argument("a ring without capacity has no temperature");
  return states;
}

void ThermalNetwork::growth(std::span<const double> T, std::span<Expansion> out) const {
  LinearGrowth::of_all(growths_, T, data_.ambient, out);
}

void ThermalNetwork::growth_rates(std::span<const double> rate, std::span<Expansion> out) const {
  LinearGrowth::of_all(growths_, rate, 0., out);
}

double ThermalNetwork::rates(std::span<const double> T, std::span<const HeatInput> heat, std::span<double> dydt) const {
  // rho C V dT/dt = H_in - H_out of each node, eq. (17) of Neisi 2019. Its steps in time, eq. (18), are the integrator's here.
  const double lost = flows_.rates(T, data_.ambient, heat, dydt);
  return add_flows<double>(law_links_, rolling_, T, data_.ambient, heat, inverse_capacity_, dydt, lost);
}

std::vector<Observable> ThermalNetwork::observables() const {
  std::vector<Observable> list;
  for (const auto& node : data_.nodes) {
    const bool is_ring = std::any_of(data_.places.begin(), data_.places.end(),
                                     [&](const auto& place) { return place.ring_node == node.name; });
    list.push_back({node.name,
                    "K",
                    node.long_name,
                    1,
                    {},
                    is_ring ? Observed::inner_ring_temperature : Observed::temperature,
                    node.name.substr(0, node.name.find('/'))});
  }
  return list;
}

void ThermalNetwork::observe(std::span<const double> T, std::span<const HeatInput> heat, std::span<double> out) const {
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    const Shown& shown = shown_[i];
    double value = shown.of_ambient * data_.ambient;
    for (const auto& term : shown.of_temperature) value += term.factor * T[term.node];
    for (std::size_t p = 0; p < data_.places.size(); ++p) {
      const auto watts = heat_by_port(heat[p]);
      value += shown.of_heat[4 * p] * watts[0] + shown.of_heat[4 * p + 1] * watts[1] +
               shown.of_heat[4 * p + 2] * watts[2] + shown.of_heat[4 * p + 3] * watts[3];
    }
    out[i] = value;
  }
  for (const auto& r : rolling_) {
    const ContactHeat q = r.heat(T, data_.ambient, heat[r.place]);
    for (std::size_t i = 0; i < shown_.size(); ++i)
      out[i] += shown_[i].of_heat[4 * r.place + 2] * q.inner + shown_[i].of_heat[4 * r.place + 3] * q.outer;
  }
}

double ThermalNetwork::stored_energy(std::span<const double> T) const {
  double sum = 0.;
  for (std::size_t i = 0; i < with_capacity_.size(); ++i)
    sum += data_.nodes[with_capacity_[i]].capacity * (T[i] - data_.ambient);
  return sum;
}

}  // namespace rotordrop
