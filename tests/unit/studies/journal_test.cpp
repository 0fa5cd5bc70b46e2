#include "study/many/journal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "io/hdf5/column_file.h"
#include "study_inputs.h"

using namespace rotordrop;

namespace {

PointResult result_of(double value) {
  PointResult r;
  r.is_done = true;
  r.scalars = {{"a", value}, {"b", std::nan("")}};
  return r;
}

std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST(Journal, GivesBackEveryBitOfItsNumbers) {
  const test::StudyFolder folder;
  const auto file = folder.path() / "j";
  {
    Journal journal(file, "head");
    journal.append(7, result_of(0.1 + 0.2), 1.5);
    PointResult failed;
    failed.reason = "line 1\nline \"2\"";
    journal.append(3, failed, 0.);
  }
  const auto content = Journal::read(file);
  EXPECT_EQ(content.header, "head");
  ASSERT_EQ(content.records.size(), 2U);
  EXPECT_EQ(content.records.at(7).values[0], 0.1 + 0.2);
  EXPECT_TRUE(std::isnan(content.records.at(7).values[1]));
  EXPECT_EQ(content.records.at(3).reason, "line 1\nline \"2\"");
  EXPECT_FALSE(content.records.at(3).is_done);
}

TEST(Journal, TellsItsHeaderWithoutTheRest) {
  const test::StudyFolder folder;
  const auto file = folder.path() / "j";
  Journal(file, "head \"of\" it").append(7, result_of(1.), 0.);
  std::ofstream(file, std::ios::binary | std::ios::app) << "a damaged end\n";
  EXPECT_EQ(Journal::header_of(file), "head \"of\" it");
  std::ofstream(file, std::ios::binary) << "no journal\n";
  EXPECT_THROW((void)Journal::header_of(file), InputError);
}

// A killed writer leaves any beginning of its file: whatever the cut, all whole lines are read, and what is added after them too.
TEST(Journal, LosesAtMostTheLineThatWasBeingWritten) {
  const test::StudyFolder folder;
  const auto file = folder.path() / "j", cut = folder.path() / "cut";
  {
    Journal journal(file, "head");
    for (std::size_t i = 0; i < 5; ++i) journal.append(i, result_of(1. / (1. + static_cast<double>(i))), 0.);
  }
  const std::string whole = content_of(file);
  const std::size_t head = whole.find('\n') + 1;
  for (std::size_t n = head; n < whole.size(); n += 7) {
    std::ofstream(cut, std::ios::binary) << whole.substr(0, n);
    const auto content = Journal::read(cut);
    EXPECT_EQ(content.valid_bytes, whole.rfind('\n', n - 1) + 1);
    {
      Journal journal(cut, content);
      for (std::size_t i = 0; i < 5; ++i)
        if (!content.records.contains(i)) journal.append(i, result_of(1. / (1. + static_cast<double>(i))), 0.);
    }
    EXPECT_EQ(content_of(cut), whole) << "cut at " << n;
  }
  std::string damaged = whole;
  damaged[whole.size() - 30] ^= 1;
  std::ofstream(cut, std::ios::binary) << damaged;
  EXPECT_EQ(Journal::read(cut).records.size(), 4U);
}

TEST(ColumnFile, HasTheSameBytesForTheSameTable) {
  const test::StudyFolder folder;
  const std::vector<TableColumn> columns{
      {"/results/a.b", "N", "force", {1., std::nan("")}, {}, {}, 1, TableColumn::Kind::numbers},
      {"/status", "", "", {}, {0, 1}, {}, 1, TableColumn::Kind::integers},
      {"/reason", "", "", {}, {}, {"", "it failed"}, 1, TableColumn::Kind::texts}};
  write_columns(folder.path() / "one.h5", {{"program", "p"}}, columns);
  timespec second{1, 100'000'000};
  nanosleep(&second, nullptr);  // HDF5 keeps times by the second, if it does
  write_columns(folder.path() / "two.h5", {{"program", "p"}}, columns);
  EXPECT_EQ(content_of(folder.path() / "one.h5"), content_of(folder.path() / "two.h5"));
}
