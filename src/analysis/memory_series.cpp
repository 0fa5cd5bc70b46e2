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
  std::size_t at = 0, n_kept = 0;
  for (const auto* list : lists)
    for (const auto& o : *list) {
      if (!is_kept || is_kept(o.name)) {
        kept.push_back({o.name, o.unit, o.long_name, at, o.size, o.columns, n_kept});
        if (!parts_.empty() && parts_.back().first + parts_.back().size == at)
          parts_.back().size += o.size;
        else
          parts_.push_back({at, o.size});
        n_kept += o.size;
      }
      at += o.size;
    }
  row_.resize(n_kept);
  tile_.resize(n_kept * RowTile::width);
  rows_ = RowStore(n_kept);
}

void MemorySeries::Group::row(double time, std::span<const double> values) {
  if (kept.empty()) return;
  times.push_back(time);
  auto to = row_.begin();
  for (const auto& part : parts_) {
    const auto from = values.subspan(part.first, part.size);
    to = std::copy(from.begin(), from.end(), to);
  }
  rows_.append(row_);
}

void MemorySeries::Group::rows(const RowTile& tile) {
  if (kept.empty()) return;
  times.insert(times.end(), tile.times.begin(), tile.times.end());
  double* to = tile_.data();
  for (const auto& part : parts_)
    for (std::size_t k = part.first; k < part.first + part.size; ++k, to += RowTile::width)
      std::copy_n(tile.values + k * RowTile::width, tile.n_rows(), to);
  rows_.append(RowTile{tile.times, tile_.data(), row_.size()});
}

std::vector<double> MemorySeries::Group::values(std::size_t column, std::size_t size) const {
  std::vector<double> list(rows_.n_rows() * size);
  rows_.copy(column, size, list.data());
  return list;
}

void MemorySeries::Group::restore(const std::function<std::vector<double>(const std::string& path)>& read) {
  if (kept.empty()) return;
  times = read(path);
  std::vector<std::vector<double>> lists;
  for (const auto& k : kept)
    if (lists.emplace_back(read(k.path)).size() != times.size() * k.size)
      throw std::invalid_argument("rows of " + k.path + " are missing");
  rows_.clear();
  for (std::size_t i = 0; i < times.size(); ++i) {
    for (std::size_t j = 0; j < kept.size(); ++j)
      std::copy_n(lists[j].begin() + static_cast<std::ptrdiff_t>(i * kept[j].size), kept[j].size,
                  row_.begin() + static_cast<std::ptrdiff_t>(kept[j].column));
    rows_.append(row_);
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
  return {group->times, group->values(found->column + column, 1)};
}

void MemorySeries::restore(const std::function<std::vector<double>(const std::string& path)>& read) {
  for (auto& group : groups_) group.restore(read);
}

}  // namespace rotordrop
