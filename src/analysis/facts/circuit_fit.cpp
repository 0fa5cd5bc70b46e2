#include "analysis/facts/circuit_fit.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <unsupported/Eigen/NonLinearOptimization>

#include "base/errors.h"
#include "thermal/heating/bearing_heat.h"

namespace rotordrop {
namespace {

constexpr std::array<BearingPort, 4> ports = {bore_port, shaft_port, inner_raceway_port, outer_raceway_port};
constexpr std::array<const char*, 5> node_names = {"shaft", "inner_ring", "ball", "outer_ring", "housing"};
constexpr auto n_ports = ports.size(), n_nodes = node_names.size();

/// Rises per watt [K/W]: [port][node] over the times.
using Responses = std::array<std::array<Eigen::ArrayXd, n_nodes>, n_ports>;

Eigen::ArrayXd times_of(const CalibrationSettings& s) {
  return Eigen::ArrayXd::LinSpaced(s.n_times, std::log(s.from), std::log(s.until)).exp();
}

HeatInput one_watt_into(BearingPort port) {
  HeatInput h;
  if (port == bore_port) h.rub = h.rub_into_ring = 1.;
  if (port == shaft_port) h.rub = 1.;
  if (port == inner_raceway_port) h.inner = 1.;
  if (port == outer_raceway_port) h.outer = 1.;
  return h;
}

/// Integral of exp(-rate s) ds from 0 to t.
Eigen::ArrayXd integral_of_decay(double rate, const Eigen::ArrayXd& t) {
  if (rate * t.maxCoeff() < 1e-8) return t * (1. - 0.5 * rate * t);
  return -(-rate * t).expm1() / rate;
}

Responses responses_of(const ReducedHeat& heat, const Eigen::ArrayXd& t) {
  std::vector<Eigen::ArrayXd> decay;
  for (const double rate : heat.rate) decay.push_back(integral_of_decay(rate, t));
  Responses r;
  for (std::size_t k = 0; k < n_nodes; ++k) {
    const ReducedHeat::Output* output = nullptr;
    for (const auto* list : {&heat.bodies, &heat.nodes})
      for (const auto& candidate : *list)
        if (candidate.name == node_names[k]) output = &candidate;
    if (output == nullptr) throw std::logic_error(std::string("circuit fit: no body or node ") + node_names[k]);
    for (std::size_t p = 0; p < n_ports; ++p) {
      r[p][k] = Eigen::ArrayXd::Zero(t.size());
      for (std::size_t i = 0; i < heat.n_modes(); ++i)
        r[p][k] += output->shape[i] * heat.ports[ports[p]].shape[i] / heat.capacity * decay[i];
    }
  }
  return r;
}

/// The circuit without convection from its housing, in its own modes.
Responses responses_of(const BearingCircuitData& circuit, double ambient, const Eigen::ArrayXd& t) {
  ThermalNetworkData data;
  data.ambient = ambient;
  add_bearing_circuit(circuit, data);
  std::erase_if(data.resistors, [](const auto& r) { return r.law == ThermalNetworkData::Law::housing_convection; });
  const ThermalNetwork network(data);
  // States are the nodes with capacity, in their order; those of a fin are nobody's to compare.
  std::vector<double> capacities;
  std::array<Eigen::Index, n_nodes> place{};
  for (const auto& node : data.nodes) {
    if (node.capacity == 0.) continue;
    for (std::size_t k = 0; k < n_nodes; ++k)
      if (node.name == circuit.name + "/" + node_names[k]) place[k] = static_cast<Eigen::Index>(capacities.size());
    capacities.push_back(node.capacity);
  }
  const std::size_t n_states = capacities.size();
  const auto n = static_cast<Eigen::Index>(n_states);
  const Eigen::VectorXd capacity = Eigen::Map<const Eigen::VectorXd>(capacities.data(), n);
  Eigen::MatrixXd A(n, n), B(n, static_cast<Eigen::Index>(n_ports));
  Eigen::VectorXd y(n), rate(n);
  const auto rates = [&](const HeatInput& heat) {
    network.rates({y.data(), n_states}, {&heat, 1}, {rate.data(), n_states});
  };
  for (Eigen::Index j = 0; j < n; ++j) {
    y.setConstant(ambient);
    y(j) += 1.;
    HeatInput none;
    none.is_in_contact = true;
    rates(none);
    A.col(j) = rate;
  }
  y.setConstant(ambient);
  for (std::size_t p = 0; p < n_ports; ++p) {
    rates(one_watt_into(ports[p]));
    B.col(static_cast<Eigen::Index>(p)) = rate;
  }
  // Reciprocal, so symmetric once scaled with the roots of the capacities.
  const Eigen::VectorXd root = capacity.cwiseSqrt();
  const Eigen::MatrixXd S = root.asDiagonal() * A * root.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(0.5 * (S + S.transpose()));
  const Eigen::MatrixXd shape = root.cwiseInverse().asDiagonal() * modes.eigenvectors(),
                        input = modes.eigenvectors().transpose() * root.asDiagonal() * B;
  Responses r;
  for (std::size_t p = 0; p < n_ports; ++p)
    for (std::size_t k = 0; k < n_nodes; ++k) {
      r[p][k] = Eigen::ArrayXd::Zero(t.size());
      for (Eigen::Index i = 0; i < n; ++i)
        r[p][k] +=
            shape(place[k], i) * input(i, static_cast<Eigen::Index>(p)) * integral_of_decay(-modes.eigenvalues()(i), t);
    }
  return r;
}

/// Differences over the largest rise that the same heat causes at the same time: [port][node] over the times.
Responses relative_errors(const Responses& lumped, const Responses& fe) {
  Responses e;
  for (std::size_t p = 0; p < n_ports; ++p) {
    Eigen::ArrayXd largest = fe[p][0];
    for (const auto& rise : fe[p]) largest = largest.max(rise);
    for (std::size_t k = 0; k < n_nodes; ++k) e[p][k] = (lumped[p][k] - fe[p][k]) / largest;
  }
  return e;
}

ResponseError measure(const Responses& e, std::size_t first_node, std::size_t end_node) {
  ResponseError m;
  double squares = 0.;
  Eigen::Index n = 0;
  for (std::size_t p = 0; p < n_ports; ++p)
    for (std::size_t k = first_node; k < end_node; ++k) {
      squares += e[p][k].square().sum();
      n += e[p][k].size();
      m.largest = std::max(m.largest, e[p][k].abs().maxCoeff());
    }
  m.rms = std::sqrt(squares / static_cast<double>(n));
  return m;
}

/// Residuals of the fit over the logarithms of the factors that are free, with a weak pull towards 1 that decides where the responses do not.
struct Fit {
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  // NOLINTNEXTLINE(readability-identifier-naming): Eigen's names
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };
  static constexpr double pull = 0.01;

  const BearingCircuitData& circuit;
  const Responses& fe;
  const Eigen::ArrayXd& t;
  double ambient;
  const std::vector<UncertainResistance>& uncertain;
  std::vector<double> logarithms = std::vector<double>(uncertain.size(), 0.);
  std::vector<std::size_t> free = {};

  [[nodiscard]] int inputs() const { return static_cast<int>(free.size()); }
  [[nodiscard]] int values() const {
    return static_cast<int>(n_ports * n_nodes) * static_cast<int>(t.size()) + static_cast<int>(uncertain.size());
  }

  [[nodiscard]] std::vector<double> with(const InputType& x) const {
    auto all = logarithms;
    for (std::size_t k = 0; k < free.size(); ++k) all[free[k]] = std::clamp(x(static_cast<Eigen::Index>(k)), -4.6, 4.6);
    return all;
  }
  /// Resistances by their factors, capacities as given.
  [[nodiscard]] CircuitFactors factors_of(const std::vector<double>& all) const {
    CircuitFactors f = circuit.factors;
    f.ball = 1.;
    for (std::size_t i = 0; i < uncertain.size(); ++i) f.*uncertain[i].member = std::exp(all[i]);
    return f;
  }
  [[nodiscard]] Responses errors_with(const CircuitFactors& factors) const {
    BearingCircuitData changed = circuit;
    changed.factors = factors;
    return relative_errors(responses_of(changed, ambient, t), fe);
  }
  [[nodiscard]] ValueType residual_of(const std::vector<double>& all) const {
    ValueType residual(values());
    const Responses e = errors_with(factors_of(all));
    Eigen::Index at = 0;
    for (const auto& of_port : e)
      for (const auto& of_node : of_port) {
        residual.segment(at, t.size()) = of_node.matrix();
        at += t.size();
      }
    for (const double logarithm : all) residual(at++) = pull * logarithm;
    return residual;
  }
  int operator()(const InputType& x, ValueType& residual) const {
    residual = residual_of(with(x));
    return 0;
  }
};

/// Fits the free factors, whatever their bounds.
void fit_free(Fit& of) {
  if (of.free.empty()) return;
  Eigen::NumericalDiff<Fit, Eigen::Central> fit(of);
  Eigen::VectorXd x(fit.inputs());
  for (std::size_t k = 0; k < of.free.size(); ++k) x(static_cast<Eigen::Index>(k)) = of.logarithms[of.free[k]];
  Eigen::LevenbergMarquardt<decltype(fit)> search(fit);
  const auto status = search.minimize(x);
  if (status == Eigen::LevenbergMarquardtSpace::ImproperInputParameters ||
      status == Eigen::LevenbergMarquardtSpace::TooManyFunctionEvaluation)
    throw SolverError(fmt::format("the circuit of {} cannot be fitted to the finite elements (status {})",
                                  of.circuit.name, static_cast<int>(status)));
  of.logarithms = of.with(x);
}

/// A bound at which a factor is held: -1 the lower, 1 the upper one, 0 neither.
using Held = std::vector<int>;

/// Fits all factors within their bounds. The one furthest beyond its bound is put there and held, and the others are fitted again; a held one that would rather go
/// back inside is let go.
Held fit_within_bounds(Fit& fit) {
  const std::size_t n = fit.uncertain.size();
  constexpr double inside = 1e-3;  // of a logarithm: to see which way the error falls
  const auto bound = [&](std::size_t i, int side) {
    return std::log(side < 0 ? fit.uncertain[i].lowest : fit.uncertain[i].highest);
  };
  Held held(n, 0);
  for (std::size_t round = 0; round < 4 * n; ++round) {
    fit.free.clear();
    for (std::size_t i = 0; i < n; ++i)
      if (held[i] == 0) fit.free.push_back(i);
    fit_free(fit);
    double furthest = 0.;
    std::size_t worst = n;
    for (const std::size_t i : fit.free)
      for (const int side : {-1, 1})
        if (const double beyond = side * (fit.logarithms[i] - bound(i, side)); beyond > furthest) {
          furthest = beyond;
          worst = i;
        }
    if (worst < n) {
      held[worst] = fit.logarithms[worst] < 0. ? -1 : 1;
      // Those that remain free start inside: what they were is an answer to the factor beyond its bound.
      for (const std::size_t i : fit.free)
        fit.logarithms[i] = i == worst ? bound(i, held[i]) : std::clamp(fit.logarithms[i], bound(i, -1), bound(i, 1));
      continue;
    }
    const double error = fit.residual_of(fit.logarithms).squaredNorm();
    bool is_done = true;
    for (std::size_t i = 0; i < n && is_done; ++i) {
      if (held[i] == 0) continue;
      auto moved = fit.logarithms;
      moved[i] -= held[i] * inside;
      if (fit.residual_of(moved).squaredNorm() >= error) continue;
      held[i] = 0;
      is_done = false;
    }
    if (is_done) break;
  }
  return held;
}

}  // namespace

std::vector<UncertainResistance> uncertain_resistances(const BearingCircuitData& circuit,
                                                       const BearingCircuitData& spreading) {
  constexpr double contact = 2., closed_form = 1.25;
  const CircuitResistances R = circuit_resistances(circuit), with = circuit_resistances(spreading);
  const auto highest = [&](double CircuitResistances::*wall, double CircuitResistances::*strips) {
    return closed_form * std::max(1., (with.*wall + with.*strips) / (R.*wall + R.*strips));
  };
  using P = CircuitFactors;
  using C = CircuitResistances;
  return {
      {"shaft_ring", &P::shaft_ring, "R2 + R3, shaft to inner ring", 1. / contact, contact},
      {"inner_race", &P::inner_race, "R4, inner ring to its contacts", 1. / closed_form,
       highest(&C::R4, &C::R4_spreading)},
      {"outer_race", &P::outer_race, "R7, contacts to outer ring", 1. / closed_form, highest(&C::R7, &C::R7_spreading)},
      {"fit", &P::fit, "R8, outer ring to housing", 1. / contact, contact}};
}

const CalibratedBearing::Resistance* CalibratedBearing::carrier() const {
  const Resistance* most = nullptr;
  for (const auto& r : resistances)
    if (r.rms_without > (most ? most->rms_without : after.rms)) most = &r;
  return most;
}

CalibratedBearing fit_circuit(const BearingCircuitData& circuit, const ReducedHeat& section, double ambient,
                              const CalibrationSettings& settings, const std::vector<UncertainResistance>& uncertain) {
  const Eigen::ArrayXd t = times_of(settings);
  const Responses fe = responses_of(section, t);
  Fit fit{circuit, fe, t, ambient, uncertain};
  const Responses before = fit.errors_with(fit.factors_of(fit.logarithms));
  const Held held = fit_within_bounds(fit);

  CalibratedBearing result{circuit.name, fit.factors_of(fit.logarithms), {}, {}, {}, {}};
  const Responses after = fit.errors_with(result.factors);
  result.before = measure(before, 0, n_nodes);
  result.after = measure(after, 0, n_nodes);
  for (std::size_t k = 0; k < n_nodes; ++k)
    result.nodes.push_back({node_names[k], {measure(before, k, k + 1), measure(after, k, k + 1)}});
  for (std::size_t i = 0; i < uncertain.size(); ++i) {
    CircuitFactors without = result.factors;
    without.*uncertain[i].member = 1.;
    result.resistances.push_back(
        {uncertain[i], measure(fit.errors_with(without), 0, n_nodes).rms, held[i]<0, held[i]> 0});
  }
  return result;
}

}  // namespace rotordrop
