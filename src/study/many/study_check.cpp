// What a study tells before it runs: whether its points are valid, which results they have, how long it takes.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <string_view>
#include <thread>

#include "analysis/drop_lanes.h"
#include "base/cpu_time.h"
#include "base/parameters/suggestion.h"
#include "case/built_machine.h"
#include "study/many/answers/result_check.h"
#include "study/many/search/fit_evaluation.h"
#include "study/many/study_run.h"
#include "study/many/surrogate/surrogate.h"

namespace rotordrop {
namespace {

std::string named(const Study& study, const StudyPoint& point) {
  std::string text;
  for (std::size_t i = 0; i < study.parameters.size() && i < 6; ++i)
    text += fmt::format("{}{} = {}", i ? ", " : "", study.parameters[i].name, to_text(point.values[i]));
  return text;
}

/// Parts of a summary that results are of. Damage counts wear; some warnings are of these parts.
SummaryParts parts_of(const std::vector<std::string>& results) {
  const auto has = [&](std::initializer_list<const char*> groups) {
    return std::any_of(results.begin(), results.end(), [&](const std::string& name) {
      return name == "run.warnings" || std::any_of(groups.begin(), groups.end(), [&](const char* group) {
               return name.find(group) != std::string::npos;
             });
    });
  };
  return {has({".local.", ".wear.", ".damage."}), has({".whirl."})};
}

/// Builds what is not meshed: a rotor that starts inside a ring is found here. @throws InputError
void require_machine(const Case& c) {
  if (c.parameters.thermal.runs_sections()) return;
  try {
    const BuiltMachine built(c);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError({}, error.what());
  }
}

/// A warning's words without their numbers: drawn values differ in each point.
std::string kind_of_warning(const Fault& warning) {
  std::string kind = warning.key + "\n" + to_string(warning.where) + "\n";
  const auto is_of_word = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
  const std::string_view text = warning.message;
  for (std::size_t i = 0; i < text.size();)
    if (std::isdigit(static_cast<unsigned char>(text[i])) && (i == 0 || !is_of_word(text[i - 1])))
      i = std::min(text.find_first_not_of("0123456789.e+-", i), text.size());
    else
      kind += text[i++];
  return kind;
}

/// What is unusual in points: each kind once. Any number of threads may add.
class PointWarnings {
 public:
  explicit PointWarnings(const std::vector<Fault>& known) : known_(known) {}

  void add(std::size_t point, const std::vector<Fault>& warnings) {
    std::map<std::string, const Fault*> kinds;
    for (const Fault& warning : warnings)
      if (std::none_of(known_.begin(), known_.end(), [&](const Fault& one) { return one.message == warning.message; }))
        kinds.emplace(kind_of_warning(warning), &warning);
    const std::scoped_lock guard(lock_);
    for (const auto& [kind, warning] : kinds) {
      Found& found = found_.try_emplace(kind, Found{point, 0, *warning}).first->second;
      ++found.n_points;
      if (point < found.point) found = {point, found.n_points, *warning};
    }
  }

  [[nodiscard]] std::vector<Fault> told(const Study& study, const Design& design) const {
    std::vector<const Found*> sorted;
    for (const auto& entry : found_) sorted.push_back(&entry.second);
    std::stable_sort(sorted.begin(), sorted.end(), [](const Found* a, const Found* b) { return a->point < b->point; });
    const std::size_t n = n_points(study, design);
    std::vector<Fault> warnings;
    for (const Found* found : sorted) {
      Fault warning = found->warning;
      warning.where = position_of_key(study, warning);
      warning.message = fmt::format("{} of {} points: {}", found->n_points, n, warning.message);
      warning.advice += fmt::format("{}Point {}: {}.", warning.advice.empty() ? "" : "\n", found->point,
                                    named(study, point_of(study, design, found->point)));
      warnings.push_back(std::move(warning));
    }
    return warnings;
  }

 private:
  struct Found {
    std::size_t point, n_points;  ///< the first point that has it
    Fault warning;
  };

  /// Where the study varies what a warning is about; else its file.
  static SourcePosition position_of_key(const Study& study, const Fault& warning) {
    for (const VariedParameter& parameter : study.parameters)
      for (const DeclaredKey& key : parameter.keys)
        if (key.name == warning.key) return parameter.where;
    return {study.file.string(), 0, 0};
  }

  const std::vector<Fault>& known_;
  std::mutex lock_;
  std::map<std::string, Found> found_;
};

}  // namespace

std::vector<Fault> check_points(const Study& study, const Design& design, unsigned n_workers,
                                const std::function<void()>& look) {
  const std::size_t n = n_points(study, design);
  constexpr std::size_t n_told = 5;
  std::atomic<std::size_t> next{0}, n_bad{0};
  std::mutex lock;
  std::map<std::size_t, InputError> bad;
  std::exception_ptr interruption;
  PointWarnings warnings(study.base.warnings);
  const auto check = [&](const std::function<void()>& between) {
    for (std::size_t i; n_bad < 100 && (i = next.fetch_add(1)) < n;) {
      try {
        if (between) between();
        const Case c = study.cases->read(overrides_of(study, point_of(study, design, i)), true);
        require_machine(c);
        warnings.add(i, c.warnings);
      } catch (const InputError& error) {
        ++n_bad;
        const std::scoped_lock guard(lock);
        bad.emplace(i, error);
      } catch (...) {  // no fault of the point, such as an interruption: nothing more is looked at
        const std::scoped_lock guard(lock);
        if (!interruption) interruption = std::current_exception();
        next = n;
      }
    }
  };
  {
    std::vector<std::jthread> pool;
    for (unsigned k = 1; k < workers_of(n_workers, n); ++k) pool.emplace_back([&] { check({}); });
    check(look);
  }
  if (interruption) std::rethrow_exception(interruption);
  if (bad.empty()) return warnings.told(study, design);
  Faults faults;
  std::size_t told = 0;
  for (const auto& [i, error] : bad) {
    if (told++ == n_told) break;
    const StudyPoint point = point_of(study, design, i);
    for (const auto& fault : error.faults())
      faults.add({study.file.string(), 0, 0}, fmt::format("point {} is no valid case: {}", i, fault.message),
                 fmt::format("There {}.{}{}", named(study, point), fault.advice.empty() ? "" : "\n", fault.advice));
  }
  if (bad.size() > n_told)
    faults.add(
        {study.file.string(), 0, 0},
        fmt::format("{}{} further points are no valid cases.", n_bad >= 100 ? "at least " : "", bad.size() - n_told),
        "Narrow the ranges. A normal distribution reaches any value; \"truncated-normal\" has ends.");
  throw InputError(faults);
}

ProbedResults probe_results(Study& study, const Design& design, const Evaluator& evaluate) {
  const Case c = study.cases->read(overrides_of(study, point_of(study, design, 0)));
  const volatile std::sig_atomic_t at_once = 1;
  PointResult result = evaluate({c, &at_once, series_of_study(study), {}});
  if (result.scalars.empty()) {
    constexpr std::string_view mark = "error: ";
    const bool is_marked = result.reason.starts_with(mark);
    throw InputError({study.file.string(), 0, 0},
                     "the first point cannot even begin: " + result.reason.substr(is_marked ? mark.size() : 0));
  }
  result.is_done = true;  // with the rows that it has
  show_measured(study, result);
  std::vector<std::string> names;
  for (const auto& scalar : result.scalars) names.push_back(scalar.first);
  Faults faults;
  for (const auto& p : study.parameters)
    if (std::ranges::find(names, p.name) != names.end() &&
        std::ranges::none_of(p.keys, [&](const DeclaredKey& key) { return key.name == p.name; }))
      faults.add(p.where, fmt::format("vary.{}: every drop has a result of this name.", p.name),
                 "Choose another name.");
  for (const auto& derived : study.derived) {
    if (std::find(names.begin(), names.end(), derived.name) != names.end())
      faults.add(derived.where, fmt::format("derived.{}: every drop has a result of this name.", derived.name),
                 "Choose another name.");
    for (const auto& name : derived.formula.names())
      if (std::find(names.begin(), names.end(), name) == names.end()) {
        const std::string advice = advice_on_quotes(derived.formula, names);
        faults.add(derived.where, fmt::format("derived.{}: no result is called \"{}\".", derived.name, name),
                   !advice.empty() ? advice
                                   : suggestion(name, names,
                                                "Formulas use the names of summary.json (docs/reference/results.md)."));
      }
  }
  faults.throw_if_any();
  if (study.surrogate) surrogate_maker();  // a module that is missing is told before the first drop
  for (const auto& derived : study.derived) names.push_back(derived.name);
  resolve_results(study, names);
  ProbedResults probed;
  for (const auto& name : names)
    if (is_kept(study, name)) probed.names.push_back(name);
  std::vector<std::string> needed = probed.names;
  for (const auto& derived : study.derived)
    needed.insert(needed.end(), derived.formula.names().begin(), derived.formula.names().end());
  study.parts = parts_of(needed);
  return probed;
}

std::string choose_lanes(Study& study, const Design& design) {
  const auto reason = [&]() -> std::string {
    if (study.is_search()) return "a search runs its drops one by one";
    const Case c = study.cases->read(overrides_of(study, point_of(study, design, 0)));
    if (c.parameters.thermal.runs_sections()) return "sections are meshed";
    const BuiltMachine built(c);
    return why_not_in_lanes(built.machine(), c.parameters.integration);
  };
  const std::string why = study.lanes_asked == false ? "" : reason();
  study.lanes = study.lanes_asked.value_or(why.empty());
  return study.lanes && !why.empty() ? "lanes = true, but these drops run one by one: " + why : "";
}

StudyEstimate estimate_study(const Study& study, const Design& design, const ProbedResults& results,
                             const Evaluator& evaluate) {
  StudyEstimate estimate;
  estimate.n_rows = design.n_rows;
  estimate.n_points = n_points(study, design);
  const Case c = study.cases->read(overrides_of(study, point_of(study, design, 0)));
  volatile std::sig_atomic_t stop = 0;
  PointResult result;
  double cpu = 0.;
  {
    std::mutex lock;
    std::condition_variable ended;
    bool has_ended = false;
    const std::jthread drop([&] {
      const double start = thread_cpu_seconds();
      result = evaluate({c, &stop, series_of_study(study), study.parts});
      cpu = thread_cpu_seconds() - start;
      const std::scoped_lock guard(lock);
      has_ended = true;
      ended.notify_all();
    });
    std::unique_lock guard(lock);
    if (!ended.wait_for(guard, std::chrono::seconds(4), [&] { return has_ended; })) stop = 1;
  }
  if (!result.reason.empty()) throw SolverError("the first point fails: " + result.reason);
  const double part = result.is_done ? 1. : result.end_time / c.parameters.run.latest_end();
  estimate.cpu_time = cpu / std::max(part, 1e-9) * static_cast<double>(estimate.n_points);
  double numbers = static_cast<double>(results.names.size() + study.parameters.size() + 3);
  for (const auto& series : result.series)
    numbers += static_cast<double>(series.time.size() + series.values.size()) / std::max(part, 1e-9);
  // In study.h5 8 bytes a number; in the journal and the table of texts about 13 each.
  estimate.bytes = numbers * static_cast<double>(estimate.n_points) * (8. + 13. + 13.);
  return estimate;
}

}  // namespace rotordrop
