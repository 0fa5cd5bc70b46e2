#pragma once
#include <algorithm>
#include <atomic>
#include <optional>
#include <vector>

namespace rotordrop {

/// Where the points come from that a process computes.
class PointSource {
 public:
  PointSource() = default;
  PointSource(const PointSource&) = delete;
  PointSource& operator=(const PointSource&) = delete;
  virtual ~PointSource() = default;
  // By the threads that compute.
  /// The next point; none: there is no further one. May wait.
  virtual std::optional<std::size_t> next() = 0;
  /// A further point without waiting for it.
  virtual std::optional<std::size_t> next_at_hand() = 0;
  /// How many points a worker that computes up to so many at once may begin with.
  [[nodiscard]] virtual std::size_t first_share(std::size_t most) const { return most; }
  /// A point is in the journal.
  virtual void finished(std::size_t /*point*/, bool /*is_done*/) {}
  // By the thread that follows them.
  /// Called often while they work and until is_complete(). @param is_over  no further point shall be begun
  virtual void serve(bool /*is_over*/) {}
  /// Whether nothing is under way anywhere else.
  [[nodiscard]] virtual bool is_complete() const { return true; }
  [[nodiscard]] virtual int serving_interval() const { return 200; }  ///< [ms]
  struct Elsewhere {
    std::size_t done = 0, failed = 0;
  };
  [[nodiscard]] virtual Elsewhere elsewhere() const { return {}; }
};

/// All points by this process.
class LocalPoints final : public PointSource {
 public:
  /// @param n_workers  that share them: none begins with more than its part
  explicit LocalPoints(std::vector<std::size_t> points, unsigned n_workers = 1)
      : points_(std::move(points)), n_workers_(n_workers) {}
  std::optional<std::size_t> next() override {
    const std::size_t i = next_.fetch_add(1);
    return i < points_.size() ? std::optional(points_[i]) : std::nullopt;
  }
  std::optional<std::size_t> next_at_hand() override { return next(); }
  [[nodiscard]] std::size_t first_share(std::size_t most) const override {
    return std::clamp<std::size_t>((points_.size() + n_workers_ - 1) / n_workers_, 1, most);
  }

 private:
  std::vector<std::size_t> points_;
  std::size_t n_workers_;
  std::atomic<std::size_t> next_{0};
};

}  // namespace rotordrop
