#pragma once
#include <Eigen/Dense>
#include <functional>
#include <vector>

namespace rotordrop {

struct LeastSquaresSettings {
  int evaluations = 200;     ///< at most
  double difference = 1e-3;  ///< of derivatives, in the unit cube
  double tolerance = 1e-5;   ///< of steps, in the unit cube
};

/// Residuals at several places at once, in their order; empty: it failed there.
using ResidualsAt = std::function<std::vector<Eigen::VectorXd>(const std::vector<std::vector<double>>& places)>;

/// The place in the unit cube with the smallest sum of squares near a start, by Levenberg & Marquardt's method with derivatives by differences.
/// Each step is tried with three dampings at once; parameters at a face of the cube that want beyond it are held there.
std::vector<double> least_squares(const LeastSquaresSettings& settings, std::vector<double> start,
                                  const ResidualsAt& residuals_at);

/// Places for central differences about a place: two for each parameter. Near a face the step is inside.
std::vector<std::vector<double>> difference_places(const std::vector<double>& at, double difference);
/// Derivatives from the residuals at these places [residuals, parameters]. Empty if one of them failed.
Eigen::MatrixXd derivatives(const std::vector<std::vector<double>>& places,
                            const std::vector<Eigen::VectorXd>& residuals);

}  // namespace rotordrop
