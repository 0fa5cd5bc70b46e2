// Well-formed UTF-8 as in table 3-7 of the Unicode standard.
#include "base/utf8.h"

#include <gtest/gtest.h>

#include <string>

namespace rotordrop {
namespace {

TEST(Utf8, LettersOfOneToFourBytesAreText) {
  for (const char* text : {"", "a", "\u00e9", "\u20ac", "\U0001F600", "\uD7FF", "\uE000", "\U0010FFFF"})
    EXPECT_TRUE(is_utf8(text)) << text;
}

TEST(Utf8, BrokenLettersAreFound) {
  for (const char* text : {"\xff", "\x80", "\xc1\x81", "\xe0\x80\x80", "\xed\xa0\x80", "\xf0\x80\x80\x80",
                           "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\xe2\x82", "\xe2\x28\xa1"})
    EXPECT_EQ(first_not_utf8(std::string("ab") + text), 2u) << text;
}

}  // namespace
}  // namespace rotordrop
