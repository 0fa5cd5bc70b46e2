#include "machine/lanes/lane_engine.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <vector>

#include "base/gather.h"
#include "bearing/touchdown_in_lanes.h"
#include "machine/evaluate_machine.h"
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
      if (form.thermal[i].follows) continue;
      thermal_.back().emplace(parts_of<ThermalNetwork>(
          machines, [&](const Machine& m) -> auto& { return *m.thermal(i).model; }));
    }
    for (std::size_t place = 0; place < form.rub_share.size(); ++place) {
      std::vector<RubNumbers<double>> rub;
      for (const Machine* machine : machines) rub.push_back(machine->parts().rub_share[place].numbers());
      std::vector<const RubNumbers<double>*> of;
      for (const auto& numbers : rub) of.push_back(&numbers);
      rub_.push_back({gathered<RubNumbers, Real>(of), form.rub_share[place].by_jaeger});
      growth_by_speed_.emplace_back();
      for (int lane = 0; lane < n_lanes; ++lane) {
        const auto at = std::min(static_cast<std::size_t>(lane), machines.size() - 1);
        growth_by_speed_.back().set(lane, machines[at]->parts().rotor_growth_by_speed[place]);
      }
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
  void found(std::size_t lane, Evaluation& e) const override {
    const int l = static_cast<int>(lane);
    e.time = observed_.time[l];
    e.inputs.clear();
    for (const auto& input : observed_.inputs) e.inputs.push_back(of_lane<SupportInputOf>(input, l));
    e.heats.resize(observed_.heats.size());
    for (std::size_t place = 0; place < e.heats.size(); ++place) {
      const HeatInputOf<Real>& h = observed_.heats[place];
      e.heats[place] = {h.rub[l],
                        h.rub_into_ring[l],
                        h.inner[l],
                        h.outer[l],
                        h.rotor_surface_speed[l],
                        h.ring_surface_speed[l],
                        h.is_in_contact[l],
                        of_lane<BallConductionOf>(h.balls, l),
                        {}};
    }
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
