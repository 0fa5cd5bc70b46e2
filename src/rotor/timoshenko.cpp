#include "rotor/timoshenko.h"

#include <array>
#include <cmath>
#include <numbers>

namespace rotordrop {

double cowper_shear_coefficient(double nu, double bore_ratio) {
  const double m2 = bore_ratio * bore_ratio;
  const double s = (1 + m2) * (1 + m2);
  return 6 * (1 + nu) * s / ((7 + 6 * nu) * s + (20 + 12 * nu) * m2);
}

ElementMatrices timoshenko_element(double length, double od, double id, const RotorMaterial& material) {
  const double L = length;
  const double A = std::numbers::pi / 4 * (od * od - id * id);
  const double I = std::numbers::pi / 64 * (std::pow(od, 4) - std::pow(id, 4));
  const double EI = material.E * I;
  const double kappa_G_A = cowper_shear_coefficient(material.nu, id / od) * material.E / (2 * (1 + material.nu)) * A;
  const double Phi = 12 * EI / (kappa_G_A * L * L);

  ElementMatrices result;
  result.stiffness << 12, 6 * L, -12, 6 * L,                //
      6 * L, (4 + Phi) * L * L, -6 * L, (2 - Phi) * L * L,  //
      -12, -6 * L, 12, -6 * L,                              //
      6 * L, (2 - Phi) * L * L, -6 * L, (4 + Phi) * L * L;
  result.stiffness *= EI / (L * L * L * (1 + Phi));

  // Shape functions of degree 3 make integrands of degree 6: four Gauss points integrate them exactly.
  constexpr std::array<double, 4> abscissa{-0.86113631159405258, -0.33998104358485626, 0.33998104358485626,
                                           0.86113631159405258};
  constexpr std::array<double, 4> weight{0.34785484513745386, 0.65214515486254614, 0.65214515486254614,
                                         0.34785484513745386};
  Eigen::Matrix4d translation = Eigen::Matrix4d::Zero(), rotation = Eigen::Matrix4d::Zero();
  for (std::size_t g = 0; g < abscissa.size(); ++g) {
    const double x = 0.5 * (1 + abscissa[g]), x2 = x * x, x3 = x2 * x;                       // x / L
    const Eigen::Vector4d N = Eigen::Vector4d(1 - 3 * x2 + 2 * x3 + Phi * (1 - x),           //
                                              L * (x - 2 * x2 + x3 + 0.5 * Phi * (x - x2)),  //
                                              3 * x2 - 2 * x3 + Phi * x,                     //
                                              L * (-x2 + x3 - 0.5 * Phi * (x - x2))) /
                              (1 + Phi);
    const Eigen::Vector4d N_phi = Eigen::Vector4d(6 / L * (x2 - x),                    //
                                                  1 - 4 * x + 3 * x2 + Phi * (1 - x),  //
                                                  6 / L * (x - x2),                    //
                                                  -2 * x + 3 * x2 + Phi * x) /
                                  (1 + Phi);
    translation += 0.5 * weight[g] * L * N * N.transpose();
    rotation += 0.5 * weight[g] * L * N_phi * N_phi.transpose();
  }
  result.mass = material.rho * (A * translation + I * rotation);
  result.gyroscopic = 2 * material.rho * I * rotation;
  return result;
}

RotorMatrices assemble(const RotorGeometry& geometry) {
  const Eigen::Index n = 2 * geometry.n_nodes();
  RotorMatrices result{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n)};
  for (const auto& element : geometry.elements) {
    const auto matrices = timoshenko_element(geometry.length(element), element.od, element.id, element.material);
    const std::array<Eigen::Index, 4> row{2 * element.n1 - 2, 2 * element.n1 - 1, 2 * element.n2 - 2,
                                          2 * element.n2 - 1};
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) {
        const auto a = static_cast<Eigen::Index>(i), b = static_cast<Eigen::Index>(j);
        result.mass(row[i], row[j]) += matrices.mass(a, b);
        result.gyroscopic(row[i], row[j]) += matrices.gyroscopic(a, b);
        result.stiffness(row[i], row[j]) += matrices.stiffness(a, b);
      }
  }
  for (const auto& point : geometry.mass_points) {
    const Eigen::Index v = 2 * point.node - 2, phi = v + 1;
    result.mass(v, v) += point.mass;
    result.mass(phi, phi) += point.Id;
    result.gyroscopic(phi, phi) += point.Ip;
  }
  return result;
}

}  // namespace rotordrop
