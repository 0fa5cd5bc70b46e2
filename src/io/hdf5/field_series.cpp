#include "io/hdf5/field_series.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <regex>

#include "base/errors.h"
#include "io/checkpoint.h"

namespace rotordrop {

namespace fs = std::filesystem;

FieldSeries::FieldSeries(fs::path directory, std::string name, double go_on_after)
    : directory_(std::move(directory)), name_(std::move(name)) {
  std::error_code error;
  fs::create_directories(directory_, error);
  if (error) throw SolverError(directory_.string() + " cannot be made: " + error.message());
  if (go_on_after >= 0.) read_list(go_on_after);
  // Files that the list no longer has, of an earlier run or after the time to go on from. The list first: it must not name what is gone.
  write_list();
  for (const auto& file : fs::directory_iterator(directory_)) {
    const std::string found = file.path().filename().string();
    const bool is_ours = std::regex_match(found.starts_with(name_) ? found.substr(name_.size()) : "",
                                          std::regex("-[0-9]+\\.vtu(\\.part)?"));
    if (is_ours && std::none_of(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.file == found; }))
      fs::remove(file.path(), error);
  }
}

void FieldSeries::read_list(double until) {
  std::ifstream list(directory_ / (name_ + ".pvd"));
  const std::regex entry("<DataSet timestep=\"([^\"]+)\".* file=\"([^\"]+)\"/>");
  std::smatch found;
  for (std::string line; std::getline(list, line);) {
    if (!std::regex_search(line, found, entry)) continue;
    const double time = std::stod(found[1]);
    if (time <= until && fs::exists(directory_ / found[2].str())) entries_.push_back({time, found[2]});
  }
}

void FieldSeries::write_list() const {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n";
  for (const auto& entry : entries_)
    text += fmt::format("    <DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}\"/>\n", entry.time, entry.file);
  write_text_atomically(directory_ / (name_ + ".pvd"), text + "  </Collection>\n</VTKFile>\n");
}

void FieldSeries::add(double time, const std::function<void(const std::string& file)>& write) {
  std::string file;
  for (std::size_t number = entries_.size(); file.empty() || fs::exists(directory_ / file); ++number)
    file = fmt::format("{}-{:05d}.vtu", name_, number);
  const fs::path beside = directory_ / (file + ".part");
  write(beside.string());
  std::error_code error;
  fs::rename(beside, directory_ / file, error);
  if (error) throw SolverError((directory_ / file).string() + " cannot be written: " + error.message());
  entries_.push_back({time, file});
  write_list();
}

double FieldTimes::after(double t) const {
  double next = std::numeric_limits<double>::infinity();
  if (t < 0.) return empty() ? next : 0.;
  const auto listed = std::upper_bound(times_.begin(), times_.end(), t);
  if (listed != times_.end()) next = *listed;
  if (interval_ > 0.) {
    // Multiples as one writes them: 0.3 and not 0.30000000000000004.
    const auto multiple = [this](double k) { return std::stod(fmt::format("{:.15g}", k * interval_)); };
    double k = std::floor(t / interval_);
    while (multiple(k) <= t) ++k;
    next = std::min(next, multiple(k));
  }
  return next;
}

}  // namespace rotordrop
