#include "analysis/memory_series.h"

#include <algorithm>
#include <stdexcept>

namespace rotordrop {

MemorySeries::MemorySeries(const Machine& machine, Drop& drop, const std::vector<std::string>& paths) {
  drop.rows().add(groups_.emplace_back(
      std::initializer_list<const std::vector<Observable>*>{&machine.step_observables(), &machine.state_observables()},
      paths));
  drop.detail_rows().add(groups_.emplace_back(
      std::initializer_list<const std::vector<Observable>*>{&machine.detail_observables()}, paths));
  const auto own = drop.sections().observables();
  drop.sections().add(groups_.emplace_back(std::initializer_list<const std::vector<Observable>*>{&own}, paths));
}

MemorySeries::Group::Group(std::initializer_list<const std::vector<Observable>*> lists,
                           const std::vector<std::string>& paths) {
  std::size_t at = 0;
  for (const auto* list : lists)
    for (const auto& o : *list) {
      if (paths.empty() || std::find(paths.begin(), paths.end(), o.name) != paths.end())
        kept.push_back({o.name, at, o.size, {}});
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

std::vector<std::string> MemorySeries::paths() const {
  std::vector<std::string> list;
  for (const auto& group : groups_)
    for (const auto& k : group.kept) list.push_back(k.path);
  return list;
}

}  // namespace rotordrop
