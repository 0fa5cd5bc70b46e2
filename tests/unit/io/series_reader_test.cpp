#include "io/hdf5/series_reader.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <numeric>
#include <string>
#include <vector>

#include "base/errors.h"
#include "io/hdf5/recorded_series.h"

namespace rotordrop {
namespace {

namespace fs = std::filesystem;
using hdf5::Handle;

class SeriesReaderTest : public testing::Test {
 protected:
  void SetUp() override { hdf5::be_quiet(); }
  void TearDown() override { fs::remove(path_); }
  /// A file with one series of `n_rows` in chunks, of which the first `values` are written.
  void write(hsize_t n_rows, hsize_t chunk_rows, const std::vector<double>& values) const {
    const Handle file(H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose, "file");
    const Handle list(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "list");
    hdf5::require(H5Pset_chunk(list.id(), 1, &chunk_rows), "chunk");
    const hsize_t most = H5S_UNLIMITED;
    const Handle space(H5Screate_simple(1, &n_rows, &most), H5Sclose, "space");
    const Handle series(
        H5Dcreate2(file.id(), "series", H5T_NATIVE_DOUBLE, space.id(), H5P_DEFAULT, list.id(), H5P_DEFAULT), H5Dclose,
        "series");
    const hsize_t start = 0, n = values.size();
    const Handle in_memory(H5Screate_simple(1, &n, nullptr), H5Sclose, "memory");
    hdf5::require(H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, &start, nullptr, &n, nullptr), "rows");
    hdf5::require(H5Dwrite(series.id(), H5T_NATIVE_DOUBLE, in_memory.id(), space.id(), H5P_DEFAULT, values.data()),
                  "write");
  }
  const fs::path path_ = fs::temp_directory_path() / ("rotordrop-series-" + std::to_string(getpid()) + ".h5");
};

TEST_F(SeriesReaderTest, ReadsRowsOfManyChunksInOrder) {
  std::vector<double> values(5000);
  std::iota(values.begin(), values.end(), 0.);
  write(5000, 2, values);  // 2048 rows are read at a time
  EXPECT_EQ(read_series(path_, "/series").values, values);
  const Handle file = hdf5::open_for_reading(path_);
  const auto within = hdf5::SeriesReader(file.id(), path_, "/series").rows(1000, 3001);
  EXPECT_EQ(within, std::vector<double>(values.begin() + 1000, values.begin() + 4001));
}

TEST_F(SeriesReaderTest, RowsThatAreNotYetWrittenAreNoDamage) {
  write(400'000, 4, {1., 2., 3.});
  EXPECT_EQ(read_series(path_, "/series").values.size(), 400'000U);
}

TEST_F(SeriesReaderTest, AFileWithMoreChunksThanItCanHoldIsDamaged) {
  // One altered byte of an extent makes three rows six million. HDF5 takes 2 GB for their chunks at once, and crashes where it does not get them.
  write(6'094'851, 4, {1., 2., 3.});
  EXPECT_THROW(static_cast<void>(read_series(path_, "/series")), DamagedFile);
}

TEST_F(SeriesReaderTest, AFileWithAChunkLargerThanItCanHoldIsDamaged) {
  write(3, hsize_t{1} << 28, {});
  EXPECT_THROW(static_cast<void>(read_series(path_, "/series")), DamagedFile);
}

}  // namespace
}  // namespace rotordrop
