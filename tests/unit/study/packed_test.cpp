// Base64 against the test vectors of RFC 4648, section 10.
#include "study/report/packed.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace rotordrop {
namespace {

std::string coded(const std::string& text) {
  return base64(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

TEST(Base64, IsThatOfItsStandard) {
  EXPECT_EQ(coded(""), "");
  EXPECT_EQ(coded("f"), "Zg==");
  EXPECT_EQ(coded("fo"), "Zm8=");
  EXPECT_EQ(coded("foo"), "Zm9v");
  EXPECT_EQ(coded("foob"), "Zm9vYg==");
  EXPECT_EQ(coded("fooba"), "Zm9vYmE=");
  EXPECT_EQ(coded("foobar"), "Zm9vYmFy");
}

TEST(Packed, KeepsEndsOfTheRangeAndItsMiddle) {
  const std::vector<double> values = {-2., 3., 0.5};
  const auto p = packed(values, 10.);
  EXPECT_DOUBLE_EQ(p["low"].get<double>(), -20.);
  EXPECT_DOUBLE_EQ(p["high"].get<double>(), 30.);
  // Levels 0, 65535, 32768 (the middle rounds up), lower byte first.
  EXPECT_EQ(p["levels"], base64(std::vector<std::uint8_t>{0, 0, 255, 255, 0, 128}));
}

TEST(Packed, OfANegativeScaleIsTurnedOver) {
  const std::vector<double> values = {1., 2.};
  const auto p = packed(values, -1.);
  EXPECT_DOUBLE_EQ(p["low"].get<double>(), -2.);
  EXPECT_EQ(p["levels"], base64(std::vector<std::uint8_t>{255, 255, 0, 0}));
}

TEST(PackedFloats, AreThoseOfIeee754) {
  const std::vector<double> values = {1., -2.};
  // 1.0 is 3f800000, -2.0 is c0000000.
  EXPECT_EQ(packed_floats(values, 1.), base64(std::vector<std::uint8_t>{0, 0, 0x80, 0x3f, 0, 0, 0, 0xc0}));
}

}  // namespace
}  // namespace rotordrop
