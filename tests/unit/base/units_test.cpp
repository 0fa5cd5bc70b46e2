#include "base/units.h"
#include "base/errors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

using namespace rotordrop;
using std::numbers::pi;
using testing::AllOf;
using testing::HasSubstr;

namespace {

/// Both sentences of a conversion that must fail.
std::string refusal(std::string_view text, std::string_view unit, QuantityKind kind,
                    std::string_view name = "air_gap") {
  const Conversion conversion = convert_to_si(text, unit, kind, name);
  EXPECT_FALSE(conversion) << text << " was read as " << conversion.value << " " << unit;
  return conversion.error + " | " + conversion.advice;
}
std::string refusal(std::string_view text, std::string_view unit) { return refusal(text, unit, kind_of(unit)); }

}  // namespace

TEST(Units, ABareNumberIsInSi) {
  EXPECT_EQ(to_si("1.144e9", "N/m"), 1.144e9);
  EXPECT_EQ(to_si(" -5 ", "m"), -5.0);
  EXPECT_EQ(to_si("+2", "m"), 2.0);
  EXPECT_EQ(to_si("25", "rad"), 25.0);
  EXPECT_EQ(to_si("293.15", "K"), 293.15);
}

TEST(Units, DecimalPrefixesCostNoDigits) {
  EXPECT_EQ(to_si("250 um", "m"), 250e-6);
  EXPECT_EQ(to_si("250um", "m"), 250e-6);
  EXPECT_EQ(to_si("250 µm", "m"), 250e-6);
  EXPECT_EQ(to_si("11.906 mm", "m"), 11.906e-3);
  EXPECT_EQ(to_si("200 GPa", "Pa"), 200e9);
  EXPECT_EQ(to_si("85 N/um", "N/m"), 85e6);
  EXPECT_EQ(to_si("15 mm2/s", "m2/s"), 15e-6);
}

TEST(Units, KnowsTheUnitsOfTheDeclarations) {
  EXPECT_EQ(to_si("3 kg m2", "kg m2"), 3.0);
  EXPECT_EQ(to_si("70 W/(m K)", "W/(m K)"), 70.0);
  EXPECT_EQ(to_si("70 W/m/K", "W/(m K)"), 70.0);
  EXPECT_EQ(to_si("510 J/(kg K)", "J/(kg K)"), 510.0);
  EXPECT_EQ(to_si("0.08 s/m", "s/m"), 0.08);
  EXPECT_EQ(to_si("30 1/s", "1/s"), 30.0);
  EXPECT_EQ(to_si("30 s^-1", "1/s"), 30.0);
  EXPECT_EQ(to_si("30 s-1", "1/s"), 30.0);
  EXPECT_EQ(to_si("9.81 m s^-2", "m/s2"), 9.81);
  EXPECT_EQ(to_si("9.81 m/s**2", "m/s2"), 9.81);
  EXPECT_NEAR(to_si("5 %", "1"), 0.05, 1e-17);
  EXPECT_EQ(to_si("2 kN m", "N m"), 2000.0);
}

TEST(Units, ARevolutionPerMinuteIsTwoPiOverSixty) {
  EXPECT_NEAR(to_si("15200 rpm", "rad/s"), 15200.0 * 2.0 * pi / 60.0, 1e-10);
  EXPECT_NEAR(to_si("15200 rev/min", "rad/s"), 15200.0 * 2.0 * pi / 60.0, 1e-10);
  EXPECT_EQ(to_si("1592 rad/s", "rad/s"), 1592.0);
}

TEST(Units, ADegreeIsPiOver180) {
  EXPECT_NEAR(to_si("180 deg", "rad"), pi, 1e-15);
  EXPECT_NEAR(to_si("25 deg", "rad"), 25.0 * pi / 180.0, 1e-16);
  EXPECT_NEAR(to_si("25 °", "rad"), 25.0 * pi / 180.0, 1e-15);
  EXPECT_NEAR(to_si("1 deg/s", "rad/s"), pi / 180.0, 1e-17);
}

TEST(Units, HertzDoesNotSayWhetherItCountsRevolutions) {
  for (const char* text : {"250 Hz", "250 1/s", "250 s-1", "250 s^-1", "0.25 kHz"})
    EXPECT_THAT(refusal(text, "rad/s"),
                AllOf(HasSubstr("revolutions or radians"), HasSubstr("Write rpm"), HasSubstr("rad/s")));
  EXPECT_EQ(to_si("250 Hz", "1/s"), 250.0) << "as a rate it is clear";
}

TEST(Units, ARateIsNoAngularSpeed) {
  EXPECT_THAT(refusal("30 rad/s", "1/s"), AllOf(HasSubstr("is an angular speed"), HasSubstr("needs a rate")));
  EXPECT_THAT(refusal("30 rpm", "1/s"), HasSubstr("write it in 1/s"));
}

TEST(Units, AnAngleIsNoNumberWithoutUnit) {
  EXPECT_THAT(refusal("5 rad", "1"), AllOf(HasSubstr("5 rad is an angle"), HasSubstr("needs a number without unit")));
  EXPECT_THAT(refusal("5 deg", "1"), HasSubstr("is an angle"));
  EXPECT_THAT(refusal("5 %", "rad"), HasSubstr("needs an angle such as 25 deg"));
  EXPECT_THAT(refusal("0.1 m", "rad"), AllOf(HasSubstr("is a length"), HasSubstr("deg or rad")));
  EXPECT_THAT(refusal("5 N m", "N m/rad"), HasSubstr("is a torque or energy"));
}

TEST(Units, AWrongDimensionIsNamedTogetherWithTheNeededOne) {
  EXPECT_THAT(refusal("5 s", "m"), HasSubstr("5 s is a time; air_gap needs a length such as 250 um"));
  EXPECT_THAT(refusal("5 kg m4", "m"), HasSubstr("a value in kg m4"));
  EXPECT_THAT(refusal("5 m", "kg m5"), HasSubstr("needs a number in kg m5 such as 1 kg m5"));
}

TEST(Units, AnAbsoluteTemperatureHasAnOffset) {
  EXPECT_EQ(to_si("20 degC", "K"), 293.15);
  EXPECT_EQ(to_si("20 °C", "K"), 293.15);
  EXPECT_EQ(to_si("20 celsius", "K"), 293.15);
  EXPECT_NEAR(to_si("68 degF", "K"), 293.15, 1e-10);
  EXPECT_EQ(to_si("293 K", "K"), 293.0);
  EXPECT_THAT(refusal("-300 degC", "K"), HasSubstr("below absolute zero"));
  EXPECT_THAT(refusal("-1", "K"), HasSubstr("below absolute zero"));
  EXPECT_THAT(refusal("20 C", "K"), AllOf(HasSubstr("electric charge"), HasSubstr("degC")));
}

TEST(Units, ATemperatureDifferenceHasNoOffset) {
  const auto difference = QuantityKind::temperature_difference;
  EXPECT_EQ(to_si("5 degC", "K", difference), 5.0);
  EXPECT_EQ(to_si("5 K", "K", difference), 5.0);
  EXPECT_EQ(to_si("-5", "K", difference), -5.0);
  EXPECT_NEAR(to_si("9 degF", "K", difference), 5.0, 1e-9);
  EXPECT_NEAR(to_si("50 W/(m2 degC)", "W/(m2 K)"), 50.0, 1e-12);
  EXPECT_THAT(refusal("5 m", "K", difference), HasSubstr("needs a temperature difference such as 5 K"));
}

TEST(Units, ExponentsThatAreNoIntegersAreRefused) {
  for (const char* text : {"5 N/m^1.11", "5 N/m1.11", "5 N/m^(10/9)", "5 N/m^10/9", "5 N/m^n", "5 m^.5", "5 m^1/2"})
    EXPECT_THAT(refusal(text, "N/m"), HasSubstr("exponent that is not an integer"));
}

TEST(Units, AUnitWithASymbolicExponentTakesBareNumbersOnly) {
  EXPECT_TRUE(takes_bare_numbers_only("N/m^n"));
  EXPECT_TRUE(takes_bare_numbers_only("N/m^(10/9)"));
  EXPECT_FALSE(takes_bare_numbers_only("1/s"));
  EXPECT_EQ(to_si("1.144e9", "N/m^n"), 1.144e9);
  EXPECT_THAT(refusal("1.144e9 N/m", "N/m^n"), HasSubstr("takes a bare number in N/m^n"));
  EXPECT_THAT(refusal("5 N/m^n", "N/m^n"), HasSubstr("without a unit"));
}

TEST(Units, NumbersWithinAUnitAreRefused) {
  EXPECT_THAT(refusal("5 10 um", "m"), HasSubstr("contains a number"));
  EXPECT_THAT(refusal("5 m*2", "m"), HasSubstr("contains a number"));
  EXPECT_THAT(refusal("5 K from 3", "K"), HasSubstr("contains a number"));
  EXPECT_THAT(refusal("5 K @ 3", "K"), HasSubstr("contains a number"));
}

TEST(Units, UnknownUnitsAndWordsAreRefused) {
  EXPECT_THAT(refusal("5 umm", "m"), HasSubstr("unknown unit \"umm\" in \"5 umm\""));
  EXPECT_THAT(refusal("5 Nm", "N m"), AllOf(HasSubstr("unknown unit"), HasSubstr("\"N m\"")));
  EXPECT_THAT(refusal("1,5 m", "m"), AllOf(HasSubstr("is not a number with a unit"), HasSubstr("decimal point")));
  EXPECT_THAT(refusal("large", "m"), HasSubstr("\"large\" is not a number with a unit; air_gap needs a length"));
  EXPECT_THAT(refusal("um", "m"), HasSubstr("is not a number with a unit"));
  EXPECT_THAT(refusal("", "m"), HasSubstr("is not a number with a unit"));
  EXPECT_THAT(refusal("+-5", "m"), HasSubstr("is not a number with a unit"));
  EXPECT_THAT(refusal("3 lg(re mW)", "W"), HasSubstr("unknown unit")) << "logarithmic";
}

TEST(Units, ValuesThatAreNotFiniteAreRefused) {
  for (const char* text : {"nan", "inf", "-inf m", "NaN m", "infinity"})
    EXPECT_THAT(refusal(text, "m"), HasSubstr("is not a finite number"));
  EXPECT_THAT(refusal("1e999 m", "m"), HasSubstr("too large"));
  EXPECT_THAT(refusal("1e308 km", "m"), HasSubstr("not a finite number"));
  EXPECT_FALSE(checked_si(std::nan(""), QuantityKind::plain));
}

TEST(Units, ADeclaredUnitThatNobodyKnowsIsOurMistake) {
  EXPECT_THROW(to_si("5 m", "furlongs per fortnight squared"), std::logic_error);
  EXPECT_THROW(to_si("5 m", "W/m2K"), std::logic_error);
}

TEST(Units, ARefusedTextThrowsAnInputError) { EXPECT_THROW(to_si("5 s", "m"), InputError); }

TEST(Units, TheShortestTextReadsBackToTheSameNumber) {
  for (const double value : {0.1, 1.0 / 3.0, 2.5e-4, 1.144e9, -1e-300, 5e-324, 1.7976931348623157e308})
    EXPECT_EQ(bare_number(shortest(value)).value_or(0.0), value);
}
