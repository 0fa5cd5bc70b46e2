#pragma once
#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "model/heat_conduction.h"
#include "model/section_mesh.h"

/// Axisymmetric thermo-elasticity as plain data, and the solver that a finite-element room provides for it.
/// Small displacements u = (u_x, u_r) of the half plane (x along the axis), weight r, strains u_x,x  u_r,r  u_r/r  and the shear; isotropic
/// bodies, thermal strain from a reference temperature, centrifugal load, bodies that meet in fits.
namespace rotordrop {

/// (x, r) parts of a displacement [m], a force or a direction.
using AxialRadial = std::array<double, 2>;
/// A function of place in a body.
using ElasticFunction = std::function<AxialRadial(std::size_t body, double x, double r)>;

/// A ring: rectangular, unless the problem has a mesh.
struct ElasticBody {
  std::string name;
  std::array<double, 2> x{}, r{};  ///< extent [m], rising; r >= 0; of a rectangle
  double density = 0;              ///< [kg/m3]
  double E = 0;                    ///< Young's modulus [Pa], > 0
  double nu = 0;                   ///< Poisson ratio, 0 to below 0.5
  PropertyTable expansion;  ///< alpha [1/K]: the thermal strain is its integral from the reference temperature on
  double spin = 0;          ///< its speed over the speed that solve() is given: 1 turns, 0 stands
};

enum class FitKind {
  frictionless,  ///< passes pressure alone, and opens where it would have to pull
  bonded         ///< passes every traction, and never opens
};

/// Two sides that lie on each other, cylinders or end faces. With n, the outward normal of the first,
///   closed: (u_second - u_first) n = interference, pressure >= 0;   open: more than that, no pressure.
struct ElasticFit {
  std::string name;
  HeatBoundary first, second;  ///< left, right, inner or outer sides
  double interference =
      0;  ///< of the parts before they were joined, by radius or along the axis [m]; negative: a clearance
  FitKind kind = FitKind::frictionless;
};

/// A side that is held in one or both directions; axially at zero unless a function says otherwise.
struct ElasticHold {
  HeatBoundary boundary;
  bool axial = false, radial = false;
  ElasticFunction displacement = {};
};

/// Traction on a side [Pa]: pressure against its outward normal, and a function of place besides.
struct ElasticTraction {
  HeatBoundary boundary;
  double pressure = 0;
  ElasticFunction traction = {};
};

/// What is wanted of the displacement: its mean over the area of sides, along a direction.
struct ElasticOutput {
  std::string name;
  std::vector<HeatBoundary> boundaries;
  AxialRadial direction = {0., 1.};
};

struct ElasticProblem {
  std::vector<ElasticBody> bodies;
  SectionMesh mesh = {};  ///< of the bodies, in their order; empty: rectangles, meshed by grid lines
  std::vector<ElasticFit> fits = {};
  std::vector<ElasticHold> holds = {};
  std::vector<ElasticTraction> tractions = {};
  ElasticFunction body_force = {};  ///< [N/m3]
  std::vector<ElasticOutput> outputs = {};
  double reference_temperature = 293.15;  ///< [K] at which there is no thermal strain
  HeatNumerics numerics;                  ///< degree, and the grid of rectangles
};

/// A fit after a solve.
struct FitState {
  double mean_pressure = 0;  ///< [Pa] the whole force across the fit over its whole area
  /// [Pa], at nodes: the projection of the nodal forces on the elements' functions, where the fit is closed. At the end of a body that presses on a wider one
  /// elasticity knows no bound of it: the highest value there follows the mesh.
  double lowest_pressure = 0, highest_pressure = 0;
  double open_fraction = 0;  ///< of the area
  double area = 0;           ///< [m2]
  struct Point {
    double x = 0, r = 0;
    double pressure = 0;  ///< [Pa]; 0 where open
    double gap = 0;       ///< [m]; 0 where closed
    bool is_closed = false;
  };
  std::vector<Point> points;  ///< the nodes
};

/// A linear output while every fit stays as it is: value = at_rest + per_speed_squared omega^2 + weights . (T - T_ref).
struct ElasticInfluence {
  double at_rest = 0;            ///< by fits, holds and tractions
  double per_speed_squared = 0;  ///< by the centrifugal load, per (rad/s)^2
  std::vector<double> weights;   ///< per kelvin of each of the mesh's unknowns of temperature [n_nodes]
};

/// What a fit that was closed everywhere does when nodes of it open: linear in their gaps, whichever of them open.
struct FitOpenings {
  std::vector<std::vector<double>> force;   ///< pressing each node, per metre of another's gap [n][n] [N/m]
  std::vector<std::vector<double>> output;  ///< per metre of each node's gap [n_outputs][n]
  std::vector<std::vector<double>> mass;    ///< integral of the product of two nodes' functions [n][n] [m2]
  std::vector<double> share;                ///< integral of a node's function [n] [m2]
};

class ElasticSolver {
 public:
  ElasticSolver() = default;
  ElasticSolver(const ElasticSolver&) = delete;
  ElasticSolver& operator=(const ElasticSolver&) = delete;
  virtual ~ElasticSolver() = default;

  /// Unknowns of temperature: those of a heat problem of the same mesh and degree, in its order.
  [[nodiscard]] virtual std::size_t n_nodes() const = 0;
  [[nodiscard]] virtual std::vector<double> interpolate(
      const std::function<double(std::size_t body, double x, double r)>& f) const = 0;

  /// Displacement under temperatures [K], with fits closed and open as they must be.
  /// @param temperatures  [n_nodes], or more, of which the first count; empty: the reference temperature
  /// @param speed         [rad/s]
  /// @throws SolverError if no state of the fits is found
  virtual void solve(std::span<const double> temperatures, double speed) = 0;
  /// Fits changed between open and closed in the last solve().
  [[nodiscard]] virtual bool fits_changed() const = 0;

  /// A free body's mean axial displacement is zero.
  [[nodiscard]] virtual AxialRadial displacement(std::size_t body, double x, double r) const = 0;
  /// Mean over the area of sides.
  [[nodiscard]] virtual AxialRadial mean_displacement(const std::vector<HeatBoundary>& boundaries) const = 0;
  [[nodiscard]] virtual double output(std::size_t output) const = 0;  ///< [m]
  [[nodiscard]] virtual FitState fit(std::size_t fit) const = 0;
  struct Stress {
    double axial = 0, radial = 0, hoop = 0, shear = 0;
  };
  [[nodiscard]] virtual Stress stress(std::size_t body, double x, double r) const = 0;  ///< [Pa]
  [[nodiscard]] virtual SurfaceRange hoop_stress(const HeatBoundary& boundary) const = 0;

  // With the fits as the last solve() left them. Expansion coefficients must be constant, else SolverError.
  [[nodiscard]] virtual ElasticInfluence influence(std::size_t output) const = 0;
  [[nodiscard]] virtual ElasticInfluence pressure_influence(std::size_t fit) const = 0;  ///< on the mean pressure [Pa]
  /// On the force of each closed node over its share of the area [Pa]: an opening begins where one of these turns negative.
  [[nodiscard]] virtual std::vector<ElasticInfluence> node_pressure_influences(std::size_t fit) const = 0;

  /// Of a frictionless fit between cylinders that no hold touches and the last solve() left closed everywhere; of others it is empty.
  [[nodiscard]] virtual FitOpenings openings(std::size_t fit) const = 0;

  /// Those nodes' shares of the fit's area.
  [[nodiscard]] virtual std::vector<double> node_shares(std::size_t fit) const = 0;

  /// sqrt of the volume integral of |u - f|^2 [m^2.5].
  [[nodiscard]] virtual double difference(const ElasticFunction& f) const = 0;
};

/// What the finite-element room's module exports under the name `rotordrop_make_elastic_solver`; the caller deletes it.
using MakeElasticSolver = ElasticSolver*(const ElasticProblem&);
inline constexpr const char* make_elastic_solver_name = "rotordrop_make_elastic_solver";

}  // namespace rotordrop
