// Thermal models written in Python.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>

#include "machine/parts_module.h"
#include "python/bindings.h"
#include "python/own_parts.h"

namespace rotordrop::python {
namespace py = pybind11;

namespace {

struct PythonKeys {
  std::map<std::string, double> values = {};
};

std::vector<double> all_of(const std::vector<Expansion>& growth) {
  std::vector<double> values;
  for (const Expansion& one : growth)
    for (const double value : growth_values(one)) values.push_back(value);
  return values;
}

/// An object of a Python class as a thermal model. Rates, stored heat and what it reports take Python's lock; growth is linear, and asked for only when the machine is built.
class PythonThermalModel final : public ThermalModel {
 public:
  /// With Python's lock.
  PythonThermalModel(std::string name, py::object part, const std::vector<BearingCircuitData>& bearings)
      : name_(std::move(name)), part_(std::move(part)), n_places_(bearings.size()) {
    states_ = state_entries_of(part_.attr("states"));
    observables_ = observables_of(part_.attr("reported")());
    for (Observable& o : observables_)
      for (const auto& b : bearings)
        if (o.name == b.name + "/inner_ring" && o.unit == "K") {
          o.kind = Observed::inner_ring_temperature;
          o.place = b.name;
        }
    initial_ = numbers_of(part_.attr("initial_state")(), states_.size(), name_ + ".initial_state()");
    find_growth();
  }
  ~PythonThermalModel() override {
    const py::gil_scoped_acquire lock;
    part_ = {};
  }

  [[nodiscard]] std::vector<StateEntry> state_entries() const override { return states_; }
  void initial_state(std::span<double> temperature) const override {
    std::copy(initial_.begin(), initial_.end(), temperature.begin());
  }
  void growth(std::span<const double> temperature, std::span<Expansion> out) const override {
    grow(temperature, initial_, growth_at_start_, out);
  }
  void growth_rates(std::span<const double> rate, std::span<Expansion> out) const override {
    grow(rate, std::vector<double>(states_.size()), std::vector<double>(growth_at_start_.size()), out);
  }

  double rates(std::span<const double> temperature, std::span<const HeatInput> heat,
               std::span<double> dydt) const override {
    return with_python([&] {
      const py::object returned = part_.attr("rates")(array_of(temperature), list_of(heat));
      if (!py::isinstance<py::tuple>(returned) || py::len(returned) != 2)
        throw py::value_error(
            fmt::format("{}.rates() must return a pair: the rates of its states, and the heat lost to ambient", name_));
      const py::tuple pair = returned;
      const auto rates = numbers_of(pair[0], dydt.size(), name_ + ".rates()");
      std::copy(rates.begin(), rates.end(), dydt.begin());
      return number_of(pair[1], name_ + ".rates(), as the heat lost,");
    });
  }

  [[nodiscard]] std::vector<Observable> observables() const override { return observables_; }
  void observe(std::span<const double> temperature, std::span<const HeatInput> heat,
               std::span<double> out) const override {
    if (out.empty()) return;
    with_python([&] {
      const auto observed =
          numbers_of(part_.attr("observe")(array_of(temperature), list_of(heat)), out.size(), name_ + ".observe()");
      std::copy(observed.begin(), observed.end(), out.begin());
    });
  }
  [[nodiscard]] double stored_energy(std::span<const double> temperature) const override {
    return with_python(
        [&] { return number_of(part_.attr("stored_energy")(array_of(temperature)), name_ + ".stored_energy()"); });
  }

 private:
  static py::list list_of(std::span<const HeatInput> heat) {
    py::list list;
    for (const HeatInput& one : heat) list.append(py::cast(one));  // copies
    return list;
  }

  [[nodiscard]] std::vector<double> growth_from_python(std::span<const double> temperature) const {
    const py::object returned = part_.attr("growth")(array_of(temperature));
    std::vector<Expansion> growth;
    try {
      growth = returned.cast<std::vector<Expansion>>();
    } catch (const py::cast_error&) {
      refuse_returned(name_ + ".growth()", "an Expansion for each bearing", returned);
    }
    if (growth.size() != n_places_)
      throw py::value_error(fmt::format("{}.growth() must return an Expansion for each of {} bearings, and returned {}",
                                        name_, n_places_, growth.size()));
    return all_of(growth);
  }

  /// The growth's derivatives, a column for each state, and whether they are all that there is.
  void find_growth() {
    growth_at_start_ = growth_from_python(initial_);
    const double step = 100.;  // [K], of a temperature; what is linear does not depend on it
    std::vector<double> moved = initial_;
    for (std::size_t k = 0; k < states_.size(); ++k) {
      moved[k] = initial_[k] + step;
      const auto there = growth_from_python(moved);
      for (std::size_t j = 0; j < there.size(); ++j)
        per_rise_.push_back((there[j] - growth_at_start_[j]) / (moved[k] - initial_[k]));
      moved[k] = initial_[k];
    }
    for (std::size_t k = 0; k < states_.size(); ++k) moved[k] += step * (0.3 + 0.4 * static_cast<double>(k % 2));
    const auto there = growth_from_python(moved);
    std::vector<Expansion> linear(n_places_);
    grow(moved, initial_, growth_at_start_, linear);
    const auto expected = all_of(linear);
    double largest = 0.;
    for (const double value : expected) largest = std::fmax(largest, std::abs(value));
    for (std::size_t j = 0; j < there.size(); ++j)
      if (!(std::abs(there[j] - expected[j]) <= 1e-9 * largest))
        throw py::value_error(
            fmt::format("{}.growth() must be linear in the temperatures, and is not: the growth of \"{}\" changes by "
                        "{:.6g} m, and by {:.6g} m according to its changes with one temperature after the other",
                        name_, growth_surface_names[j % growth_surface_names.size()], there[j] - growth_at_start_[j],
                        expected[j] - growth_at_start_[j]));
  }

  void grow(std::span<const double> values, std::span<const double> from, std::span<const double> at,
            std::span<Expansion> out) const {
    constexpr std::size_t n = growth_surfaces.size();
    for (std::size_t place = 0; place < n_places_; ++place)
      for (std::size_t s = 0; s < n; ++s) {
        double sum = at[place * n + s];
        for (std::size_t k = 0; k < states_.size(); ++k)
          sum += per_rise_[(k * n_places_ + place) * n + s] * (values[k] - from[k]);
        out[place].*growth_surfaces[s] = sum;
      }
  }

  std::string name_;
  py::object part_;
  std::size_t n_places_;
  std::vector<StateEntry> states_;
  std::vector<Observable> observables_;
  std::vector<double> initial_, growth_at_start_;  // [n_states], [n_places][surfaces]
  std::vector<double> per_rise_;                   // [n_states][n_places][surfaces] [m/K]
};

KnownClasses& known_classes() {
  static auto* known = new KnownClasses;
  return *known;
}

void add_thermal_model(const std::string& type, const std::string& title, const py::list& parameters,
                       const py::object& part) {
  const auto keys = keys_of(parameters, type + ".parameters");
  if (replace_class(known_classes(), type, keys, part)) return;
  auto* kept = new py::object(part);
  const auto make = [kept, type](const ThermalGeometry& geometry, const PythonKeys& p) {
    return with_python([&] {
      return std::make_unique<PythonThermalModel>(type, (*kept)(geometry.bearings, geometry.ambient, p.values),
                                                  geometry.bearings);
    });
  };
  ThermalKind kind;
  kind.name = type;
  kind.title = title;
  if (keys.empty()) {
    kind.make = [make](const ThermalGeometry& geometry) { return make(geometry, {}); };
    add_thermal_kind(std::move(kind));
  } else {
    Section<PythonKeys> section(type, "A thermal model written in Python.");
    declare_keys(section, keys, "thermal." + type + ".");
    add_thermal_kind(thermal_kind_of(std::move(kind), section, make));
  }
  known_classes()[type] = {kept, keys};
}

Expansion growth_of(const BearingCircuitData& b, double shaft, double inner_ring, double outer_ring, double ball) {
  const auto g = section_growth(b);
  return {.shaft = g.shaft * shaft,
          .bore = g.bore * inner_ring,
          .inner_race = g.inner_race * inner_ring,
          .outer_race = g.outer_race * outer_ring,
          .ball = g.ball * ball,
          .inner_width = g.inner_width * inner_ring,
          .outer_width = g.outer_width * outer_ring};
}

/// As the lumped circuit has them, its calibration included.
std::map<std::string, double> capacities_of(const BearingCircuitData& b) {
  ThermalNetworkData network;
  add_bearing_circuit(b, network);
  std::map<std::string, double> capacities;
  for (const auto& node : network.nodes)
    if (node.capacity > 0.) capacities[node.name.substr(b.name.size() + 1)] = node.capacity;
  return capacities;
}

std::map<std::string, double> resistances_of(const BearingCircuitData& b) {
  const auto R = circuit_resistances(b);
  return {{"R1", R.R1},
          {"R2", R.R2},
          {"R3", R.R3},
          {"R4", R.R4},
          {"R4_spreading", R.R4_spreading},
          {"R5_inside", R.R5_inside},
          {"R5_constriction", R.R5_constriction},
          {"R6", R.R6},
          {"R7", R.R7},
          {"R7_spreading", R.R7_spreading},
          {"R8_ring", R.R8_ring},
          {"R8_fit", R.R8_fit},
          {"R8_housing", R.R8_housing}};
}

void add_heat(py::module_& core) {
  py::class_<BallConduction>(core, "BallConduction", "Conductances that rolling balls make [W/K].")
      .def_readonly("inner_to_ball", &BallConduction::inner_to_ball, "[W/K]")
      .def_readonly("outer_to_ball", &BallConduction::outer_to_ball, "[W/K]")
      .def_readonly("inner_to_outer", &BallConduction::inner_to_outer, "[W/K]");
  py::class_<RowHeat>(core, "RowHeat", "Heat of one row of balls.")
      .def_readonly("inner", &RowHeat::inner, "[W]")
      .def_readonly("outer", &RowHeat::outer, "[W]")
      .def_readonly("balls", &RowHeat::balls, "what they conduct");
  py::class_<HeatInput>(core, "HeatInput", "Heat that a bearing releases.")
      .def_readonly("rub", &HeatInput::rub, "[W]")
      .def_readonly("rub_into_ring", &HeatInput::rub_into_ring, "[W]")
      .def_readonly("inner", &HeatInput::inner, "[W]")
      .def_readonly("outer", &HeatInput::outer, "[W]")
      .def_readonly("rotor_surface_speed", &HeatInput::rotor_surface_speed, "[m/s]")
      .def_readonly("ring_surface_speed", &HeatInput::ring_surface_speed, "[m/s]")
      .def_readonly("is_in_contact", &HeatInput::is_in_contact, "rotor and bore touch")
      .def_readonly("balls", &HeatInput::balls, "what rolling balls conduct")
      .def_readonly("rows", &HeatInput::rows, "the same by row, if finite elements heat rows apart; else empty");
}

void add_geometry(py::module_& core) {
  using B = BearingCircuitData;
  using M = ThermalMaterial;
  py::class_<M>(core, "ThermalMaterial", "Properties at ambient.")
      .def_readonly("conductivity", &M::conductivity, "[W/(m K)]")
      .def_readonly("heat_capacity", &M::heat_capacity, "[J/(kg K)]")
      .def_readonly("density", &M::density, "[kg/m3]")
      .def_readonly("expansion", &M::expansion, "[1/K]")
      .def_readonly("poisson_ratio", &M::poisson_ratio, "[1]");
  py::class_<B>(core, "ThermalBearing", "Dimensions and materials of a touchdown bearing.")
      .def_readonly("name", &B::name, "of the bearing")
      .def_readonly("ring", &B::ring, "material of rings and housing")
      .def_readonly("shaft", &B::shaft, "material of the shaft")
      .def_readonly("ball", &B::ball, "material of the balls")
      .def_readonly("width", &B::width, "all rows [m]")
      .def_readonly("journal_radius", &B::journal_radius, "[m]")
      .def_readonly("ring_mass", &B::ring_mass, "inner ring(s) [kg]")
      .def_readonly("inner_bore", &B::inner_bore, "diameter [m]")
      .def_readonly("inner_outside", &B::inner_outside, "diameter [m]")
      .def_readonly("outer_bore", &B::outer_bore, "diameter [m]")
      .def_readonly("outer_outside", &B::outer_outside, "diameter [m]")
      .def_readonly("housing_bore", &B::housing_bore, "diameter [m]")
      .def_readonly("housing_outside", &B::housing_outside, "diameter [m]")
      .def_readonly("housing_length", &B::housing_length, "[m]")
      .def_readonly("shaft_length", &B::shaft_length, "of the lump of shaft [m]")
      .def_readonly("shaft_bore_radius", &B::shaft_bore_radius, "of a hollow shaft, 0 of a solid one [m]")
      .def_readonly("n_balls", &B::n_balls, "of all rows")
      .def_readonly("ball_diameter", &B::ball_diameter, "[m]")
      .def_readonly("h_shaft", &B::h_shaft, "[W/(m2 K)]")
      .def_readonly("h_ball", &B::h_ball, "[W/(m2 K)]")
      .def_readonly("fit_resistance", &B::fit_resistance, "[K/W]")
      .def_property_readonly("capacities", &capacities_of, "nodes of the lumped circuit [J/K]")
      .def_property_readonly("resistances", &resistances_of, "of the lumped circuit [K/W]")
      .def("growth", &growth_of, py::arg("shaft") = 0., py::arg("inner_ring") = 0., py::arg("outer_ring") = 0.,
           py::arg("ball") = 0., "Growth of its surfaces when each part is evenly warmer [K].");
}

}  // namespace

void add_own_thermal(py::module_& core) {
  using E = Expansion;
  py::class_<E>(core, "Expansion", "Growth of the surfaces of a bearing [m].")
      .def(py::init([](double shaft, double bore, double inner_race, double outer_race, double ball, double inner_width,
                       double outer_width, double row_difference) {
             return E{shaft, bore, inner_race, outer_race, ball, inner_width, outer_width, row_difference};
           }),
           py::arg("shaft") = 0., py::arg("bore") = 0., py::arg("inner_race") = 0., py::arg("outer_race") = 0.,
           py::arg("ball") = 0., py::arg("inner_width") = 0., py::arg("outer_width") = 0.,
           py::arg("row_difference") = 0.)
      .def_readonly("shaft", &E::shaft, "[m]")
      .def_readonly("bore", &E::bore, "[m]")
      .def_readonly("inner_race", &E::inner_race, "[m]")
      .def_readonly("outer_race", &E::outer_race, "[m]")
      .def_readonly("ball", &E::ball, "[m]")
      .def_readonly("inner_width", &E::inner_width, "[m]")
      .def_readonly("outer_width", &E::outer_width, "[m]")
      .def_readonly("row_difference", &E::row_difference, "[m]");
  add_heat(core);
  add_geometry(core);
  core.def("add_thermal_model", &add_thermal_model, py::arg("type"), py::arg("title"), py::arg("parameters"),
           py::arg("part"));
}

}  // namespace rotordrop::python
