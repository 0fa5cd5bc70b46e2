#pragma once
#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>

#include "study/many/ranks/point_source.h"
#include "study/many/ranks/ranks.h"

namespace rotordrop {

/// Rank 0: computes points itself and gives points to the other ranks. Those of a rank that falls silent are computed here.
/// Silent is a rank that hangs, such as in a file system that does not answer or stopped by someone, or is lost under a launcher that lets
/// the others live. Open MPI's mpirun does so with --enable-recovery; without, it ends all ranks when one dies. The study then is complete, but
/// its launcher waits for a rank that hangs.
class SharedPoints final : public PointSource {
 public:
  /// @param stops_on_failure  a failed point anywhere ends the study
  /// @param tell              called when a rank is lost
  /// @param silence           after which a rank is given up
  SharedPoints(std::vector<std::size_t> points, Ranks& ranks, bool stops_on_failure,
               std::function<void(const std::string&)> tell,
               std::chrono::milliseconds silence = std::chrono::seconds(20));
  std::optional<std::size_t> next() override;
  std::optional<std::size_t> next_at_hand() override;
  void serve(bool is_over) override;
  [[nodiscard]] bool is_complete() const override;
  [[nodiscard]] int serving_interval() const override { return 2; }
  [[nodiscard]] Elsewhere elsewhere() const override;
  [[nodiscard]] bool is_anyone_lost() const { return is_anyone_lost_; }
  [[nodiscard]] bool is_stopped_by_failure() const { return is_stopped_by_failure_; }

 private:
  using Clock = std::chrono::steady_clock;
  std::optional<std::size_t> taken();
  void hear(const Ranks::Message& message);
  void give_up(int rank);

  Ranks& ranks_;
  std::function<void(const std::string&)> tell_;
  mutable std::mutex lock_;
  std::condition_variable changed_;
  std::vector<std::size_t> points_, returned_;
  std::size_t next_ = 0;
  struct Rank {
    std::set<std::size_t> given;
    Clock::time_point heard;
  };
  std::map<int, Rank> others_;  ///< that are at work
  Elsewhere elsewhere_;
  const bool stops_on_failure_;
  const std::chrono::milliseconds silence_;
  bool is_over_ = false, is_anyone_lost_ = false, is_stopped_by_failure_ = false;
};

/// Another rank: computes what rank 0 gives.
class GivenPoints final : public PointSource {
 public:
  /// @param n_ahead  points that are asked for before they are needed
  GivenPoints(Ranks& ranks, unsigned n_ahead);
  std::optional<std::size_t> next() override;
  std::optional<std::size_t> next_at_hand() override;
  void finished(std::size_t point, bool is_done) override;
  void serve(bool is_over) override;
  [[nodiscard]] int serving_interval() const override { return 2; }
  /// Tells rank 0 that the journal is complete and on the disk.
  void say_bye();
  [[nodiscard]] bool is_rank_0_lost() const { return is_rank_0_lost_; }

 private:
  std::optional<std::size_t> first_of_queue();
  using Clock = std::chrono::steady_clock;
  void report_finished();

  Ranks& ranks_;
  const unsigned n_ahead_;
  std::mutex lock_;
  std::condition_variable changed_;
  std::vector<std::size_t> queue_;
  std::vector<std::pair<std::size_t, bool>> finished_;
  unsigned n_asked_ = 0;
  bool is_over_ = false, is_rank_0_lost_ = false;
  Clock::time_point said_, asked_;
};

}  // namespace rotordrop
