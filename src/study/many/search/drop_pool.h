#pragma once
#include <atomic>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

#include "study/many/journal.h"
#include "study/many/search/search_space.h"
#include "study/many/study_run.h"

namespace rotordrop {

/// Thrown to those who wait for drops when no further one is begun.
struct SearchStopped {};

/// Threads that run the drops of searches. Drops that the journal knows are not run again: a search that is repeated from its start comes to
/// where it stood.
class DropPool {
 public:
  /// @param earlier  drops that are finished, by their numbers
  DropPool(const Study& study, const StudyOptions& options, Journal& journal, Journal::Content earlier,
           unsigned n_workers);
  DropPool(const DropPool&) = delete;
  DropPool& operator=(const DropPool&) = delete;
  ~DropPool();

  /// Runs all drops of some evaluations and waits for them. May be called from several threads.
  /// @param first   number of the first drop
  /// @param rows    of all evaluations, as many for each
  /// @param values  of the searched parameters [evaluations]
  /// @throws SearchStopped if not all were run
  std::vector<PointResult> run(std::size_t first, const Design& rows, const std::vector<std::vector<double>>& values);

  struct Counts {
    std::size_t done = 0, failed = 0, here = 0;  ///< here: by this process
    double working = 0;                          ///< time that workers had a drop [s]
  };
  [[nodiscard]] Counts counts() const;
  [[nodiscard]] bool is_over() const;
  [[nodiscard]] bool is_stopped_by_failure() const { return is_stopped_by_failure_; }
  /// What stopped a worker; none if nothing did.
  [[nodiscard]] std::exception_ptr error() const;

 private:
  struct Task {
    std::size_t number = 0;
    StudyPoint point;
    const std::vector<double>* at = nullptr;
    PointResult* result = nullptr;
    std::size_t* n_left = nullptr;
  };
  void work();
  void compute(const Task& task);

  const Study& study_;
  const StudyOptions& options_;
  Journal& journal_;
  const Journal::Content earlier_;
  mutable std::mutex lock_;
  std::condition_variable waiting_, finished_;
  std::deque<Task> tasks_;
  Counts counts_;
  std::exception_ptr error_;
  bool is_closed_ = false;  ///< no further task comes
  std::atomic<bool> is_stopped_by_failure_{false}, has_error_{false};
  std::vector<std::jthread> workers_;
};

}  // namespace rotordrop
