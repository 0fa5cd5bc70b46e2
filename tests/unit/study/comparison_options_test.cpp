#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/errors.h"
#include "study/compare/comparison.h"

namespace {

using namespace rotordrop;

TEST(ComparisonOptions, TakeATemperatureOrAPart) {
  EXPECT_TRUE(parse_temperature_tolerance("5 %").is_part);
  EXPECT_DOUBLE_EQ(parse_temperature_tolerance("5 %").value, 0.05);
  EXPECT_DOUBLE_EQ(parse_temperature_tolerance("12%").value, 0.12);
  EXPECT_FALSE(parse_temperature_tolerance("0.5 K").is_part);
  EXPECT_DOUBLE_EQ(parse_temperature_tolerance("500 mK").value, 0.5);
  // A difference: no offset of the Celsius scale.
  EXPECT_DOUBLE_EQ(parse_temperature_tolerance("2 degC").value, 2.);
}

TEST(ComparisonOptions, RefuseWhatIsNone) {
  for (const char* text : {"", "%", "0 %", "-5 %", "0 K", "-1 K", "5 um", "5 % K", "nan %", "warm"})
    EXPECT_THROW(parse_temperature_tolerance(text), InputError) << text;
  EXPECT_THROW(parse_length("0 um", "--growth-tolerance"), InputError);
  EXPECT_THROW(parse_length("1 K", "--growth-tolerance"), InputError);
  EXPECT_THROW(parse_instants("10 ms,"), InputError);
  EXPECT_THROW(parse_instants("10 mm"), InputError);
}

TEST(ComparisonOptions, TakeSeveralInstants) {
  EXPECT_THAT(parse_instants("10 ms, 50 ms"), testing::ElementsAre(testing::DoubleEq(0.01), testing::DoubleEq(0.05)));
  EXPECT_THAT(parse_instants("0.01, 0.05"), testing::ElementsAre(testing::DoubleEq(0.01), testing::DoubleEq(0.05)));
  EXPECT_THROW(parse_instants("10 ms, 0.05"), InputError);
  EXPECT_DOUBLE_EQ(parse_length("0.2 um", "x"), 2e-7);
}

TEST(ComparisonFiles, SeriesStandBesideTheReport) {
  EXPECT_EQ(comparison_series_file("out/a/comparison.json"), "out/a/comparison.h5");
  EXPECT_EQ(comparison_series_file("report"), "report.h5");
}

}  // namespace
