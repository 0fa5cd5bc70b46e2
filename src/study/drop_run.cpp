#include "study/drop_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <deque>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/cpu_time.h"
#include "base/errors.h"
#include "base/version.h"
#include "integrate/sundials_version.h"
#include "io/checkpoint.h"
#include "io/hdf5_version.h"
#include "io/recorded_series.h"
#include "io/recorder.h"
#include "io/resumed_recording.h"
#include "io/sha256.h"
#include "study/drop_fields.h"
#include "study/kelvin_check.h"
#include "study/results_folder.h"
#include "study/row_schedule.h"
#include "study/run_end.h"
#include "study/summary.h"

namespace rotordrop {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Of the files that the parameters only name, and on which the results depend: a mesh, the growth of an earlier run.
std::string digests_of_files(const Case& c) {
  std::string digests;
  const auto& thermal = c.parameters.thermal;
  if (thermal.fe.mesh && thermal.has_fe)
    for (const auto& name : touchdown_names(c.parameters))
      digests += "\n" + sha256_of_file(own_mesh_file(*thermal.fe.mesh, name));
  return digests;
}

std::vector<SeriesGroup> series_groups(const Machine& machine, const WindowedSections* windows) {
  const auto channels = [](std::vector<Channel>& to, const std::vector<Observable>& from) {
    for (const auto& o : from) to.push_back({o.name, o.unit, o.long_name, o.size, o.columns});
  };
  SeriesGroup series{"/time", {}}, details{"/detail/time", {}};
  channels(series.channels, machine.step_observables());
  channels(series.channels, machine.state_observables());
  channels(details.channels, machine.detail_observables());
  std::vector<SeriesGroup> groups = {std::move(series)};
  if (!details.channels.empty()) groups.push_back(std::move(details));
  if (windows) {
    groups.push_back({"/windows/time", {}});
    channels(groups.back().channels, windows->observables());
  }
  return groups;
}

RecordHeader record_header(const Case& drop_case) {
  return {{{"program", std::string("rotordrop ") + version()},
           {"git_revision", git_revision()},
           {"sundials_version", sundials_version()},
           {"hdf5_version", hdf5_version()},
           {"case", drop_case.name},
           {"frame",
            "x along the rotor axis, y up, z horizontal; y, z from the unloaded outer ring's axis; angles from +y "
            "towards +z"}},
          {{"/parameters", drop_case.resolved}}};
}

/// Tells once of every fit that begins to open: reads it from what is recorded.
class FitWatch {
 public:
  FitWatch(const std::vector<Observable>& list, std::size_t at, bool follows) : follows_(follows) {
    const std::string ending = "/housing_fit_open";
    for (const auto& o : list) {
      if (o.name.ends_with(ending)) {
        const std::string path = o.name.substr(0, o.name.size() - ending.size());
        fits_.push_back({path.substr(path.rfind('/') + 1), at});
      }
      at += o.size;
    }
  }
  void look(double t, std::span<const double> row, const std::function<void(const std::string&)>& tell) {
    for (auto& fit : fits_) {
      if (fit.is_told || !(row[fit.at] > 0.)) continue;
      fit.is_told = true;
      if (tell)
        tell(fmt::format(
            "the fit of {}'s outer ring in its housing begins to open before t = {:.4g} ms: {:.0f} % of its "
            "area{}.",
            fit.bearing, t * 1e3, 100. * row[fit.at],
            follows_ ? ""
                     : " would have to pull. Growth stays that of a closed fit; thermal.fe.coupling = "
                       "\"windowed\" lets it open"));
    }
  }

 private:
  struct Fit {
    std::string bearing;
    std::size_t at = 0;
    bool is_told = false;
  };
  std::vector<Fit> fits_;
  bool follows_;
};

/// One run from its start, or from a checkpoint, to its end.
class DropRun {
 public:
  DropRun(const Case& drop_case, const Machine& machine, const RunOptions& options)
      : case_(drop_case),
        machine_(machine),
        options_(options),
        scalars_(machine),
        text_digest_(sha256_of_toml(drop_case.resolved)),
        digest_(sha256_of_toml(drop_case.resolved + digests_of_files(drop_case))),
        condition_(machine, drop_case.parameters.run.until),
        end_time_(drop_case.parameters.run.latest_end()),
        rows_(schedule(drop_case.parameters.output.interval)),
        detail_rows_(schedule(drop_case.parameters.output.detail_interval)),
        window_rows_(schedule(drop_case.parameters.output.interval)) {
    const std::size_t n = machine.layout().size();
    state_.resize(n);
    at_record_.resize(n);
    n_step_ = observed_size(machine.step_observables());
    n_detail_ = observed_size(machine.detail_observables());
    found_.wants_step = true;
    detailed_.wants_details = true;
    row_.resize(n_step_ + observed_size(machine.state_observables()));
    if (options.elements && options.elements->coupling == FeCoupling::windowed && !options.elements->sections.empty()) {
      const auto& fe = drop_case.parameters.thermal.fe;
      windows_.emplace(*options.elements, fe.window_tolerance, fe.longest_window);
      energies_.resize(machine.n_thermal_places());
      balls_.resize(machine.n_thermal_places());
      window_row_.resize(observed_size(windows_->observables()));
      found_.growth_in_force = detailed_.growth_in_force = &windows_->growth_in_force();
    }
    if (windows_)
      fits_.emplace(windows_->observables(), 0, true);
    else
      fits_.emplace(machine.state_observables(), n_step_, false);
    kelvin_.emplace(machine.state_observables(), n_step_);
    averaging_start_ = std::max(end_time_ - averaging_time, 0.);
    impulse_.assign(scalars_.size(), 0.);
    for (const auto& entry : machine.layout().entries()) entry_names_.push_back(entry.name);
    // Places of the inner rings' temperatures among the state observables, for the moving line.
    std::size_t at = n_step_;
    for (const auto& o : machine.state_observables()) {
      if ((o.name.starts_with("/thermal/") || o.name.starts_with("/fe/")) && o.name.ends_with("/inner_ring"))
        inner_rings_.push_back(at);
      at += o.size;
    }
  }

  DropResult run() {
    folder_.emplace(options_.directory, options_.resume  ? ResultsFolder::Existing::resume
                                        : options_.force ? ResultsFolder::Existing::replace
                                                         : ResultsFolder::Existing::refuse);
    machine_.initial_state(state_);
    if (options_.resume)
      resume();
    else
      open_recorder();
    if (options_.elements)
      fields_.emplace(options_.directory, *options_.elements, case_.parameters.thermal.fe, machine_, time_);
    write_text_atomically(options_.directory / "parameters.toml", case_.resolved);

    wall_start_ = Clock::now();
    cpu_start_ = cpu_seconds();
    start_time_ = time_;
    if (!is_at_end()) integrate();
    if (windows_ && !interrupted_) {
      windows_->finish(time_, energies(state_), balls(time_, state_));
      record_window(time_, true);
    }
    recorder_->close();
    folder_->require_there();

    DropResult result;
    result.completed = !interrupted_;
    result.end_time = time_;
    result.wall_time = earlier_wall_ + seconds_since(wall_start_);
    result.cpu_time = earlier_cpu_ + cpu_seconds() - cpu_start_;
    result.statistics = statistics();
    result.state = state_;
    result.condition_met = condition_.is_reached();
    result.impulse_before_end = impulse_;
    result.averaging_start = is_averaging_ ? averaging_start_ : 0.;
    if (!recent_impulses_.empty()) {
      result.averaging_start = recent_impulses_.front().time;
      result.impulse_before_end = recent_impulses_.front().impulse;
    }
    if (windows_) {
      result.windows = windows_->report();
      result.windows_energy = windows_->energy();
      result.growth_in_force = windows_->growth_in_force();
    }
    auto summary = summarise(case_, machine_, scalars_, result, options_.elements, recorder_->path());
    summary["input_warnings"] = nlohmann::ordered_json::array();
    for (const auto& warning : case_.warnings)
      summary["input_warnings"].push_back(
          {{"where", to_string(warning.where)}, {"message", warning.message}, {"advice", warning.advice}});
    write_text_atomically(options_.directory / "summary.json", summary.dump(2) + "\n");
    if (result.completed) folder_->remove_checkpoints();
    return result;
  }

 private:
  [[nodiscard]] RowSchedule schedule(double interval) const {
    const auto& output = case_.parameters.output;
    const double longest = output.longest_interval.value_or(std::max(output.interval, end_time_ / 20000.));
    // Details keep their ratio to the other rows.
    return {interval, longest * interval / output.interval, output.change,
            watched_columns(machine_.step_observables())};
  }

  [[nodiscard]] bool is_at_end() const { return time_ >= end_time_ || condition_.is_reached(); }

  void integrate() {
    system_.emplace(machine_, found_.growth_in_force);
    integrator_ = make_integrator(*system_, case_.parameters.integration, time_, state_, end_time_);
    if (time_ == 0.) {
      evaluate_step(0., state_);
      try {
        record(0., state_);
        if (windows_)
          write_windowed_fields(0.);
        else
          write_reduced_fields();
      } catch (const SolverError& error) {
        fail(error);
      }
    }
    auto last_report = Clock::now(), last_checkpoint = last_report;
    long counter = 0;
    while (!is_at_end()) {
      try {
        take_step();
      } catch (const SolverError& error) {
        fail(error);
      }
      if (is_stopped()) {
        interrupted_ = !is_at_end();
        break;
      }
      if (++counter % 64 != 0) continue;
      const auto now = Clock::now();
      if (options_.report && now - last_report > std::chrono::milliseconds(200)) {
        last_report = now;
        report();
      }
      if (std::chrono::duration<double>(now - last_checkpoint).count() > case_.parameters.output.checkpoint_interval) {
        last_checkpoint = now;
        save(options_.directory / "checkpoints");
      }
    }
    if (interrupted_) save(options_.directory / "checkpoints");
    if (options_.report) report();
  }

  /// One step with all that is recorded on the way; time_ and state_ follow when all of it is done.
  void take_step() {
    integrator_->advance();
    const double last_time = time_;
    time_ = integrator_->time();
    const auto y = integrator_->state();
    try {
      record_between();
      if (!windows_) write_reduced_fields();
      if (is_to_be_observed()) {
        evaluate_step(time_, y);
        if (rows_.is_awoken(last_time)) record_before_change(last_time, y);
        record_at(y);
      }
      follow_impulse(y);
      advance_windows();
    } catch (...) {
      time_ = last_time;
      throw;
    }
    std::copy(y.begin(), y.end(), state_.begin());
  }

  /// Energies of the thermal places in a state.
  std::span<const PlaceEnergy> energies(std::span<const double> y) {
    for (std::size_t place = 0; place < energies_.size(); ++place) energies_[place] = machine_.heat_given(place, y);
    return energies_;
  }

  /// What the balls of the thermal places conduct in a state, if they do as they roll.
  std::span<const BallConduction> balls(double t, std::span<const double> y) {
    if (case_.parameters.thermal.contact_conduction != BallConductionModel::rolling) return balls_;
    machine_.evaluate(t, y, detailed_);
    for (std::size_t place = 0; place < balls_.size(); ++place) balls_[place] = detailed_.heats[place].balls;
    return balls_;
  }

  void advance_windows() {
    if (windows_) windows_->look(time_, energies(integrator_->state()));
    while (windows_ && windows_->next_end() <= time_ && !is_stopped()) {
      const double end = windows_->next_end();
      integrator_->interpolate(end, at_record_);
      windows_->advance(time_, energies(at_record_), balls(end, at_record_));
      record_window(end);
    }
  }

  void record_window(double t, bool is_last = false) {
    windows_->observe(window_row_);
    fits_->look(t, window_row_, options_.tell);
    if (is_last || window_rows_.due() <= t || is_same_time(window_rows_.due(), t)) {
      recorder_->append(n_detail_ > 0 ? 2 : 1, t, window_row_);
      window_rows_.written(t);
    }
    write_windowed_fields(t);
  }

  void write_windowed_fields(double t) {
    if (fields_ && fields_->is_due(t)) fields_->write_windowed(t);
  }

  /// Those that are due at the integrator's time or before.
  void write_reduced_fields() {
    while (fields_ && fields_->is_due(time_)) {
      const double t = std::min(fields_->next(), time_);
      if (time_ > 0.)
        integrator_->interpolate(t, at_record_);
      else
        at_record_ = state_;
      machine_.evaluate(t, at_record_, found_);
      fields_->write_reduced(at_record_, found_);
    }
  }

  /// Every step where that costs nothing; else as often as peaks need: 12 times in a period of the rings' fastest motion, 8 kHz.
  [[nodiscard]] bool is_to_be_observed() const {
    return integrator_->uses_offered_rates() || time_ - observed_time_ >= 10e-6 || time_ >= end_time_ ||
           is_now(rows_.due()) || (n_detail_ > 0 && is_now(detail_rows_.due()));
  }

  /// Rates and step observables at an accepted state; the scalars follow.
  void evaluate_step(double t, std::span<const double> y) {
    machine_.evaluate(t, y, found_);
    integrator_->offer_rates(found_.rates);
    observed_time_ = t;
    scalars_.follow(t, found_.step);
    for (auto* rows : {&rows_, &detail_rows_, &window_rows_}) rows->follow(t, found_.step);
    condition_.follow(t, found_.step, machine_.spin(y).speed);
  }

  /// A row at the beginning of the step that brought a change after a long interval without any.
  void record_before_change(double before, std::span<const double> y) {
    machine_.evaluate(before, state_, found_);
    record(before, state_);
    machine_.evaluate(time_, y, found_);
  }

  /// Impulses of a sliding mean before an end that is not known yet.
  void follow_impulse(std::span<const double> y) {
    if (case_.parameters.run.until == EndCondition::time) return;
    constexpr double spacing = 0.1 * averaging_time;
    if (!recent_impulses_.empty() && time_ - recent_impulses_.back().time < spacing && !is_at_end()) return;
    RecentImpulse now{time_, {}};
    for (std::size_t i = 0; i < scalars_.size(); ++i)
      now.impulse.push_back(machine_.ledger(scalars_.support(i), "contact impulse", y));
    while (recent_impulses_.size() > 1 && recent_impulses_[1].time <= time_ - averaging_time)
      recent_impulses_.pop_front();
    if (!is_at_end()) recent_impulses_.push_back(std::move(now));
  }

  [[nodiscard]] bool is_stopped() const { return options_.stop && *options_.stop; }
  // A record time this close to a step's end is that end.
  [[nodiscard]] bool is_now(double t) const { return is_same_time(t, time_); }

  /// Everything that lies between the last state and the new one, by the integrator's own interpolation; also of the step after which the run is
  /// stopped, for a resumed run goes on behind it.
  void record_between() {
    while (rows_.due() < time_ && !is_now(rows_.due())) {
      const double t = rows_.due();
      integrator_->interpolate(t, at_record_);
      machine_.evaluate(t, at_record_, found_);
      record(t, at_record_);
    }
    if (n_detail_ > 0)
      while (detail_rows_.due() < time_ && !is_now(detail_rows_.due())) {
        const double t = detail_rows_.due();
        integrator_->interpolate(t, at_record_);
        record_details(t, at_record_);
      }
    if (!is_averaging_ && averaging_start_ <= time_ && case_.parameters.run.until == EndCondition::time) {
      is_averaging_ = true;
      if (averaging_start_ > 0.) {
        integrator_->interpolate(std::min(averaging_start_, time_), at_record_);
        for (std::size_t i = 0; i < scalars_.size(); ++i)
          impulse_[i] = machine_.ledger(scalars_.support(i), "contact impulse", at_record_);
      }
    }
  }

  void record_at(std::span<const double> y) {
    const bool is_last = is_at_end();
    if (is_now(rows_.due()) || is_last) record(time_, y);
    if (n_detail_ > 0 && (is_now(detail_rows_.due()) || is_last)) record_details(time_, y);
  }

  /// Writes a row; rates and step observables must be those at t, y.
  void record(double t, std::span<const double> y) {
    std::copy(found_.step.begin(), found_.step.end(), row_.begin());
    machine_.observe_state(y, found_, std::span(row_).subspan(n_step_));
    if (!windows_) fits_->look(t, row_, options_.tell);
    kelvin_->require_above_zero(t, row_);
    recorder_->append(0, t, row_);
    rows_.written(t);
    if (t == 0. && n_detail_ > 0) record_details(t, y);
  }

  void record_details(double t, std::span<const double> y) {
    machine_.evaluate(t, y, detailed_);
    recorder_->append(1, t, detailed_.details);
    detail_rows_.written(t);
  }

  void open_recorder() {
    const fs::path file = options_.directory / "results.h5";
    RecorderOptions recorder_options;
    recorder_options.overwrite = options_.force;
    if (time_ > 0.) {
      auto resumed = resume_recording(file, time_, record_header(case_), series_groups(machine_, windows()),
                                      recorder_options, recorded_);
      recorder_.emplace(std::move(resumed.recorder));
    } else {
      recorder_options.overwrite |= options_.resume;
      recorder_.emplace(file, record_header(case_), series_groups(machine_, windows()), recorder_options);
    }
  }

  [[nodiscard]] IntegrationStatistics statistics() const {
    IntegrationStatistics s = integrator_ ? integrator_->statistics() : IntegrationStatistics{};
    s.steps += earlier_.steps;
    s.rhs_evaluations += earlier_.rhs_evaluations;
    s.rejected_steps += earlier_.rejected_steps;
    return s;
  }

  fs::path save(const fs::path& directory) {
    folder_->require_there();
    recorded_ = recorder_->sync();  // on the disk before the checkpoint that relies on it
    return write_checkpoint(directory, checkpoint());
  }

  [[nodiscard]] Checkpoint checkpoint() const {
    Checkpoint c;
    c.time = time_;
    c.state = state_;
    c.parameter_digest = digest_;
    c.entry_names = entry_names_;
    c.extras["scalars"] = scalars_.packed();
    c.extras["impulse"] = impulse_;
    c.extras["rows"] = rows_.packed();
    c.extras["detail rows"] = detail_rows_.packed();
    c.extras["window rows"] = window_rows_.packed();
    c.extras["condition"] = condition_.packed();
    for (const auto& recent : recent_impulses_) {
      auto& values = c.extras["recent impulses"];
      values.push_back(recent.time);
      values.insert(values.end(), recent.impulse.begin(), recent.impulse.end());
    }
    c.extras["recorded"] = recorded_.packed();
    if (windows_) c.extras["windows"] = windows_->packed();
    const auto s = statistics();
    c.extras["statistics"] = {static_cast<double>(s.steps),
                              static_cast<double>(s.rhs_evaluations),
                              static_cast<double>(s.rejected_steps),
                              earlier_wall_ + seconds_since(wall_start_),
                              earlier_cpu_ + cpu_seconds() - cpu_start_,
                              is_averaging_ ? 1. : 0.,
                              observed_time_};
    return c;
  }

  /// From the newest checkpoint whose rows are all on file: after a power cut that may be an earlier one.
  void resume() {
    for (fs::path newer; newer = read_newest_checkpoint(newer), true;) {
      try {
        open_recorder();
        return;
      } catch (const DamagedFile& error) {
        const auto& fault = error.faults().front();
        const std::string earlier = newest_valid_checkpoint(options_.directory / "checkpoints", newer).path.string();
        if (earlier.empty())
          throw InputError(fault.where, "the results are damaged: " + fault.message,
                           "No checkpoint can be resumed with them. What can be read of them stays as it is; choose "
                           "another directory with -o DIR, or start anew with --force.");
        if (options_.tell)
          options_.tell(fmt::format("the results are damaged: {} The run resumes from an earlier checkpoint, {}",
                                    fault.message, earlier));
      }
    }
  }

  /// @param newer  a checkpoint that is of no use; empty at first
  /// @return the checkpoint; empty if the run starts anew
  fs::path read_newest_checkpoint(const fs::path& newer) {
    const auto found = newest_valid_checkpoint(options_.directory / "checkpoints", newer);
    if (!found.checkpoint) {
      const std::string where = options_.directory.string();
      if (!found.skipped.empty())
        throw InputError({where, 0, 0}, "none of the checkpoints can be read",
                         fmt::format("{}", fmt::join(found.skipped, "\n")));
      if (fs::exists(options_.directory / "summary.json"))
        throw InputError({options_.directory.string(), 0, 0}, "there is no checkpoint to go on from",
                         "The run was finished, or its checkpoints were removed.");
      // Killed before its first checkpoint: it starts anew, but only as what it was.
      std::ifstream earlier(options_.directory / "parameters.toml");
      const std::string text{std::istreambuf_iterator<char>(earlier), {}};
      if (!text.empty() && sha256_of_toml(text) != text_digest_)
        throw InputError({where, 0, 0}, "the directory holds the run of another case",
                         "Choose another with -o DIR, or replace the results with --force.");
      if (options_.tell) options_.tell("there is no checkpoint yet: the run starts anew");
      return {};
    }
    if (options_.tell)
      for (const auto& file : found.skipped) options_.tell("a newer checkpoint cannot be read: " + file);
    require_same_case(found.path, *found.checkpoint, digest_, entry_names_);
    try {
      take(*found.checkpoint);
    } catch (const std::logic_error&) {  // something is missing, or of another size
      throw InputError({found.path.string()}, "this checkpoint does not hold what this version of the program needs.",
                       "Start anew with --force, or resume with the version that wrote it.");
    }
    return found.path;
  }

  /// @throws std::logic_error if something is missing or does not fit
  void take(const Checkpoint& c) {
    const auto& s = c.extras.at("statistics");
    if (s.size() != 7 || c.extras.at("impulse").size() != impulse_.size() || c.state.size() != state_.size() ||
        !(c.time >= 0. && c.time <= end_time_) ||
        !std::all_of(c.state.begin(), c.state.end(), [](double y) { return std::isfinite(y); }))
      throw std::invalid_argument("a checkpoint of another kind");
    time_ = c.time;
    state_ = c.state;
    scalars_.unpack(c.extras.at("scalars"));
    impulse_ = c.extras.at("impulse");
    rows_.unpack(c.extras.at("rows"));
    detail_rows_.unpack(c.extras.at("detail rows"));
    window_rows_.unpack(c.extras.at("window rows"));
    condition_.unpack(c.extras.at("condition"));
    if (const auto recent_values = c.extras.find("recent impulses"); recent_values != c.extras.end()) {
      if (recent_values->second.size() % (1 + scalars_.size()) != 0)
        throw std::invalid_argument("impulses are missing");
      for (auto at = recent_values->second.begin(); at != recent_values->second.end();) {
        RecentImpulse recent{*at++, {}};
        for (std::size_t i = 0; i < scalars_.size(); ++i) recent.impulse.push_back(*at++);
        recent_impulses_.push_back(std::move(recent));
      }
    }
    if (windows_) windows_->unpack(c.extras.at("windows"));
    recorded_ = c.extras.contains("recorded") ? RecordedRows::unpacked(c.extras.at("recorded")) : RecordedRows{};
    earlier_ = {static_cast<long>(s[0]), static_cast<long>(s[1]), static_cast<long>(s[2])};
    earlier_wall_ = s[3];
    earlier_cpu_ = s[4];
    is_averaging_ = s[5] != 0.;
    observed_time_ = s[6];
  }

  [[noreturn]] void fail(const SolverError& error) {
    std::string text = error.what();
    try {
      try {
        recorded_ = recorder_->sync();
      } catch (const SolverError&) {  // the recorder is what failed: the state may still find room
      }
      const fs::path file = write_checkpoint(options_.directory / "failed", checkpoint());
      text +=
          fmt::format("\n       The last good state, at t = {:.6g} ms, is saved in {}.", time_ * 1e3, file.string());
      recorder_->close();
    } catch (const std::exception& other) {
      text += fmt::format("\n       The state could not be saved: {}", other.what());
    }
    throw SolverError(text);
  }

  void report() {
    Progress p;
    p.time = time_;
    p.end_time = end_time_;
    p.wall_time = seconds_since(wall_start_);
    p.wall_time_left = time_ > start_time_ ? p.wall_time * (end_time_ - time_) / (time_ - start_time_) : 0.;
    p.rotor_speed = machine_.spin(state_).speed;
    p.largest_contact_force = scalars_.largest_contact_force();
    p.inner_ring_temperature = std::numeric_limits<double>::quiet_NaN();
    machine_.evaluate(time_, state_, found_);
    machine_.observe_state(state_, found_, std::span(row_).subspan(n_step_));
    for (const std::size_t at : inner_rings_) p.inner_ring_temperature = std::fmax(p.inner_ring_temperature, row_[at]);
    options_.report(p);
  }

  [[nodiscard]] const WindowedSections* windows() const { return windows_ ? &*windows_ : nullptr; }

  const Case& case_;
  const Machine& machine_;
  const RunOptions& options_;
  DropScalars scalars_;
  std::string text_digest_, digest_;  ///< of the parameters; of these and of the files that they name
  std::vector<std::string> entry_names_;
  std::optional<MachineSystem> system_;
  std::unique_ptr<Integrator> integrator_;
  std::optional<ResultsFolder> folder_;
  std::optional<Recorder> recorder_;
  RecordedRows recorded_;  ///< of the last checkpoint
  std::optional<WindowedSections> windows_;
  std::optional<DropFields> fields_;
  std::vector<PlaceEnergy> energies_;
  std::vector<BallConduction> balls_;  ///< of the thermal places
  std::vector<double> window_row_;
  std::optional<FitWatch> fits_;
  std::optional<KelvinCheck> kelvin_;

  struct RecentImpulse {
    double time;                  // [s]
    std::vector<double> impulse;  // of each touchdown bearing [N s]
  };
  RunEnd condition_;
  std::deque<RecentImpulse> recent_impulses_;
  double time_ = 0, start_time_ = 0, observed_time_ = 0, end_time_;
  RowSchedule rows_, detail_rows_, window_rows_;
  Evaluation found_, detailed_;
  std::vector<double> state_, at_record_, row_;
  std::size_t n_step_ = 0, n_detail_ = 0;
  std::vector<std::size_t> inner_rings_;
  double averaging_start_ = 0;
  bool is_averaging_ = false, interrupted_ = false;
  std::vector<double> impulse_;
  IntegrationStatistics earlier_;
  double earlier_wall_ = 0, earlier_cpu_ = 0, cpu_start_ = 0;
  Clock::time_point wall_start_ = Clock::now();
};

}  // namespace

DropResult run_drop(const Case& drop_case, const Machine& machine, const RunOptions& options) {
  return DropRun(drop_case, machine, options).run();
}

}  // namespace rotordrop
