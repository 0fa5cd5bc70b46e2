#include "analysis/drop_loop.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "bearing/touchdown_bearing.h"

namespace rotordrop {
/// Tells whether growth that comes from outside goes on otherwise than it did.
class DropLoop::GrowthWatch {
 public:
  GrowthWatch(const GrowthHistory* growth, std::size_t n_places) : growth_(growth), before_(n_places), now_(n_places) {}
  void remember(double t) {
    if (growth_) growth_->rate(t, before_);
  }
  [[nodiscard]] bool has_changed(double t) {
    if (!growth_) return false;
    growth_->rate(t, now_);
    for (std::size_t i = 0; i < now_.size(); ++i)
      if (growth_values(now_[i]) != growth_values(before_[i])) return true;
    return false;
  }

 private:
  const GrowthHistory* growth_;
  std::vector<Expansion> before_, now_;
};

/// How often values are looked at for their peaks, at least [s]: 9 to 12 times in a period of 8 kHz, and 12 times in one of a ring on its contact or on
/// its shoulders, if they are faster.
double DropLoop::often_enough(const Machine& machine) {
  constexpr double pi = std::numbers::pi, impact = 1e4;  // [N]
  double interval = 9.9e-6;
  for (std::size_t i = 0; i < machine.n_supports(); ++i) {
    const auto* bearing = dynamic_cast<const TouchdownBearing*>(&machine.support(i));
    if (!bearing) continue;
    const auto& d = bearing->data();
    const auto& [K, n, lambda] = d.contact;
    double stiffness = n * std::pow(K, 1. / n) * std::pow(impact, 1. - 1. / n);  // of F = K delta^n under that force
    if (d.free_ring && !d.free_ring->shoulders.empty())
      stiffness = std::max(stiffness, d.free_ring->shoulder_stiffness);
    interval = std::min(interval, 2. * pi / 12. * std::sqrt(d.ring_mass / stiffness));
  }
  return interval;
}

/// Without an integrator it is the start.
class DropLoop::EndedStep final : public Step {
 public:
  EndedStep(const Integrator* integrator, const Followers& followers)
      : integrator_(integrator), followers_(followers) {}
  void interpolate(double t, std::span<double> y) const override {
    if (t == time)
      std::copy(after.begin(), after.end(), y.begin());
    else if (t == start)
      std::copy(before.begin(), before.end(), y.begin());
    else
      integrator_->interpolate(t, y.first(after.size()));
    followers_.fill(t, y);
  }

 private:
  const Integrator* integrator_;
  const Followers& followers_;
};

DropLoop::DropLoop(const Machine& machine, const IntegrationParameters& integration, const RunParameters& run,
                   const GrowthHistory* growth_in_force)
    : machine_(machine),
      integration_(integration),
      end_(machine, run.until),
      end_time_(run.latest_end()),
      instants_(machine.instants(), end_time_),
      system_(machine, growth_in_force),
      followers_(machine),
      state_(machine.layout().size()),
      after_(machine.layout().size()),
      growth_(std::make_unique<GrowthWatch>(growth_in_force, machine.n_thermal_places())),
      often_enough_(often_enough(machine)) {
  found_.wants_step = true;
  found_.growth_in_force = growth_in_force;
  machine.initial_state(state_);
}

DropLoop::~DropLoop() = default;

bool DropLoop::run(const std::function<bool()>& is_stopped) {
  if (is_at_end()) return true;
  const std::size_t n_integrated = machine_.integrated_layout().size();
  integrator_ = make_integrator(system_, integration_, time_, std::span(state_).first(n_integrated), end_time_);
  has_end_rates_ = integrator_->evaluate_ends_with([this](double t, std::span<const double> y, std::span<double> dydt) {
    ask(is_to_be_observed(t));
    machine_.evaluate(instants_.before(t), y, dydt, found_);
  });
  show_start();
  while (!is_at_end()) {
    integrator_->advance();
    follow_step();
    if (is_stopped && is_stopped()) break;
  }
  return is_at_end();
}

void DropLoop::start(std::unique_ptr<Integrator> integrator) {
  integrator_ = std::move(integrator);
  has_end_rates_ = true;
  show_start();
}

bool DropLoop::follow_step() {
  const EndedStep step = ended_step();
  constexpr double memory = 16.;  // steps: one that is cut at a corner is none of those that stability keeps short
  mean_step_ += (step.time - step.start - mean_step_) / memory;  // checkpoints are written in show()
  growth_->remember(step.time);
  show(step);
  if (step.is_observed && growth_->has_changed(step.time)) evaluate_end(step.time, step.after, true);
  time_ = step.time;
  state_.swap(after_);
  followers_.follow(step.start, time_, state_, found_);
  return is_at_end();
}

void DropLoop::show_start() {
  if (time_ > 0.) return;
  EndedStep first(nullptr, followers_);
  first.before = first.after = std::span(state_).first(machine_.integrated_layout().size());
  machine_.evaluate(0., state_, found_);
  followers_.begin(0., state_, found_);
  integrator_->offer_rates(found_.rates);
  end_.follow(0., found_.step, machine_.spin(state_).speed);
  first.is_observed = true;
  first.found = &found_;
  show(first);
}

void DropLoop::show(const Step& step) {
  for (Observer* observer : observers_) observer->step(step);
}

DropLoop::EndedStep DropLoop::ended_step() {
  EndedStep step(integrator_.get(), followers_);
  step.start = last_start_ = time_;
  step.time = integrator_->time();
  const std::span<const double> integrated = integrator_->state();
  std::copy(integrated.begin(), integrated.end(), after_.begin());
  step.before = std::span(state_).first(integrated.size());
  step.after = std::span(after_).first(integrated.size());
  step.found = &found_;
  step.is_observed = is_to_be_observed(step.time);
  if (!has_end_rates_ && (step.is_observed || integrator_->uses_offered_rates() || !followers_.empty()))
    evaluate_end(instants_.before(step.time), step.after, step.is_observed);
  if (step.is_observed) {
    end_.follow(step.time, found_.step, machine_.spin(step.after).speed);
    observed_time_ = step.time;
  }
  step.is_cut = instants_.contains(step.time);
  step.is_last = step.time >= end_time_ || end_.is_reached();
  return step;
}

void DropLoop::ask(bool is_observed) {
  found_.wants_step = is_observed;
  found_.wants_details = is_observed && wants_details_;
}

void DropLoop::evaluate_end(double t, std::span<const double> y, bool is_observed) {
  ask(is_observed);
  machine_.evaluate(t, y, found_);
  integrator_->offer_rates(found_.rates);
}

/// Every step, or as often as peaks need: where an evaluation comes on top of the method's own,
/// and where stability keeps steps that short, since what is observed and who looks at it cost as much as the rates.
bool DropLoop::is_to_be_observed(double t) const {
  constexpr double short_step = 4.5e-6;  // [s]
  const bool costs_little = integrator_->uses_offered_rates() && mean_step_ > short_step;
  return costs_little || t - observed_time_ >= often_enough_ || t >= end_time_ ||
         std::any_of(observers_.begin(), observers_.end(),
                     [t](const Observer* observer) { return is_same_time(observer->due(), t); });
}

std::span<const double> DropLoop::state() const {
  followers_.fill(time_, state_);
  return state_;
}

IntegrationStatistics DropLoop::statistics() const {
  IntegrationStatistics s = integrator_ ? integrator_->statistics() : IntegrationStatistics{};
  s.steps += earlier_.steps;
  s.rhs_evaluations += earlier_.rhs_evaluations;
  s.rejected_steps += earlier_.rejected_steps;
  return s;
}

void DropLoop::pack(PackedValues& to) const {
  const auto s = statistics();
  to["loop"] = {static_cast<double>(s.steps), static_cast<double>(s.rhs_evaluations),
                static_cast<double>(s.rejected_steps), observed_time_, mean_step_};
  to["end condition"] = end_.packed();
  if (!followers_.empty()) {
    auto& values = to["followers"] = {last_start_, followers_.time()};
    values.insert(values.end(), followers_.state().begin(), followers_.state().end());
  }
  for (const Observer* observer : observers_) observer->pack(to);
}

void DropLoop::unpack(double time, std::span<const double> state, const PackedValues& from) {
  const auto& loop = from.at("loop");
  if (loop.size() != 5 || state.size() != state_.size() || !(time >= 0. && time <= end_time_) ||
      !std::all_of(state.begin(), state.end(), [](double y) { return std::isfinite(y); }))
    throw std::invalid_argument("a checkpoint of another kind");
  end_.unpack(from.at("end condition"));
  for (Observer* observer : observers_) observer->unpack(from);
  time_ = time;
  std::copy(state.begin(), state.end(), state_.begin());
  if (!followers_.empty()) {
    const auto& values = from.at("followers");
    if (values.size() != 2 + state_.size() || !(values[1] <= time))
      throw std::invalid_argument("a checkpoint of another kind");
    last_start_ = values[0];
    const auto begun = std::span(values).subspan(2);
    machine_.evaluate(values[1], begun, found_);
    followers_.begin(values[1], begun, found_);
    // While a step is shown, it has not been followed yet.
    machine_.evaluate(time_, state_, found_);
    followers_.follow(last_start_, time_, state_, found_);
  }
  earlier_ = {static_cast<long>(loop[0]), static_cast<long>(loop[1]), static_cast<long>(loop[2])};
  observed_time_ = loop[3];
  mean_step_ = loop[4];
}

}  // namespace rotordrop
