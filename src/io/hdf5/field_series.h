#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace rotordrop {

/// Fields over time for ParaView: DIRECTORY/NAME.pvd names a file for each time. Every file is complete once it has its name, and the list
/// once its files are: a killed run leaves a series that can be opened.
class FieldSeries {
 public:
  /// Starts anew, or goes on after what is listed up to a time; later files are removed.
  /// @param go_on_after  [s]; negative: anew
  /// @throws SolverError if the directory cannot be made or read
  FieldSeries(std::filesystem::path directory, std::string name, double go_on_after = -1.);

  /// @param write  writes the field into the file that it is given
  /// @throws SolverError
  void add(double time, const std::function<void(const std::string& file)>& write);
  [[nodiscard]] bool empty() const { return entries_.empty(); }
  [[nodiscard]] double last_time() const { return entries_.back().time; }  ///< of a series that is not empty [s]

 private:
  struct Entry {
    double time = 0;
    std::string file;
  };
  void read_list(double until);
  void write_list() const;

  const std::filesystem::path directory_;
  const std::string name_;
  std::vector<Entry> entries_;
};

/// When fields are wanted: listed times and multiples of an interval, 0 among them.
class FieldTimes {
 public:
  FieldTimes() = default;
  /// @param interval  [s]; 0: none
  FieldTimes(std::vector<double> times, double interval) : times_(std::move(times)), interval_(interval) {}
  [[nodiscard]] bool empty() const { return times_.empty() && interval_ <= 0.; }
  /// The first time after t [s]; infinity if there is none.
  [[nodiscard]] double after(double t) const;

 private:
  std::vector<double> times_;
  double interval_ = 0;
};

}  // namespace rotordrop
