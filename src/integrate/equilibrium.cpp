#include "integrate/equilibrium.h"

#include <kinsol/kinsol.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <optional>
#include <vector>

#include "base/errors.h"
#include "integrate/sundials_memory.h"

namespace rotordrop {
namespace {

// Everything is solved in unknowns u = x / scale and energies g_i = scale_i f_i, divided by force_scale times the first scale, a length:
// numbers near one, whatever the mixture of lengths and angles.
class Scaled {
 public:
  explicit Scaled(EquilibriumSystem& system)
      : system_(system), n_(system.size()), scales_(system.scales().begin(), system.scales().end()), x_(n_) {
    energy_ = system.force_scale() * scales_.front();
  }
  [[nodiscard]] std::size_t size() const { return n_; }
  [[nodiscard]] Eigen::VectorXd unknowns(std::span<const double> x) const {
    Eigen::VectorXd u(static_cast<Eigen::Index>(n_));
    for (std::size_t i = 0; i < n_; ++i) u[static_cast<Eigen::Index>(i)] = x[i] / scales_[i];
    return u;
  }
  void places(const double* u, std::span<double> x) const {
    for (std::size_t i = 0; i < n_; ++i) x[i] = u[i] * scales_[i];
  }
  void forces(const double* u, double* g) {
    places(u, x_);
    system_.forces(x_, {g, n_});
    for (std::size_t i = 0; i < n_; ++i) g[i] *= scales_[i] / energy_;
  }
  /// Stiffness, column by column.
  void stiffness(const double* u, double* K) {
    places(u, x_);
    system_.stiffness(x_, {K, n_ * n_});
    for (std::size_t column = 0; column < n_; ++column)
      for (std::size_t row = 0; row < n_; ++row) K[column * n_ + row] *= scales_[row] * scales_[column] / energy_;
  }
  [[nodiscard]] double potential(const double* u) {
    places(u, x_);
    return system_.potential(x_) / energy_;
  }
  [[nodiscard]] Eigen::VectorXd forces(const Eigen::VectorXd& u) {
    Eigen::VectorXd g(u.size());
    forces(u.data(), g.data());
    return g;
  }
  [[nodiscard]] double residual(const Eigen::VectorXd& u) {
    const double r = forces(u).lpNorm<Eigen::Infinity>();
    return std::isfinite(r) ? r : HUGE_VAL;
  }

 private:
  EquilibriumSystem& system_;
  std::size_t n_;
  std::vector<double> scales_, x_;
  double energy_ = 1.;
};

struct KinsolDeleter {
  void operator()(void* memory) const { KINFree(&memory); }
};

/// KINSOL for one system.
class Kinsol {
 public:
  Kinsol(Scaled& scaled, const EquilibriumOptions& options) : scaled_(scaled), context_(new_sundials_context()) {
    const auto n = static_cast<sunindextype>(scaled.size());
    bool good = context_ != nullptr;
    if (good) {
      u_.reset(N_VNew_Serial(n, context_.get()));
      ones_.reset(N_VNew_Serial(n, context_.get()));
      matrix_.reset(SUNDenseMatrix(n, n, context_.get()));
      solver_.reset(SUNLinSol_Dense(u_.get(), matrix_.get(), context_.get()));
      memory_.reset(KINCreate(context_.get()));
      N_VConst(1., ones_.get());
    }
    void* memory = memory_.get();
    const auto check = [&](int code) { good = good && code == 0; };
    check(KINInit(memory, residual, u_.get()));
    check(KINSetUserData(memory, this));
    check(KINSetErrHandlerFn(
        memory, [](int, const char*, const char*, char*, void*) {}, nullptr));
    check(KINSetLinearSolver(memory, solver_.get(), matrix_.get()));
    check(KINSetJacFn(memory, jacobian));
    check(KINSetMaxSetupCalls(memory, 1));
    check(KINSetFuncNormTol(memory, options.tolerance));
    check(KINSetScaledStepTol(memory, 1e-14));
    check(KINSetMaxNewtonStep(memory, 1e4));
    check(KINSetNumMaxIters(memory, options.max_newton_steps));
    if (!good) throw SolverError("KINSOL could not be set up");
  }
  Kinsol(const Kinsol&) = delete;
  Kinsol& operator=(const Kinsol&) = delete;
  /// @return steps taken; u is left at the better of start and end
  long solve(Eigen::VectorXd& u) {
    const double before = scaled_.residual(u);
    std::copy(u.data(), u.data() + u.size(), NV_DATA_S(u_.get()));
    KINSol(memory_.get(), u_.get(), KIN_LINESEARCH, ones_.get(), ones_.get());
    if (exception_) std::rethrow_exception(exception_);
    const Eigen::VectorXd end = Eigen::Map<Eigen::VectorXd>(NV_DATA_S(u_.get()), u.size());
    if (scaled_.residual(end) < before) u = end;
    long steps = 0;
    KINGetNumNonlinSolvIters(memory_.get(), &steps);
    return steps;
  }

 private:
  static int residual(N_Vector u, N_Vector g, void* self) {
    auto& s = *static_cast<Kinsol*>(self);
    try {
      s.scaled_.forces(NV_DATA_S(u), NV_DATA_S(g));
    } catch (...) {
      s.exception_ = std::current_exception();
      return -1;
    }
    for (sunindextype i = 0; i < NV_LENGTH_S(g); ++i)
      if (!std::isfinite(NV_DATA_S(g)[i])) return 1;
    return 0;
  }
  static int jacobian(N_Vector u, N_Vector, SUNMatrix J, void* self, N_Vector, N_Vector) {
    auto& s = *static_cast<Kinsol*>(self);
    const auto n = static_cast<sunindextype>(s.scaled_.size());
    double* data = SUNDenseMatrix_Data(J);
    s.scaled_.stiffness(NV_DATA_S(u), data);
    double largest = 0.;
    for (sunindextype i = 0; i < n; ++i) largest = std::max(largest, std::fabs(data[i * n + i]));
    for (sunindextype k = 0; k < n * n; ++k) data[k] = -data[k];
    // Directions without stiffness must not make the matrix singular; where there is stiffness this changes nothing.
    for (sunindextype i = 0; i < n; ++i) data[i * n + i] -= 1e-12 * largest;
    return 0;
  }

  Scaled& scaled_;
  OwnedContext context_;
  OwnedVector u_, ones_;
  OwnedMatrix matrix_;
  OwnedLinearSolver solver_;
  std::unique_ptr<void, KinsolDeleter> memory_;
  std::exception_ptr exception_;
};

/// Newton steps, damped until they lead downhill (Levenberg). In a convex potential this arrives from anywhere.
long descend(Scaled& scaled, Eigen::VectorXd& u, const EquilibriumOptions& options) {
  const auto n = u.size();
  Eigen::MatrixXd K(n, n);
  Eigen::VectorXd g = scaled.forces(u);
  double V = scaled.potential(u.data()), damping = 1.;
  long step = 0;
  for (; step < options.max_descent_steps && g.lpNorm<Eigen::Infinity>() > options.tolerance; ++step) {
    scaled.stiffness(u.data(), K.data());
    bool moved = false;
    for (int trial = 0; trial < 60 && !moved; ++trial) {
      const Eigen::MatrixXd damped = K + damping * Eigen::MatrixXd::Identity(n, n);
      const Eigen::VectorXd next = u + damped.ldlt().solve(g);
      const double V_next = scaled.potential(next.data());
      const Eigen::VectorXd g_next = scaled.forces(next);
      // Where the potential no longer resolves the step, the forces do.
      const bool is_level = std::fabs(V_next - V) <= 1e-13 * (std::fabs(V) + std::fabs(V_next));
      moved = is_level ? g_next.norm() < g.norm() : V_next < V;
      damping *= moved ? 0.2 : 5.;
      if (!moved) continue;
      u = next;
      V = V_next;
      g = g_next;
    }
    if (!moved) break;
  }
  return step;
}

class Search {
 public:
  Search(EquilibriumSystem& system, const EquilibriumOptions& options)
      : system_(system), options_(options), scaled_(system) {}

  bool newton(Eigen::VectorXd& u) {
    if (scaled_.residual(u) > options_.tolerance) {
      if (!kinsol_) kinsol_.emplace(scaled_, options_);
      result_.newton_steps += kinsol_->solve(u);
    }
    return scaled_.residual(u) <= options_.accepted;
  }
  bool in_potential(Eigen::VectorXd& u) {
    Eigen::VectorXd trial = u;
    if (newton(trial)) {
      u = trial;
      return true;
    }
    result_.descent_steps += descend(scaled_, u, options_);
    return newton(u);
  }
  bool with_circulatory_forces(Eigen::VectorXd& u) {
    system_.set_circulatory_share(1.);
    Eigen::VectorXd trial = u;
    if (newton(trial)) {
      u = trial;
      return true;
    }
    system_.set_circulatory_share(0.);
    bool good = in_potential(u);
    double share = 0., increment = 1.;
    while (good && share < 1.) {
      const double next = std::min(share + increment, 1.);
      system_.set_circulatory_share(next);
      trial = u;
      ++result_.continuation_steps;
      if (newton(trial)) {
        u = trial;
        share = next;
        increment *= 2.;
      } else {
        increment *= 0.5;
        good = increment > 1e-4;
      }
    }
    system_.set_circulatory_share(1.);
    return good;
  }
  EquilibriumResult run(std::span<double> x) {
    Eigen::VectorXd u = scaled_.unknowns(x);
    system_.has_circulatory_forces() ? with_circulatory_forces(u) : in_potential(u);
    scaled_.places(u.data(), x);
    result_.residual = scaled_.residual(u);
    result_.found = result_.residual <= options_.accepted;
    return result_;
  }

 private:
  EquilibriumSystem& system_;
  EquilibriumOptions options_;
  Scaled scaled_;
  std::optional<Kinsol> kinsol_;  // made when it is needed
  EquilibriumResult result_;
};

}  // namespace

EquilibriumResult find_equilibrium(EquilibriumSystem& system, std::span<double> x, const EquilibriumOptions& options) {
  return Search(system, options).run(x);
}

}  // namespace rotordrop
