#pragma once
#include <vector>

namespace rotordrop {

/// Isotropic, linear elastic.
struct RotorMaterial {
  double E = 0;    ///< Young's modulus [Pa], > 0
  double nu = 0;   ///< Poisson's ratio, in (-1, 0.5)
  double rho = 0;  ///< density [kg/m^3], > 0
  bool operator==(const RotorMaterial&) const = default;
};

/// Straight circular piece of shaft between two neighbouring nodes. Several may lie over the same span
/// (a sleeve on a shaft): they then share the nodes' motion and add their matrices.
struct ShaftElement {
  int n1 = 0;     ///< node at the smaller x, numbered from 1
  int n2 = 0;     ///< node at the larger x, numbered from 1
  double od = 0;  ///< outer diameter [m], > id
  double id = 0;  ///< bore [m], >= 0; 0 is solid
  RotorMaterial material;
  bool operator==(const ShaftElement&) const = default;
};

/// Mass without stiffness at a node: a disk, gear, lamination stack.
struct RotorMassPoint {
  int node = 0;     ///< numbered from 1
  double mass = 0;  ///< [kg], >= 0
  double Ip = 0;    ///< about x [kg m^2], >= 0
  double Id = 0;    ///< about a diameter [kg m^2], >= 0
  bool operator==(const RotorMassPoint&) const = default;
};

/// Shaft, section by section, and what is mounted on it. Plain data: `rotor_parameters.h` reads and checks it.
struct RotorGeometry {
  std::vector<double> node_x;  ///< [n_nodes] axial positions [m], increasing; node k is node_x[k - 1]
  std::vector<ShaftElement> elements;
  std::vector<RotorMassPoint> mass_points;

  [[nodiscard]] int n_nodes() const { return static_cast<int>(node_x.size()); }
  /// @param node numbered from 1
  [[nodiscard]] double position(int node) const { return node_x[static_cast<std::size_t>(node - 1)]; }
  bool operator==(const RotorGeometry&) const = default;
  [[nodiscard]] double length(const ShaftElement& element) const { return position(element.n2) - position(element.n1); }
};

/// Largest outer diameter of the shaft's elements at a node [m]; 0 if there are none.
[[nodiscard]] double shaft_diameter(const RotorGeometry& rotor, int node);

/// Rotor as one rigid body.
struct RigidBody {
  double mass = 0;               ///< [kg]
  double centre_of_gravity = 0;  ///< axial position [m]
  double Ip = 0;                 ///< about x [kg m^2]
  double Id = 0;                 ///< about a diameter through the centre of gravity [kg m^2]
};

/// Sums of cylinders and mass points, in closed form.
[[nodiscard]] RigidBody rigid_body(const RotorGeometry& geometry);

}  // namespace rotordrop
