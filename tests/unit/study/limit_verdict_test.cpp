#include "study/limit_verdict.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rotordrop {
namespace {

Limit limit_on(const std::string& name, std::optional<double> max, std::optional<double> min) {
  Limit limit;
  limit.pattern = name;
  limit.max = max;
  limit.min = min;
  return limit;
}
std::optional<bool> keeps_max(const std::string& name, double value, double max, const SummaryNumbers& told) {
  return verdict_on(limit_on(name, max, {}), true, value, told).is_kept;
}
std::optional<bool> keeps_min(const std::string& name, double value, double min, const SummaryNumbers& told) {
  return verdict_on(limit_on(name, {}, min), false, value, told).is_kept;
}

const double never_happened = std::nan("");
constexpr const char *peak = "bearings.A.peak_contact_force", *other_peak = "bearings.B.peak_contact_force";

TEST(LimitVerdict, IsThatOfTheBearingWhoseResultIsLimited) {
  const SummaryNumbers told = {{"bearings.A.first_touch_time", 7e-3},
                               {"bearings.A.ends_in_first_contact", 0.},
                               {"bearings.B.first_touch_time", never_happened},
                               {"bearings.B.ends_in_first_contact", 0.}};
  EXPECT_EQ(keeps_max(peak, 5e3, 6e3, told), true);
  EXPECT_EQ(keeps_max(peak, 5e3, 4e3, told), false);
  EXPECT_EQ(keeps_max(other_peak, 0., 6e3, told), std::nullopt);
  EXPECT_EQ(verdict_on(limit_on(other_peak, 6e3, {}), true, 0., told).why, "the rotor did not touch the bearing");
  EXPECT_EQ(keeps_max("bearings.B.largest_contact_pressure", 3e9, 2e9, told), false) << "preload alone breaks it";
  EXPECT_EQ(keeps_max("energy.dissipated", 1., 2., told), true) << "of the machine, which touched something";
}

TEST(LimitVerdict, IsOpenWhereTheRunEndsInTheFirstImpactUnlessTheBoundIsBroken) {
  const SummaryNumbers told = {{"bearings.A.first_touch_time", 7e-3}, {"bearings.A.ends_in_first_contact", 1.}};
  EXPECT_EQ(keeps_max(peak, 3e3, 4e3, told), std::nullopt);
  EXPECT_EQ(verdict_on(limit_on(peak, 4e3, {}), true, 3e3, told).why,
            "the run ends in the first contact with the bearing");
  EXPECT_EQ(keeps_max(peak, 5e3, 4e3, told), false);
  EXPECT_EQ(keeps_max("bearings.A.first_contact_time", 7e-3, 1., told), true) << "it has passed";
  // Results of earlier versions do not tell.
  EXPECT_EQ(keeps_max(peak, 3e3, 4e3, {{"bearings.A.first_touch_time", 7e-3}}), true);
}

TEST(LimitVerdict, OfADropWithoutContactIsOpen) {
  EXPECT_EQ(keeps_max("energy.dissipated", 1., 2., {{"bearings.A.first_touch_time", never_happened}}), std::nullopt);
}

TEST(LimitVerdict, KnowsToWhichSideVoidNumbersAreOff) {
  const SummaryNumbers edge = {{"bearings.A.first_touch_time", 7e-3}, {"bearings.A.rows[0].truncation", 0.2}};
  // The true fatigue share is higher, the true safety lower.
  EXPECT_EQ(keeps_max("bearings.A.damage.fatigue.share", 1e-8, 0.01, edge), std::nullopt);
  EXPECT_EQ(keeps_max("bearings.A.damage.fatigue.share", 0.02, 0.01, edge), false);
  EXPECT_EQ(keeps_max("bearings.A.damage.fatigue.rows[0]", 1e-8, 0.01, edge), std::nullopt);
  EXPECT_EQ(keeps_min("bearings.A.static_safety", 5., 2., edge), std::nullopt);
  EXPECT_EQ(keeps_min("bearings.A.static_safety", 1., 2., edge), false);
  EXPECT_EQ(keeps_max("bearings.A.largest_contact_pressure", 5e9, 4e9, edge), false);
  EXPECT_EQ(keeps_min("bearings.A.rows[1].static_safety", 5., 2., edge), true) << "another row";
  const SummaryNumbers shoulder = {{"bearings.A.first_touch_time", 7e-3}, {"bearings.A.damage.rubs_on_shoulder", 1.}};
  EXPECT_EQ(keeps_min("bearings.A.wear.drops_until_limit", 6519., 10., shoulder), std::nullopt);
  EXPECT_EQ(keeps_min("bearings.A.wear.drops_until_limit", 6., 10., shoulder), false);
  EXPECT_EQ(keeps_max("bearings.A.wear.bore_depth", 1e-6, 1e-5, shoulder), true) << "it is of the bore";
  EXPECT_EQ(verdict_on(limit_on("bearings.A.damage.wear_share", 1., {}), true, never_happened, shoulder).why,
            "the rotor rubs on a shoulder, whose wear is not computed");
}

TEST(LimitVerdict, HoldsAnyNumberOfDropsWhereNoLimitOfThemWasFound) {
  SummaryNumbers told = {{"bearings.A.first_touch_time", 7e-3},
                         {"bearings.A.damage.assessed", 1.},
                         {"bearings.A.damage.pressure_is_void", 0.},
                         {"bearings.A.damage.rubs_on_shoulder", 0.},
                         {"bearings.A.damage.wear_share", 0.}};
  EXPECT_EQ(keeps_min("bearings.A.damage.allowed_drops", never_happened, 20., told), true);
  told.back().second = never_happened;  // nothing was assessed
  EXPECT_EQ(keeps_min("bearings.A.damage.allowed_drops", never_happened, 20., told), std::nullopt);
}

TEST(LimitVerdict, NeedsOnlyWhatItLooksAt) {
  for (const char* name : {"bearings.A.first_touch_time", "bearings.A.ends_in_first_contact"})
    EXPECT_TRUE(is_needed_for_verdict(name, "bearings.*.peak_contact_force"));
  EXPECT_FALSE(is_needed_for_verdict("bearings.A.ends_in_first_contact", "energy.residual"));
  EXPECT_FALSE(is_needed_for_verdict("bearings.A.rows[0].truncation", peak));
  EXPECT_TRUE(is_needed_for_verdict("bearings.A.rows[0].truncation", "bearings.A.damage.fatigue.share"));
  EXPECT_TRUE(is_needed_for_verdict("bearings.A.damage.rubs_on_shoulder", "bearings.*.wear.drops_until_limit"));
}

}  // namespace
}  // namespace rotordrop
