#include "study/many/study_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <string_view>

#include "base/version.h"
#include "io/checkpoint.h"
#include "io/hdf5/column_file.h"
#include "study/many/answers/result_check.h"

namespace rotordrop {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A text for a table separated by commas.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c == '\n' ? ' ' : c);
  return result + "\"";
}
std::string cell(double value) { return std::isfinite(value) ? shortest(value) : ""; }
std::string cell(const Node& value) {
  return value.is_number() ? cell(value.number()) : cell(value.is_text() ? value.text() : to_text(value));
}

/// Columns of a parameter: under its name, and under each key that it sets.
std::vector<std::string> names_of(const VariedParameter& p) {
  std::vector<std::string> names{p.name};
  for (const auto& key : p.keys)
    if (key.name != p.name) names.push_back(key.name);
  return names;
}

TableColumn parameter_column(const Study& study, const Design& design, std::size_t i, std::size_t n) {
  const auto& p = study.parameters[i];
  TableColumn column;
  column.unit = p.unit();
  column.long_name = p.keys.front().declaration.help;
  const bool is_numeric = p.is_numeric();
  column.kind = is_numeric ? TableColumn::Kind::numbers : TableColumn::Kind::texts;
  for (std::size_t k = 0; k < n; ++k) {
    const Node value = point_of(study, design, k).values[i];
    if (is_numeric)
      column.numbers.push_back(value.number());
    else
      column.texts.push_back(value.is_text() ? value.text() : to_text(value));
  }
  return column;
}

void add_series(const StudyTable& table, std::vector<TableColumn>& columns) {
  for (const auto& [point, list] : table.series)
    for (const auto& s : list) {
      const std::string path = fmt::format("/series/{}{}", point, s.path);
      columns.push_back({path, s.unit, s.long_name, s.values, {}, {}, s.width, TableColumn::Kind::numbers});
      columns.push_back({path + "_time", "s", "time", s.time, {}, {}, 1, TableColumn::Kind::numbers});
    }
}

using Attributes = std::vector<std::pair<std::string, std::string>>;
Attributes attributes_of(const Study& study, const Design& design, const std::string& digest) {
  return {{"program", program_name()}, {"git_revision", git_revision()}, {"study", study.name},
          {"case", study.base.name},   {"design", name_of(design.kind)}, {"seed", std::to_string(study.design.seed)},
          {"digest", digest}};
}

bool is_series(const TableColumn& column) { return column.path.starts_with("/series/"); }

/// Every n-th value from the first on.
template <class T>
void thin_out(std::vector<T>& values, std::size_t first, std::size_t n) {
  std::vector<T> kept;
  for (std::size_t i = first; i < values.size(); i += n) kept.push_back(std::move(values[i]));
  values = std::move(kept);
}

/// Where the values of a result or of a point's series lie.
std::vector<TableColumn::Source> sources_of(const TableColumn& column, const std::vector<ShardFile>& shards) {
  std::vector<TableColumn::Source> sources;
  const std::size_t n = column.numbers.size() / column.width;
  for (const auto& s : shards) {
    if (!is_series(column))
      sources.push_back({s.file, s.shard - 1, s.n_shards, (n + s.n_shards - s.shard) / s.n_shards});
    else if (std::stoul(column.path.substr(std::string_view("/series/").size())) % s.n_shards == s.shard - 1)
      sources.push_back({s.file, 0, 1, n});
  }
  return sources;
}

}  // namespace

std::size_t StudyTable::count(PointStatus of) const {
  return static_cast<std::size_t>(std::count(status.begin(), status.end(), of));
}

const ResultColumn* StudyTable::find(const std::string& name) const {
  for (const auto& column : results)
    if (column.name == name) return &column;
  return nullptr;
}

StudyTable make_table(const Study& study, const Design& design, const std::map<std::size_t, PointRecord>& records,
                      const std::vector<std::vector<std::string>>& layouts) {
  StudyTable table;
  table.n_points = n_points(study, design);
  table.status.assign(table.n_points, PointStatus::not_run);
  table.reason.assign(table.n_points, "");
  // Names come in the order of the points, whatever the order in which these were finished.
  std::map<std::string, std::size_t> places;
  std::vector<std::vector<std::size_t>> columns_of(layouts.size());
  for (const auto& [point, record] : records) {
    if (point >= table.n_points) continue;
    table.status[point] = record.is_done ? PointStatus::done : PointStatus::failed;
    table.reason[point] = record.reason;
    table.cpu_time += record.cpu_time;
    if (!record.is_done) continue;
    auto& columns = columns_of.at(record.layout);
    if (columns.empty())
      for (const auto& name : layouts[record.layout]) {
        const auto [place, is_new] = places.emplace(name, table.results.size());
        if (is_new)
          table.results.push_back({name, unit_of_result(study, name), long_name_of_result(study, name),
                                   std::vector<double>(table.n_points, nan)});
        columns.push_back(place->second);
      }
    for (std::size_t i = 0; i < columns.size(); ++i) table.results[columns[i]].values[point] = record.values[i];
    if (!record.series.empty()) table.series.emplace(point, record.series);
  }
  return table;
}

namespace {

std::vector<TableColumn> columns_of(const Study& study, const Design& design, const StudyTable& table) {
  std::vector<TableColumn> columns;
  const std::size_t n = table.n_points;
  for (std::size_t i = 0; i < study.parameters.size(); ++i) {
    TableColumn column = parameter_column(study, design, i, n);
    for (const auto& name : names_of(study.parameters[i])) {
      column.path = "/parameters/" + name;
      columns.push_back(column);
    }
  }
  for (const auto& result : table.results)
    columns.push_back({"/results/" + result.name,
                       result.unit,
                       result.long_name,
                       result.values,
                       {},
                       {},
                       1,
                       TableColumn::Kind::numbers});
  TableColumn status{"/status", "", "0 done, 1 failed, 2 not run"}, row{"/design_row", "", "row of the design"},
      replicate{"/replicate", "", "replicate of that row"};
  status.kind = row.kind = replicate.kind = TableColumn::Kind::integers;
  for (std::size_t k = 0; k < n; ++k) {
    status.integers.push_back(static_cast<int>(table.status[k]));
    row.integers.push_back(static_cast<std::int64_t>(k) / study.n_replicates);
    replicate.integers.push_back(static_cast<std::int64_t>(k) % study.n_replicates);
  }
  TableColumn search{"/search", "", "search to which a point belongs"},
      evaluation{"/evaluation", "", "evaluation of that search"};
  search.kind = evaluation.kind = TableColumn::Kind::integers;
  for (std::size_t k = 0; k < n && !design.steps.empty(); ++k) {
    const SearchStep& step = design.step_of(k / static_cast<std::size_t>(study.n_replicates));
    search.integers.push_back(static_cast<std::int64_t>(step.search));
    evaluation.integers.push_back(static_cast<std::int64_t>(step.evaluation));
  }
  TableColumn reason{"/reason", "", "why a point failed, or what a second try changed", {}, {}, table.reason};
  reason.kind = TableColumn::Kind::texts;
  for (auto* column : {&status, &reason, &row, &replicate}) columns.push_back(std::move(*column));
  if (!design.steps.empty())
    for (auto* column : {&search, &evaluation}) columns.push_back(std::move(*column));
  add_series(table, columns);
  return columns;
}

}  // namespace

void write_study_hdf5(const std::filesystem::path& file, const Study& study, const Design& design,
                      const StudyTable& table, const std::string& digest, const std::vector<ShardFile>& shards) {
  auto columns = columns_of(study, design, table);
  for (auto& column : columns)
    if (is_series(column) || column.path.starts_with("/results/")) column.sources = sources_of(column, shards);
  write_columns(file, attributes_of(study, design, digest), columns);
}

void write_shard_hdf5(const std::filesystem::path& file, const Study& study, const Design& design,
                      const StudyTable& table, const std::string& digest, std::size_t shard, std::size_t n_shards) {
  auto columns = columns_of(study, design, table);
  TableColumn point{"/point", "", "number of the point in the study"};
  point.kind = TableColumn::Kind::integers;
  point.integers.resize(table.n_points);
  std::iota(point.integers.begin(), point.integers.end(), 0);
  columns.push_back(std::move(point));
  for (auto& column : columns) {
    if (is_series(column)) continue;
    thin_out(column.numbers, shard - 1, n_shards);
    thin_out(column.integers, shard - 1, n_shards);
    thin_out(column.texts, shard - 1, n_shards);
  }
  auto attributes = attributes_of(study, design, digest);
  attributes.emplace_back("shard", fmt::format("{}/{}", shard, n_shards));
  write_columns(file, attributes, columns);
}

void write_study_csv(const std::filesystem::path& file, const Study& study, const Design& design,
                     const StudyTable& table) {
  std::set<std::string> parameters;
  for (const auto& p : study.parameters)
    for (const auto& name : names_of(p)) parameters.insert(name);
  std::string text = "point,design_row,replicate,status,reason";
  if (!design.steps.empty()) text += ",search,evaluation";
  for (const auto& p : study.parameters)
    for (const auto& name : names_of(p)) text += "," + cell(name);
  // A drop may end before the varied run.end_time: the result keeps its own column, with its name in study.h5.
  for (const auto& result : table.results)
    text += "," + cell((parameters.contains(result.name) ? "results/" : "") + result.name);
  text += "\n";
  for (std::size_t k = 0; k < table.n_points; ++k) {
    const StudyPoint point = point_of(study, design, k);
    text += fmt::format("{},{},{},{},{}", k, point.row, point.replicate, static_cast<int>(table.status[k]),
                        cell(table.reason[k]));
    if (!design.steps.empty()) {
      const SearchStep& step = design.step_of(point.row);
      text += fmt::format(",{},{}", step.search, step.evaluation);
    }
    for (std::size_t i = 0; i < study.parameters.size(); ++i)
      for (std::size_t copy = 0; copy < names_of(study.parameters[i]).size(); ++copy)
        text += "," + cell(point.values[i]);
    for (const auto& result : table.results) text += "," + cell(result.values[k]);
    text += "\n";
  }
  write_text_atomically(file, text);
}

}  // namespace rotordrop
