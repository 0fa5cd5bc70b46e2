// A text whose copies share one place in memory.
#include "base/shared_text.h"

#include <gtest/gtest.h>

namespace rotordrop {
namespace {

TEST(SharedText, CopiesLieInOnePlace) {
  const SharedText one("a/long/way/to/a/case.toml"), copy = one;
  EXPECT_EQ(one.text(), "a/long/way/to/a/case.toml");
  EXPECT_EQ(&one.text(), &copy.text());
}

TEST(SharedText, IsTheSameIfItReadsTheSame) {
  const SharedText one("case.toml"), other("case.toml"), third("base.toml");
  EXPECT_NE(&one.text(), &other.text());
  EXPECT_EQ(one, other);
  EXPECT_FALSE(one == third);
  EXPECT_EQ(one, std::string("case.toml"));
  EXPECT_FALSE(one == SharedText());
}

TEST(SharedText, IsEmptyUnlessGiven) {
  EXPECT_TRUE(SharedText().empty());
  EXPECT_TRUE(SharedText("").empty());
  EXPECT_EQ(SharedText().text(), "");
  EXPECT_EQ(SharedText(""), SharedText());
  EXPECT_FALSE(SharedText("x").empty());
}

}  // namespace
}  // namespace rotordrop
