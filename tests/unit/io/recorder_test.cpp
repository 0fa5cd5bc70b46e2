// Result files: what is written is what is read, at any moment, also after a SIGKILL or with a full disk.

#include "io/hdf5/recorder.h"
#include "base/trial.h"
#include "io/hdf5/hdf5_handle.h"
#include "io/hdf5/recorded_series.h"
#include "io/hdf5/resumed_recording.h"
#include "io/hdf5/trial_reading.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <limits>
#include <set>
#include <sstream>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "base/errors.h"

#if defined(__SANITIZE_ADDRESS__)
// HDF5 1.10.8 loses the buffer of a chunk that it cannot write: the one leak that is let pass, without a word on standard error.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_options();
const char* __lsan_default_suppressions() { return "leak:H5FL__malloc\n"; }
const char* __lsan_default_options() { return "print_suppressions=0"; }
#endif

namespace {

using namespace rotordrop;
namespace fs = std::filesystem;

class RecorderTest : public testing::Test {
 protected:
  RecorderTest() {
    std::string pattern = (fs::temp_directory_path() / "rotordrop-recorder-XXXXXX").string();
    directory = ::mkdtemp(pattern.data());
    path = directory / "results.h5";
  }
  ~RecorderTest() override {
    std::error_code ignored;
    fs::remove_all(directory, ignored);
  }

  [[nodiscard]] std::size_t n_files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(directory), fs::directory_iterator()));
  }

  fs::path directory, path;
};

const RecordHeader header{{{"case", "two bearings"}, {"git_revision", "abc123"}},
                          {{"/parameters", "[contact]\nair_gap = \"250 \xc2\xb5m\"\n"}}};

std::vector<SeriesGroup> machine() {
  return {{"/time",
           {{"/bearings/TB1/contact_force", "N", "normal force of the ring on the rotor", 1, {}},
            {"/bearings/TB1/orbit", "m", "position of the rotor's centre", 2, {"y", "z"}}}},
          {"/coarse/time", {{"/thermal/TB1/ball", "K", "temperature of the balls", 1, {}}}}};
}

/// Row i of the first group. Every value tells its row.
double time_of(std::size_t i) { return 1e-5 * static_cast<double>(i); }
std::vector<double> row_of(std::size_t i) {
  const auto x = static_cast<double>(i);
  return {x, x + 0.25, -x};
}

void append_rows(Recorder& recorder, std::size_t from, std::size_t to) {
  for (std::size_t i = from; i < to; ++i) {
    recorder.append(0, time_of(i), row_of(i));
    if (i % 10 == 0) recorder.append(1, time_of(i), std::vector<double>{300 + static_cast<double>(i)});
  }
}

/// The first n rows are there, complete and unaltered.
void expect_rows(const fs::path& path, std::size_t n) {
  const Series time = read_series(path, "/time");
  const Series force = read_series(path, "/bearings/TB1/contact_force");
  const Series orbit = read_series(path, "/bearings/TB1/orbit");
  ASSERT_GE(time.values.size(), n);
  ASSERT_GE(force.shape.at(0), time.shape.at(0)) << "a time was on file before its force";
  ASSERT_GE(orbit.shape.at(0), time.shape.at(0)) << "a time was on file before its orbit";
  for (std::size_t i = 0; i < time.values.size(); ++i) {
    ASSERT_EQ(time.values[i], time_of(i));
    ASSERT_EQ(force.values[i], row_of(i)[0]);
    ASSERT_EQ(orbit.values[2 * i], row_of(i)[1]);
    ASSERT_EQ(orbit.values[2 * i + 1], row_of(i)[2]);
  }
}

/// A process of its own; killed, if it still runs, when the test ends.
class Child {
 public:
  explicit Child(const std::function<int()>& work) : id_(::fork()) {
    if (id_ != 0) return;
    int code = 99;
    try {
      code = work();
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
    }
    std::_Exit(code);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (id_ > 0) kill();
  }

  void kill() {
    ::kill(id_, SIGKILL);
    wait();
  }
  /// Exit code, or -signal.
  int wait() {
    int status = 0;
    ::waitpid(std::exchange(id_, -1), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  [[nodiscard]] bool is_running() const { return ::waitpid(id_, nullptr, WNOHANG) == 0; }

 private:
  pid_t id_;
};

/// Waits until `is_true`, at most 20 s: the machine may be busy.
bool eventually(const std::function<bool()>& is_true) {
  for (int i = 0; i < 4000; ++i) {
    if (is_true()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

/// Writes for ever; made to be killed.
int write_without_end(const fs::path& path) {
  RecorderOptions options;
  options.rows_per_flush = 37;  // not a divisor of the chunk length
  options.rows_per_chunk = 64;
  Recorder recorder(path, header, machine(), options);
  for (std::size_t i = 0;; ++i) append_rows(recorder, i, i + 1);
}

std::string content(const fs::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST_F(RecorderTest, ReturnsEveryRowInOrderWithItsShape) {
  RecorderOptions options;
  options.rows_per_flush = 7;
  options.rows_per_chunk = 5;
  Recorder recorder(path, header, machine(), options);
  append_rows(recorder, 0, 100);
  EXPECT_EQ(recorder.n_rows(0), 100U);
  EXPECT_EQ(recorder.row_size(0), 3U);
  recorder.close();
  expect_rows(path, 100);
  EXPECT_EQ(read_series(path, "/bearings/TB1/contact_force").shape, (std::vector<std::size_t>{100}));
  EXPECT_EQ(read_series(path, "/bearings/TB1/orbit").shape, (std::vector<std::size_t>{100, 2}));
  EXPECT_EQ(read_series(path, "/coarse/time").shape, (std::vector<std::size_t>{10}));
  EXPECT_EQ(read_series(path, "/thermal/TB1/ball").values.back(), 390);
}

TEST_F(RecorderTest, EveryDatasetSaysItsUnitItsMeaningAndItsTimeAxis) {
  Recorder(path, header, machine()).close();
  EXPECT_EQ(read_attribute(path, "/bearings/TB1/orbit", "units"), "m");
  EXPECT_EQ(read_attribute(path, "/bearings/TB1/orbit", "long_name"), "position of the rotor's centre");
  EXPECT_EQ(read_attribute(path, "/bearings/TB1/orbit", "time"), "/time");
  EXPECT_EQ(read_attribute_list(path, "/bearings/TB1/orbit", "columns"), (std::vector<std::string>{"y", "z"}));
  EXPECT_EQ(read_attribute(path, "/thermal/TB1/ball", "time"), "/coarse/time");
  EXPECT_EQ(read_attribute(path, "/coarse/time", "units"), "s");
  EXPECT_EQ(list_datasets(path),
            (std::vector<std::string>{"/bearings/TB1/contact_force", "/bearings/TB1/orbit", "/coarse/time",
                                      "/parameters", "/thermal/TB1/ball", "/time"}));
}

TEST_F(RecorderTest, CarriesTheCaseAndItsParametersInside) {
  Recorder(path, header, machine()).close();
  EXPECT_EQ(read_attribute(path, "/", "case"), "two bearings");
  EXPECT_EQ(read_attribute(path, "/", "git_revision"), "abc123");
  EXPECT_EQ(read_text(path, "/parameters"), header.texts[0].second);
}

TEST_F(RecorderTest, CarriesAnAttributeAndATextLongerThan64Kilobytes) {
  const std::string text(200000, 'x');
  Recorder(path, {{{"long", text}}, {{"/parameters", text}}}, machine()).close();
  EXPECT_EQ(read_attribute(path, "/", "long"), text);
  EXPECT_EQ(read_text(path, "/parameters"), text);
}

TEST_F(RecorderTest, KeepsNanAndInfinity) {
  Recorder recorder(path, header, machine());
  recorder.append(0, 0, std::vector<double>{std::numeric_limits<double>::quiet_NaN(), INFINITY, -0.});
  recorder.close();
  EXPECT_TRUE(std::isnan(read_series(path, "/bearings/TB1/contact_force").values[0]));
  EXPECT_EQ(read_series(path, "/bearings/TB1/orbit").values[0], INFINITY);
}

TEST_F(RecorderTest, AnotherProcessReadsWhileTheRunGoesOn) {
  const Child writer([&] { return write_without_end(path); });
  ASSERT_TRUE(eventually([&] { return fs::exists(path); }));
  std::size_t before = 0;
  int n_growths = 0;
  ASSERT_TRUE(eventually([&] {
    const std::size_t now = read_series(path, "/time").values.size();
    if (now > before) {
      expect_rows(path, before);
      before = now;
      ++n_growths;
    }
    return n_growths >= 8 || HasFatalFailure();
  })) << "the file did not grow";
  EXPECT_TRUE(writer.is_running());
}

TEST_F(RecorderTest, H5pyReadsWhileTheRunGoesOn) {
  if (std::system("/usr/bin/python3 -c 'import h5py' 2>/dev/null") != 0) GTEST_SKIP() << "no h5py";
  Recorder recorder(path, header, machine());
  append_rows(recorder, 0, 50);
  recorder.flush();
  const std::string script =
      "import h5py, sys; f = h5py.File('" + path.string() +
      "', 'r', swmr=True); d = f['/bearings/TB1/orbit']; "
      "assert f['/time'].shape == (50,), f['/time'].shape; assert d[49, 1] == -49; "
      "assert d.attrs['units'] == 'm'; assert list(d.attrs['columns']) == ['y', 'z']; "
      "assert f.attrs['case'] == 'two bearings'; assert f['/parameters'].asstr()[()].startswith('[contact]')";
  EXPECT_EQ(std::system(("/usr/bin/python3 -c \"" + script + "\"").c_str()), 0);
}

TEST_F(RecorderTest, ShowsRowsOnlyAfterAFlushAndThenAll) {
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  int go_on[2];
  ASSERT_EQ(::pipe(go_on), 0);
  Child writer([&] {
    RecorderOptions options;
    options.seconds_per_flush = 1e9;
    Recorder recorder(path, header, machine(), options);
    char byte = 0;
    append_rows(recorder, 0, 20);
    if (::write(ready[1], "a", 1) != 1 || ::read(go_on[0], &byte, 1) != 1) return 1;
    recorder.flush();
    if (::write(ready[1], "b", 1) != 1 || ::read(go_on[0], &byte, 1) != 1) return 1;
    return 0;
  });
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  EXPECT_EQ(read_series(path, "/time").values.size(), 0U);
  ASSERT_EQ(::write(go_on[1], "x", 1), 1);
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  EXPECT_EQ(read_series(path, "/time").values.size(), 20U);
  expect_rows(path, 20);
  ASSERT_EQ(::write(go_on[1], "x", 1), 1);
  EXPECT_EQ(writer.wait(), 0);
  for (const int end : {ready[0], ready[1], go_on[0], go_on[1]}) ::close(end);
}

TEST_F(RecorderTest, FilesWhoseSeriesCannotBeListedAreDamaged) {
  // So many links lie in a heap of their own. Where they cannot be read, HDF5 frees what was never set, and may crash or not.
  std::vector<SeriesGroup> groups = {{"/time", {}}};
  for (int i = 0; i < 40; ++i)
    groups[0].channels.push_back({"/group/series_" + std::to_string(i), "1", "numbers", 1, {}});
  Recorder(path, header, groups).close();
  EXPECT_NO_THROW(hdf5::try_to_read(path));
  const std::string whole = content(path);
  int n_unlisted = 0;
  for (std::size_t at = 4096; at + 64 < whole.size(); at += 1500) {
    std::string damaged = whole;
    std::fill_n(damaged.begin() + static_cast<std::ptrdiff_t>(at), 64, '\0');
    std::ofstream(path, std::ios::binary) << damaged;
    Trial listing(Trial::Limits{});
    listing.start([&] {
      try {
        static_cast<void>(hdf5::dataset_paths(hdf5::open_without_trial(path).id()));
      } catch (const std::exception&) {
        std::_Exit(1);
      }
    });
    if (listing.wait() == Trial::End::done) continue;
    ++n_unlisted;
    EXPECT_THROW(hdf5::try_to_read(path), DamagedFile) << at;
  }
  EXPECT_GT(n_unlisted, 3);
}

TEST_F(RecorderTest, ChecksumsKnowEveryValueAndItsPlace) {
  const std::vector<SeriesGroup> groups = {{"/time", {{"/x", "1", "numbers", 4, {}}, {"/y", "1", "numbers", 3, {}}}}};
  RecorderOptions options;
  options.overwrite = true;
  const auto sum = [&](const std::function<void(std::vector<double>&)>& change) {
    std::vector<double> all(3 * 8);  // three rows of a time and seven values
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<double>(i);
    change(all);
    Recorder recorder(path, header, groups, options);
    for (std::size_t row = 0; row < 3; ++row) recorder.append(0, all[8 * row], std::span(all).subspan(8 * row + 1, 7));
    return recorder.sync().check_sums.at(0);
  };
  const auto whole = sum([](auto&) {});
  EXPECT_EQ(sum([](auto&) {}), whole);
  std::set<std::uint64_t> others;
  for (std::size_t i = 0; i < 24; ++i) others.insert(sum([i](auto& all) { all[i] += 0.5; }));
  for (std::size_t i = 1; i < 7; ++i) others.insert(sum([i](auto& all) { std::swap(all[i], all[i + 1]); }));
  for (std::size_t i = 1; i < 8; ++i) others.insert(sum([i](auto& all) { std::swap(all[i], all[i + 8]); }));
  EXPECT_EQ(others.size(), 37U) << "each change by itself";
  EXPECT_FALSE(others.contains(whole));
}

TEST_F(RecorderTest, RowsSideBySideAreThoseOneByOne) {
  constexpr std::size_t n_rows = 51;
  const std::vector<SeriesGroup> groups = {{"/time", {{"/x", "1", "numbers", 2, {}}, {"/y", "1", "numbers", 1, {}}}}};
  RecorderOptions options;
  options.overwrite = true;
  options.rows_per_chunk = 10;  // their ends lie within tiles
  const auto value = [](std::size_t row, std::size_t k) { return static_cast<double>(100 * row + k); };
  std::set<std::uint64_t> sums;
  for (const std::size_t at_once : {1U, 3U, 8U})
    for (const std::size_t rows_until_flush : {7U, 1000U}) {
      Recorder recorder(path, header, groups, options);
      for (std::size_t row = 0; row < n_rows; row += at_once) {
        const std::size_t n = std::min(at_once, n_rows - row);
        std::vector<double> times(n), values(3 * RowTile::width);
        for (std::size_t i = 0; i < n; ++i) {
          times[i] = static_cast<double>(row + i);
          for (std::size_t k = 0; k < 3; ++k) values[k * RowTile::width + i] = value(row + i, k);
        }
        if (at_once == 1)
          recorder.append(0, times[0], std::vector{value(row, 0), value(row, 1), value(row, 2)});
        else
          recorder.append(0, RowTile{times, values.data(), 3});
        if (row % rows_until_flush == 0) recorder.flush();
      }
      EXPECT_EQ(recorder.n_rows(0), n_rows);
      sums.insert(recorder.sync().check_sums.at(0));
      recorder.close();
      const auto x = read_series(path, "/x").values, y = read_series(path, "/y").values;
      ASSERT_EQ(x.size(), 2 * n_rows);
      ASSERT_EQ(y.size(), n_rows);
      for (std::size_t row = 0; row < n_rows; ++row) {
        EXPECT_EQ(x[2 * row], value(row, 0));
        EXPECT_EQ(x[2 * row + 1], value(row, 1));
        EXPECT_EQ(y[row], value(row, 2));
      }
    }
  EXPECT_EQ(sums.size(), 1U) << "how many rows come at a time is no matter";
  Recorder recorder(path, header, groups, options);
  const std::vector<double> times = {1., 0.5}, values(3 * RowTile::width);
  EXPECT_THROW(recorder.append(0, RowTile{times, values.data(), 3}), std::invalid_argument) << "times decrease";
  EXPECT_THROW(recorder.append(0, RowTile{std::span(times).first(1), values.data(), 2}), std::invalid_argument);
  EXPECT_EQ(recorder.n_rows(0), 0U);
}

TEST_F(RecorderTest, IsMadeLaterIfAsked) {
  RecorderOptions options;
  options.seconds_until_made = 1e9;
  {
    Recorder recorder(path, header, machine(), options);
    append_rows(recorder, 0, 20);
    EXPECT_EQ(n_files(), 0U);
    recorder.flush();
    expect_rows(path, 20);
  }
  EXPECT_THROW(Recorder(path, header, machine(), options), InputError);  // at once, not after a second of computing
  fs::remove(path);
  Recorder(path, header, machine(), options).close();
  EXPECT_EQ(read_series(path, "/time").values.size(), 0U);
  fs::remove(path);
  {
    Recorder whole(path, header, machine(), options);
    append_rows(whole, 0, 3000);  // more than two chunks
    EXPECT_EQ(n_files(), 0U);
    whole.close();
    EXPECT_EQ(n_files(), 1U) << "and nothing beside it";
    expect_rows(path, 3000);
    EXPECT_THROW(append_rows(whole, 3000, 3001), std::logic_error);
    EXPECT_EQ(whole.n_rows(0), 3000U);
  }
  {
    Recorder nowhere(directory / "missing" / "results.h5", header, machine(), options);
    append_rows(nowhere, 0, 20);
    const auto message = message_of([&] { nowhere.close(); });
    EXPECT_NE(message.find("could not be made: "), std::string::npos) << message;
  }
  fs::remove(path);
  options.seconds_until_made = 0.02;
  Recorder soon(path, header, machine(), options);
  append_rows(soon, 0, 20);
  std::this_thread::sleep_for(std::chrono::milliseconds(30));
  append_rows(soon, 20, 21);
  EXPECT_EQ(n_files(), 1U);
  Recorder late(directory / "missing" / "results.h5", header, machine(), options);
  for (int attempt = 0; attempt < 2; ++attempt) {
    const auto message = message_of([&] { late.flush(); });
    EXPECT_NE(message.find("could not be made: "), std::string::npos) << message;
  }
}

TEST_F(RecorderTest, WritesWhatItHoldsWhenTheTimeForItHasPassed) {
  const Child writer([&] {
    RecorderOptions options;
    options.rows_per_flush = 1000000;
    options.seconds_per_flush = 0.02;
    Recorder recorder(path, header, machine(), options);
    for (std::size_t i = 0;; ++i) {  // closing it would show the rows, too
      append_rows(recorder, i, i + 1);
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return 0;
  });
  ASSERT_TRUE(eventually([&] { return fs::exists(path); }));
  EXPECT_TRUE(eventually([&] { return read_series(path, "/time").values.size() > 5; }));
}

TEST_F(RecorderTest, KeepsEveryFlushedRowThroughSigkill) {
  for (int attempt = 0; attempt < 5; ++attempt) {  // the moment of the kill differs
    fs::remove(path);
    Child writer([&] { return write_without_end(path); });
    ASSERT_TRUE(eventually([&] { return fs::exists(path) && read_series(path, "/time").values.size() > 200; }));
    std::this_thread::sleep_for(std::chrono::microseconds(700 * attempt));
    const std::size_t seen = read_series(path, "/time").values.size();
    writer.kill();
    expect_rows(path, seen);
    if (HasFatalFailure()) return;
  }
}

TEST_F(RecorderTest, ResumesAKilledRunInOneCompleteFile) {
  {
    Child writer([&] { return write_without_end(path); });
    ASSERT_TRUE(eventually([&] { return fs::exists(path) && read_series(path, "/coarse/time").values.size() > 50; }));
    writer.kill();
  }
  ResumedRecorder resumed = resume_recording(path, time_of(400), header, machine());
  EXPECT_EQ(resumed.copied.n_rows, (std::vector<std::size_t>{401, 41})) << "rows with time <= t are kept, t included";
  EXPECT_TRUE(resumed.copied.missing.empty());
  EXPECT_EQ(resumed.recorder.path(), path);
  EXPECT_EQ(n_files(), 1U) << "the new file has taken the old one's name";
  append_rows(resumed.recorder, 401, 1000);
  resumed.recorder.close();
  EXPECT_EQ(read_series(path, "/time").values.size(), 1000U);
  EXPECT_EQ(read_series(path, "/thermal/TB1/ball").values.size(), 100U);
  expect_rows(path, 1000);
}

TEST_F(RecorderTest, AResumeThatFailsLeavesTheOldFileAsItWas) {
  Recorder recorder(path, header, machine());
  append_rows(recorder, 0, 30);
  recorder.close();
  auto other = machine();
  other[0].channels[0].unit = "kN";
  const auto message = message_of([&] { (void)resume_recording(path, 1, header, other); });
  EXPECT_NE(message.find("/bearings/TB1/contact_force is in N in this file; now it is in kN"), std::string::npos)
      << message;
  other = machine();
  other[0].channels[1].size = 3;
  other[0].channels[1].columns.clear();
  EXPECT_THROW((void)resume_recording(path, 1, header, other), InputError);
  EXPECT_EQ(n_files(), 1U);
  expect_rows(path, 30);
}

TEST_F(RecorderTest, FillsAChannelThatTheOldFileLacksWithNanAndSaysSo) {
  Recorder recorder(path, header, machine());
  append_rows(recorder, 0, 30);
  recorder.close();
  auto more = machine();
  more[0].channels.insert(more[0].channels.begin(), {"/rotor/spin_speed", "rad/s", "spin", 1, {}});
  ResumedRecorder resumed = resume_recording(path, 1, header, more);
  resumed.recorder.close();
  EXPECT_EQ(resumed.copied.missing, (std::vector<std::string>{"/rotor/spin_speed"}));
  EXPECT_TRUE(std::isnan(read_series(path, "/rotor/spin_speed").values.at(29)));
  expect_rows(path, 30);
}

TEST_F(RecorderTest, PlainH5pyReadsALiveFile) {
  if (std::system("/usr/bin/python3 -c 'import h5py' 2>/dev/null") != 0) GTEST_SKIP() << "no h5py";
  Recorder recorder(path, header, machine());
  append_rows(recorder, 0, 50);
  recorder.flush();
  const std::string script =
      "import h5py; f = h5py.File('" + path.string() + "', 'r'); assert f['/time'].shape == (50,)";
  EXPECT_EQ(std::system(("/usr/bin/python3 -c \"" + script + "\"").c_str()), 0);
}

TEST_F(RecorderTest, ANewFileIsAsLongAsItsContentWhenItIsClosed) {
  Recorder recorder(path, header, machine());
  append_rows(recorder, 0, 50);
  recorder.flush();
  EXPECT_GE(fs::file_size(path), 4U << 20) << "ahead of what is in use, for readers";
  recorder.close();
  EXPECT_LT(fs::file_size(path), 1U << 20);
}

TEST_F(RecorderTest, ResumesOnlyFromTheRowsThatWereWritten) {
  Recorder recorder(path, header, machine());
  append_rows(recorder, 0, 30);
  const RecordedRows rows = recorder.sync();
  EXPECT_EQ(rows.n_rows, (std::vector<std::size_t>{30, 3}));
  EXPECT_EQ(RecordedRows::unpacked(rows.packed()), rows);
  append_rows(recorder, 30, 40);
  recorder.close();
  const auto resume = [&](const RecordedRows& expected) {
    resume_recording(path, time_of(29), header, machine(), {}, expected).recorder.close();
  };
  for (const std::size_t group : {0U, 1U}) {
    RecordedRows other = rows;
    other.check_sums[group] ^= 1;
    EXPECT_THROW(resume(other), DamagedFile);
    other = rows;
    other.n_rows[group] += 100;
    EXPECT_THROW(resume(other), DamagedFile);
  }
  expect_rows(path, 40);
  resume(rows);
  expect_rows(path, 30);
}

TEST_F(RecorderTest, TimesThatDoNotRiseAreDamage) {
  Recorder recorder(path, header, machine());
  append_rows(recorder, 0, 10);
  recorder.append(0, time_of(9), std::vector<double>{1., 2., 3.});  // again
  recorder.close();
  const auto message = message_of([&] { (void)resume_recording(path, 1, header, machine()); });
  EXPECT_NE(message.find("/time does not rise after row 10"), std::string::npos) << message;
}

TEST(RecordedRows, OfNumbersThatCannotBeAreNone) {
  EXPECT_TRUE(RecordedRows::unpacked({1., 2.}).n_rows.empty());
  EXPECT_TRUE(RecordedRows::unpacked({-1., 2., 3.}).n_rows.empty());
  EXPECT_TRUE(RecordedRows::unpacked({std::nan(""), 2., 3.}).n_rows.empty());
}

TEST_F(RecorderTest, CopiesMoreRowsThanFitInOneBlock) {
  Recorder recorder(path, header, machine());
  append_rows(recorder, 0, 10000);
  recorder.close();
  Recorder copy(directory / "copy.h5", header, machine());
  EXPECT_EQ(copy_rows_until(path, time_of(9999), copy).n_rows.at(0), 10000U);
  copy.close();
  expect_rows(directory / "copy.h5", 10000);
}

TEST_F(RecorderTest, RefusesToReplaceOlderResultsUnlessTold) {
  Recorder first(path, header, machine());
  append_rows(first, 0, 10);
  first.close();
  EXPECT_THROW(Recorder(path, header, machine()), InputError);
  expect_rows(path, 10);
  RecorderOptions options;
  options.overwrite = true;
  Recorder second(path, header, machine(), options);
  append_rows(second, 0, 3);
  second.close();
  EXPECT_EQ(read_series(path, "/time").values.size(), 3U);
  EXPECT_EQ(n_files(), 1U);
}

TEST_F(RecorderTest, SaysWhyTheFileCouldNotBeMadeAndLeavesNothingBehind) {
  const auto missing = message_of([&] { Recorder(directory / "missing" / "results.h5", header, machine()); });
  EXPECT_NE(missing.find("missing/results.h5"), std::string::npos) << missing;
  EXPECT_NE(missing.find("No such file or directory"), std::string::npos) << missing;
  EXPECT_THROW(Recorder(directory / "missing" / "results.h5", header, machine()), SolverError);
  EXPECT_EQ(n_files(), 0U);
}

TEST_F(RecorderTest, ADiskThatIsFullAtTheStartLeavesNothingBehind) {
  Child writer([&] {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1000, 1000};  // [bytes] a file may have; stands for a full disk
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const auto message = message_of([&] { Recorder(path, header, machine()); });
    return message.find("could not be made") != std::string::npos && message.find("File too large") != std::string::npos
               ? 0
               : 1;
  });
  EXPECT_EQ(writer.wait(), 0);
  EXPECT_EQ(n_files(), 0U);
}

TEST_F(RecorderTest, ADiskThatFillsUpWhileAllIsWrittenAtOnceLeavesNothingBehind) {
  const fs::path screen = directory / "stderr.txt";
  for (const rlim_t bytes : {20000, 50000, 90000}) {
    Child writer([&] {
      const int file = ::open(screen.c_str(), O_WRONLY | O_CREAT, 0600);
      ::dup2(file, STDERR_FILENO);
      ::signal(SIGXFSZ, SIG_IGN);
      const rlimit limit{bytes, bytes};
      ::setrlimit(RLIMIT_FSIZE, &limit);
      RecorderOptions options;
      options.seconds_until_made = 1e9;
      {
        Recorder recorder(path, header, machine(), options);
        append_rows(recorder, 0, 3000);
        const auto message = message_of([&] { recorder.close(); });
        if (message.find("results.h5 could not be made") == std::string::npos) return 1;
        if (message.find("File too large") == std::string::npos) return 2;
        if (message_of([&] { recorder.close(); }) != message) return 3;
      }
      std::exit(0);  // runs HDF5's own clean-up, which must neither print nor hang
    });
    EXPECT_EQ(writer.wait(), 0) << bytes;
    EXPECT_EQ(content(screen), "") << bytes;
    fs::remove(screen);
    EXPECT_EQ(n_files(), 0U) << bytes;
  }
}

TEST_F(RecorderTest, ADiskThatFillsUpKeepsTheEarlierRowsAndIsReportedQuietly) {
  const fs::path screen = directory / "stderr.txt";
  Child writer([&] {
    const int file = ::open(screen.c_str(), O_WRONLY | O_CREAT, 0600);
    ::dup2(file, STDERR_FILENO);
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{100000, 100000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    RecorderOptions options;
    options.rows_per_flush = 64;
    options.rows_per_chunk = 64;
    {
      Recorder recorder(path, header, machine(), options);
      const auto message = message_of([&] { append_rows(recorder, 0, 100000); });
      if (message.find("results.h5 could not be written") == std::string::npos) return 1;
      if (message.find("File too large") == std::string::npos) return 2;
      // Once it failed, every further call says so.
      if (message_of([&] { recorder.flush(); }) != message) return 3;
      if (message_of([&] { recorder.close(); }) != message) return 4;
    }              // the destructor must cope, too
    std::exit(0);  // runs HDF5's own clean-up, which must neither print nor hang
  });
  EXPECT_EQ(writer.wait(), 0);
  EXPECT_EQ(content(screen), "");
  const std::size_t n = read_series(path, "/time").values.size();
  EXPECT_GT(n, 500U);
  expect_rows(path, n);
}

TEST_F(RecorderTest, RefusesATableOrARowThatIsWrong) {
  auto groups = machine();
  groups[1].channels[0].path = "/time";
  EXPECT_THROW(Recorder(path, header, groups), std::invalid_argument) << "the same path twice";
  groups = machine();
  groups[0].channels[0].path = "force";
  EXPECT_THROW(Recorder(path, header, groups), std::invalid_argument) << "not absolute";
  groups = machine();
  groups[0].channels[1].columns = {"y"};
  EXPECT_THROW(Recorder(path, header, groups), std::invalid_argument) << "one name for two columns";
  groups = machine();
  groups[0].channels[0].size = 0;
  EXPECT_THROW(Recorder(path, header, groups), std::invalid_argument);
  EXPECT_EQ(n_files(), 0U);

  Recorder recorder(path, header, machine());
  EXPECT_THROW(recorder.append(0, 0, std::vector<double>(2)), std::invalid_argument) << "a value is missing";
  EXPECT_THROW(recorder.append(2, 0, std::vector<double>(1)), std::out_of_range);
  recorder.append(0, 1, row_of(0));
  EXPECT_THROW(recorder.append(0, 0.5, row_of(1)), std::invalid_argument) << "time runs backwards";
  recorder.close();
  recorder.close();
  EXPECT_THROW(recorder.append(0, 2, row_of(2)), std::logic_error);
}

TEST_F(RecorderTest, GoesOnWritingAfterItWasMovedInMemoryAndOnDisk) {
  Recorder first(path, header, machine());
  append_rows(first, 0, 10);
  Recorder second(std::move(first));
  second.move_to(directory / "other.h5");
  append_rows(second, 10, 20);
  second.close();
  EXPECT_EQ(n_files(), 1U);
  expect_rows(directory / "other.h5", 20);
}

// A child of a process with threads waits for ever in the allocator that GCC 12 has for sanitizers, if another thread had locked it.
#if !defined(__SANITIZE_ADDRESS__)
TEST_F(RecorderTest, AFileIsTriedWhileAnotherThreadReads) {
  {
    Recorder recorder(path, header, machine());
    append_rows(recorder, 0, 2000);
  }
  std::atomic<bool> ends = false;
  std::thread reader([&] {
    while (!ends) static_cast<void>(read_series(path, "/bearings/TB1/orbit"));
  });
  // HDF5 has one lock: a process that begins amid a call of the reader must not wait for it.
  std::string message;
  for (int i = 0; i < 20 && message.empty(); ++i) {
    try {
      hdf5::try_to_read(path, 2);
    } catch (const std::exception& error) {
      message = error.what();
    }
  }
  ends = true;
  reader.join();
  EXPECT_EQ(message, "");
}
#endif

TEST_F(RecorderTest, ReadersSayWhatIsNotThere) {
  testing::internal::CaptureStderr();
  Recorder(path, header, machine()).close();
  EXPECT_THROW((void)read_series(directory / "none.h5", "/time"), InputError);
  EXPECT_THROW((void)read_series(directory, "/time"), InputError);
  const auto message = message_of([&] { (void)read_series(path, "/bearings/TB3/orbit"); });
  EXPECT_NE(message.find("there is no dataset /bearings/TB3/orbit"), std::string::npos) << message;
  EXPECT_THROW((void)read_series(path, "/parameters"), InputError) << "text is not a series";
  EXPECT_THROW((void)read_series(path, "/bearings/TB1"), InputError) << "a group is not a series";
  EXPECT_THROW((void)read_text(path, "/time"), InputError);
  EXPECT_THROW((void)read_attribute(path, "/time", "colour"), InputError);
  EXPECT_THROW((void)read_attribute(path, "/nothing", "units"), InputError);
  std::ofstream(directory / "text.h5") << "This is not HDF5.";
  EXPECT_THROW((void)read_series(directory / "text.h5", "/time"), InputError);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "HDF5 must not print";
}

}  // namespace
