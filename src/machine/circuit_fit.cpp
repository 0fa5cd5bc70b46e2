#include "machine/circuit_fit.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <unsupported/Eigen/NonLinearOptimization>

#include "base/errors.h"
#include "thermal/bearing_heat.h"

namespace rotordrop {
namespace {

constexpr std::array<BearingPort, 4> ports = {bore_port, shaft_port, inner_raceway_port, outer_raceway_port};
constexpr std::array<const char*, 5> nodes = {"shaft", "inner_ring", "ball", "outer_ring", "housing"};
constexpr auto n_ports = ports.size(), n_nodes = nodes.size();

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
        if (candidate.name == nodes[k]) output = &candidate;
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
      if (node.name == circuit.name + "/" + nodes[k]) place[k] = static_cast<Eigen::Index>(capacities.size());
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

/// Residuals of the fit over the factors' logarithms, with a weak pull towards 1 that decides where the responses do not.
struct Fit {
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };
  static constexpr double pull = 0.01;

  const BearingCircuitData& circuit;
  const Responses& fe;
  const Eigen::ArrayXd& t;
  double ambient;

  [[nodiscard]] int inputs() const { return static_cast<int>(circuit_factors.size()); }
  [[nodiscard]] int values() const {
    return static_cast<int>(n_ports * n_nodes) * static_cast<int>(t.size()) + inputs();
  }

  static CircuitFactors factors_of(const InputType& x) {
    CircuitFactors f;
    for (std::size_t i = 0; i < circuit_factors.size(); ++i)
      f.*circuit_factors[i].second = std::exp(std::clamp(x(static_cast<Eigen::Index>(i)), -4.6, 4.6));
    return f;
  }
  [[nodiscard]] Responses errors_with(const CircuitFactors& factors) const {
    BearingCircuitData changed = circuit;
    changed.factors = factors;
    return relative_errors(responses_of(changed, ambient, t), fe);
  }
  int operator()(const InputType& x, ValueType& residual) const {
    const Responses e = errors_with(factors_of(x));
    Eigen::Index at = 0;
    for (const auto& of_port : e)
      for (const auto& of_node : of_port) {
        residual.segment(at, t.size()) = of_node.matrix();
        at += t.size();
      }
    residual.tail(inputs()) = pull * x;
    return 0;
  }
};

}  // namespace

CalibratedBearing fit_circuit(const BearingCircuitData& circuit, const ReducedHeat& section, double ambient,
                              const CalibrationSettings& settings) {
  const Eigen::ArrayXd t = times_of(settings);
  const Responses fe = responses_of(section, t);
  Eigen::NumericalDiff<Fit, Eigen::Central> fit(Fit{circuit, fe, t, ambient});
  Eigen::VectorXd x = Eigen::VectorXd::Zero(fit.inputs());
  Eigen::LevenbergMarquardt<decltype(fit)> search(fit);
  const auto status = search.minimize(x);
  if (status == Eigen::LevenbergMarquardtSpace::ImproperInputParameters ||
      status == Eigen::LevenbergMarquardtSpace::TooManyFunctionEvaluation)
    throw SolverError(fmt::format("the circuit of {} cannot be fitted to the finite elements (status {})", circuit.name,
                                  static_cast<int>(status)));

  CalibratedBearing result{circuit.name, Fit::factors_of(x), {}, {}, {}};
  const Responses before = fit.errors_with({}), after = fit.errors_with(result.factors);
  result.before = measure(before, 0, n_nodes);
  result.after = measure(after, 0, n_nodes);
  for (std::size_t k = 0; k < n_nodes; ++k)
    result.nodes.push_back({nodes[k], {measure(before, k, k + 1), measure(after, k, k + 1)}});
  return result;
}

}  // namespace rotordrop
