#include "conduction/assembled_equations.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <numeric>
#include <optional>

#include "base/errors.h"
#include "conduction/supernodes.h"

namespace rotordrop {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::SparseMatrix<double>;

}  // namespace

/// Upper halves of both matrices, rows and columns in an order of elimination that leaves few entries in the factors: found once for all of them.
struct OrderedMatrices {
  OrderedMatrices(const Matrix& given_capacity, const Matrix& given_conductance,
                  const std::vector<HeldUnknowns>& held) {
    Eigen::AMDOrdering<int>()(given_capacity, order);  // by the pattern; its inverse
    order = Eigen::PermutationMatrix<Eigen::Dynamic>(order.inverse());
    const auto upper = [&](const Matrix& matrix) {
      Matrix half(matrix.rows(), matrix.cols());
      half.selfadjointView<Eigen::Upper>() = matrix.selfadjointView<Eigen::Lower>().twistedBy(order);
      return half;
    };
    capacity = upper(given_capacity);
    conductance = upper(given_conductance);
    std::vector<bool> is_held(static_cast<std::size_t>(capacity.rows()));
    for (const auto& part : held)
      for (const auto i : part.unknowns)
        is_held[static_cast<std::size_t>(order.indices()[static_cast<Eigen::Index>(i)])] = true;
    for (int column = 0; column < capacity.outerSize(); ++column)
      for (int k = capacity.outerIndexPtr()[column]; k < capacity.outerIndexPtr()[column + 1]; ++k) {
        const int row = capacity.innerIndexPtr()[k];
        if (row != column && (is_held[static_cast<std::size_t>(row)] || is_held[static_cast<std::size_t>(column)]))
          left_out.push_back(k);
      }
  }
  Eigen::PermutationMatrix<Eigen::Dynamic> order;
  Matrix capacity, conductance;                          ///< of one pattern
  std::vector<int> left_out;                             ///< entries in rows and columns of held unknowns
  mutable std::unique_ptr<const Supernodes> supernodes;  ///< of all factors, found with the first
};

namespace {

/// L D L^T factors.
class CholeskyInverse final : public HeatInverse {
 public:
  explicit CholeskyInverse(const OrderedMatrices& ordered) : ordered_(ordered), matrix_(ordered.capacity) {
    factors_.analyzePattern(matrix_);
  }

  void set_matrix(const Vector&, double scaled_step, HeatMatrix) override {
    Eigen::Map<Vector>(matrix_.valuePtr(), matrix_.nonZeros()) =
        values(ordered_.capacity) + scaled_step * values(ordered_.conductance);
    for (const int k : ordered_.left_out) matrix_.valuePtr()[k] = 0.;
    factors_.factorize(matrix_);
    if (factors_.info() != Eigen::Success)
      throw SolverError("the matrix of the finite elements could not be factorised.");
    const Matrix& L = factors_.matrixL().nestedExpression();
    const auto n_entries = static_cast<std::size_t>(L.nonZeros());
    if (!ordered_.supernodes)
      ordered_.supernodes =
          std::make_unique<const Supernodes>(std::span(L.outerIndexPtr(), static_cast<std::size_t>(L.outerSize()) + 1),
                                             std::span(L.innerIndexPtr(), n_entries));
    if (!L_) L_.emplace(*ordered_.supernodes);
    L_->set({L.valuePtr(), n_entries});
  }
  void solve(Vector& v) override {
    in_order_.resize(v.size() + 1);
    const std::span<double> with_one_more(in_order_.data(), static_cast<std::size_t>(in_order_.size()));
    auto in_order = in_order_.head(v.size());
    in_order = ordered_.order * v;
    L_->solve(with_one_more);
    in_order.array() /= factors_.vectorD().array();
    L_->solve_transposed(with_one_more);
    v = ordered_.order.inverse() * in_order;
  }

 private:
  static Eigen::Map<const Vector> values(const Matrix& matrix) { return {matrix.valuePtr(), matrix.nonZeros()}; }
  const OrderedMatrices& ordered_;
  Matrix matrix_;
  Eigen::SimplicialLDLT<Matrix, Eigen::Upper, Eigen::NaturalOrdering<int>> factors_;
  std::optional<SupernodalTriangle> L_;
  Vector in_order_;
};

}  // namespace

AssembledEquations::AssembledEquations(const HeatConductionProblem& problem, const AssembledHeat& assembled)
    : problem_(problem),
      assembled_(assembled),
      capacity_(matrix(assembled.capacity)),
      conductance_(matrix(assembled.conductance)),
      ambient_power_(std::accumulate(assembled.ambient_load.begin(), assembled.ambient_load.end(), 0.)),
      sources_(problem, assembled.flux_areas, assembled.port_areas) {}

AssembledEquations::~AssembledEquations() = default;

AssembledEquations::Rows AssembledEquations::matrix(const std::vector<double>& values) const {
  const auto n = static_cast<Eigen::Index>(assembled_.size());
  return {n,
          n,
          static_cast<Eigen::Index>(values.size()),
          assembled_.row_start.data(),
          assembled_.column.data(),
          values.data()};
}

Vector AssembledEquations::initial_temperature() const {
  return Vector::Constant(static_cast<Eigen::Index>(assembled_.size()), T_0());
}

void AssembledEquations::enthalpy_difference(const Vector& T, const Vector& T_before, Vector& out) const {
  out.noalias() = capacity_ * (T - T_before);
}

void AssembledEquations::heat_flow(const Vector& T, double t, Vector& out) const {
  out = list(assembled_.ambient_load);
  out.noalias() -= conductance_ * (T.array() - T_0()).matrix();
  for (std::size_t f = 0; f < assembled_.flux_loads.size(); ++f)
    if (sources_.flux(f) != 0.) out += sources_.flux(f) * list(assembled_.flux_loads[f]);
  for (std::size_t p = 0; p < assembled_.ports.size(); ++p) {
    if (sources_.is_silent(p)) continue;
    const auto& port = assembled_.ports[p];
    for (std::size_t i = 0; i < port.unknowns.size(); ++i)
      out[port.unknowns[i]] += sources_.watts(p, t) * port.weights[i];
  }
}

std::unique_ptr<HeatInverse> AssembledEquations::make_inverse() const {
  // Symmetric: rows are columns.
  if (!ordered_) ordered_ = std::make_unique<const OrderedMatrices>(capacity_, conductance_, assembled_.held);
  return std::make_unique<CholeskyInverse>(*ordered_);
}

double AssembledEquations::lost_power(const Vector& T) const {
  return list(assembled_.loss_weights).dot((T.array() - T_0()).matrix()) - ambient_power_;
}

double AssembledEquations::stored_energy(const Vector& T, const Vector& T_before) const {
  return list(assembled_.capacity_weights).dot(T - T_before);
}

std::string AssembledEquations::part_of(std::size_t unknown) const {
  const auto& body_of = assembled_.body_of;
  if (unknown >= body_of.size()) return "node \"" + problem_.nodes[unknown - body_of.size()].name + "\"";
  return "body \"" + problem_.bodies[body_of[unknown]].name + "\"";
}

std::string AssembledEquations::strongest_cooling(std::size_t unknown, double t) const {
  return sources_.strongest_cooling(
      t, [&](std::size_t f) { return assembled_.flux_loads[f][unknown] != 0.; },
      [&](std::size_t p) { return std::ranges::count(assembled_.ports[p].unknowns, unknown) > 0; });
}

}  // namespace rotordrop
