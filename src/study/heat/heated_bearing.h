#pragma once
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "machine/heat/finite_elements.h"
#include "machine/machine.h"
#include "model/heat_conduction.h"

namespace rotordrop {

/// A thermal model of one touchdown bearing that advances without a machine, under heat that it is told.
class HeatedBearing {
 public:
  HeatedBearing() = default;
  HeatedBearing(const HeatedBearing&) = delete;
  HeatedBearing& operator=(const HeatedBearing&) = delete;
  virtual ~HeatedBearing() = default;

  /// To a later time [s], from where it stands. @param heat  where it stands [W]; @param rate  from there on [W/s]; @throws SolverError
  virtual void advance(double until, const HeatInput& heat, const HeatInput& rate) = 0;
  /// @param ask  called before each step; what it throws ends advance() at time()
  virtual void ask_between_steps(std::function<void()> ask) = 0;
  [[nodiscard]] virtual double time() const = 0;
  /// Names of temperatures: "inner_ring".
  [[nodiscard]] virtual const std::vector<std::string>& names() const = 0;
  /// [K] [as many as names]
  [[nodiscard]] virtual std::vector<double> temperatures() const = 0;
  [[nodiscard]] virtual Expansion growth() = 0;
  [[nodiscard]] virtual double stored() const = 0;  ///< [J]
  [[nodiscard]] virtual double lost() const = 0;    ///< [J]
  /// The meshed section with the field of time(); none of a circuit.
  virtual const HeatConductionSolver* section() = 0;
  virtual void report(nlohmann::ordered_json& to) const = 0;  ///< cost
};

/// Data of a model in a state vector: the circuit, or a section on its modes.
struct HeatedModelSettings {
  std::string bearing;
  std::size_t n_places = 0, place = 0;  ///< of the model, and the bearing's among them
  double ambient = 0;                   ///< [K]
  /// Error of one step, in what is shown, over the mean rise that all heat so far would make without losses: a joule that goes in and out counts twice. What comes later has no part in it.
  double time_tolerance = 0;
  FiniteElements::Section* section = nullptr;  ///< of which the model is the reduced form
};
std::unique_ptr<HeatedBearing> heated_model(const ThermalModel& model, const HeatedModelSettings& settings);

/// A section on its whole mesh.
std::unique_ptr<HeatedBearing> heated_mesh(FiniteElements::Section& section);

}  // namespace rotordrop
