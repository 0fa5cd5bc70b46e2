#include "conduction/assembled_equations.h"

#include <Eigen/SparseCholesky>

#include <numeric>

#include "base/errors.h"

namespace rotordrop {
namespace {

using Vector = Eigen::VectorXd;

/// L D L^T factors, column by column. The order of elimination is found once.
class CholeskyInverse final : public HeatInverse {
 public:
  using Matrix = Eigen::SparseMatrix<double>;
  CholeskyInverse(const Matrix& capacity, const Matrix& conductance, const std::vector<HeldUnknowns>& held)
      : capacity_(capacity), conductance_(conductance), matrix_(capacity) {
    std::vector<bool> is_held(static_cast<std::size_t>(capacity.rows()));
    for (const auto& part : held)
      for (const auto i : part.unknowns) is_held[i] = true;
    for (int column = 0; column < capacity.outerSize(); ++column)
      for (int k = capacity.outerIndexPtr()[column]; k < capacity.outerIndexPtr()[column + 1]; ++k) {
        const int row = capacity.innerIndexPtr()[k];
        if (row != column && (is_held[static_cast<std::size_t>(row)] || is_held[static_cast<std::size_t>(column)]))
          left_out_.push_back(k);
      }
    factors_.analyzePattern(matrix_);
  }

  void set_matrix(const Vector&, double scaled_step) override {
    values(matrix_) = values(capacity_) + scaled_step * values(conductance_);  // of one pattern
    for (const int k : left_out_) matrix_.valuePtr()[k] = 0.;
    factors_.factorize(matrix_);
    if (factors_.info() != Eigen::Success)
      throw SolverError("the matrix of the finite elements could not be factorised.");
  }
  void solve(Vector& v) override { v = factors_.solve(v).eval(); }

 private:
  static Eigen::Map<Vector> values(Matrix& matrix) { return {matrix.valuePtr(), matrix.nonZeros()}; }
  Matrix capacity_, conductance_, matrix_;
  std::vector<int> left_out_;  ///< entries in rows and columns of held unknowns
  Eigen::SimplicialLDLT<Matrix> factors_;
};

}  // namespace

AssembledEquations::AssembledEquations(const HeatConductionProblem& problem, const AssembledHeat& assembled)
    : problem_(problem),
      assembled_(assembled),
      capacity_(matrix(assembled.capacity)),
      conductance_(matrix(assembled.conductance)),
      ambient_power_(std::accumulate(assembled.ambient_load.begin(), assembled.ambient_load.end(), 0.)),
      sources_(problem, assembled.flux_areas, assembled.port_areas) {}

AssembledEquations::Matrix AssembledEquations::matrix(const std::vector<double>& values) const {
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
  for (std::size_t p = 0; p < assembled_.port_loads.size(); ++p)
    if (!sources_.is_silent(p)) out += sources_.watts(p, t) * list(assembled_.port_loads[p]);
}

std::unique_ptr<HeatInverse> AssembledEquations::make_inverse() const {
  // Symmetric: rows are columns.
  return std::make_unique<CholeskyInverse>(CholeskyInverse::Matrix(capacity_), CholeskyInverse::Matrix(conductance_),
                                           assembled_.held);
}

double AssembledEquations::lost_power(const Vector& T) const {
  return list(assembled_.loss_weights).dot((T.array() - T_0()).matrix()) - ambient_power_;
}

double AssembledEquations::stored_energy(const Vector& T) const {
  return list(assembled_.capacity_weights).dot((T.array() - T_0()).matrix());
}

std::string AssembledEquations::part_of(std::size_t unknown) const {
  const auto& body_of = assembled_.body_of;
  if (unknown >= body_of.size()) return "node \"" + problem_.nodes[unknown - body_of.size()].name + "\"";
  return "body \"" + problem_.bodies[body_of[unknown]].name + "\"";
}

std::string AssembledEquations::strongest_cooling(std::size_t unknown, double t) const {
  return sources_.strongest_cooling(
      t, [&](std::size_t f) { return assembled_.flux_loads[f][unknown] != 0.; },
      [&](std::size_t p) { return assembled_.port_loads[p][unknown] != 0.; });
}

}  // namespace rotordrop
