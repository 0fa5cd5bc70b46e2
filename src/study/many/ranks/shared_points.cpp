#include "study/many/ranks/shared_points.h"

#include <fmt/format.h>

namespace rotordrop {
namespace {

using namespace std::chrono_literals;
constexpr auto heartbeat = 1s;
constexpr auto silence_of_rank_0 = 60s;
constexpr auto look_again = 50ms;

}  // namespace

SharedPoints::SharedPoints(std::vector<std::size_t> points, Ranks& ranks, bool stops_on_failure,
                           std::function<void(const std::string&)> tell, std::chrono::milliseconds silence)
    : ranks_(ranks),
      tell_(std::move(tell)),
      points_(std::move(points)),
      stops_on_failure_(stops_on_failure),
      silence_(silence) {
  for (int k = 1; k < ranks.size(); ++k) others_[k].heard = Clock::now();
}

std::optional<std::size_t> SharedPoints::taken() {
  if (is_over_) return {};
  if (!returned_.empty()) {
    const std::size_t point = returned_.back();
    returned_.pop_back();
    return point;
  }
  return next_ < points_.size() ? std::optional(points_[next_++]) : std::nullopt;
}

std::optional<std::size_t> SharedPoints::next() {
  std::unique_lock lock(lock_);
  for (;;) {
    if (const auto point = taken()) return point;
    // Points of a rank that is lost later come back here.
    bool is_any_given = false;
    for (const auto& [k, rank] : others_) is_any_given |= !rank.given.empty();
    if (is_over_ || !is_any_given) return {};
    changed_.wait_for(lock, look_again);
  }
}

std::optional<std::size_t> SharedPoints::next_at_hand() {
  const std::scoped_lock lock(lock_);
  return taken();
}

void SharedPoints::hear(const Ranks::Message& message) {
  const auto found = others_.find(message.from);
  if (found == others_.end()) {
    // Given up too early: what it has finished is in its journal all the same.
    if (message.kind == Ranks::Kind::want) ranks_.send(message.from, Ranks::Kind::give, -1);
    return;
  }
  Rank& rank = found->second;
  rank.heard = Clock::now();
  switch (message.kind) {
    case Ranks::Kind::want: {
      const auto point = taken();
      if (point) rank.given.insert(*point);
      ranks_.send(message.from, Ranks::Kind::give, point ? static_cast<long>(*point) : -1L);
      break;
    }
    case Ranks::Kind::done:
    case Ranks::Kind::failed:
      rank.given.erase(static_cast<std::size_t>(message.point));
      if (message.kind == Ranks::Kind::failed && stops_on_failure_) is_over_ = is_stopped_by_failure_ = true;
      ++(message.kind == Ranks::Kind::done ? elsewhere_.done : elsewhere_.failed);
      break;
    case Ranks::Kind::bye:
      returned_.insert(returned_.end(), rank.given.begin(), rank.given.end());  // it was interrupted
      others_.erase(found);
      break;
    default:
      break;
  }
  changed_.notify_all();
}

void SharedPoints::give_up(int rank) {
  const auto& given = others_[rank].given;
  if (tell_)
    tell_(fmt::format("rank {} is silent and given up; {} of its points are computed by rank 0", rank, given.size()));
  returned_.insert(returned_.end(), given.begin(), given.end());
  others_.erase(rank);
  is_anyone_lost_ = true;
  changed_.notify_all();
}

void SharedPoints::serve(bool is_over) {
  const std::scoped_lock lock(lock_);
  is_over_ |= is_over;
  while (const auto message = ranks_.receive()) hear(*message);
  std::vector<int> silent;
  for (const auto& [k, rank] : others_)
    if (Clock::now() - rank.heard > silence_) silent.push_back(k);
  for (const int k : silent) give_up(k);
}

bool SharedPoints::is_complete() const {
  const std::scoped_lock lock(lock_);
  return others_.empty() && (is_over_ || returned_.empty());
}

PointSource::Elsewhere SharedPoints::elsewhere() const {
  const std::scoped_lock lock(lock_);
  return elsewhere_;
}

GivenPoints::GivenPoints(Ranks& ranks, unsigned n_ahead)
    : ranks_(ranks), n_ahead_(n_ahead), said_(Clock::now()), asked_(Clock::now()) {}

std::optional<std::size_t> GivenPoints::next() {
  std::unique_lock lock(lock_);
  while (queue_.empty() && !is_over_) changed_.wait_for(lock, look_again);
  return first_of_queue();
}

std::optional<std::size_t> GivenPoints::next_at_hand() {
  const std::scoped_lock lock(lock_);
  return first_of_queue();
}

std::optional<std::size_t> GivenPoints::first_of_queue() {
  if (queue_.empty()) return {};
  const std::size_t point = queue_.front();
  queue_.erase(queue_.begin());
  return point;
}

void GivenPoints::finished(std::size_t point, bool is_done) {
  const std::scoped_lock lock(lock_);
  finished_.emplace_back(point, is_done);
}

void GivenPoints::report_finished() {
  for (const auto& [point, is_done] : finished_)
    ranks_.send(0, is_done ? Ranks::Kind::done : Ranks::Kind::failed, static_cast<long>(point));
  finished_.clear();
}

void GivenPoints::serve(bool is_over) {
  const std::scoped_lock lock(lock_);
  const auto now = Clock::now();
  if (!finished_.empty() || now - said_ > heartbeat) {
    if (finished_.empty()) ranks_.send(0, Ranks::Kind::alive, -1);
    report_finished();
    said_ = now;
  }
  while (const auto message = ranks_.receive()) {
    if (message->kind != Ranks::Kind::give) continue;
    --n_asked_;
    if (message->point < 0)
      is_over_ = true;
    else
      queue_.push_back(static_cast<std::size_t>(message->point));
  }
  if (n_asked_ > 0 && now - asked_ > silence_of_rank_0) is_over_ = is_rank_0_lost_ = true;
  if (is_over) {
    is_over_ = true;
    queue_.clear();
  }
  for (; !is_over_ && n_asked_ + queue_.size() < n_ahead_; ++n_asked_) {
    ranks_.send(0, Ranks::Kind::want, -1);
    asked_ = now;
  }
  changed_.notify_all();
}

void GivenPoints::say_bye() {
  const std::scoped_lock lock(lock_);
  report_finished();
  ranks_.send(0, Ranks::Kind::bye, -1);
}

}  // namespace rotordrop
