#include "machine/others/guarded_parts.h"

#include <fmt/format.h>

#include <cmath>
#include <exception>
#include <new>
#include <utility>

#include "base/errors.h"
#include "base/utf8.h"
#include "bearing/touchdown_bearing.h"
#include "thermal/circuit/thermal_network.h"

namespace rotordrop {
namespace {

[[noreturn]] void tell(const std::string& part, const char* function, const std::string& what) {
  throw PartError(
      fmt::format("{} failed in {}: {}\n       The fault is in that module, and not in the program or the case: tell "
                  "whoever made the module.",
                  part, function, what));
}

/// Calls what may throw anything.
template <class Call>
auto at_door(const std::string& part, const char* function, const Call& call) -> decltype(call()) {
  try {
    return call();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    tell(part, function, is_utf8(error.what()) ? error.what() : "its message is no UTF-8.");
  } catch (...) {
    tell(part, function, "it threw what is no std::exception.");
  }
}

/// An energy, without which there is no balance.
double finite(const std::string& part, const char* function, double energy) {
  if (!std::isfinite(energy)) tell(part, function, "it returned what is no finite number.");
  return energy;
}

/// The same where a part may find faults of the input.
template <class Call>
auto at_door_of_input(const std::string& part, const char* function, const Call& call) -> decltype(call()) {
  try {
    return call();
  } catch (const InputError&) {
    throw;
  } catch (...) {
    return at_door(part, function, [&]() -> decltype(call()) { throw; });
  }
}

class GuardedSupport final : public Support {
 public:
  GuardedSupport(std::string part, std::unique_ptr<Support> inner) : part_(std::move(part)), inner_(std::move(inner)) {}

  [[nodiscard]] const std::string& name() const override {
    return at_door(part_, "name()", [&]() -> const std::string& { return inner_->name(); });
  }
  [[nodiscard]] std::string results_path() const override {
    return at_door(part_, "results_path()", [&] { return inner_->results_path(); });
  }
  [[nodiscard]] std::vector<StateEntry> state_entries() const override {
    return at_door(part_, "state_entries()", [&] { return inner_->state_entries(); });
  }
  [[nodiscard]] std::vector<StateEntry> ledger_entries() const override {
    return at_door(part_, "ledger_entries()", [&] { return inner_->ledger_entries(); });
  }
  [[nodiscard]] std::vector<Observable> observables() const override {
    return at_door(part_, "observables()", [&] { return inner_->observables(); });
  }
  [[nodiscard]] std::vector<Observable> detailed_observables() const override {
    return at_door(part_, "detailed_observables()", [&] { return inner_->detailed_observables(); });
  }
  [[nodiscard]] std::string heat_port() const override {
    return at_door(part_, "heat_port()", [&] { return inner_->heat_port(); });
  }
  [[nodiscard]] std::size_t n_heated_rows() const override {
    return at_door(part_, "n_heated_rows()", [&] { return inner_->n_heated_rows(); });
  }
  [[nodiscard]] std::vector<double> instants() const override {
    return at_door(part_, "instants()", [&] { return inner_->instants(); });
  }
  void initial_state(std::span<double> y) const override {
    at_door(part_, "initial_state()", [&] { inner_->initial_state(y); });
  }
  void evaluate(const SupportInput& input, std::span<const double> y, std::span<double> dydt,
                std::span<double> ledger_rates, SupportOutput& out) const override {
    at_door(part_, "evaluate()", [&] { inner_->evaluate(input, y, dydt, ledger_rates, out); });
    if (out.heat.rub != 0. || out.heat.inner != 0. || out.heat.outer != 0.)
      tell(part_, "evaluate()",
           "it gives heat as a touchdown bearing does (SupportOutput::heat), which no thermal model takes from it. "
           "What it dissipates is other_dissipation; heat_port() and heat_into_port warm thermal models.");
  }
  [[nodiscard]] double energy(const SupportInput& input, std::span<const double> y) const override {
    return finite(part_, "energy()", at_door(part_, "energy()", [&] { return inner_->energy(input, y); }));
  }

 private:
  std::string part_;
  std::unique_ptr<Support> inner_;
};

class GuardedThermalModel final : public ThermalModel {
 public:
  GuardedThermalModel(std::string part, std::unique_ptr<ThermalModel> inner)
      : part_(std::move(part)), inner_(std::move(inner)) {}

  [[nodiscard]] std::vector<StateEntry> state_entries() const override {
    return at_door(part_, "state_entries()", [&] { return inner_->state_entries(); });
  }
  void initial_state(std::span<double> temperature) const override {
    at_door(part_, "initial_state()", [&] { inner_->initial_state(temperature); });
  }
  void growth(std::span<const double> temperature, std::span<Expansion> out) const override {
    at_door(part_, "growth()", [&] { inner_->growth(temperature, out); });
  }
  void growth_rates(std::span<const double> temperature_rate, std::span<Expansion> out) const override {
    at_door(part_, "growth_rates()", [&] { inner_->growth_rates(temperature_rate, out); });
  }
  double rates(std::span<const double> temperature, std::span<const HeatInput> heat,
               std::span<double> dydt) const override {
    return at_door(part_, "rates()", [&] { return inner_->rates(temperature, heat, dydt); });
  }
  [[nodiscard]] bool can_follow() const override {
    return at_door(part_, "can_follow()", [&] { return inner_->can_follow(); });
  }
  [[nodiscard]] double advance(double step, std::span<const double> from, std::span<const HeatInput> heat,
                               std::span<double> to) const override {
    return at_door(part_, "advance()", [&] { return inner_->advance(step, from, heat, to); });
  }
  [[nodiscard]] std::vector<std::string> heat_ports() const override {
    return at_door(part_, "heat_ports()", [&] { return inner_->heat_ports(); });
  }
  void add_heat(std::size_t port, double watts, std::span<double> dydt) const override {
    at_door(part_, "add_heat()", [&] { inner_->add_heat(port, watts, dydt); });
  }
  [[nodiscard]] std::vector<Observable> observables() const override {
    return at_door(part_, "observables()", [&] { return inner_->observables(); });
  }
  void observe(std::span<const double> temperature, std::span<const HeatInput> heat,
               std::span<double> out) const override {
    at_door(part_, "observe()", [&] { inner_->observe(temperature, heat, out); });
  }
  [[nodiscard]] std::vector<std::size_t> ring_states() const override {
    return at_door(part_, "ring_states()", [&] { return inner_->ring_states(); });
  }
  [[nodiscard]] double stored_energy(std::span<const double> temperature) const override {
    return finite(part_, "stored_energy()",
                  at_door(part_, "stored_energy()", [&] { return inner_->stored_energy(temperature); }));
  }
  void observe_tile(std::span<const double> temperature, std::span<const HeatInput> heat,
                    std::span<double> out) const override {
    at_door(part_, "observe_tile()", [&] { inner_->observe_tile(temperature, heat, out); });
  }

 private:
  std::string part_;
  std::unique_ptr<ThermalModel> inner_;
};

MakeThermalModel guarded_maker(MakeThermalModel make, const std::string& part) {
  return [make = std::move(make), part](const ThermalGeometry& geometry) -> std::unique_ptr<ThermalModel> {
    auto made = at_door_of_input(part, "its constructor", [&] { return make(geometry); });
    // One of ours that a module makes is known by its class.
    if (!made || dynamic_cast<const ThermalNetwork*>(made.get())) return made;
    return std::make_unique<GuardedThermalModel>(part, std::move(made));
  };
}

}  // namespace

SupportKind guarded(SupportKind kind, const std::string& file) {
  const std::string of = fmt::format("(type \"{}\" of {})", kind.type, file);
  kind.read = [read = std::move(kind.read), of](const Node& table, const ReadContext& here, Faults& faults) {
    OtherSupport support = at_door_of_input(fmt::format("the support at {} {}", to_string(table.where()), of),
                                            "reading its keys", [&] { return read(table, here, faults); });
    support.make = [make = std::move(support.make), of](const std::string& name) -> std::unique_ptr<Support> {
      const std::string part = fmt::format("bearings.{} {}", name, of);
      auto made = at_door_of_input(part, "its constructor", [&] { return make(name); });
      if (!made || dynamic_cast<const TouchdownBearing*>(made.get())) return made;
      return std::make_unique<GuardedSupport>(part, std::move(made));
    };
    return support;
  };
  return kind;
}

ThermalKind guarded(ThermalKind kind, const std::string& file) {
  const std::string part = fmt::format("thermal model \"{}\" (of {})", kind.name, file);
  if (kind.make) kind.make = guarded_maker(std::move(kind.make), part);
  if (kind.read)
    kind.read = [read = std::move(kind.read), part](const Node& table, const ReadContext& here,
                                                    Faults& faults) -> MakeThermalModel {
      return guarded_maker(at_door_of_input(part, "reading its keys", [&] { return read(table, here, faults); }), part);
    };
  return kind;
}

}  // namespace rotordrop
