#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/table_value.h"
#include "model/assembled_heat.h"
#include "model/reduced_heat.h"
#include "model/section_mesh.h"

/// Axisymmetric heat conduction as plain data, and the solver that a finite-element room provides for it.
///   rho c(T) dT/dt = div(k(T) grad T)   in bodies of the r-z half plane (x along the axis), weight r.
namespace rotordrop {

/// A material property over temperature: linear between its points, constant outside them.
class PropertyTable {
 public:
  PropertyTable() = default;
  explicit PropertyTable(double constant) : points_{{0., constant}} {}
  /// @param points  temperature [K], rising, and value; at least one
  explicit PropertyTable(std::vector<std::array<double, 2>> points) : points_(std::move(points)) {}

  [[nodiscard]] bool is_constant() const {
    return std::all_of(points_.begin(), points_.end(), [&](const auto& p) { return p[1] == points_.front()[1]; });
  }
  [[nodiscard]] double value(double T) const { return table_value(points_, T); }
  /// d value/dT; zero outside the points.
  [[nodiscard]] double slope(double T) const {
    if (T < points_.front()[0] || T >= points_.back()[0]) return 0.;
    const auto high =
        std::upper_bound(points_.begin(), points_.end(), T, [](double x, const auto& p) { return x < p[0]; });
    const auto low = high - 1;
    return ((*high)[1] - (*low)[1]) / ((*high)[0] - (*low)[0]);
  }
  [[nodiscard]] const std::vector<std::array<double, 2>>& points() const { return points_; }
  /// Integral of the value from temperature a to b [value K], exact.
  [[nodiscard]] double integral(double a, double b) const {
    if (b < a) return -integral(b, a);
    double sum = 0., from = a;
    for (const auto& p : points_) {
      if (p[0] <= from) continue;
      if (p[0] >= b) break;
      sum += 0.5 * (value(from) + value(p[0])) * (p[0] - from);
      from = p[0];
    }
    return sum + 0.5 * (value(from) + value(b)) * (b - from);
  }

 private:
  std::vector<std::array<double, 2>> points_ = {{0., 0.}};
};

/// A ring: rectangular, unless the problem has a mesh.
struct HeatBody {
  std::string name;
  std::array<double, 2> x{}, r{};      ///< extent [m], rising; r >= 0; of a rectangle
  double density = 0;                  ///< [kg/m3]
  PropertyTable conductivity;          ///< [W/(m K)]
  PropertyTable heat_capacity;         ///< [J/(kg K)]
  std::optional<double> held_at = {};  ///< temperature at which all of it is held from the start on [K]
};

/// A function of place and time, f(x, r, t): tests with manufactured solutions use these.
using HeatFunction = std::function<double(double x, double r, double t)>;

/// Heat into a boundary [W/m2], on the part of it that no interface covers; or into an interface, where its two boundaries lie on each other.
/// Several on one boundary add up.
struct HeatFlux {
  HeatBoundary boundary;
  std::vector<double> times,
      values;  ///< values[i] holds from times[i] to times[i + 1]; nothing before the first, the last one for ever
  HeatFunction function = {};               ///< added to that
  std::optional<HeatBoundary> second = {};  ///< of an interface between `boundary` and this one
  /// Of an interface: where in its resistance the heat arises, as the part of it that lies on the second's side. While both sides have one temperature,
  /// this part of the heat enters `boundary`.
  double resistance_beyond = 0.5;
};

/// A boundary that is held at a temperature [K] from the start on, on the part of it that no interface covers. Where two of them meet the first counts.
struct HeatFixed {
  HeatBoundary boundary;
  double temperature = 0;
};

/// Loss [W/m2] = coefficient rise |rise|^exponent with rise = T - ambient; none below ambient if the exponent is positive.
/// On the part of the boundary that no interface covers.
struct HeatConvection {
  HeatBoundary boundary;
  double coefficient = 0, exponent = 0, ambient = 0;
};

/// Heat passes from first to second at (T_first - T_second)/resistance [W/m2] where the two boundaries lie on each other.
struct HeatInterface {
  HeatBoundary first, second;
  double resistance = 0;  ///< [m2 K/W], > 0
};

/// A part without a section, of one temperature: the balls, a lump of shaft.
struct HeatNode {
  std::string name;
  double capacity = 0;  ///< [J/K], > 0
};

/// Where heat comes in as watts, spread evenly over the area of its boundaries, or into a node. Its temperature is the mean over that area.
struct HeatPort {
  std::string name;
  std::vector<HeatBoundary> boundaries;
  std::optional<std::size_t> node = {};  ///< instead of boundaries
  double steady_for = 0;                 ///< [s] its heat changes no faster: a reduction need not answer it sooner
};

/// A thermal resistance between two ports, or a port and the surroundings (at the initial temperature).
struct HeatLink {
  std::size_t from = 0;
  std::optional<std::size_t> to = {};  ///< none: the surroundings
  double resistance = 0;               ///< [K/W], > 0
};

/// How linear equations are solved: by factorisation, or by conjugate gradients with algebraic multigrid, for meshes whose factors are too large
/// for the memory; automatic: by factorisation as long as they are not.
enum class HeatLinearSolver { automatic, direct, multigrid };

/// Mesh and accuracy in time.
struct HeatNumerics {
  int degree = 2;       ///< of the elements
  int cells = 8;        ///< across the smallest body, per direction, where nothing grades them
  double grading = 30;  ///< cells at boundaries with flux are this many times thinner
  double end_grading =
      1;  ///< cells at ends of interfaces inside a side are this many times thinner, in both directions; rectangles
  double growth = 1.5;      ///< largest ratio of neighbouring cells
  double tolerance = 1e-6;  ///< error of one step over the largest change of temperature
  double fixed_step = 0;    ///< [s]; if positive, steps of this length without error control
  HeatLinearSolver solver = HeatLinearSolver::direct;
};

/// bodies.size() if none has that name.
[[nodiscard]] inline std::size_t body_index(const std::vector<HeatBody>& bodies, const std::string& name) {
  std::size_t i = 0;
  while (i < bodies.size() && bodies[i].name != name) ++i;
  return i;
}

struct HeatConductionProblem {
  std::vector<HeatBody> bodies;
  SectionMesh mesh = {};  ///< of the bodies, in their order; empty: rectangles, meshed by grid lines
  std::vector<HeatFlux> fluxes;
  std::vector<HeatConvection> convections;
  std::vector<HeatInterface> interfaces;
  std::vector<HeatNode> nodes = {};
  std::vector<HeatPort> ports = {};
  std::vector<HeatLink> links = {};
  double initial_temperature = 293.15;                                                       ///< [K]
  std::function<double(std::size_t body, double x, double r)> initial_field = {};            ///< instead of that
  std::function<double(std::size_t body, double x, double r, double t)> volume_source = {};  ///< [W/m3]
  HeatNumerics numerics;
  std::vector<HeatFixed> fixed = {};
};

/// [J], whole circumference. Each is computed on its own; see docs/how-to/heat.md.
struct HeatEnergy {
  double input = 0;   ///< through fluxes, ports and boundaries that are held while they warm the body
  double stored = 0;  ///< enthalpy of the temperature field over that of the initial one
  double lost = 0;  ///< through convection, links to the surroundings, and boundaries that are held while they cool it
  [[nodiscard]] double residual() const { return input - stored - lost; }
};

/// Temperatures over a boundary [K].
struct SurfaceRange {
  double mean = 0, lowest = 0, highest = 0;
};

struct HeatStatistics {
  std::size_t unknowns = 0, cells = 0;
  long steps = 0, rejected_steps = 0, factorisations = 0, solves = 0;
  HeatLinearSolver solver = HeatLinearSolver::direct;  ///< that was chosen
};

class HeatConductionSolver {
 public:
  HeatConductionSolver() = default;
  HeatConductionSolver(const HeatConductionSolver&) = delete;
  HeatConductionSolver& operator=(const HeatConductionSolver&) = delete;
  virtual ~HeatConductionSolver() = default;

  [[nodiscard]] virtual double time() const = 0;
  /// Steps to exactly this time [s], >= time(). @throws SolverError
  virtual void advance_to(double time) = 0;
  /// @param ask  called before each step of advance_to(); what it throws ends that at time(), with a field and energies that belong together
  virtual void ask_between_steps(std::function<void()> ask) = 0;
  /// Temperature [K] at a point of a body.
  [[nodiscard]] virtual double temperature(std::size_t body, double x, double r) const = 0;
  /// Mean over the area of a boundary [K].
  [[nodiscard]] virtual double mean_temperature(const HeatBoundary& boundary) const = 0;
  [[nodiscard]] virtual SurfaceRange surface(const std::vector<HeatBoundary>& boundaries) const = 0;
  /// Mean over the volume of a body [K].
  [[nodiscard]] virtual double body_mean(std::size_t body) const = 0;
  [[nodiscard]] virtual double body_capacity(std::size_t body) const = 0;     ///< at the initial temperature [J/K]
  [[nodiscard]] virtual double port_temperature(std::size_t port) const = 0;  ///< [K]
  [[nodiscard]] virtual double port_area(std::size_t port) const = 0;         ///< [m2]; 0 of a node
  [[nodiscard]] virtual HeatEnergy energy() const = 0;
  [[nodiscard]] virtual HeatStatistics statistics() const = 0;
  /// Sets the heat into each port [W] [n_ports] from now on, and its rate of change [W/s] [n_ports, or none: it stays].
  virtual void set_port_heat(std::span<const double> watts, std::span<const double> rates) = 0;
  void set_port_heat(std::span<const double> watts) { set_port_heat(watts, {}); }
  /// One implicit step of second order without error control; factorisations are kept by step length.
  /// @param step  [s]; @throws SolverError
  virtual void advance_window(double step) = 0;
  /// Temperatures of all unknowns [K], for checkpoints.
  [[nodiscard]] virtual std::vector<double> field() const = 0;
  /// A field of an earlier computation, with the energies that came in and were lost until then.
  virtual void set_field(std::span<const double> temperatures, double time, double input, double lost) = 0;

  /// Reduces the problem, as seen from its ports, to a few modes. Keeps what lift() needs.
  /// @throws SolverError if a property depends on temperature, a convection is not linear or a boundary is held
  virtual ReducedHeat reduce(const ReductionSettings& settings) = 0;
  /// Sets the field to the one represented by a state of the last reduce().
  /// @param state  [n_modes]; @param watts  heat into the ports at that instant [n_ports]
  virtual void lift(std::span<const double> state, std::span<const double> watts, double time) = 0;
  /// A weighted sum of all unknowns' rises as one of the modes' of the last reduce(): sum weight_i (T_i - T_0) = sum shape_i (z_i - T_0).
  /// @param weights  [as many as field()]; @return shape [n_modes]
  [[nodiscard]] virtual std::vector<double> project(std::span<const double> weights) const = 0;
  /// The mesh, of rectangles too.
  [[nodiscard]] virtual const SectionMesh& section_mesh() const = 0;
  /// The field as a VTU file: temperature [K] and body of every cell. @throws SolverError
  virtual void write_vtu(const std::string& file) const = 0;
  /// Under mpirun: whether any rank says yes. All ranks must ask. Alone: what was asked.
  [[nodiscard]] virtual bool on_any_rank(bool own) const = 0;

  /// The problem in space as plain data, apart from its fluxes over time: nothing if it is not linear, or so large that it is stepped better here.
  [[nodiscard]] virtual std::optional<AssembledHeat> assembled() const { return std::nullopt; }
  /// temperature(), and surface(), as means over unknowns.
  [[nodiscard]] virtual HeatMean mean_at(std::size_t body, double x, double r) const = 0;
  [[nodiscard]] virtual HeatMean mean_over(const std::vector<HeatBoundary>& boundaries) const = 0;

  /// sqrt of the volume integral of (T - f)^2 [K m^1.5].
  [[nodiscard]] virtual double difference(
      const std::function<double(std::size_t body, double x, double r)>& f) const = 0;
};

/// What the finite-element room's module exports under the name `rotordrop_make_heat_solver`; the caller deletes it.
using MakeHeatSolver = HeatConductionSolver*(const HeatConductionProblem&);
inline constexpr const char* make_heat_solver_name = "rotordrop_make_heat_solver";

}  // namespace rotordrop
