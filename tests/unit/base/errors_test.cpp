#include "base/errors.h"

#include <gtest/gtest.h>

using namespace rotordrop;

TEST(Errors, AFaultIsRenderedWithItsPlaceAndIndentedAdvice) {
  const InputError error({"params/drop.toml", 14, 1}, "unknown key \"air_gpa\" in [contact].",
                         "Did you mean \"air_gap\"?  Known here: air_gap, exponent.");
  EXPECT_STREQ(error.what(),
               "error: params/drop.toml:14:1: unknown key \"air_gpa\" in [contact].\n"
               "       Did you mean \"air_gap\"?  Known here: air_gap, exponent.");
}

TEST(Errors, APlaceOnTheCommandLineHasNoNumbers) {
  EXPECT_EQ(to_string({"--set contact.air_gap", 0, 0}), "--set contact.air_gap");
  EXPECT_STREQ(InputError({"--set a", 0, 0}, "wrong.").what(), "error: --set a: wrong.");
  EXPECT_STREQ(InputError({}, "wrong.").what(), "error: wrong.");
}

TEST(Errors, FilesComeInTheOrderOfTheirFirstFaultAndEachByLine) {
  Faults faults;
  faults.add({"b.toml", 9, 1}, "third.");
  faults.add({"a.toml", 1, 1}, "fourth.");
  faults.add({"b.toml", 2, 7}, "second.");
  faults.add({"b.toml", 2, 3}, "first.");
  EXPECT_STREQ(InputError(faults).what(),
               "error: b.toml:2:3: first.\n\n"
               "error: b.toml:2:7: second.\n\n"
               "error: b.toml:9:1: third.\n\n"
               "error: a.toml:1:1: fourth.");
}

TEST(Errors, TheSameFaultIsReportedOnce) {
  Faults faults;
  faults.add({"a.toml", 1, 1}, "wrong.");
  faults.add({"a.toml", 1, 1}, "wrong.");
  EXPECT_EQ(faults.size(), 1U);
}

TEST(Errors, LongAdviceIsBrokenAtSpacesWithinThePage) {
  std::string advice = "Known here:";
  for (int i = 0; i < 40; ++i) advice += " key_" + std::to_string(i) + ",";
  const std::string text = InputError({}, "wrong.", advice).what();
  std::size_t start = 0;
  std::size_t n_lines = 0;
  while (start < text.size()) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    EXPECT_LE(end - start, 120U);
    ++n_lines;
    start = end + 1;
  }
  EXPECT_EQ(n_lines, 4U);
}

TEST(Errors, NoFaultsThrowNothing) { EXPECT_NO_THROW(Faults().throw_if_any()); }
