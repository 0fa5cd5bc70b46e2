// A process that records is killed before, and within, each single one of its writes. The system ends a write of a killed process only
// between two pages, so these are all files that a kill can leave.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include "io/hdf5/file_bytes.h"
#include "io/hdf5/guarded_write.h"
#include "io/hdf5/recorded_series.h"
#include "io/hdf5/recorder.h"

namespace {

/// When this process is to die: at the n-th place where a kill makes another file. Only children set it.
long places_until_death = -1;
/// Whether the last write before it was one that a kill ended halfway; shared with the parent.
struct Seen {
  std::atomic<std::size_t> n_rows;
  std::atomic<bool> was_torn;
};
Seen* seen = nullptr;

constexpr std::size_t page = 4096;

void place(bool is_torn) {
  if (--places_until_death != 0) return;
  seen->was_torn = is_torn;
  ::raise(SIGKILL);
}

}  // namespace

/// Stands before the system's own, for everything in this program.
extern "C" ssize_t pwrite(int descriptor, const void* bytes, size_t size, off_t address) {
  if (places_until_death < 0) return ::syscall(SYS_pwrite64, descriptor, bytes, size, address);
  place(false);
  const char* from = static_cast<const char*>(bytes);
  for (std::size_t done = 0; done < size;) {
    const std::size_t in_page = std::min(size - done, page - (static_cast<std::size_t>(address) + done) % page);
    const ssize_t n = ::syscall(SYS_pwrite64, descriptor, from + done, in_page, address + static_cast<off_t>(done));
    if (n < 0) return n;
    done += static_cast<std::size_t>(n);
    if (done < size) place(true);
  }
  return static_cast<ssize_t>(size);
}

namespace rotordrop {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t n_orbit = 60;  // of a row: rows between two flushes are longer than a page

double value_of(std::size_t row) { return 0.5 * static_cast<double>(row); }

std::vector<double> row_of(std::size_t row) {
  std::vector<double> values(1 + n_orbit, 1.);
  values.front() = value_of(row);
  return values;
}

std::vector<SeriesGroup> three_groups() {
  std::vector<SeriesGroup> groups;
  for (const std::string name : {"a", "b", "c"})
    groups.push_back(
        {"/" + name + "/time",
         {{"/" + name + "/force", "N", "force", 1, {}}, {"/" + name + "/orbit", "m", "orbit", n_orbit, {}}}});
  return groups;
}

void record(const fs::path& path) {
  RecorderOptions options;
  options.rows_per_flush = 1000;  // by hand
  options.rows_per_chunk = 8;     // many chunks: their index grows
  Recorder recorder(path, {}, three_groups(), options);
  for (std::size_t row = 0; row < 260; ++row) {
    for (std::size_t group = 0; group < 3; ++group)
      recorder.append(group, 1e-5 * static_cast<double>(row), row_of(row));
    if (row % 20 != 19) continue;
    recorder.flush();
    seen->n_rows = row + 1;
  }
  recorder.close();
}

class KillWithinWrite : public testing::Test {
 protected:
  KillWithinWrite() {
    void* shared = ::mmap(nullptr, sizeof(Seen), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    seen = new (shared) Seen{};
    fs::create_directories(folder);
  }
  ~KillWithinWrite() override {
    fs::remove_all(folder);
    ::munmap(seen, sizeof(Seen));
    seen = nullptr;
  }
  KillWithinWrite(const KillWithinWrite&) = delete;
  KillWithinWrite& operator=(const KillWithinWrite&) = delete;

  /// Does the work in a process of its own. @returns whether that died at its n-th place; false if it came to its end before
  template <class Work>
  [[nodiscard]] static bool dies_at_place(long n, Work work) {
    new (seen) Seen{};
    const pid_t child = ::fork();
    if (child == 0) {
      places_until_death = n;
      work();
      std::_Exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFSIGNALED(status);
  }

  fs::path folder = fs::temp_directory_path() / ("kill_within_write_" + std::to_string(::getpid()));
  fs::path path = folder / "results.h5";
};

TEST_F(KillWithinWrite, LeavesEveryFlushedRowReadableAtEveryPlace) {
  std::size_t n_places = 0, n_torn = 0, n_mended = 0;
  for (long n = 1;; ++n) {
    fs::remove_all(folder);
    fs::create_directories(folder);
    if (!dies_at_place(n, [&] { record(path); })) break;
    ++n_places;
    n_torn += seen->was_torn ? 1 : 0;
    if (!fs::exists(path)) {
      ASSERT_EQ(seen->n_rows, 0U) << n;
      continue;
    }
    const int descriptor = ::open(path.c_str(), O_RDONLY);
    n_mended += hdf5::TornBlock::find(descriptor).has_value() ? 1 : 0;
    ::close(descriptor);
    for (const std::string group : {"a", "b", "c"})
      for (const std::string series : {"/time", "/force", "/orbit"}) {
        SCOPED_TRACE("/" + group + series + " after a kill at place " + std::to_string(n));
        Series found;
        ASSERT_NO_THROW(found = read_series(path, "/" + group + series));
        ASSERT_GE(found.shape.at(0), seen->n_rows);
        if (series != "/force") continue;
        for (std::size_t row = 0; row < found.values.size(); ++row) ASSERT_EQ(found.values[row], value_of(row));
      }
  }
  RecordProperty("places", std::to_string(n_places));
  EXPECT_GT(n_torn, 20U) << "there are writes of more than one page";
  EXPECT_GT(n_mended, 0U) << "some of them are blocks that HDF5 cannot read in halves";
}

TEST(Lookup3, HasThePublishedValue) {
  // Self-test of lookup3.c (Bob Jenkins, public domain): hashlittle("Four score and seven years ago", 30, 0).
  constexpr std::string_view text = "Four score and seven years ago";
  EXPECT_EQ(hdf5::lookup3(std::vector<unsigned char>(text.begin(), text.end())), 0x17770551U);
}

/// A block over the ends of two pages is written over by another.
class GuardedWrite : public KillWithinWrite {
 protected:
  using Bytes = std::vector<unsigned char>;
  static constexpr std::uint64_t file_size = 64 << 10, address = 4000;
  static constexpr std::size_t size = 5000, n_pages = 3;

  static Bytes rising(std::size_t n) {
    Bytes bytes(n);
    std::iota(bytes.begin(), bytes.end(), static_cast<unsigned char>(1));
    return bytes;
  }

  GuardedWrite() : descriptor(::open(path.c_str(), O_RDWR | O_CREAT, 0600)) {
    EXPECT_EQ(::ftruncate(descriptor, file_size), 0);
    EXPECT_TRUE(write(before));
  }
  ~GuardedWrite() override { ::close(descriptor); }
  GuardedWrite(const GuardedWrite&) = delete;
  GuardedWrite& operator=(const GuardedWrite&) = delete;

  [[nodiscard]] bool write(const Bytes& block) const {
    return hdf5::write_whole(descriptor, address, block, address + size, file_size);
  }
  /// The system's view, and the one of a reader.
  [[nodiscard]] Bytes on_file() const {
    Bytes bytes(size);
    EXPECT_EQ(::pread(descriptor, bytes.data(), size, address), static_cast<ssize_t>(size));
    return bytes;
  }
  [[nodiscard]] Bytes read() const {
    Bytes bytes = on_file();
    if (const auto torn = hdf5::TornBlock::find(descriptor)) torn->mend(descriptor, address, bytes);
    return bytes;
  }
  /// Leaves the block torn after its first page.
  void tear() const {
    for (long n = 1; on_file() == before; ++n) ASSERT_TRUE(dies_at_place(n, [&] { (void)write(after); }));
    ASSERT_NE(on_file(), after);
    ASSERT_TRUE(hdf5::TornBlock::find(descriptor));
  }

  int descriptor;
  Bytes before = Bytes(size, 'a'), after = rising(size);
};

TEST_F(GuardedWrite, IsReadAsBeforeOrAsMeantAtEveryPlace) {
  std::size_t n_torn = 0;
  for (long n = 1; dies_at_place(n, [&] { (void)write(after); }); ++n) {
    n_torn += on_file() != before && on_file() != after ? 1 : 0;
    EXPECT_TRUE(read() == before || read() == after) << "killed at place " << n;
    ASSERT_TRUE(write(before));
  }
  EXPECT_EQ(n_torn, n_pages - 1);
  EXPECT_EQ(read(), after) << "the last one was not killed";
  EXPECT_FALSE(hdf5::TornBlock::find(descriptor)) << "its copy is struck out";
}

TEST_F(GuardedWrite, MendsWhatIsReadInParts) {
  tear();
  const auto torn = hdf5::TornBlock::find(descriptor);
  Bytes part(1000, 'x');
  torn->mend(descriptor, address + size - 500, part);
  Bytes expected(after.end() - 500, after.end());
  expected.resize(1000, 'x');
  EXPECT_EQ(part, expected);
  Bytes beside(100, 'x');
  torn->mend(descriptor, address - 100, beside);
  torn->mend(descriptor, address + size, beside);
  EXPECT_EQ(beside, Bytes(100, 'x'));
}

TEST_F(GuardedWrite, LeavesWhatIsNewerThanTheCopy) {
  tear();
  const auto torn = hdf5::TornBlock::find(descriptor);
  const Bytes newer(size, 'c');
  ASSERT_TRUE(write(newer));  // the writer lived, and went on
  Bytes bytes = on_file();
  torn->mend(descriptor, address, bytes);
  EXPECT_EQ(bytes, newer);
}

TEST_F(GuardedWrite, LeavesABlockThatAnotherProgramHasWritten) {
  tear();
  const Bytes newer(size, 'c');
  ASSERT_TRUE(hdf5::write_bytes(descriptor, address, newer));
  EXPECT_EQ(read(), newer);
}

TEST_F(GuardedWrite, LeavesAPartOfABlockThatWasWrittenLater) {
  ASSERT_TRUE(write(after));
  const Bytes newer(100, 'c');
  ASSERT_TRUE(hdf5::write_whole(descriptor, address + 4000, newer, address + size, file_size)) << "within one page";
  EXPECT_EQ(read(), on_file());
}

TEST_F(GuardedWrite, KeepsToTheUnusedEndOfTheFile) {
  const Bytes used(2 * size, 'u');
  ASSERT_TRUE(hdf5::write_bytes(descriptor, file_size - used.size(), used));
  ASSERT_TRUE(hdf5::write_whole(descriptor, address, after, file_size - size, file_size)) << "no room for a copy";
  Bytes bytes(used.size());
  ASSERT_EQ(::pread(descriptor, bytes.data(), bytes.size(), file_size - used.size()),
            static_cast<ssize_t>(used.size()));
  EXPECT_EQ(bytes, used);
  EXPECT_EQ(on_file(), after);
}

}  // namespace
}  // namespace rotordrop
