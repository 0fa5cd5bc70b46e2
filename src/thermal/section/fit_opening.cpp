#include "thermal/section/fit_opening.h"

#include <algorithm>

#include "base/errors.h"

namespace rotordrop {
namespace {

// Of forces, as parts of what adds up at a node, and of gaps, as parts of the largest.
constexpr double roundoff = 1e-11;

Eigen::MatrixXd matrix_of(const std::vector<std::vector<double>>& rows, std::size_t n_columns) {
  Eigen::MatrixXd m(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(n_columns));
  for (std::size_t i = 0; i < rows.size(); ++i)
    m.row(static_cast<Eigen::Index>(i)) =
        Eigen::Map<const Eigen::RowVectorXd>(rows[i].data(), static_cast<Eigen::Index>(n_columns));
  return m;
}

/// Of some nodes alone.
Eigen::MatrixXd part_of(const Eigen::MatrixXd& m, const std::vector<Eigen::Index>& nodes) {
  const auto n = static_cast<Eigen::Index>(nodes.size());
  return Eigen::MatrixXd::NullaryExpr(n, n, [&](Eigen::Index i, Eigen::Index j) {
    return m(nodes[static_cast<std::size_t>(i)], nodes[static_cast<std::size_t>(j)]);
  });
}
Eigen::VectorXd part_of(const Eigen::VectorXd& v, const std::vector<Eigen::Index>& nodes) {
  return Eigen::VectorXd::NullaryExpr(static_cast<Eigen::Index>(nodes.size()),
                                      [&](Eigen::Index i) { return v(nodes[static_cast<std::size_t>(i)]); });
}

}  // namespace

FitOpening::FitOpening(const FitOpenings& o)
    : stiffness_(matrix_of(o.force, o.share.size())),
      per_gap_(matrix_of(o.output, o.share.size())),
      mass_(matrix_of(o.mass, o.share.size())),
      share_(Eigen::Map<const Eigen::VectorXd>(o.share.data(), index(o.share.size()))),
      gap_(Eigen::VectorXd::Zero(share_.size())),
      force_(gap_),
      is_open_(o.share.size(), false) {}

std::vector<Eigen::Index> FitOpening::nodes_that(bool are_open) const {
  std::vector<Eigen::Index> nodes;
  for (std::size_t i = 0; i < is_open_.size(); ++i)
    if (is_open_[i] == are_open) nodes.push_back(index(i));
  return nodes;
}

void FitOpening::find_forces(const Eigen::VectorXd& closed) {
  const auto open = nodes_that(true);
  gap_.setZero();
  if (!open.empty()) {
    const Eigen::VectorXd gap = part_of(stiffness_, open).ldlt().solve(-part_of(closed, open));
    for (std::size_t i = 0; i < open.size(); ++i) gap_(open[i]) = gap(index(i));
  }
  force_ = closed + stiffness_ * gap_;
  for (const Eigen::Index i : open) force_(i) = 0.;
}

bool FitOpening::put_right(bool only_first) {
  const Eigen::VectorXd added = (stiffness_.cwiseAbs() * gap_.cwiseAbs()) + force_.cwiseAbs();
  const double force_slack = roundoff * std::max(added.maxCoeff(), force_size_),
               gap_slack = roundoff * gap_.cwiseAbs().maxCoeff();
  bool has_changed = false;
  for (std::size_t i = 0; i < is_open_.size(); ++i) {
    const bool is_wrong = is_open_[i] ? gap_(index(i)) < -gap_slack : force_(index(i)) < -force_slack;
    if (!is_wrong) continue;
    is_open_[i] = !is_open_[i];
    has_changed = true;
    if (only_first) break;
  }
  return has_changed;
}

void FitOpening::solve(std::span<const double> pressures, std::span<const double> sizes) {
  const Eigen::VectorXd closed =
      Eigen::Map<const Eigen::VectorXd>(pressures.data(), share_.size()).cwiseProduct(share_);
  force_size_ = Eigen::Map<const Eigen::VectorXd>(sizes.data(), share_.size()).cwiseProduct(share_).maxCoeff();
  std::fill(is_open_.begin(), is_open_.end(), false);
  // All at once is quick but may go round in circles; the first one alone never does (Murty 1974), and may take long.
  constexpr int patient = 15;
  const auto most = patient + 100 * static_cast<int>(is_open_.size());
  for (int i = 0; i < most; ++i) {
    find_forces(closed);
    if (!put_right(i >= patient)) return;
  }
  throw SolverError("no state of the fit is found in which no node pulls and none overlaps.");
}

FitState FitOpening::state() const {
  FitState s;
  s.area = share_.sum();
  s.mean_pressure = force_.sum() / s.area;
  s.open_fraction = part_of(share_, nodes_that(true)).sum() / s.area;
  const auto closed = nodes_that(false);
  if (closed.empty()) return s;
  const Eigen::VectorXd pressure = part_of(mass_, closed).ldlt().solve(part_of(force_, closed));
  s.lowest_pressure = pressure.minCoeff();
  s.highest_pressure = pressure.maxCoeff();
  return s;
}

}  // namespace rotordrop
