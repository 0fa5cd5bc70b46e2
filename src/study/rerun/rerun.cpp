#include "study/rerun/rerun.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "base/errors.h"
#include "base/processor.h"
#include "base/version.h"
#include "base/wide_vectors.h"
#include "case/case_text.h"
#include "case/given_values.h"
#include "io/checkpoint.h"
#include "io/hdf5/recorded_series.h"
#include "io/sha256.h"
#include "study/recorded_drop.h"

namespace rotordrop {
namespace {

namespace fs = std::filesystem;

bool is_time_axis(const std::string& dataset) { return dataset.ends_with("/time"); }

std::string attribute_or_unknown(const fs::path& file, const std::string& name) {
  try {
    return read_attribute(file, "/", name);
  } catch (const DamagedFile&) {
    throw;
  } catch (const InputError&) {
    return "unknown";
  }
}

/// Files that the case names must be what they were.
void require_same_files(const fs::path& file, const std::vector<std::string>& datasets) {
  if (!std::binary_search(datasets.begin(), datasets.end(), std::string("/inputs"))) return;
  Faults faults;
  std::istringstream lines(read_text(file, "/inputs"));
  for (std::string line; std::getline(lines, line);) {
    const auto space = line.find(' ');
    if (space == std::string::npos) continue;
    const fs::path named = line.substr(space + 1);
    if (sha256_of_file(named) != line.substr(0, space))
      faults.add({named.string(), 0, 0}, "the file has changed since the drop was recorded.",
                 "Put back the one that the drop used, or run the case anew with `rotordrop run`.");
  }
  faults.throw_if_any();
}

/// Times of the rows of both files.
struct TimeAxes {
  std::vector<double> a, b;
  std::map<double, std::size_t> b_rows;  ///< row of each time, the last one of those that are equal

  TimeAxes() = default;
  TimeAxes(std::vector<double> of_a, std::vector<double> of_b) : a(std::move(of_a)), b(std::move(of_b)) {
    for (std::size_t i = 0; i < b.size(); ++i) b_rows[b[i]] = i;
  }
};

bool same_bits(const double* a, const double* b, std::size_t n) { return std::memcmp(a, b, n * sizeof(double)) == 0; }

/// All rows of a finished drop can be read, and the last one is that of its end. @throws DamagedFile
void require_whole(const fs::path& file, const std::vector<std::string>& datasets, double end) {
  std::map<std::string, std::size_t> n_rows;
  for (const auto& name : datasets) {
    if (!is_time_axis(name)) continue;
    const auto times = read_series(file, name).values;
    if (std::adjacent_find(times.begin(), times.end(), [](double a, double b) { return !(b > a); }) != times.end())
      throw DamagedFile({file.string()}, name + " does not rise.");
    constexpr double roundoff = 1e-12;
    if (name == "/time" && (times.empty() || !(std::fabs(times.back() - end) <= roundoff * end)))
      throw DamagedFile({file.string()}, fmt::format("its rows do not reach the end of the run, {:.6g} s.", end));
    n_rows[name] = times.size();
  }
  for (const auto& name : datasets) {
    const std::string axis = is_time_axis(name) ? "" : read_meaning(file, name).time_path;
    if (!axis.empty() && read_series(file, name).shape.at(0) < n_rows[axis])
      throw DamagedFile({file.string()}, name + " has fewer rows than " + axis + ".");
  }
}

}  // namespace

RecordedInput read_recorded_input(const fs::path& path) {
  RecordedInput input;
  std::error_code ignored;
  input.file = fs::is_directory(path, ignored) ? path / "results.h5" : path;
  if (!fs::exists(input.file, ignored))
    throw InputError({input.file.string(), 0, 0}, "there is no such file",
                     "Give the results.h5 of a drop, or the directory into which `rotordrop run` wrote it.");
  if (input.file.extension() == ".toml")
    throw InputError({input.file.string(), 0, 0}, "this is a file of parameters, not results.h5 of a drop.",
                     fmt::format("A case is computed by: rotordrop run {}", input.file.string()));
  const auto datasets = list_datasets(input.file);
  const auto has = [&](const char* name) { return std::binary_search(datasets.begin(), datasets.end(), name); };
  if (!has("/parameters") || !has("/energy/mechanical"))
    throw InputError({input.file.string(), 0, 0}, "the file does not contain a drop with its parameters",
                     "Give the results.h5 of a drop.");
  require_same_files(input.file, datasets);
  input.program = attribute_or_unknown(input.file, "program");
  input.revision = attribute_or_unknown(input.file, "git_revision");
  input.processor = attribute_or_unknown(input.file, "processor");
  input.instruction_set = attribute_or_unknown(input.file, "instruction_set");
  input.in_lanes = attribute_or_unknown(input.file, "lanes") == "yes";
  GivenCase given;
  given.file = input.file.parent_path() / (read_attribute(input.file, "/", "case") + ".toml");
  given.tree = parse_toml(read_text(input.file, "/parameters"), given.file.string());
  // Of a set of catalogue bearings the values are all there: the catalogue itself may have gone.
  if (Node* bearings = given.tree->find("bearings"); bearings && bearings->is_table())
    for (auto& bearing : bearings->entries())
      if (bearing.value.is_table())
        for (const char* key : {"catalogue", "count"}) bearing.value.erase(key);
  input.drop_case = read_given_case(given, {});
  return input;
}

nlohmann::ordered_json finished_summary(const fs::path& directory, const Case& c) {
  std::error_code ignored;
  // A run that was killed amid its last act has an empty folder for checkpoints, or leftovers in it.
  if (holds_checkpoint(directory / "checkpoints") || !fs::exists(directory / "summary.json", ignored)) return nullptr;
  std::ifstream parameters(directory / "parameters.toml"), file(directory / "summary.json");
  const std::string text{std::istreambuf_iterator<char>(parameters), {}};
  if (digest_of_parameters(text) != digest_of_parameters(c.resolved.text)) return nullptr;
  auto summary = nlohmann::ordered_json::parse(file, nullptr, false);
  if (!summary.is_object() || !summary.contains("run") || !summary["run"].value("completed", false)) return nullptr;
  const fs::path results = directory / "results.h5";
  try {
    const auto datasets = list_datasets(results);
    require_same_files(results, datasets);
    require_whole(results, datasets, summary["run"].value("end_time", 0.));
  } catch (const DamagedFile& damage) {
    const Fault& fault = damage.faults().front();
    throw DamagedFile(fault.where, fault.message,
                      "The run was finished, and its checkpoints are gone: run it again with --force, without "
                      "--resume.");
  }
  return summary;
}

BitComparison compare_bits(const fs::path& first, const fs::path& second) {
  BitComparison result;
  const auto ours = list_datasets(second);
  std::map<std::string, TimeAxes> axes;
  for (const auto& name : list_datasets(first)) {
    if (name == "/parameters" || name == "/given" || name == "/inputs") continue;
    ++result.n_datasets;
    if (!std::binary_search(ours.begin(), ours.end(), name)) {
      result.differences.push_back({name, "missing"});
      continue;
    }
    const bool is_axis = is_time_axis(name);
    const std::string axis = is_axis ? name : read_attribute(first, name, "time");
    if (!axes.contains(axis)) axes[axis] = {read_series(first, axis).values, read_series(second, axis).values};
    const TimeAxes& times = axes.at(axis);
    const Series a = read_series(first, name), b = read_series(second, name);
    const std::size_t width = a.shape.size() > 1 ? a.shape[1] : 1;
    if ((b.shape.size() > 1 ? b.shape[1] : 1) != width) {
      result.differences.push_back({name, "another number of columns"});
      continue;
    }
    // A part ends with a row at its interruption, which a whole run need not have.
    const bool is_part = !times.a.empty() && !times.b.empty() && times.a.back() < times.b.back();
    result.is_part = result.is_part || is_part;
    const std::size_t n = times.a.size() - (is_part ? 1 : 0);
    if (name == "/time") result.n_rows = n;
    double largest = 0., since = std::nan("");
    std::size_t n_missing = !is_part && times.b.size() > n ? times.b.size() - n : 0;
    for (std::size_t i = 0; i < n && (i + 1) * width <= a.values.size(); ++i) {
      const auto found = times.b_rows.find(times.a[i]);
      if (found == times.b_rows.end() || (found->second + 1) * width > b.values.size()) {
        ++n_missing;
        continue;
      }
      const double *x = a.values.data() + i * width, *y = b.values.data() + found->second * width;
      if (same_bits(x, y, width)) continue;
      if (std::isnan(since)) since = times.a[i];
      for (std::size_t k = 0; k < width; ++k)
        if (!same_bits(x + k, y + k, 1)) {
          const double difference = std::fabs(x[k] - y[k]);
          largest = std::isfinite(difference) ? std::max(largest, difference) : std::numeric_limits<double>::infinity();
        }
    }
    if (std::isfinite(since))
      result.differences.push_back(
          {name, fmt::format("largest difference {:.3g} {}, first at {:.6g} ms", largest,
                             is_axis ? "s" : read_attribute(first, name, "units"), since * 1e3)});
    else if (n_missing > 0)
      result.differences.push_back({name, fmt::format("{} rows at other times", n_missing)});
  }
  return result;
}

namespace {

/// @param recorded  another than ours, or several of a run that was resumed: "v3, v4"
std::string instruction_set_text(const std::string& recorded) {
  const std::string ours = name_of(vector_level);
  if (recorded.find(',') != std::string::npos)
    return fmt::format(
        "The run was resumed with another instruction set, and had {} one after the other: no rerun has its bits. "
        "This one has {}.\n",
        recorded, ours);
  if (recorded == "unknown")
    return fmt::format(
        "The instruction set is {}, and was not recorded; ROTORDROP_ISA in the environment chooses "
        "another.\n",
        ours);
  return fmt::format(
      "The instruction set was {0} and is {1}; ROTORDROP_ISA={0} in the environment chooses the former.\n", recorded,
      ours);
}

}  // namespace

std::string rerun_text(const RecordedInput& input, const BitComparison& c) {
  const std::string part = c.is_part ? ", up to where the recorded run was interrupted" : "";
  if (c.differences.empty())
    return fmt::format("the same bits as {}: {} datasets, {} rows{}\n", input.file.string(), c.n_datasets, c.n_rows,
                       part);
  std::string text = fmt::format("OTHER bits than {}: {} of {} datasets differ{}\n", input.file.string(),
                                 c.differences.size(), c.n_datasets, part);
  constexpr std::size_t n_shown = 5;
  for (std::size_t i = 0; i < c.differences.size() && i < n_shown; ++i)
    text += fmt::format("  {}: {}\n", c.differences[i].dataset, c.differences[i].what);
  if (c.differences.size() > n_shown) text += fmt::format("  and {} more\n", c.differences.size() - n_shown);
  const std::string program = program_name();
  if (input.program != program || input.revision != git_revision())
    text += fmt::format("The program was {} ({}) and is {} ({}).\n", input.program, input.revision, program,
                        git_revision());
  if (input.processor != processor_name())
    text += fmt::format("The processor was {} and is {}.\n", input.processor, processor_name());
  const bool has_same_set = input.instruction_set == name_of(vector_level);
  if (!has_same_set) text += instruction_set_text(input.instruction_set);
  if (has_same_set && input.program == program && input.revision == git_revision() &&
      input.processor == processor_name())
    text +=
        "Program and processor are the same. A run that was interrupted and resumed with an error-controlled method "
        "chooses its steps anew; otherwise please report this with the file.\n";
  return text;
}

}  // namespace rotordrop
