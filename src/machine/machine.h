#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "laws/heat/heat_flow.h"
#include "machine/heat/growth_history.h"
#include "machine/heat/place_energy.h"
#include "model/evaluation.h"
#include "model/ode_system.h"
#include "model/probe.h"
#include "model/rotor_model.h"
#include "model/support.h"
#include "model/thermal_model.h"

namespace rotordrop {

/// Where the joules are at one instant [J].
template <class Real>
struct EnergyBalanceOf {
  Real mechanical = 0;       ///< kinetic, elastic, gravitational
  Real dissipated = 0;       ///< heat deposited and damping, since the start
  Real growth_work = 0;      ///< done on the machine by thermal growth
  Real prescribed_work = 0;  ///< of all supports (SupportOutputOf) and of the rotor's growth by its speed
  Real unbalance_work = 0;
  Real drive_work = 0;  ///< by motor or brake
  Real windage = 0;     ///< dissipated by the gas around the rotor; part of `dissipated`
  Real residual = 0;    ///< initial - mechanical - dissipated + works: 0 if every joule is found
  Real heat_deposited = 0;
  struct Heat {
    Real stored = 0, lost = 0;
    Real deposited = 0;  ///< heat_deposited, and what supports gave into ports of this model
    Real residual = 0;   ///< deposited - stored - lost
  };
  std::vector<Heat> heat;  ///< of each thermal model in the state vector
};
using EnergyBalance = EnergyBalanceOf<double>;
/// What results say of SupportOutputOf::prescribed_work.
inline constexpr const char* prescribed_work_meaning =
    "work of everything that is prescribed: cage, waves, balls' inertia, growth by speed, magnets, circulatory "
    "stiffness";

/// Rotor, supports and thermal models wired to one state vector with its energy ledgers:
///   y = [ rotor | each support | temperatures of each thermal model | ledgers | heat lost by each model that follows | its temperatures ].
/// What follows is no part of what is integrated: functions of y that do not say otherwise read the rest alone, and can be given that alone.
/// One pass computes all rates: motion and growth from states, then forces and heats, then rates. Nothing in it changes once it is built: several
/// threads can evaluate one machine, each with an Evaluation of its own.
class Machine final {
 public:
  struct Parts {
    std::unique_ptr<RotorModel> rotor;
    std::vector<std::unique_ptr<Support>> supports;  ///< one per station of the rotor, in their order
    struct Thermal {
      std::string name;   ///< of its kind
      std::string group;  ///< of its datasets, "/thermal/"
      std::unique_ptr<ThermalModel> model;
      bool is_unmarked = false;  ///< its ledgers and keys carry no name
      bool follows = false;      ///< advances behind the integration (Followers): nothing depends on its temperatures
      double longest_step = 0;   ///< of one that follows [s]
      /// Before what results call its heat: "", "fe_".
      [[nodiscard]] std::string prefix() const { return is_unmarked ? "" : name + "_"; }
    };
    std::vector<Thermal> thermal;                           ///< all take the same heat; may be none
    std::vector<std::optional<std::size_t>> thermal_place;  ///< of each support, if it gives off heat
    std::vector<RubShare> rub_share;                        ///< of each thermal place
    std::optional<std::size_t> driver;                      ///< the thermal model whose growth is fed back
    /// Temperatures that friction of rotor and ring follows; none: it follows none.
    struct RingTemperatures {
      std::size_t model = 0;            ///< thermal model
      std::vector<std::size_t> states;  ///< of it, for each thermal place
    };
    std::optional<RingTemperatures> friction_temperatures;
    std::shared_ptr<const GrowthHistory> prescribed_growth;  ///< fed back instead, if there is no driver
    bool takes_growth =
        false;  ///< growth that the caller hands over with Evaluation::growth_in_force is fed back instead
    /// Its growth is added to the prescribed one: what heat does at once, before any of it is conducted on. Reported nowhere.
    std::unique_ptr<ThermalModel> immediate_growth;
    /// Growth of the rotor's surface at each thermal place per square of the rotor's speed [m s^2]; empty: it does not grow by its speed.
    std::vector<double> rotor_growth_by_speed;
    std::vector<double> initial_rotor_state;
    std::vector<Probe> probes;  ///< watched when step observables are asked for
  };
  explicit Machine(Parts parts);
  [[nodiscard]] const Parts& parts() const { return parts_; }
  [[nodiscard]] std::size_t n_step() const { return n_step_; }       ///< size of all step observables
  [[nodiscard]] std::size_t n_details() const { return n_detail_; }  ///< of all detailed ones

  [[nodiscard]] const StateLayout& layout() const { return layout_; }
  /// The first part of it, which has rates and is integrated; all of it if no thermal model follows.
  [[nodiscard]] const StateLayout& integrated_layout() const { return integrated_; }
  /// @param y [layout().size()], or [integrated_layout().size()] for that part alone
  void initial_state(std::span<double> y) const;
  /// Entries [from, integrated_layout().size()) are quadratures, the ledgers.
  [[nodiscard]] std::size_t first_quadrature() const { return first_ledger_; }

  /// Modes of the rotor, which comes first in the state vector.
  [[nodiscard]] std::vector<Oscillator> oscillators() const { return parts_.rotor->oscillators(); }
  /// Known times at which the rates jump or bend [s]: those of rotor and supports.
  [[nodiscard]] std::vector<double> instants() const;
  [[nodiscard]] std::size_t n_supports() const { return parts_.supports.size(); }
  [[nodiscard]] const Support& support(std::size_t i) const { return *parts_.supports[i]; }
  [[nodiscard]] const RotorModel& rotor() const { return *parts_.rotor; }
  [[nodiscard]] const std::vector<Probe>& probes() const { return parts_.probes; }
  [[nodiscard]] Spin spin(std::span<const double> y) const { return parts_.rotor->spin(rotor_part(y)); }

  /// What the supports report at every step, with paths such as "/bearings/TB1/contact_force".
  [[nodiscard]] const std::vector<Observable>& step_observables() const { return step_observables_; }
  /// Every ball and the like.
  [[nodiscard]] const std::vector<Observable>& detail_observables() const { return detail_observables_; }
  /// Rotor, temperatures, energies: "/rotor/spin_speed", "/thermal/TB1/ball", "/energy/dissipated".
  [[nodiscard]] const std::vector<Observable>& state_observables() const { return state_observables_; }
  /// Rates, and on the way what is asked for.
  void evaluate(double t, std::span<const double> y, Evaluation& found) const;
  /// The same with the rates elsewhere. @param rates [integrated_layout().size()]
  void evaluate(double t, std::span<const double> y, std::span<double> rates, Evaluation& found) const;
  /// The same with the parts of machines alike side by side: those of several drops (machine/evaluate_machine.h).
  template <class Real, class PartsOf>
  void evaluate_with(const PartsOf& parts, const Real& t, std::span<const Real> y, std::span<Real> rates,
                     EvaluationOf<Real>& found) const;
  /// Rates by themselves, for a few calls: integrators have a MachineSystem.
  void rhs(double t, std::span<const double> y, std::span<double> rates) const;
  /// @param found  by an evaluation of the same y
  /// @param out    [sum of sizes of state_observables()]
  void observe_state(std::span<const double> y, const Evaluation& found, std::span<double> out) const;

  /// Values of the probes' observables, the last of the step observables. @param y  the rotor's states are enough
  void observe_probes(std::span<const double> y, std::span<double> out) const;
  [[nodiscard]] std::size_t n_rotor_states() const { return n_rotor_; }
  /// Those of them that need no evaluation, being the rotor's own and the ledgers; the others are left alone. @param out  as above
  void observe_held(std::span<const double> y, std::span<double> out) const;
  /// The same of states side by side (machine/observe_machine.h); observe_state_of() only of one machine.
  template <class Real, class PartsOf>
  void observe_state_of(const PartsOf& parts, std::span<const Real> y, const EvaluationOf<Real>& found,
                        std::span<Real> out) const;
  template <class Real, class PartsOf>
  void observe_held_of(const PartsOf& parts, std::span<const Real> y, std::span<Real> out) const;
  [[nodiscard]] static bool is_held(const std::string& state_observable) {
    return state_observable.starts_with("/rotor/") || state_observable.starts_with("/ledger/");
  }

  /// @param growth_in_force  as of Evaluation
  [[nodiscard]] EnergyBalance energy_balance(double t, std::span<const double> y,
                                             const GrowthHistory* growth_in_force = nullptr) const;
  [[nodiscard]] std::size_t n_thermal_places() const { return ledger_of_place_.size(); }
  [[nodiscard]] std::size_t n_thermal_models() const { return parts_.thermal.size(); }
  [[nodiscard]] const Parts::Thermal& thermal(std::size_t i) const { return parts_.thermal[i]; }
  [[nodiscard]] const std::string& thermal_name(std::size_t i) const { return parts_.thermal[i].name; }
  /// Heat that a thermal place has been given since the start.
  [[nodiscard]] PlaceEnergy heat_given(std::size_t place, std::span<const double> y) const;
  /// States of a thermal model [n_states of it].
  [[nodiscard]] std::span<const double> thermal_state(std::size_t model, std::span<const double> y) const {
    return thermal_part(model, y);
  }
  /// Those of a model that follows, and the heat that it has lost. @param y [layout().size()]
  [[nodiscard]] std::span<double> followed_state(std::size_t model, std::span<double> y) const {
    return y.subspan(thermal_[model].state, thermal_[model].n_state);
  }
  [[nodiscard]] std::size_t heat_lost_ledger(std::size_t model) const { return thermal_[model].lost; }
  /// Of a machine's state, the support's own.
  [[nodiscard]] std::span<const double> support_part(std::size_t support, std::span<const double> y) const {
    return y.subspan(places_[support].state, places_[support].n_state);
  }
  [[nodiscard]] double initial_mechanical_energy() const { return initial_mechanical_; }
  [[nodiscard]] double mechanical_energy(double t, std::span<const double> y,
                                         const GrowthHistory* growth_in_force = nullptr) const;
  /// Value of a ledger of a support, by its name, e.g. "rub heat" or "contact impulse". @throws std::out_of_range
  [[nodiscard]] double ledger(std::size_t support, const std::string& name, std::span<const double> y) const;

 private:
  /// Ledgers that every support has, in this order, before its own.
  enum SupportLedger : std::size_t {
    rub_heat,
    rub_heat_into_ring,
    inner_heat,
    outer_heat,
    other_dissipation,
    prescribed_work,
    growth_work,
    n_support_ledger
  };
  /// After them the heat lost by each thermal model that is integrated (ThermalBlock::lost), and the windage, if the rotor has any.
  enum MachineLedger : std::size_t { rotor_damping, unbalance_work, drive_work, n_machine_ledger };
  struct Place {
    std::size_t state = 0, n_state = 0;    // of the support
    std::size_t ledger = 0, n_own = 0;     // its ledgers: n_support_ledger common ones, then its own
    std::size_t n_rows = 0;                // heated apart: two ledgers each, after its own
    std::size_t n_step = 0, n_detail = 0;  // sizes of what it reports
    bool heats_port = false;               // the last of its ledgers is the heat into its port
    [[nodiscard]] std::size_t port_ledger() const { return ledger + n_support_ledger + n_own + 2 * n_rows; }
  };
  [[nodiscard]] std::span<const double> rotor_part(std::span<const double> y) const { return y.subspan(0, n_rotor_); }
  struct ThermalBlock {
    std::size_t state = 0, n_state = 0, n_observed = 0;
    std::size_t lost = 0;  // its ledger
  };
  [[nodiscard]] std::span<const double> thermal_part(std::size_t model, std::span<const double> y) const {
    return y.subspan(thermal_[model].state, thermal_[model].n_state);
  }
  struct OwnParts;
  template <class Real>
  void fit(EvaluationOf<Real>& found) const;
  template <class Real, class PartsOf>
  void prepare_inputs(const PartsOf& parts, const Real& t, std::span<const Real> y, EvaluationOf<Real>& found) const;
  [[nodiscard]] Evaluation inputs_at(double t, std::span<const double> y, const GrowthHistory* growth_in_force) const;
  // machine/observe_machine.h:
  template <class Real, class PartsOf>
  [[nodiscard]] Real mechanical_energy_of(const PartsOf& parts, std::span<const Real> y,
                                          std::span<const SupportInputOf<Real>> inputs) const;
  template <class Real, class PartsOf>
  [[nodiscard]] EnergyBalanceOf<Real> energy_balance_of(const PartsOf& parts, std::span<const Real> y,
                                                        std::span<const SupportInputOf<Real>> inputs) const;
  void list_observables();
  void connect_heat_ports();
  void lay_out_states();
  void lay_out_temperatures(std::size_t model);
  [[nodiscard]] std::vector<double> find_initial_state() const;
  void lay_out_ledgers();
  void lay_out_followers();

  Parts parts_;
  StateLayout layout_, integrated_;
  std::size_t n_rotor_ = 0, first_ledger_ = 0, n_ledger_ = 0;
  std::size_t machine_ledger_ = 0, windage_ledger_ = 0;
  std::vector<ThermalBlock> thermal_;
  /// A support whose heat enters a port of a thermal model.
  struct HeatedPort {
    std::size_t support = 0, model = 0, port = 0;
  };
  std::vector<HeatedPort> heated_ports_;
  ThermalBlock immediate_;  // of the immediate growth
  std::vector<Place> places_;
  struct PlaceLedger {
    std::size_t first = 0, rows = 0,
                n_rows = 0;  // where the ledgers of its support begin, and those of its rows; how many rows
  };
  std::vector<PlaceLedger> ledger_of_place_;  // of each thermal place
  std::vector<Observable> step_observables_, detail_observables_, state_observables_;
  std::size_t n_step_ = 0, n_detail_ = 0;  ///< sizes of the first two
  std::size_t n_rotor_observed_ = 0;       ///< of the rotor besides its spin
  std::vector<double> initial_state_;      ///< of all states: rings at rest in their balls take a while to find
  double initial_mechanical_ = 0;
};

/// A machine as one integrator sees it, with the space that its evaluations need: one thread at a time.
class MachineSystem final : public OdeSystem {
 public:
  /// @param growth_in_force  of a machine that takes it from outside
  explicit MachineSystem(const Machine& machine, const GrowthHistory* growth_in_force = nullptr) : machine_(machine) {
    found_.growth_in_force = growth_in_force;
  }
  [[nodiscard]] const StateLayout& layout() const override { return machine_.integrated_layout(); }
  void initial_state(std::span<double> y) const override { machine_.initial_state(y); }
  void rhs(double t, std::span<const double> y, std::span<double> dydt) const override {
    machine_.evaluate(t, y, dydt, found_);
  }
  [[nodiscard]] std::size_t first_quadrature() const override { return machine_.first_quadrature(); }
  [[nodiscard]] std::vector<Oscillator> oscillators() const override { return machine_.oscillators(); }
  [[nodiscard]] std::vector<double> instants() const override { return machine_.instants(); }

 private:
  const Machine& machine_;
  mutable Evaluation found_;
};

}  // namespace rotordrop
