// Supports written in Python.
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>

#include "machine/supports.h"
#include "python/bindings.h"
#include "python/own_parts.h"

namespace rotordrop::python {
namespace py = pybind11;

namespace {

/// Keys of a support of a Python class, in SI.
struct PythonKeys {
  int node = 0;
  std::map<std::string, double> values = {};
};

/// What a Python class returns from one evaluation.
struct SupportResponse {
  Force force;
  double dissipation = 0, prescribed_work = 0;
  std::vector<double> rates, observed;
};

/// An object of a Python class as a support. Every evaluation takes Python's lock: some microseconds.
class PythonSupport final : public Support {
 public:
  /// With Python's lock.
  PythonSupport(std::string name, py::object part) : name_(std::move(name)), part_(std::move(part)) {
    states_ = state_entries_of(part_.attr("states"));
    observables_ = observables_of(part_.attr("series"));
    if (py::hasattr(part_, "instants")) instants_ = times_of(part_.attr("instants")(), name_ + ".instants()");
    initial_ = numbers_of(part_.attr("initial_state")(), states_.size(), name_ + ".initial_state()");
  }
  ~PythonSupport() override {
    const py::gil_scoped_acquire lock;
    part_ = {};
  }

  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] std::vector<StateEntry> state_entries() const override { return states_; }
  [[nodiscard]] std::vector<Observable> observables() const override { return observables_; }
  [[nodiscard]] std::vector<double> instants() const override { return instants_; }
  void initial_state(std::span<double> y) const override { std::copy(initial_.begin(), initial_.end(), y.begin()); }

  void evaluate(const SupportInput& input, std::span<const double> y, std::span<double> dydt,
                std::span<double> /*ledger_rates*/, SupportOutput& out) const override {
    with_python([&] {
      const py::object returned = part_.attr("evaluate")(input, array_of(y));
      if (!py::isinstance<SupportResponse>(returned))
        refuse_returned(name_ + ".evaluate()", "a SupportResponse", returned);
      const auto& r = returned.cast<const SupportResponse&>();
      if (r.rates.size() != dydt.size()) refuse("rates", dydt.size(), r.rates.size());
      if (!out.observed.empty() && r.observed.size() != out.observed.size())
        refuse("observed", out.observed.size(), r.observed.size());
      out.force_on_rotor = r.force;
      out.heat = {};
      out.energy_gradient = {};
      out.other_dissipation = r.dissipation;
      out.prescribed_work = r.prescribed_work;
      std::copy(r.rates.begin(), r.rates.end(), dydt.begin());
      if (!out.observed.empty()) std::copy(r.observed.begin(), r.observed.end(), out.observed.begin());
    });
  }

  [[nodiscard]] double energy(const SupportInput& input, std::span<const double> y) const override {
    return with_python([&] { return number_of(part_.attr("energy")(input, array_of(y)), name_ + ".energy()"); });
  }

 private:
  [[noreturn]] void refuse(const char* what, std::size_t expected, std::size_t given) const {
    throw py::value_error(
        fmt::format("{}: evaluate() must return {} {}, and returned {}", name_, expected, what, given));
  }

  std::string name_;
  py::object part_;
  std::vector<StateEntry> states_;
  std::vector<Observable> observables_;
  std::vector<double> initial_, instants_;
};

Section<PythonKeys> section_of(const std::string& type, const std::vector<KeyOfPart>& keys) {
  Section<PythonKeys> section(type, "A support written in Python.");
  section.integer("node", &PythonKeys::node, {.range = at_least(1), .help = "Rotor node that it holds, from 1."});
  declare_keys(section, keys);
  return section;
}

KnownClasses& known_classes() {
  static auto* known = new KnownClasses;
  return *known;
}

void add_support(const std::string& type, const py::list& parameters, const py::object& part) {
  const auto keys = keys_of(parameters, type + ".parameters", {"node", "type"});
  if (replace_class(known_classes(), type, keys, part)) return;
  auto* kept = new py::object(part);
  add_support_kind(type, section_of(type, keys), [kept](const std::string& name, const PythonKeys& p) {
    return with_python([&] { return std::make_unique<PythonSupport>(name, (*kept)(name, p.values)); });
  });
  known_classes()[type] = {kept, keys};
}

}  // namespace

void add_own_supports(py::module_& core) {
  py::class_<Motion>(core, "Motion", "Motion of a station of the rotor.")
      .def_readonly("x", &Motion::x, "[m]")
      .def_readonly("y", &Motion::y, "[m]")
      .def_readonly("z", &Motion::z, "[m]")
      .def_readonly("theta_y", &Motion::theta_y, "[rad]")
      .def_readonly("theta_z", &Motion::theta_z, "[rad]")
      .def_readonly("velocity_x", &Motion::velocity_x, "[m/s]")
      .def_readonly("velocity_y", &Motion::velocity_y, "[m/s]")
      .def_readonly("velocity_z", &Motion::velocity_z, "[m/s]")
      .def_readonly("tilt_rate_y", &Motion::tilt_rate_y, "[rad/s]")
      .def_readonly("tilt_rate_z", &Motion::tilt_rate_z, "[rad/s]");
  py::class_<SupportInput>(core, "SupportInput", "What a support sees.")
      .def_readonly("time", &SupportInput::time, "[s]")
      .def_readonly("journal", &SupportInput::journal, "motion of the rotor at the support")
      .def_property_readonly(
          "spin_angle", [](const SupportInput& in) { return in.rotor_spin.angle; },
          "rotation of the rotor about +x [rad]")
      .def_property_readonly(
          "spin_speed", [](const SupportInput& in) { return in.rotor_spin.speed; }, "spin speed of the rotor [rad/s]");
  py::class_<SupportResponse>(core, "SupportResponse", "What a support returns.")
      .def(py::init([](double force_y, double force_z, double force_x, double moment_y, double moment_z, double torque,
                       double dissipation, double prescribed_work, std::vector<double> rates,
                       std::vector<double> observed) {
             return SupportResponse{{force_x, force_y, force_z, moment_y, moment_z, torque},
                                    dissipation,
                                    prescribed_work,
                                    std::move(rates),
                                    std::move(observed)};
           }),
           py::arg("force_y") = 0., py::arg("force_z") = 0., py::arg("force_x") = 0., py::arg("moment_y") = 0.,
           py::arg("moment_z") = 0., py::arg("torque") = 0., py::arg("dissipation") = 0.,
           py::arg("prescribed_work") = 0., py::arg("rates") = std::vector<double>{},
           py::arg("observed") = std::vector<double>{});
  core.def("add_support", &add_support, py::arg("type"), py::arg("parameters"), py::arg("part"));
}

}  // namespace rotordrop::python
