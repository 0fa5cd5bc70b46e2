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

/// The nodes after elimination: each has a state or is massless, and the surroundings come after the last state.
struct ThermalNetwork::Reduced {
  static constexpr auto none = static_cast<std::size_t>(-1);
  const Data& data;
  Names index;
  Elimination elimination;
  std::size_t n;                                   // number of nodes, and what Names calls the surroundings
  std::vector<std::size_t> state_of, massless_of;  // of each node and the surroundings
  std::size_t surroundings = 0;                    // their state

  explicit Reduced(const Data& network)
      : data(network),
        index(network),
        elimination(eliminate(network, index)),
        n(network.nodes.size()),
        state_of(n + 1, none),
        massless_of(n + 1, none) {
    for (std::size_t i = 0; i < n; ++i)
      if (data.nodes[i].capacity > 0.) state_of[i] = surroundings++;
    state_of[n] = surroundings;
    for (std::size_t i = 0; i < elimination.massless.size(); ++i) massless_of[elimination.massless[i]] = i;
  }
  [[nodiscard]] bool is_massless(std::size_t node) const { return massless_of[node] != none; }
  /// Weights of the temperatures that a massless node's consists of.
  [[nodiscard]] std::vector<Term> terms(std::size_t node, double& of_ambient) const {
    std::vector<Term> list;
    const auto row = static_cast<Eigen::Index>(massless_of[node]);
    for (std::size_t k = 0; k < n; ++k)
      if (const double weight = elimination.weights(row, static_cast<Eigen::Index>(k)); weight != 0.)
        list.push_back({state_of[k], weight});
    of_ambient = elimination.weights(row, static_cast<Eigen::Index>(n));
    return list;
  }
  /// Where a watt into a node goes. That into a massless one leaves it towards its neighbours as its temperature's weights say.
  [[nodiscard]] std::vector<Term> spread(const std::string& name, double& lost) const {
    const std::size_t node = index(name);
    lost = 0.;
    if (is_massless(node)) return terms(node, lost);
    if (node == n) throw std::invalid_argument("heat cannot enter the surroundings directly");
    return {{state_of[node], 1.}};
  }
  /// Rise of node a by heat into node b at held states [K/W].
  [[nodiscard]] double impedance(std::size_t a, std::size_t b) const {
    return is_massless(a) && is_massless(b) ? elimination.impedance(static_cast<Eigen::Index>(massless_of[a]),
                                                                    static_cast<Eigen::Index>(massless_of[b]))
                                            : 0.;
  }
};

ThermalNetwork::ThermalNetwork(ThermalNetworkData data) : data_(std::move(data)) {
  const Reduced reduced(data_);
  for (std::size_t i = 0; i < data_.nodes.size(); ++i)
    if (data_.nodes[i].capacity > 0.) {
      with_capacity_.push_back(i);
      inverse_capacity_.push_back(1. / data_.nodes[i].capacity);
    }
  flows_ = LinearFlows(reduced.surroundings, data_.places.size());
  lay_conductances(reduced);
  lay_law_links(reduced);
  lay_ports(reduced);
  lay_rolling_balls(reduced);
  lay_growths(reduced);
  lay_shown(reduced);
}

double ThermalNetwork::rate_per_watt(std::size_t state) const {
  return state == with_capacity_.size() ? 1. : inverse_capacity_[state];
}

// Conductances between kept nodes after elimination: the Schur complement's off-diagonal entries.
void ThermalNetwork::lay_conductances(const Reduced& reduced) {
  const auto& [massless, weights, impedance, laplacian] = reduced.elimination;
  for (std::size_t a = 0; a <= reduced.n; ++a)
    for (std::size_t b = a + 1; b <= reduced.n; ++b) {
      if (reduced.is_massless(a) || reduced.is_massless(b)) continue;
      const auto row = static_cast<Eigen::Index>(a), column = static_cast<Eigen::Index>(b);
      double G = -laplacian(row, column);
      for (std::size_t m = 0; m < massless.size(); ++m)
        G -= laplacian(row, static_cast<Eigen::Index>(massless[m])) * weights(static_cast<Eigen::Index>(m), column);
      if (!(G > 0.)) continue;
      const std::size_t of_a = reduced.state_of[a], of_b = reduced.state_of[b];
      for (const auto& [from, to] : {std::pair{of_a, of_b}, std::pair{of_b, of_a}}) {
        if (from == reduced.surroundings) continue;  // always at the ambient temperature
        flows_.by_rise(from, from) -= G * rate_per_watt(from);
        flows_.by_rise(to, from) += G * rate_per_watt(to);
      }
    }
}

void ThermalNetwork::lay_law_links(const Reduced& reduced) {
  for (const auto& r : data_.resistors) {
    if (r.law == Data::Law::constant) continue;
    const std::size_t a = reduced.index(r.between), b = reduced.index(r.and_node);
    if (reduced.is_massless(a) || reduced.is_massless(b))
      throw std::invalid_argument("a resistor that is not constant joins the massless thermal node \"" +
                                  (reduced.is_massless(a) ? r.between : r.and_node) + "\"");
    law_links_.push_back({reduced.state_of[a], reduced.state_of[b], r.law, r.place, r.resistance, r.R_apart, r.area});
  }
}

void ThermalNetwork::lay_ports(const Reduced& reduced) {
  for (std::size_t p = 0; p < data_.places.size(); ++p) {
    const auto& place = data_.places[p];
    std::size_t port = 0;
    for (const std::string* name : {&place.ring_node, &place.shaft_node, &place.inner_contact, &place.outer_contact}) {
      double lost = 0.;
      for (const auto& term : reduced.spread(*name, lost))
        flows_.by_port(term.node, p, port) += term.factor * rate_per_watt(term.node);
      flows_.by_port(reduced.surroundings, p, port++) += lost;
    }
  }
}

// Contacts of rolling balls, each a massless node, or one with capacity that a user's circuit has instead.
void ThermalNetwork::lay_rolling_balls(const Reduced& reduced) {
  for (std::size_t p = 0; p < data_.places.size(); ++p) {
    const auto& place = data_.places[p];
    if (place.balls.empty()) continue;
    const std::size_t balls = reduced.index(place.balls);
    if (reduced.is_massless(balls) || balls == reduced.n)
      throw std::invalid_argument("the balls' node \"" + place.balls + "\" needs a heat capacity");
    RollingBalls<double> r{p, reduced.state_of[balls], 1. / place.ball_factor, 0., 0., {}, {}, 0., 0., 0.};
    const std::array<std::size_t, 2> contact = {reduced.index(place.inner_contact), reduced.index(place.outer_contact)};
    r.inner_of = reduced.spread(place.inner_contact, r.inner_of_ambient);
    r.outer_of = reduced.spread(place.outer_contact, r.outer_of_ambient);
    r.inner_inner = reduced.impedance(contact[0], contact[0]);
    r.inner_outer = reduced.impedance(contact[0], contact[1]);
    r.outer_outer = reduced.impedance(contact[1], contact[1]);
    for (const auto& other : data_.places) {
      if (&other == &place || other.balls.empty()) continue;
      for (const std::size_t own : contact)
        for (const auto* name : {&other.inner_contact, &other.outer_contact})
          if (reduced.impedance(own, reduced.index(*name)) != 0.)
            throw std::invalid_argument("massless nodes alone join contacts of rolling balls of two bearings");
    }
    rolling_.push_back(std::move(r));
  }
}

void ThermalNetwork::lay_growths(const Reduced& reduced) {
  for (const auto& g : data_.growths) {
    while (growths_.size() <= g.place) growths_.emplace_back();
    LinearGrowth& growth = growths_[g.place];
    const std::size_t node = reduced.index(g.node);
    const auto surface = static_cast<std::size_t>(std::find(growth_surfaces.begin(), growth_surfaces.end(), g.surface) -
                                                  growth_surfaces.begin());
    if (!reduced.is_massless(node)) {
      if (node != reduced.n) growth.add(surface, reduced.state_of[node], g.coefficient);
      continue;
    }
    double of_ambient = 0.;  // which does not rise
    for (const auto& term : reduced.terms(node, of_ambient))
      growth.add(surface, term.node, g.coefficient * term.factor);
  }
}

void ThermalNetwork::lay_shown(const Reduced& reduced) {
  shown_.resize(reduced.n);
  for (std::size_t i = 0; i < reduced.n; ++i) {
    Shown& shown = shown_[i];
    shown.of_heat.assign(4 * data_.places.size(), 0.);
    if (!reduced.is_massless(i)) {
      shown.of_temperature.push_back({reduced.state_of[i], 1.});
      continue;
    }
    shown.of_temperature = reduced.terms(i, shown.of_ambient);
    for (std::size_t p = 0; p < data_.places.size(); ++p) {
      const auto& place = data_.places[p];
      std::size_t port = 4 * p;
      for (const std::string* name : {&place.ring_node, &place.shaft_node, &place.inner_contact, &place.outer_contact})
        shown.of_heat[port++] = reduced.impedance(i, reduced.index(*name));
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
