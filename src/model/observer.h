#pragma once
#include <limits>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "base/row_tile.h"
#include "model/evaluation.h"

namespace rotordrop {

/// Numbers of observers in a checkpoint, by name.
using PackedValues = std::map<std::string, std::vector<double>>;

/// A step that a run has taken, as its observers see it. The first one has no length: the run's start.
struct Step {
  double start = 0, time = 0;             ///< [s]
  std::span<const double> before, after;  ///< what is integrated, at start and at time
  bool is_observed = false;               ///< whether `found` holds an evaluation at `time`, with the step observables
  bool is_last = false;                   ///< the run ends here
  bool is_cut = false;                    ///< it ends at a known instant, and the next one begins anew
  const Evaluation* found = nullptr;
  /// Whole state at a time within the step. @throws SolverError for one outside
  virtual void interpolate(double t, std::span<double> y) const = 0;

 protected:
  ~Step() = default;
};

/// Watches a run step by step.
class Observer {
 public:
  Observer() = default;
  Observer(const Observer&) = delete;
  Observer& operator=(const Observer&) = delete;
  virtual ~Observer() = default;

  /// After every step, and once at the start of a run that is not resumed.
  virtual void step(const Step& step) = 0;
  /// A time [s] at which it wants an evaluation if a step ends just there.
  [[nodiscard]] virtual double due() const { return std::numeric_limits<double>::infinity(); }
  /// Whether evaluations that it sees must hold the detailed observables.
  [[nodiscard]] virtual bool wants_details() const { return false; }
  /// For checkpoints: all that decides about what it tells later.
  virtual void pack(PackedValues&) const {}
  /// @throws std::logic_error if something is missing or does not fit
  virtual void unpack(const PackedValues&) {}
};

/// Takes rows of observed values: a file, a list in memory, a check.
class RowSink {
 public:
  RowSink() = default;
  RowSink(const RowSink&) = delete;
  RowSink& operator=(const RowSink&) = delete;
  virtual ~RowSink() = default;
  virtual void row(double time, std::span<const double> values) = 0;
  /// Whether rows() is called for rows that were evaluated side by side; else row() is, for each.
  [[nodiscard]] virtual bool takes_tiles() const { return false; }
  virtual void rows(const RowTile& tile) {
    std::vector<double> values(tile.row_size);
    for (std::size_t i = 0; i < tile.n_rows(); ++i) {
      tile.copy_row(i, values);
      row(tile.times[i], values);
    }
  }
};

}  // namespace rotordrop
