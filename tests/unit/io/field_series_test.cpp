#include "io/hdf5/field_series.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>

namespace rotordrop {
namespace {

namespace fs = std::filesystem;

class FieldSeriesTest : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  void add(FieldSeries& series, double time) {
    series.add(time, [time](const std::string& file) { std::ofstream(file) << time; });
  }
  [[nodiscard]] std::string list() const {
    std::ifstream file(folder_ / "TB1.pvd");
    return {std::istreambuf_iterator<char>(file), {}};
  }
  [[nodiscard]] std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& file : fs::directory_iterator(folder_)) names.insert(file.path().filename().string());
    return names;
  }
  const fs::path folder_ = fs::temp_directory_path() / ("rotordrop-fields-" + std::to_string(getpid()));
};

TEST_F(FieldSeriesTest, ListsEveryFileWithItsTimeAsWritten) {
  FieldSeries series(folder_, "TB1");
  for (const double t : {0., 0.1, 1. / 3.}) add(series, t);
  EXPECT_NE(list().find("timestep=\"0.1\" group=\"\" part=\"0\" file=\"TB1-00001.vtu\""), std::string::npos) << list();
  EXPECT_NE(list().find("timestep=\"0.3333333333333333\""), std::string::npos) << list();
  EXPECT_EQ(files(), (std::set<std::string>{"TB1.pvd", "TB1-00000.vtu", "TB1-00001.vtu", "TB1-00002.vtu"}));
}

TEST_F(FieldSeriesTest, GoesOnAfterATimeAndForgetsWhatCameLater) {
  {
    FieldSeries series(folder_, "TB1");
    for (const double t : {0., 0.1, 0.2, 0.3}) add(series, t);
    std::ofstream(folder_ / "TB1-00004.vtu.part") << "half";
    std::ofstream(folder_ / "TB1-2-00000.vtu") << "another bearing's";
  }
  FieldSeries series(folder_, "TB1", 0.2);
  EXPECT_EQ(series.last_time(), 0.2);
  EXPECT_EQ(files(),
            (std::set<std::string>{"TB1.pvd", "TB1-00000.vtu", "TB1-00001.vtu", "TB1-00002.vtu", "TB1-2-00000.vtu"}));
  add(series, 0.25);
  EXPECT_EQ(list().find("\"0.3\""), std::string::npos);
  EXPECT_NE(list().find("timestep=\"0.25\" group=\"\" part=\"0\" file=\"TB1-00003.vtu\""), std::string::npos);
}

TEST_F(FieldSeriesTest, StartsAnewUnlessToldOtherwise) {
  {
    FieldSeries series(folder_, "TB1");
    add(series, 0.);
    add(series, 0.1);
  }
  const FieldSeries series(folder_, "TB1");
  EXPECT_TRUE(series.empty());
  EXPECT_EQ(files(), std::set<std::string>{"TB1.pvd"});
}

TEST_F(FieldSeriesTest, KeepsTheListWhenAFileCannotBeWritten) {
  FieldSeries series(folder_, "TB1");
  add(series, 0.);
  const std::string before = list();
  EXPECT_ANY_THROW(series.add(0.1, [](const std::string&) {}));
  EXPECT_EQ(list(), before);
}

TEST(FieldTimes, AreListedOnesAndMultiplesAsOneWritesThem) {
  const FieldTimes times({0.15, 0.3}, 0.1);
  std::vector<double> met;
  for (double t = -1.; (t = times.after(t)) < 0.45;) met.push_back(t);
  EXPECT_EQ(met, (std::vector<double>{0., 0.1, 0.15, 0.2, 0.3, 0.4}));
  EXPECT_EQ(FieldTimes().after(-1.), std::numeric_limits<double>::infinity());
  EXPECT_EQ(FieldTimes({0.2}, 0.).after(0.2), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace rotordrop
