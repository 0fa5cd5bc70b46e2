#include "thermal/fe/operator_equations.h"

#include <algorithm>

#include "thermal/fe/solvers/linear_solver.h"

namespace rotordrop {
namespace {

class OperatorInverse final : public HeatInverse {
 public:
  OperatorInverse(const HeatOperator& problem, HeatLinearSolver solver)
      : operator_(problem), solver_(solver), matrix_(problem.pattern()) {}

  void set_matrix(const Eigen::VectorXd& T, double scaled_step, HeatMatrix kind) override {
    const bool is_symmetric = kind == HeatMatrix::symmetric || operator_.is_symmetric();
    auto& factors = is_symmetric ? symmetric_ : exact_;
    if (!factors) factors = make_linear_solver(solver_, is_symmetric);
    copy_to(T, vector_);
    operator_.jacobian(vector_, scaled_step, kind, matrix_);
    factors->set_matrix(matrix_);
    last_ = factors.get();
  }
  void solve(Eigen::VectorXd& v) override {
    copy_to(v, vector_);
    last_->solve(vector_);
    copy_to(vector_, v);
  }

 private:
  const HeatOperator& operator_;
  const HeatLinearSolver solver_;
  HeatOperator::Matrix matrix_;
  std::unique_ptr<LinearSolver> symmetric_, exact_;
  LinearSolver* last_ = nullptr;  ///< of them, that has the matrix
  HeatOperator::Vector vector_;
};

}  // namespace

void copy_to(const Eigen::VectorXd& from, dealii::Vector<double>& to) {
  if (to.size() != static_cast<std::size_t>(from.size()))
    to.reinit(static_cast<unsigned int>(from.size()), /*omit_zeroing_entries=*/true);
  std::copy(from.begin(), from.end(), to.begin());
}

void copy_to(const dealii::Vector<double>& from, Eigen::VectorXd& to) {
  to.resize(static_cast<Eigen::Index>(from.size()));
  std::copy(from.begin(), from.end(), to.begin());
}

OperatorEquations::Vector OperatorEquations::initial_temperature() const {
  operator_.initial_temperature(T_);
  Vector T;
  copy_to(T_, T);
  return T;
}

void OperatorEquations::enthalpy_difference(const Vector& T, const Vector& T_before, Vector& out) const {
  copy_to(T, T_);
  copy_to(T_before, T_before_);
  out_.reinit(T_, /*omit_zeroing_entries=*/true);
  operator_.enthalpy_difference(T_, T_before_, out_);
  copy_to(out_, out);
}

void OperatorEquations::heat_flow(const Vector& T, double t, Vector& out) const {
  copy_to(T, T_);
  out_.reinit(T_, /*omit_zeroing_entries=*/true);
  operator_.heat_flow(T_, t, out_);
  copy_to(out_, out);
}

std::unique_ptr<HeatInverse> OperatorEquations::make_inverse() const {
  return std::make_unique<OperatorInverse>(operator_, solver_);
}

double OperatorEquations::lost_power(const Vector& T) const {
  copy_to(T, T_);
  return operator_.lost_power(T_);
}

double OperatorEquations::stored_energy(const Vector& T, const Vector& T_before) const {
  copy_to(T, T_);
  copy_to(T_before, T_before_);
  return operator_.stored_energy(T_, T_before_);
}

}  // namespace rotordrop
