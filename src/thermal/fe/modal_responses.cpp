#include "thermal/fe/modal_responses.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rotordrop {
namespace {

/// Of a joule's largest mean rise; less than that is left of it later.
constexpr double gone = 1e-4;

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int times_per_decade = 12, snapshots_per_decade = 5;
constexpr double first_modes_per_decade = 3.;  // the rest is chosen by the errors
constexpr double means_weight = 3.;            // of a mean's responses among the snapshots, by trial
constexpr double dependent = 1e-7;             // what is left of a vector that the others span

/// 1/s from `low` to `high`, evenly by their logarithms.
std::vector<double> spread(double low, double high, int per_decade) {
  const int n = 1 + std::max(1, static_cast<int>(std::ceil(per_decade * std::log10(high / low))));
  std::vector<double> values;
  for (int k = 0; k < n; ++k) values.push_back(low * std::pow(high / low, static_cast<double>(k) / (n - 1)));
  return values;
}

VectorXd answer(const ModalHeat& heat, const VectorXd& load, double s) {
  return load.array() / (heat.rate.array() + s);
}

/// Orthonormal columns.
class Columns {
 public:
  explicit Columns(Index n) : Q_(n, 0) {}
  [[nodiscard]] Index size() const { return Q_.cols(); }
  [[nodiscard]] const MatrixXd& matrix() const { return Q_; }
  [[nodiscard]] VectorXd beside(const VectorXd& v) const { return v - Q_ * (Q_.transpose() * v); }
  bool add(VectorXd v) {
    const double before = v.norm();
    for (int pass = 0; pass < 2; ++pass) v = beside(v);
    if (!(v.norm() > dependent * before)) return false;
    Q_.conservativeResize(Eigen::NoChange, Q_.cols() + 1);
    Q_.rightCols(1) = v.normalized();
    return true;
  }

 private:
  MatrixXd Q_;
};

/// Answers of ports and means, each over its own size, as columns; their strongest directions first.
MatrixXd strongest_directions(const ModalResponses& responses, const ReductionSettings& settings) {
  const ModalHeat& heat = responses.reference();
  std::vector<VectorXd> snapshots;
  const auto add = [&](const VectorXd& load, double from, double weight) {
    for (const double s : spread(0.3 / settings.longest_time, 2. / from, snapshots_per_decade)) {
      const VectorXd v = answer(heat, load, s);
      snapshots.emplace_back(weight * std::sqrt(s / load.dot(v)) * v);
    }
  };
  for (Index p = 0; p < heat.in.cols(); ++p) add(heat.in.col(p), responses.from()[static_cast<std::size_t>(p)], 1.);
  for (Index k = 0; k < heat.out.cols(); ++k) add(heat.out.col(k), 20. * settings.shortest_time, means_weight);
  MatrixXd all(heat.rate.size(), static_cast<Index>(snapshots.size()));
  for (std::size_t i = 0; i < snapshots.size(); ++i) all.col(static_cast<Index>(i)) = snapshots[i];
  return Eigen::BDCSVD<MatrixXd>(all, Eigen::ComputeThinU).matrixU();
}

/// Of the answers that matter where the error is largest, the one that the columns span worst.
bool add_worst(const ModalResponses& responses, const ResponseErrors& errors, Columns& columns) {
  const ModalHeat& heat = responses.reference();
  double worst = 0.;
  VectorXd candidate;
  const auto look_at = [&](const VectorXd& load) {
    for (const double factor : {0.3, 0.55, 1., 1.8, 3.}) {
      const double s = factor / errors.time;
      const VectorXd v = answer(heat, load, s);
      const Eigen::ArrayXd scale = (heat.rate.array() + s).sqrt();
      const double left = (columns.beside(v).array() * scale).matrix().norm() / (v.array() * scale).matrix().norm();
      if (left <= worst) continue;
      worst = left;
      candidate = v;
    }
  };
  look_at(heat.in.col(static_cast<Index>(errors.port)));
  if (errors.is_mean) look_at(heat.out.col(static_cast<Index>(errors.mean)));
  return worst > 0. && columns.add(candidate);
}

}  // namespace

EigenModes modes_of_factor(const MatrixXd& B) {
  const Eigen::BDCSVD<MatrixXd> svd(B, Eigen::ComputeThinV);
  return {svd.singularValues().reverse().cwiseAbs2(), svd.matrixV().rowwise().reverse()};
}

EigenModes modes_of(const MatrixXd& K) {
  const Eigen::LLT<MatrixXd, Eigen::Upper> factor(K);
  if (factor.info() == Eigen::Success) return modes_of_factor(factor.matrixU());
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(K);
  return {eigen.eigenvalues().cwiseMax(0.), eigen.eigenvectors()};
}

ModalHeat ModalHeat::projected(const MatrixXd& columns, MatrixXd& modes) const {
  const EigenModes own = modes_of_factor(rate.cwiseSqrt().asDiagonal() * columns);
  modes = columns * own.vectors;
  return {own.rate, modes.transpose() * in, modes.transpose() * out, VectorXd::Zero(in.cols())};
}

ModalHeat ModalHeat::truncated(Index n, const ModalHeat& reference, double s) const {
  ModalHeat few{rate.head(n), in.topRows(n), out.topRows(n), VectorXd::Zero(in.cols())};
  const auto own = [s](const ModalHeat& heat, Index p) { return heat.in.col(p).dot(answer(heat, heat.in.col(p), s)); };
  for (Index p = 0; p < in.cols(); ++p) few.at_once(p) = own(reference, p) - own(few, p);
  return few;
}

ModalResponses::ModalResponses(ModalHeat reference, const ReductionSettings& settings, PortTimes from)
    : reference_(std::move(reference)),
      from_(std::move(from)),
      times_(spread(settings.shortest_time, settings.longest_time, times_per_decade)),
      means_from_(10. * settings.shortest_time),
      tables_(tables_of(reference_)) {}

ModalResponses::Tables ModalResponses::tables_of(const ModalHeat& heat) const {
  Tables tables;
  tables.ports.resize(static_cast<Index>(times_.size()), heat.in.cols());
  for (std::size_t i = 0; i < times_.size(); ++i) {
    const double t = times_[i];
    const VectorXd decay = (-t * heat.rate.array()).exp();
    VectorXd integral = decay;  // of the decay, from 0 to t
    for (Index k = 0; k < integral.size(); ++k) {
      const double x = t * heat.rate(k);
      integral(k) = x < 1e-8 ? t * (1. - 0.5 * x) : -std::expm1(-x) / heat.rate(k);
    }
    tables.step.emplace_back(heat.out.transpose() * integral.asDiagonal() * heat.in);
    tables.joule.emplace_back(heat.out.transpose() * decay.asDiagonal() * heat.in);
    for (Index p = 0; p < heat.in.cols(); ++p)
      tables.ports(static_cast<Index>(i), p) = heat.in.col(p).cwiseAbs2().dot(integral) + heat.at_once(p);
  }
  return tables;
}

ResponseErrors ModalResponses::errors_of(const ModalHeat& few) const {
  const Tables own = tables_of(few);
  ResponseErrors e{VectorXd::Zero(few.in.cols()), VectorXd::Zero(few.out.cols())};
  const auto note = [&e](double error, std::size_t port, std::size_t mean, bool is_mean, double time) {
    auto& total = is_mean ? e.means(static_cast<Index>(mean)) : e.ports(static_cast<Index>(port));
    total = std::max(total, error);
    if (error <= e.largest) return;
    e.largest = error;
    e.port = port;
    e.mean = mean;
    e.is_mean = is_mean;
    e.time = time;
  };
  for (std::size_t i = 0; i < times_.size(); ++i) {
    const auto row = static_cast<Index>(i);
    for (std::size_t p = 0; p < from_.size(); ++p) {
      const auto column = static_cast<Index>(p);
      const double t = times_[i] * (1. + 1e-9);
      if (t >= from_[p])
        note(std::fabs(own.ports(row, column) / tables_.ports(row, column) - 1.), p, 0, false, times_[i]);
      if (t < std::max(from_[p], means_from_)) continue;
      for (const auto& [mine, theirs] : {std::pair{&own.step, &tables_.step}, std::pair{&own.joule, &tables_.joule}}) {
        const VectorXd exact = (*theirs)[i].col(column), error = (*mine)[i].col(column) - exact;
        // A joule that has long left for the surroundings has no error: exponentials of many time constants.
        const double first = (*theirs)[0].col(column).cwiseAbs().maxCoeff();
        const double largest = exact.cwiseAbs().maxCoeff();
        const double least = mean_floor * (theirs == &tables_.joule ? std::max(largest, gone * first) : largest);
        for (Index k = 0; k < exact.size(); ++k)
          note(std::fabs(error(k)) / (std::fabs(exact(k)) + least), p, static_cast<std::size_t>(k), true, times_[i]);
      }
    }
  }
  return e;
}

FewModes choose_modes(const ModalResponses& responses, const MatrixXd& uniform, const ReductionSettings& settings) {
  const ModalHeat& reference = responses.reference();
  const auto most = std::min(static_cast<Index>(settings.modes), reference.rate.size());
  Columns columns(reference.rate.size());
  for (Index i = 0; i < uniform.cols(); ++i) columns.add(uniform.col(i));
  const Index n_uniform = columns.size();
  const MatrixXd directions = strongest_directions(responses, settings);
  Index next = 0;
  const auto add_strongest = [&] {
    while (next < directions.cols())
      if (columns.add(directions.col(next++))) return true;
    return false;
  };
  const auto first =
      n_uniform + static_cast<Index>(
                      std::lround(first_modes_per_decade * std::log10(settings.longest_time / settings.shortest_time)));
  while (columns.size() < std::min(first, most) && add_strongest()) {
  }
  FewModes best;
  for (;;) {
    FewModes few;
    const ModalHeat all = reference.projected(columns.matrix(), few.modes);
    Index n = all.rate.size();
    while (n > n_uniform && all.rate(n - 1) > settings.fastest) --n;
    few.heat = all.truncated(n, reference, shift_of_residue);
    few.modes = MatrixXd(few.modes.leftCols(n));
    few.errors = responses.errors_of(few.heat);
    const ResponseErrors errors = few.errors;
    if (best.modes.cols() == 0 || errors.largest < best.errors.largest) best = std::move(few);
    if (errors.largest <= settings.response_tolerance || columns.size() >= most) return best;
    if (!add_worst(responses, errors, columns) && !add_strongest()) return best;
  }
}

}  // namespace rotordrop
