#include "analysis/drop_lanes.h"

#include <algorithm>
#include <array>

#include "integrate/lane_integrator.h"
#include "machine/lanes/machine_lanes.h"

namespace rotordrop {

std::string why_not_in_lanes(const Machine& machine, const IntegrationParameters& integration) {
  if (!runs_in_lanes(integration.method)) return "integration.method is neither \"tsitouras\" nor \"bogacki-shampine\"";
  return why_not_in_lanes(machine);
}

bool are_alike(const Machine& a, const IntegrationParameters& a_integration, const Machine& b,
               const IntegrationParameters& b_integration) {
  return runs_in_lanes(a_integration.method) && a_integration.method == b_integration.method && are_alike(a, b);
}

namespace {

/// A drop, its loop's integrator, and where its steps' values go.
struct Lane {
  Drop* drop = nullptr;
  LaneView* view = nullptr;
  [[nodiscard]] DropLoop& loop() const { return drop->loop(); }
};

/// Evaluates the next rows of all lanes that lie within their last steps.
class RowsAhead {
 public:
  explicit RowsAhead(std::size_t n_step) : values_(n_step * width) {}
  void evaluate(std::span<const Lane> lanes, LaneIntegrator& integrator) {
    std::array<double, width> t;
    bool is_any_due = false;
    for (std::size_t l = 0; l < width; ++l) {
      t[l] = integrator.time(l);
      if (l >= lanes.size() || !integrator.has_stepped(l)) continue;
      const double due = lanes[l].drop->rows().due_ahead();
      if (!(due < t[l]) || due <= lanes[l].loop().time()) continue;
      t[l] = due;
      is_any_due = true;
    }
    if (!is_any_due) return;
    integrator.observe_within(t, values_);
    for (std::size_t l = 0; l < lanes.size(); ++l) {
      if (!integrator.has_stepped(l) || t[l] == integrator.time(l)) continue;
      const auto ahead = lanes[l].drop->rows().ahead(t[l]);
      for (std::size_t i = 0; i < ahead.size(); ++i) ahead[i] = values_[i * width + l];
    }
  }

 private:
  static constexpr std::size_t width = LaneSystem::width;
  std::vector<double> values_;  // [n_step][width]
};

void follow(const Lane& lane, LaneIntegrator& lanes, std::size_t l) {
  lane.view->update();
  Evaluation& found = lane.loop().found();
  found.time = lanes.time(l);
  found.is_whole = false;
  lanes.step_values(l, found.step);
  if (found.wants_details) lanes.details(l, found.details);
  if (lane.loop().follow_step()) lanes.stop(l);
}

}  // namespace

std::vector<std::exception_ptr> run_in_lanes(std::span<Drop* const> drops, const std::function<bool()>& is_stopped) {
  std::vector<const Machine*> machines;
  std::vector<LaneIntegrator::Lane> starts;
  bool wants_details = false;
  for (const Drop* drop : drops) {
    const DropLoop& loop = drop->loop();
    machines.push_back(&loop.machine());
    starts.push_back({loop.integration(), loop.time(), loop.end_time(), loop.state()});
    wants_details |= loop.found().wants_details;
  }
  const Machine& form = *machines.front();
  const auto shared = std::make_shared<LaneIntegrator>(make_lanes(machines), starts, form.n_step(),
                                                       wants_details ? form.n_details() : 0);
  LaneIntegrator& lanes = *shared;

  std::vector<std::exception_ptr> failures(drops.size());
  std::vector<Lane> running;
  for (std::size_t l = 0; l < drops.size(); ++l) {
    auto view = std::make_unique<LaneView>(shared, l, drops[l]->loop().state());
    running.push_back({drops[l], view.get()});
    drops[l]->rows().thin_out();
    drops[l]->loop().start(std::move(view));
  }
  RowsAhead rows(form.n_step());
  while (lanes.any_runs()) {
    lanes.advance();
    rows.evaluate(running, lanes);
    for (std::size_t l = 0; l < running.size(); ++l) {
      if (lanes.has_stepped(l)) try {
          follow(running[l], lanes, l);
        } catch (...) {
          failures[l] = std::current_exception();
          lanes.stop(l);
        }
      if (lanes.failure(l)) failures[l] = lanes.failure(l);
    }
    if (is_stopped && is_stopped()) break;
  }
  for (std::size_t l = 0; l < drops.size(); ++l)
    if (!failures[l]) drops[l]->finish();
  return failures;
}

}  // namespace rotordrop
