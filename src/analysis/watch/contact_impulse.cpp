#include "analysis/watch/contact_impulse.h"

#include <algorithm>
#include <deque>
#include <optional>
#include <stdexcept>

#include "bearing/touchdown_bearing.h"

namespace rotordrop {
namespace {

/// Finds each touchdown bearing's impulse in a state; 0 of a support of others that is followed like one, and keeps none.
class Impulses {
 public:
  Impulses(const Machine& machine, const DropScalars& bearings) : machine_(machine) {
    for (std::size_t i = 0; i < bearings.size(); ++i) {
      const std::size_t support = bearings.support(i);
      const bool has_one = dynamic_cast<const TouchdownBearing*>(&machine.support(support)) != nullptr;
      supports_.push_back(has_one ? std::optional(support) : std::nullopt);
    }
  }
  [[nodiscard]] std::size_t size() const { return supports_.size(); }
  [[nodiscard]] std::vector<double> of(std::span<const double> y) const {
    std::vector<double> impulses;
    for (const auto& support : supports_)
      impulses.push_back(support ? machine_.ledger(*support, "contact impulse", y) : 0.);
    return impulses;
  }
  [[nodiscard]] std::size_t n_state() const { return machine_.layout().size(); }

 private:
  const Machine& machine_;
  std::vector<std::optional<std::size_t>> supports_;  // those that keep an impulse
};

class BeforeAKnownEnd final : public ContactImpulse {
 public:
  BeforeAKnownEnd(Impulses impulses, double end_time)
      : impulses_(std::move(impulses)),
        time_(std::max(end_time - averaging_time, 0.)),
        before_(impulses_.size(), 0.),
        state_(impulses_.n_state()) {}
  void step(const Step& step) override {
    if (is_passed_ || step.time < time_) return;
    is_passed_ = true;
    if (time_ <= 0.) return;
    step.interpolate(std::min(time_, step.time), state_);
    before_ = impulses_.of(state_);
  }
  void pack(PackedValues& to) const override {
    auto& values = to["impulse"] = before_;
    values.push_back(is_passed_ ? 1. : 0.);
  }
  void unpack(const PackedValues& from) override {
    const auto& values = from.at("impulse");
    if (values.size() != before_.size() + 1) throw std::invalid_argument("impulses of another machine");
    before_.assign(values.begin(), values.end() - 1);
    is_passed_ = values.back() != 0.;
  }
  [[nodiscard]] double start() const override { return is_passed_ ? time_ : 0.; }
  [[nodiscard]] std::vector<double> before() const override { return before_; }

 private:
  Impulses impulses_;
  double time_;
  std::vector<double> before_, state_;
  bool is_passed_ = false;
};

class SlidingBeforeTheEnd final : public ContactImpulse {
 public:
  explicit SlidingBeforeTheEnd(Impulses impulses) : impulses_(std::move(impulses)) {}
  void step(const Step& step) override {
    constexpr double spacing = 0.1 * averaging_time;
    if (step.time == step.start) return;
    if (!recent_.empty() && step.time - recent_.back().time < spacing && !step.is_last) return;
    while (recent_.size() > 1 && recent_[1].time <= step.time - averaging_time) recent_.pop_front();
    if (!step.is_last) recent_.push_back({step.time, impulses_.of(step.after)});
  }
  void pack(PackedValues& to) const override {
    auto& values = to["recent impulses"];
    for (const auto& recent : recent_) {
      values.push_back(recent.time);
      values.insert(values.end(), recent.impulse.begin(), recent.impulse.end());
    }
  }
  void unpack(const PackedValues& from) override {
    const auto& values = from.at("recent impulses");
    const std::size_t size = 1 + impulses_.size();
    if (values.size() % size != 0) throw std::invalid_argument("impulses are missing");
    recent_.clear();
    for (auto at = values.begin(); at != values.end(); at += static_cast<std::ptrdiff_t>(size))
      recent_.push_back({*at, {at + 1, at + static_cast<std::ptrdiff_t>(size)}});
  }
  [[nodiscard]] double start() const override { return recent_.empty() ? 0. : recent_.front().time; }
  [[nodiscard]] std::vector<double> before() const override {
    return recent_.empty() ? std::vector<double>(impulses_.size(), 0.) : recent_.front().impulse;
  }

 private:
  struct Recent {
    double time;                  // [s]
    std::vector<double> impulse;  // of each touchdown bearing [N s]
  };
  Impulses impulses_;
  std::deque<Recent> recent_;
};

}  // namespace

std::unique_ptr<ContactImpulse> make_contact_impulse(const Machine& machine, const DropScalars& bearings,
                                                     const RunParameters& run) {
  Impulses impulses(machine, bearings);
  if (run.until == EndCondition::time) return std::make_unique<BeforeAKnownEnd>(std::move(impulses), run.latest_end());
  return std::make_unique<SlidingBeforeTheEnd>(std::move(impulses));
}

}  // namespace rotordrop
