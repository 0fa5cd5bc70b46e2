#pragma once
#include <memory>
#include <vector>

#include "thermal/fe/solvers/linear_solver.h"
#include "thermal/fe/solvers/sorted_rows.h"

namespace rotordrop {

/// LU factors (UMFPACK): the order of elimination is found once.
class LuSolver final : public LinearSolver {
 public:
  void set_matrix(const Matrix& matrix) override;
  void solve(Vector& v) override;

 private:
  SortedRows rows_;
  std::vector<double> solution_;
  std::shared_ptr<void> symbolic_, numeric_;
};

}  // namespace rotordrop
