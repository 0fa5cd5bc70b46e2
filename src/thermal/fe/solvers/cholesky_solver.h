#pragma once
#include <memory>

#include "thermal/fe/solvers/linear_solver.h"

namespace rotordrop {

/// L D L^T factors of symmetric positive definite matrices (CHOLMOD): the order of elimination is found once. Sections of a few thousand
/// unknowns are too small for its dense blocks, so it works column by column: a quarter of the time of LU, docs/how-to/heat.md.
class CholeskySolver final : public LinearSolver {
 public:
  CholeskySolver();
  ~CholeskySolver() override;
  void set_matrix(const Matrix& matrix) override;
  void solve(Vector& v) override;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace rotordrop
