#include "analysis/drop_lanes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "analysis/lanes/scalars_in_lanes.h"
#include "integrate/exponential_stages.h"
#include "integrate/lane_integrator.h"
#include "machine/lanes/machine_lanes.h"

namespace rotordrop {

std::string why_not_in_lanes(const Machine& machine, const IntegrationParameters& integration) {
  if (runs_in_lanes(integration.method)) {
    if (!fast_oscillators(machine.oscillators(), integration).empty())
      return "its rotor has modes above integration.exponential_above";
    return why_not_in_lanes(machine);
  }
  std::string names;
  for (const auto& kind : integration_methods)
    if (runs_in_lanes(kind.method)) names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", kind.name);
  return "integration.method is none of " + names;
}

bool are_alike(const Machine& a, const IntegrationParameters& a_integration, const Machine& b,
               const IntegrationParameters& b_integration) {
  return runs_in_lanes(a_integration.method) && a_integration.method == b_integration.method && are_alike(a, b);
}

namespace {

constexpr std::size_t width = LaneSystem::width;

/// A drop and its loop's integrator; none: the lane is free.
struct Lane {
  Drop* drop = nullptr;
  LaneView* view = nullptr;
  [[nodiscard]] DropLoop& loop() const { return drop->loop(); }
};

/// Interpolates the states of the next rows of all lanes that lie within their last steps: at once, which costs less than lane by lane.
void interpolate_rows(std::span<const Lane> lanes, LaneIntegrator& integrator) {
  std::array<double, width> t;
  bool is_any_due = false;
  for (std::size_t l = 0; l < width; ++l) {
    t[l] = integrator.time(l);
    if (!integrator.has_stepped(l)) continue;
    const double due = lanes[l].drop->rows().due_ahead();
    if (!(due < t[l]) || due <= lanes[l].loop().time()) continue;
    t[l] = due;
    is_any_due = true;
  }
  if (is_any_due) integrator.interpolate_all(t);
}

/// Drops from a feed in eight lanes.
class LaneRun {
 public:
  LaneRun(LaneFeed& feed, const std::function<bool()>& is_stopped) : feed_(feed), is_stopped_(is_stopped) {}

  std::size_t run() {
    fill();
    if (!integrator_) return 0;
    while (busy() != lanes_.end()) {
      integrator_->advance();
      interpolate_rows(lanes_, *integrator_);
      std::array<double, width> told{}, t{};
      for (std::size_t l = 0; l < width; ++l) {
        if (!integrator_->has_stepped(l)) continue;
        follow(l);
        told[l] = lanes_[l].loop().has_observed_last_step() ? 1. : 0.;
        t[l] = integrator_->time(l);
      }
      scalars_->follow(told, t, integrator_->step_values());
      if (is_stopped_ && is_stopped_()) break;
      if (end_those_over()) fill();
    }
    for (std::size_t l = 0; l < width; ++l)
      if (lanes_[l].drop) end(l);
    return n_begun_;
  }

 private:
  using Lanes = std::array<Lane, width>;
  [[nodiscard]] static LaneIntegrator::Lane start_of(const Drop& drop) {
    const DropLoop& loop = drop.loop();
    return {.parameters = loop.integration(),
            .start_time = loop.time(),
            .end_time = loop.end_time(),
            .layout = &loop.machine().layout(),
            .state = loop.state(),
            .n_details = loop.found().wants_details ? loop.machine().n_details() : 0,
            .instants = loop.instants()};
  }

  /// A lane that is not free; the end of lanes_ if all are.
  [[nodiscard]] Lanes::const_iterator busy() const {
    return std::find_if(lanes_.begin(), lanes_.end(), [](const Lane& lane) { return lane.drop; });
  }

  /// Begins drops in the lanes that are free. Those that stay so repeat the machine of another lane.
  void fill() {
    if (busy() == lanes_.end()) integrator_ = nullptr;  // the next ones may be of another kind
    std::vector<std::size_t> begun;
    for (std::size_t l = 0; l < width; ++l) {
      if (lanes_[l].drop) continue;
      lanes_[l].drop = feed_.next();
      if (!lanes_[l].drop) break;
      begun.push_back(l);
    }
    const auto any = busy();
    if (any == lanes_.end()) return;
    std::vector<const Machine*> machines;
    for (const Lane& lane : lanes_) machines.push_back(&(lane.drop ? lane : *any).loop().machine());
    auto system = make_lanes(machines);
    if (integrator_) {
      integrator_->exchange(std::move(system));
    } else {
      integrator_ =
          std::make_shared<LaneIntegrator>(std::move(system), start_of(*any->drop), any->loop().machine().n_step());
      scalars_ = make_scalars_in_lanes(any->drop->scalars().columns());
    }
    for (const std::size_t l : begun) {
      integrator_->begin(l, start_of(*lanes_[l].drop));
      show(l);
    }
  }

  /// The drop of a lane takes its first look.
  void show(std::size_t l) {
    ++n_begun_;
    Drop& drop = *lanes_[l].drop;
    auto view = std::make_unique<LaneView>(integrator_, l);
    lanes_[l].view = view.get();
    failures_[l] = nullptr;
    drop.rows().thin_out();
    unless_it_fails(l, [&] { drop.loop().start(std::move(view)); });
    scalars_->take(l, drop.scalars().let_go());
  }

  void follow(std::size_t l) {
    const Lane& lane = lanes_[l];
    unless_it_fails(l, [&] {
      lane.view->update();
      Evaluation& found = lane.loop().found();
      found.time = integrator_->time(l);
      found.is_whole = false;
      std::ranges::copy(integrator_->step_values(l), found.step.begin());
      if (found.wants_details) integrator_->details(l, found.details);
      if (lane.loop().follow_step()) integrator_->stop(l);
    });
  }

  /// A lane that fails stops; the others go on.
  template <class Act>
  void unless_it_fails(std::size_t l, Act&& act) {
    try {
      act();
    } catch (...) {
      failures_[l] = std::current_exception();
      integrator_->stop(l);
    }
  }

  /// Whether there were any.
  bool end_those_over() {
    bool is_any_over = false;
    for (std::size_t l = 0; l < width; ++l) {
      if (!lanes_[l].drop || integrator_->runs(l)) continue;
      end(l);
      is_any_over = true;
    }
    return is_any_over;
  }

  void end(std::size_t l) {
    const Lane lane = std::exchange(lanes_[l], {});
    lane.view->update();
    lane.drop->scalars().take_back(scalars_->of(l));
    std::exception_ptr failure = integrator_->failure(l) ? integrator_->failure(l) : failures_[l];
    if (!failure) {
      try {
        lane.drop->finish();
      } catch (...) {
        failure = std::current_exception();
      }
    }
    feed_.over(*lane.drop, failure);
  }

  LaneFeed& feed_;
  const std::function<bool()>& is_stopped_;
  std::shared_ptr<LaneIntegrator> integrator_;
  std::unique_ptr<ScalarsInLanes> scalars_;
  Lanes lanes_;
  std::array<std::exception_ptr, width> failures_;
  std::size_t n_begun_ = 0;
};

/// A list of drops.
class ListFeed final : public LaneFeed {
 public:
  explicit ListFeed(std::span<Drop* const> drops) : drops_(drops) { failures_.resize(drops.size()); }
  Drop* next() override { return next_ < drops_.size() ? drops_[next_++] : nullptr; }
  void over(Drop& drop, const std::exception_ptr& failure) override {
    failures_[static_cast<std::size_t>(std::find(drops_.begin(), drops_.end(), &drop) - drops_.begin())] = failure;
  }
  [[nodiscard]] std::vector<std::exception_ptr> failures() && { return std::move(failures_); }

 private:
  std::span<Drop* const> drops_;
  std::vector<std::exception_ptr> failures_;
  std::size_t next_ = 0;
};

}  // namespace

std::size_t run_in_lanes(LaneFeed& feed, const std::function<bool()>& is_stopped) {
  return LaneRun(feed, is_stopped).run();
}

std::vector<std::exception_ptr> run_in_lanes(std::span<Drop* const> drops, const std::function<bool()>& is_stopped) {
  ListFeed feed(drops);
  run_in_lanes(feed, is_stopped);
  return std::move(feed).failures();
}

}  // namespace rotordrop
