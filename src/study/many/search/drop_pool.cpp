#include "study/many/search/drop_pool.h"

#include <chrono>

#include "base/cpu_time.h"

namespace rotordrop {

using Clock = std::chrono::steady_clock;

DropPool::DropPool(const Study& study, const StudyOptions& options, Journal& journal, Journal::Content earlier,
                   unsigned n_workers)
    : study_(study), options_(options), journal_(journal), earlier_(std::move(earlier)) {
  for (unsigned k = 0; k < n_workers; ++k) workers_.emplace_back([this] { work(); });
}

DropPool::~DropPool() {
  {
    const std::scoped_lock lock(lock_);
    is_closed_ = true;
  }
  waiting_.notify_all();
}

bool DropPool::is_over() const { return is_stopped_by_failure_ || has_error_ || (options_.stop && *options_.stop); }

DropPool::Counts DropPool::counts() const {
  const std::scoped_lock lock(lock_);
  return counts_;
}

std::exception_ptr DropPool::error() const {
  const std::scoped_lock lock(lock_);
  return error_;
}

std::vector<PointResult> DropPool::run(std::size_t first, const Design& rows,
                                       const std::vector<std::vector<double>>& values) {
  const std::size_t n = n_points(study_, rows);
  std::vector<PointResult> results(n);
  std::size_t n_left = 0;
  std::unique_lock lock(lock_);
  for (std::size_t k = 0; k < n; ++k) {
    if (const auto known = earlier_.records.find(first + k); known != earlier_.records.end()) {
      results[k] = result_of(known->second, earlier_.layouts);
      ++(results[k].is_done ? counts_.done : counts_.failed);
      continue;
    }
    ++n_left;
    tasks_.push_back({first + k, point_of(study_, rows, k), &values[k * values.size() / n], &results[k], &n_left});
  }
  waiting_.notify_all();
  // Also after a stop: workers hold pointers into this frame until every task has come back.
  while (n_left > 0) finished_.wait(lock);
  for (const auto& result : results)
    if (result.is_interrupted) throw SearchStopped{};
  return results;
}

void DropPool::work() {
  std::unique_lock lock(lock_);
  for (;;) {
    waiting_.wait(lock, [this] { return !tasks_.empty() || is_closed_; });
    if (tasks_.empty()) return;
    const Task task = tasks_.front();
    tasks_.pop_front();
    lock.unlock();
    compute(task);
    lock.lock();
    if (--*task.n_left == 0) finished_.notify_all();
  }
}

void DropPool::compute(const Task& task) {
  task.result->is_interrupted = true;
  if (is_over()) return;
  const auto start = Clock::now();
  const double cpu = thread_cpu_seconds();
  try {
    PointResult result = run_point(study_, task.point, options_);
    if (result.is_interrupted) return;
    result.at = *task.at;
    journal_.append(task.number, result, thread_cpu_seconds() - cpu);
    if (!result.is_done && study_.on_failure == FailurePolicy::stop) is_stopped_by_failure_ = true;
    *task.result = std::move(result);
  } catch (...) {
    has_error_ = true;
    const std::scoped_lock lock(lock_);
    if (!error_) error_ = std::current_exception();
    return;
  }
  const std::scoped_lock lock(lock_);
  ++(task.result->is_done ? counts_.done : counts_.failed);
  ++counts_.here;
  counts_.working += std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace rotordrop
