#include "machine/lanes/lane_engine.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <vector>

#include "base/gather.h"
#include "bearing/touchdown_in_lanes.h"
#include "machine/evaluate_machine.h"
#include "machine/observe_machine.h"
#include "rotor/modal_rotor_in_lanes.h"
#include "thermal/circuit/thermal_network_in_lanes.h"

// Compiled for every level of vectors, with ROTORDROP_LANE_FACTORY the name of its factory.

namespace rotordrop {
namespace {

template <class Part, class Of>
std::vector<const Part*> parts_of(std::span<const Machine* const> machines, Of&& of) {
  std::vector<const Part*> parts;
  for (const Machine* machine : machines) parts.push_back(&static_cast<const Part&>(of(*machine)));
  return parts;
}

/// Heat of one lane, without that of single rows, which do not run in lanes.
template <class Real>
HeatInput heat_of_lane(const HeatInputOf<Real>& h, int lane) {
  return {h.rub[lane],
          h.rub_into_ring[lane],
          h.inner[lane],
          h.outer[lane],
          h.rotor_surface_speed[lane],
          h.ring_surface_speed[lane],
          h.is_in_contact[lane],
          of_lane<BallConductionOf>(h.balls, lane),
          {}};
}

/// A thermal model of any kind that follows one drop, asked for what rows of that drop report.
template <class Real>
class FollowerInLanes {
 public:
  explicit FollowerInLanes(const ThermalModel& model) : model_(&model) {}

  void observe(std::span<const Real> T, std::span<const HeatInputOf<Real>> heat, std::span<Real> out) const {
    std::vector<HeatInput> heats;
    for (int lane = 0; lane < n_lanes; ++lane)
      for (const auto& h : heat) heats.push_back(heat_of_lane(h, lane));
    std::vector<double> temperatures(T.size() * RowTile::width), values(out.size() * RowTile::width);
    for (std::size_t i = 0; i < T.size(); ++i) T[i].store(temperatures.data() + i * RowTile::width);
    model_->observe_tile(temperatures, heats, values);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = Real::load(values.data() + i * RowTile::width);
  }
  void growth(std::span<const Real> T, std::span<ExpansionOf<Real>> out) const {
    std::vector<Expansion> values(out.size());
    for_each(T, [&](int lane, std::span<const double> T_of_one) {
      model_->growth(T_of_one, values);
      for (std::size_t i = 0; i < out.size(); ++i)
        for (std::size_t k = 0; k < growth_surfaces.size(); ++k)
          (out[i].*growth_surfaces_of<Real>[k]).set(lane, values[i].*growth_surfaces[k]);
    });
  }
  [[nodiscard]] Real stored_energy(std::span<const Real> T) const {
    Real energy;
    for_each(T, [&](int lane, std::span<const double> T_of_one) { energy.set(lane, model_->stored_energy(T_of_one)); });
    return energy;
  }

 private:
  template <class Act>
  static void for_each(std::span<const Real> T, const Act& act) {
    std::vector<double> one(T.size());
    for (int lane = 0; lane < n_lanes; ++lane) {
      for (std::size_t i = 0; i < one.size(); ++i) one[i] = T[i][lane];
      act(lane, one);
    }
  }
  const ThermalModel* model_;
};

/// Parts of machines alike, as Machine::evaluate_with() asks for them.
template <class Real>
class PartsInLanes {
 public:
  explicit PartsInLanes(std::span<const Machine* const> machines)
      : rotor_(parts_of<ModalRotor>(
            machines, [](const Machine& m) -> auto& { return m.rotor(); })) {
    const auto& form = machines.front()->parts();
    for (std::size_t i = 0; i < form.supports.size(); ++i)
      supports_.emplace_back(parts_of<TouchdownBearing>(
          machines, [&](const Machine& m) -> auto& { return m.support(i); }));
    for (std::size_t i = 0; i < form.thermal.size(); ++i) {
      thermal_.emplace_back();
      followers_.emplace_back(*form.thermal[i].model);
      if (form.thermal[i].follows) continue;
      thermal_.back().emplace(parts_of<ThermalNetwork>(
          machines, [&](const Machine& m) -> auto& { return *m.thermal(i).model; }));
    }
    initial_mechanical_ = machines.front()->initial_mechanical_energy();
    for (std::size_t place = 0; place < form.rub_share.size(); ++place) {
      std::vector<RubNumbers<double>> rub;
      for (const Machine* machine : machines) rub.push_back(machine->parts().rub_share[place].numbers());
      std::vector<const RubNumbers<double>*> of;
      for (const auto& numbers : rub) of.push_back(&numbers);
      rub_.push_back({gathered<RubNumbers, Real>(of), form.rub_share[place].by_jaeger});
      growth_by_speed_.push_back(side_by_side<Real>(
          machines.size(), [&](std::size_t i) { return machines[i]->parts().rotor_growth_by_speed[place]; }));
    }
  }

  struct Rub {
    RubNumbers<Real> numbers;
    bool by_jaeger;
    [[nodiscard]] Real to_ring(const Real& rotor_surface_speed, const Real& ring_surface_speed) const {
      return numbers.to_ring(by_jaeger, rotor_surface_speed, ring_surface_speed);
    }
  };
  [[nodiscard]] const ModalRotorInLanes<Real>& rotor() const { return rotor_; }
  [[nodiscard]] const TouchdownInLanes<Real>& support(std::size_t i) const { return supports_[i]; }
  [[nodiscard]] const ThermalNetworkInLanes<Real>& thermal(std::size_t i) const { return *thermal_[i]; }
  [[nodiscard]] const ThermalNetworkInLanes<Real>& immediate_growth() const {
    return *thermal_.front();
  }  // there is none
  /// A model that follows is that of the first machine: rows are of one machine.
  template <class Act>
  void with_thermal(std::size_t i, const Act& act) const {
    if (thermal_[i])
      act(*thermal_[i]);
    else
      act(followers_[i]);
  }
  [[nodiscard]] const Real& initial_mechanical() const { return initial_mechanical_; }
  [[nodiscard]] const Rub& rub_share(std::size_t place) const { return rub_[place]; }
  [[nodiscard]] const Real& rotor_growth_by_speed(std::size_t place) const { return growth_by_speed_[place]; }
  /// Without a thermal model that drives nothing grows.
  void given_growth(const Real&, const EvaluationOf<Real>&, std::span<ExpansionOf<Real>> out) const {
    std::fill(out.begin(), out.end(), ExpansionOf<Real>{});
  }
  void given_growth_rate(const Real& t, const EvaluationOf<Real>& e, std::span<ExpansionOf<Real>> out) const {
    given_growth(t, e, out);
  }

 private:
  ModalRotorInLanes<Real> rotor_;
  std::vector<TouchdownInLanes<Real>> supports_;
  std::vector<std::optional<ThermalNetworkInLanes<Real>>> thermal_;  // of those that do not follow
  std::vector<FollowerInLanes<Real>> followers_;                     // all models, as if they followed
  Real initial_mechanical_;                                          // of the first machine
  std::vector<Rub> rub_;
  std::vector<Real> growth_by_speed_;
};

template <class Real>
class MachineLanes final : public LaneSystem {
 public:
  static_assert(n_lanes == LaneSystem::width);
  explicit MachineLanes(std::span<const Machine* const> machines)
      : machines_(machines.begin(), machines.end()), form_(*machines.front()), parts_(machines) {}

  [[nodiscard]] const StateLayout& layout() const override { return form_.layout(); }
  [[nodiscard]] std::size_t first_quadrature() const override { return form_.first_quadrature(); }

  void rates(std::span<const double> t, std::span<const double> y, std::span<double> dydt) override {
    evaluate(t, y, dydt, rates_only_);
  }
  void observe(std::span<const double> t, std::span<const double> y, std::span<double> dydt, std::span<double> step,
               std::span<double> details) override {
    observed_.wants_step = !step.empty();
    observed_.wants_details = !details.empty();
    evaluate(t, y, dydt, observed_);
    if (!step.empty()) observe_probes(y);
    store(observed_.step, step);
    store(observed_.details, details);
  }
  void observe_state(std::span<const double> y, std::span<double> out) override {
    if (std::ranges::any_of(machines_, [&](const Machine* machine) { return machine != &form_; }))
      throw std::logic_error("rows of several machines side by side");
    form_.observe_state_of<Real>(parts_, in_vectors(y), observed_, in_vectors(out));
  }
  void observe_held(std::span<const double> y, std::span<double> out) override {
    form_.observe_held_of<Real>(parts_, in_vectors(y), in_vectors(out));
  }

 private:
  void evaluate(std::span<const double> t, std::span<const double> y, std::span<double> dydt, EvaluationOf<Real>& e) {
    form_.evaluate_with<Real>(parts_, Real::load(t.data()), in_vectors(y), in_vectors(dydt), e);
  }
  void observe_probes(std::span<const double> y) {
    const std::size_t n_probed = 3 * form_.probes().size(), first = observed_.step.size() - n_probed;
    if (n_probed == 0) return;
    std::vector<double> rotor(form_.n_rotor_states()), values(n_probed);
    for (int lane = 0; lane < n_lanes; ++lane) {
      const auto l = static_cast<std::size_t>(lane);
      for (std::size_t i = 0; i < rotor.size(); ++i) rotor[i] = y[i * width + l];
      machines_[std::min(l, machines_.size() - 1)]->observe_probes(rotor, values);
      for (std::size_t i = 0; i < n_probed; ++i) observed_.step[first + i].set(lane, values[i]);
    }
  }
  /// A list as it lies in memory, where the numbers of all lanes make whole vectors. Nothing in this source touches it as single numbers.
  static std::span<const Real> in_vectors(std::span<const double> list) {
    return {reinterpret_cast<const Real*>(list.data()), list.size() / width};
  }
  static std::span<Real> in_vectors(std::span<double> list) {
    return {reinterpret_cast<Real*>(list.data()), list.size() / width};
  }
  static void store(const std::vector<Real>& from, std::span<double> to) {
    for (std::size_t i = 0; i < from.size(); ++i) from[i].store(to.data() + i * width);
  }

  std::vector<const Machine*> machines_;
  const Machine& form_;
  PartsInLanes<Real> parts_;
  EvaluationOf<Real> rates_only_, observed_;
};

}  // namespace

std::unique_ptr<LaneSystem> ROTORDROP_LANE_FACTORY(std::span<const Machine* const> machines) {
  return std::make_unique<MachineLanes<EightDrops>>(machines);
}

}  // namespace rotordrop
