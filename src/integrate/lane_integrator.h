#pragma once
#include <algorithm>
#include <array>
#include <exception>
#include <memory>
#include <span>
#include <vector>

#include "base/aligned_numbers.h"
#include "integrate/integrator.h"
#include "integrate/pairs.h"
#include "model/instants.h"
#include "model/lane_system.h"

namespace rotordrop {

/// Whether drops in lanes can be integrated by a method: one of our own embedded pairs.
[[nodiscard]] bool runs_in_lanes(IntegrationMethod method);

/// Integrates drops side by side by an embedded pair, each with its own time and step, as EmbeddedPair does one. A lane that rejects its step or has
/// ended keeps its state while the others go on.
class LaneIntegrator {
 public:
  static constexpr std::size_t width = LaneSystem::width;
  struct Lane {
    IntegrationParameters parameters;  ///< methods of all lanes are the same
    double start_time = 0, end_time = 0;
    const StateLayout* layout = nullptr;  ///< as long as that of the system
    std::span<const double> state;        ///< [layout->size()]
    std::size_t n_details = 0;            ///< that are observed at the end of every step
    Instants instants = {};               ///< at which steps end, and begin anew
  };
  /// All lanes are free, and stand where a drop starts.
  /// @param n_step  of what is observed at the end of every step
  LaneIntegrator(std::unique_ptr<LaneSystem> system, const Lane& like, std::size_t n_step);

  /// The same drops but for lanes that do not run: another drop of their kind begins there, or none.
  /// @param system  as before, with the new drops in their lanes
  void exchange(std::unique_ptr<LaneSystem> system) { system_ = std::move(system); }
  /// Begins a drop of the system in a lane that does not run. @throws std::invalid_argument for one of another kind
  void begin(std::size_t lane, const Lane& drop);

  /// Tries a step of every lane that runs; has_stepped() tells which of them took theirs.
  void advance();
  [[nodiscard]] bool runs(std::size_t lane) const { return runs_[lane]; }
  [[nodiscard]] bool has_stepped(std::size_t lane) const { return stepped_[lane] != 0.; }
  void stop(std::size_t lane) { runs_[lane] = false; }
  /// Why a lane came to a stop by itself; none: it did not.
  [[nodiscard]] const std::exception_ptr& failure(std::size_t lane) const { return failures_[lane]; }

  [[nodiscard]] double time(std::size_t lane) const { return time_[lane]; }
  /// Until the next advance(), or another drop begins there.
  [[nodiscard]] std::span<const double> state(std::size_t lane) const { return y_by_lane_.of(lane); }
  /// What was observed at the end of the lane's last step, for as long.
  [[nodiscard]] std::span<const double> step_values(std::size_t lane) const { return step_by_lane_.of(lane); }
  /// The same of all lanes that have stepped [n_step][width].
  [[nodiscard]] std::span<const double> step_values() const { return step_; }
  void details(std::size_t lane, std::span<double> values) const { column(details_, lane, values); }
  /// State at a time within the lane's last step.
  void interpolate(std::size_t lane, double t, std::span<double> y) const;
  /// Interpolates all lanes that have stepped at times of their own within their last steps: interpolate() there has it at hand then.
  /// @param t [width]
  void interpolate_all(std::span<const double> t);
  [[nodiscard]] IntegrationStatistics statistics(std::size_t lane) const { return statistics_[lane]; }

 private:
  using PerLane = std::array<double, width>;
  static void column(const AlignedNumbers& from, std::size_t lane, std::span<double> to) {
    for (std::size_t i = 0; i < to.size(); ++i) to[i] = from[i * width + lane];
  }
  /// Numbers of all lanes, those of each one after the other.
  struct ByLane {
    explicit ByLane(std::size_t n) : length(n), numbers(n * width) {}
    void lay_out(const AlignedNumbers& side_by_side);
    [[nodiscard]] std::span<const double> of(std::size_t lane) const {
      return {numbers.data() + lane * length, length};
    }
    std::size_t length;
    AlignedNumbers numbers;  // [width][length]
  };
  void start_begun();
  [[nodiscard]] bool have_all_stepped() const;
  /// Rates at the start of each lane's step.
  [[nodiscard]] AlignedNumbers& at_start() { return k_[static_cast<std::size_t>(shape_.start)]; }
  /// The state from which a stage is evaluated, of the first n numbers.
  void combine(std::size_t n, int stage);
  [[nodiscard]] PerLane error_sizes();
  void finish(std::size_t lane, double size);
  [[noreturn]] void fail(std::size_t lane, double size) const;

  std::unique_ptr<LaneSystem> system_;
  const EmbeddedTableau& shape_;                // what the lanes' methods have in common
  std::array<EmbeddedTableau, width> methods_;  // each with the ratio of its own steps
  std::size_t n_, n_controlled_;
  AlignedNumbers scale_;  // [n_controlled][width]
  std::array<Instants, width> instants_;
  PerLane time_{}, end_time_{}, longest_{}, tolerance_{}, next_step_{}, tried_{}, target_{}, last_step_{};
  PerLane stepped_{};  // 1 or 0: the last step was taken
  PerLane begun_{};    // 1 or 0: the first step, or the first after an instant, is still to come
  std::array<bool, width> runs_{}, was_rejected_{}, ends_{};
  std::vector<StepControl> control_;
  AlignedNumbers y_, before_, stage_, step_, details_;  // [n][width]
  ByLane y_by_lane_, step_by_lane_;
  PerLane within_time_{};  // of within_ [s]
  AlignedNumbers within_;  // [n][width], made when it is asked for
  std::vector<AlignedNumbers> k_;
  std::array<IntegrationStatistics, width> statistics_{};
  std::array<std::exception_ptr, width> failures_{};
};

/// One lane as an integrator that somebody else advances.
class LaneView final : public Integrator {
 public:
  LaneView(std::shared_ptr<const LaneIntegrator> lanes, std::size_t lane) : lanes_(std::move(lanes)), lane_(lane) {}
  /// Keeps the statistics. After the lane has stepped, and before another drop begins there.
  void update() { statistics_ = lanes_->statistics(lane_); }
  /// Time and state are the drop's until another one begins there.
  [[nodiscard]] double time() const override { return lanes_->time(lane_); }
  [[nodiscard]] std::span<const double> state() const override { return lanes_->state(lane_); }
  /// @throws std::logic_error always
  void advance() override;
  void offer_rates(std::span<const double>) override {}
  [[nodiscard]] bool uses_offered_rates() const override { return true; }
  /// Within the lane's last step.
  void interpolate(double t, std::span<double> y) const override { lanes_->interpolate(lane_, t, y); }
  [[nodiscard]] IntegrationStatistics statistics() const override { return statistics_; }

 private:
  std::shared_ptr<const LaneIntegrator> lanes_;
  std::size_t lane_;
  IntegrationStatistics statistics_{};
};

}  // namespace rotordrop
