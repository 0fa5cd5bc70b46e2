#include "analysis/memory_series.h"

#include <algorithm>
#include <stdexcept>

namespace rotordrop {

MemorySeries::MemorySeries(const Machine& machine, Drop& drop, const Choice& is_kept) {
  using Lists = std::initializer_list<const std::vector<Observable>*>;
  const auto own = drop.sections().observables();
  const auto& rows =
      groups_.emplace_back("/time", Lists{&machine.step_observables(), &machine.state_observables()}, is_kept);
  const bool has_state_rows = std::any_of(rows.kept.begin(), rows.kept.end(), [&](const Kept& k) {
    return k.first >= machine.n_step() && !Machine::is_held(k.path);
  });
  if (!rows.kept.empty()) drop.rows().add(groups_.back(), has_state_rows ? RowNeeds::all : RowNeeds::step);
  if (const auto& details = groups_.emplace_back("/detail/time", Lists{&machine.detail_observables()}, is_kept);
      !details.kept.empty())
    drop.detail_rows().add(groups_.back());
  drop.sections().add(groups_.emplace_back("/windows/time", Lists{&own}, is_kept));
}

MemorySeries::Group::Group(std::string times_path, std::initializer_list<const std::vector<Observable>*> lists,
                           const Choice& is_kept)
    : path(std::move(times_path)) {
  std::size_t at = 0;
  for (const auto* list : lists)
    for (const auto& o : *list) {
      if (!is_kept || is_kept(o.name)) kept.push_back({o.name, o.unit, o.long_name, at, o.size, o.columns, {}});
      at += o.size;
    }
}

void MemorySeries::Group::row(double time, std::span<const double> values) {
  if (kept.empty()) return;
  times.push_back(time);
  for (auto& k : kept) {
    const auto part = values.subspan(k.first, k.size);
    k.values.insert(k.values.end(), part.begin(), part.end());
  }
}

std::pair<const MemorySeries::Group*, const MemorySeries::Kept*> MemorySeries::find(const std::string& path) const {
  for (const auto& group : groups_)
    for (const auto& k : group.kept)
      if (k.path == path) return {&group, &k};
  return {nullptr, nullptr};
}

bool MemorySeries::has(const std::string& path) const { return find(path).second != nullptr; }

SeriesInMemory MemorySeries::series(const std::string& path, std::size_t column) const {
  const auto [group, found] = find(path);
  if (!found || column >= found->size)
    throw std::out_of_range("no series " + path + ", column " + std::to_string(column) + ", is kept");
  SeriesInMemory s{group->times, {}};
  s.values.reserve(s.times.size());
  for (std::size_t at = column; at < found->values.size(); at += found->size) s.values.push_back(found->values[at]);
  return s;
}

void MemorySeries::restore(const std::function<std::vector<double>(const std::string& path)>& read) {
  for (auto& group : groups_) {
    if (group.kept.empty()) continue;
    group.times = read(group.path);
    for (auto& k : group.kept) {
      k.values = read(k.path);
      if (k.values.size() != group.times.size() * k.size)
        throw std::invalid_argument("rows of " + k.path + " are missing");
    }
  }
}

}  // namespace rotordrop
