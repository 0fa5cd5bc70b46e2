#pragma once
#include <span>
#include <vector>

#include "base/drops.h"
#include "thermal/circuit/thermal_network.h"

namespace rotordrop {

/// Thermal networks of several drops side by side: the same equations as ThermalNetwork's, without the factors that are zero in all of them.
template <class Real>
class ThermalNetworkInLanes {
 public:
  /// @param networks  alike (is_alike()); lanes without one repeat the first
  explicit ThermalNetworkInLanes(std::span<const ThermalNetwork* const> networks);

  /// Whether two networks differ in nothing but their numbers: the same nodes with capacity, links, contacts of rolling balls,
  /// and temperatures behind what each node shows.
  [[nodiscard]] static bool is_alike(const ThermalNetwork& a, const ThermalNetwork& b);

  void growth(std::span<const Real> T, std::span<ExpansionOf<Real>> out) const { grow(T, ambient_, out); }
  void growth_rates(std::span<const Real> rate, std::span<ExpansionOf<Real>> out) const { grow(rate, Real(0.), out); }
  Real rates(std::span<const Real> T, std::span<const HeatInputOf<Real>> heat, std::span<Real> dydt) const;
  void add_heat(std::size_t port, const Real& watts, std::span<Real> dydt) const {
    dydt[port] += watts * inverse_capacity_[port];
  }
  void observe(std::span<const Real> T, std::span<const HeatInputOf<Real>> heat, std::span<Real> out) const;
  [[nodiscard]] Real stored_energy(std::span<const Real> T) const {
    Real sum = 0.;
    for (std::size_t i = 0; i < n_; ++i) sum += capacity_[i] * (T[i] - ambient_);
    return sum;
  }

 private:
  using Term = CircuitTerm<Real>;
  using Terms = std::vector<Term>;
  void grow(std::span<const Real> T, const Real& above, std::span<ExpansionOf<Real>> out) const;
  void list_shown();
  void take_watts(std::span<const HeatInputOf<Real>> heat) const {
    for (std::size_t place = 0; place < n_places_; ++place) {
      const auto watts = heat_by_port(heat[place]);
      std::copy(watts.begin(), watts.end(), watts_.begin() + static_cast<std::ptrdiff_t>(watts.size() * place));
    }
  }
  /// A number of every network.
  template <class F>
  Real of_all(F&& number) const {
    Real r;
    for (int lane = 0; lane < n_lanes; ++lane) r.set(lane, number(*networks_[static_cast<std::size_t>(lane)]));
    return r;
  }

  std::vector<const ThermalNetwork*> networks_;  // [n_lanes]
  std::size_t n_ = 0, n_places_ = 0;
  Real ambient_;
  std::vector<Real> capacity_, inverse_capacity_;
  mutable std::vector<Real> watts_;       // into the ports, while they are asked for
  std::vector<Terms> by_rise_, by_port_;  // of each row: the nodes, then the heat lost
  std::vector<LawLink<Real>> law_links_;
  std::vector<RollingBalls<Real>> rolling_;
  struct Surface {
    std::size_t surface;
    Terms terms;
  };
  std::vector<std::vector<Surface>> growths_;  // of each place: surfaces that grow
  struct Shown {                               // of a node, massless ones too
    Real by_ambient;                           // part of the temperature [K]
    Terms by_temperature, by_port;
  };
  std::vector<Shown> shown_;  // of all nodes
};

template <class Real>
bool ThermalNetworkInLanes<Real>::is_alike(const ThermalNetwork& a, const ThermalNetwork& b) {
  using Network = ThermalNetwork;
  const auto same_terms = [](const std::vector<Network::Term>& p, const std::vector<Network::Term>& q) {
    return std::ranges::equal(p, q, {}, &Network::Term::node, &Network::Term::node);
  };
  return a.with_capacity_ == b.with_capacity_ && a.data_.places.size() == b.data_.places.size() &&
         a.growths_.size() == b.growths_.size() &&
         std::ranges::equal(
             a.shown_, b.shown_,
             [&](const auto& p, const auto& q) { return same_terms(p.of_temperature, q.of_temperature); }) &&
         std::ranges::equal(a.law_links_, b.law_links_,
                            [](const auto& p, const auto& q) {
                              return p.a == q.a && p.b == q.b && p.law == q.law && p.place == q.place;
                            }) &&
         std::ranges::equal(a.rolling_, b.rolling_, [&](const auto& p, const auto& q) {
           return p.place == q.place && p.balls == q.balls && same_terms(p.inner_of, q.inner_of) &&
                  same_terms(p.outer_of, q.outer_of);
         });
}

template <class Real>
ThermalNetworkInLanes<Real>::ThermalNetworkInLanes(std::span<const ThermalNetwork* const> networks) {
  for (int lane = 0; lane < n_lanes; ++lane)
    networks_.push_back(static_cast<std::size_t>(lane) < networks.size() ? networks[static_cast<std::size_t>(lane)]
                                                                         : networks.front());
  const ThermalNetwork& first = *networks_.front();
  n_ = first.with_capacity_.size();
  n_places_ = first.data_.places.size();
  watts_.resize(4 * n_places_);
  ambient_ = of_all([](const ThermalNetwork& w) { return w.data_.ambient; });
  for (std::size_t i = 0; i < n_; ++i) {
    capacity_.push_back(of_all([&](const ThermalNetwork& w) { return w.data_.nodes[w.with_capacity_[i]].capacity; }));
    inverse_capacity_.push_back(of_all([&](const ThermalNetwork& w) { return w.inverse_capacity_[i]; }));
  }
  const auto append = [&](Terms& to, std::size_t from, auto&& number) {
    const Real factor = of_all(number);
    if (any(factor != 0.)) to.push_back({from, factor});
  };
  for (std::size_t row = 0; row < first.flows_.n_rows(); ++row) {
    by_rise_.emplace_back();
    by_port_.emplace_back();
    for (std::size_t column = 0; column < first.flows_.n_columns(); ++column)
      append(column < n_ ? by_rise_.back() : by_port_.back(), column < n_ ? column : column - n_,
             [&](const ThermalNetwork& w) { return w.flows_.factor(row, column); });
  }
  for (std::size_t k = 0; k < first.law_links_.size(); ++k) {
    const auto& link = first.law_links_[k];
    using One = LawLink<double>;
    const auto number = [&](double One::*member) {
      return of_all([&](const ThermalNetwork& w) { return w.law_links_[k].*member; });
    };
    law_links_.push_back(
        {link.a, link.b, link.law, link.place, number(&One::resistance), number(&One::R_apart), number(&One::area)});
  }
  for (std::size_t k = 0; k < first.rolling_.size(); ++k) {
    const auto& one = first.rolling_[k];
    const auto number = [&](auto member) {
      return of_all([&](const ThermalNetwork& w) { return w.rolling_[k].*member; });
    };
    const auto terms = [&](auto list) {
      Terms made;
      for (std::size_t i = 0; i < (one.*list).size(); ++i)
        made.push_back(
            {(one.*list)[i].node, of_all([&](const ThermalNetwork& w) { return (w.rolling_[k].*list)[i].factor; })});
      return made;
    };
    using Own = RollingBalls<double>;
    rolling_.push_back({one.place, one.balls, number(&Own::factor), number(&Own::inner_of_ambient),
                        number(&Own::outer_of_ambient), terms(&Own::inner_of), terms(&Own::outer_of),
                        number(&Own::inner_inner), number(&Own::inner_outer), number(&Own::outer_outer)});
  }
  for (std::size_t p = 0; p < first.growths_.size(); ++p) {
    growths_.emplace_back();
    for (std::size_t surface = 0; surface < LinearGrowth::n_surfaces; ++surface) {
      Terms terms;
      for (std::size_t i = 0; i < n_; ++i)
        append(terms, i, [&](const ThermalNetwork& w) { return w.growths_[p].factor(surface, i); });
      if (!terms.empty()) growths_.back().push_back({surface, std::move(terms)});
    }
  }
  list_shown();
}

template <class Real>
void ThermalNetworkInLanes<Real>::list_shown() {
  const auto& first = networks_.front()->shown_;
  for (std::size_t i = 0; i < first.size(); ++i) {
    Shown shown{of_all([&](const ThermalNetwork& w) { return w.shown_[i].of_ambient * w.data_.ambient; }), {}, {}};
    for (std::size_t k = 0; k < first[i].of_temperature.size(); ++k)
      shown.by_temperature.push_back({first[i].of_temperature[k].node, of_all([&](const ThermalNetwork& w) {
                                        return w.shown_[i].of_temperature[k].factor;
                                      })});
    for (std::size_t port = 0; port < first[i].of_heat.size(); ++port) {
      const Real factor = of_all([&](const ThermalNetwork& w) { return w.shown_[i].of_heat[port]; });
      if (any(factor != 0.)) shown.by_port.push_back({port, factor});
    }
    shown_.push_back(std::move(shown));
  }
}

// What rolling balls give to contacts counts as heat there.
template <class Real>
void ThermalNetworkInLanes<Real>::observe(std::span<const Real> T, std::span<const HeatInputOf<Real>> heat,
                                          std::span<Real> out) const {
  take_watts(heat);
  for (const auto& r : rolling_) {
    const ContactHeatOf<Real> q = r.heat(T, ambient_, heat[r.place]);
    watts_[4 * r.place + 2] += q.inner;
    watts_[4 * r.place + 3] += q.outer;
  }
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    Real value = shown_[i].by_ambient;
    for (const Term& term : shown_[i].by_temperature) value += term.factor * T[term.node];
    for (const Term& term : shown_[i].by_port) value += term.factor * watts_[term.node];
    out[i] = value;
  }
}

template <class Real>
void ThermalNetworkInLanes<Real>::grow(std::span<const Real> T, const Real& above,
                                       std::span<ExpansionOf<Real>> out) const {
  for (std::size_t p = 0; p < out.size(); ++p) {
    out[p] = {};
    if (p >= growths_.size()) continue;
    for (const Surface& s : growths_[p]) {
      Real sum = 0.;
      for (const Term& term : s.terms) sum += term.factor * (T[term.node] - above);
      out[p].*growth_surfaces_of<Real>[s.surface] = sum;
    }
  }
}

template <class Real>
Real ThermalNetworkInLanes<Real>::rates(std::span<const Real> T, std::span<const HeatInputOf<Real>> heat,
                                        std::span<Real> dydt) const {
  take_watts(heat);
  Real lost = 0.;
  for (std::size_t row = 0; row <= n_; ++row) {
    Real sum = 0.;
    for (const Term& term : by_rise_[row]) sum += term.factor * (T[term.node] - ambient_);
    for (const Term& term : by_port_[row]) sum += term.factor * watts_[term.node];
    (row < n_ ? dydt[row] : lost) = sum;
  }
  return add_flows<Real>(law_links_, rolling_, T, ambient_, heat, inverse_capacity_, dydt, lost);
}

}  // namespace rotordrop
