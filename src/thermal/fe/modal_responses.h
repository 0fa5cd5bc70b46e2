#pragma once
#include <Eigen/Dense>
#include <string>
#include <vector>

#include "model/reduced_heat.h"

namespace rotordrop {

/// Orthonormal eigenvectors of a symmetric matrix, slow ones first.
struct EigenModes {
  Eigen::VectorXd rate;     ///< eigenvalues, none below zero
  Eigen::MatrixXd vectors;  ///< as columns
};
/// Those of B^T B, by the singular values of B: the slowest rate errs by a part of roundoff times the root of fastest over slowest. By eigenvalues of
/// the product it would be fastest over slowest itself, 1e-7 where rates span nine decades, and energy would close no better.
/// @param B [at least as many rows as columns]
EigenModes modes_of_factor(const Eigen::MatrixXd& B);
/// Those of a conductance K, by its factor if it has one; where nothing conducts to ambient it has none.
EigenModes modes_of(const Eigen::MatrixXd& K);

/// A linear heat problem in its own modes, orthonormal by capacity: dz_i/dt = - rate_i z_i + sum_p in(i, p) q_p; a mean is sum_i out(i, k) z_i.
struct ModalHeat {
  Eigen::VectorXd rate;     ///< [1/s] [n]
  Eigen::MatrixXd in, out;  ///< [n][n_ports], [n][n_means]
  Eigen::VectorXd at_once;  ///< what is added to a port's own rise [K/W] [n_ports]
  /// Projection on the span of some orthonormal columns, again in its own modes.
  /// @param modes  set to these modes in the coordinates of this problem [n][n_columns]
  [[nodiscard]] ModalHeat projected(const Eigen::MatrixXd& columns, Eigen::MatrixXd& modes) const;
  /// The first n modes, and at_once so that every port's own response to exp(s t) stays what it was.
  [[nodiscard]] ModalHeat truncated(Eigen::Index n, const ModalHeat& reference, double s) const;
};

/// Times from which a port's heat is looked at [s] [n_ports]: its own, or the settings' shortest.
using PortTimes = std::vector<double>;

/// How far a problem on few modes is off, over the settings' times.
///   ports: rise of a port over the rise itself, under a step of heat into it.
///   means: rise of a mean under a step of heat, or a joule at once, into any port, over that rise plus a thousandth of the largest mean rise
///          at that time. What holds for a joule at once holds for every heat that is never negative: its rises are sums of these.
/// Means follow heat slowly; they are looked at from ten times the shortest time.
struct ResponseErrors {
  Eigen::VectorXd ports, means;
  double largest = 0;
  // Where it is largest.
  std::size_t port = 0, mean = 0;
  bool is_mean = false;
  double time = 0;  ///< [s]
};

/// The responses of a detailed problem, against which others are held.
class ModalResponses {
 public:
  ModalResponses(ModalHeat reference, const ReductionSettings& settings, PortTimes from);
  [[nodiscard]] ResponseErrors errors_of(const ModalHeat& few) const;
  [[nodiscard]] const ModalHeat& reference() const { return reference_; }
  [[nodiscard]] const PortTimes& from() const { return from_; }

 private:
  struct Tables {
    std::vector<Eigen::MatrixXd> step, joule;  ///< of each time [n_means][n_ports]
    Eigen::MatrixXd ports;                     ///< [n_times][n_ports]
  };
  [[nodiscard]] Tables tables_of(const ModalHeat& heat) const;

  ModalHeat reference_;
  PortTimes from_;
  std::vector<double> times_;
  double means_from_;
  Tables tables_;
};

/// Few modes whose errors are below the tolerance, or as many as are allowed: the uniform temperatures, the strongest directions of the ports' and means'
/// responses, each over its own size at its time, and then one by one the response that is worst.
struct FewModes {
  ModalHeat heat;
  Eigen::MatrixXd modes;  ///< in the coordinates of the reference [n][n_modes]
  ResponseErrors errors;
};
/// @param uniform  temperatures that must be among what the modes span, as columns
FewModes choose_modes(const ModalResponses& responses, const Eigen::MatrixXd& uniform,
                      const ReductionSettings& settings);

/// [1/s] Where what few modes leave of a port's response is added to it: modes left out for their speed are far faster.
inline constexpr double shift_of_residue = 1e3;
/// Share of the largest mean rise below which a mean's error is no longer judged by its own rise.
inline constexpr double mean_floor = 1e-3;

}  // namespace rotordrop
