#include "io/text/comments.h"

#include <gtest/gtest.h>

#include "io/text/toml_reader.h"

namespace rotordrop {
namespace {

TEST(Comments, BeginAtTheFirstHashOutsideQuotes) {
  using Parts = std::pair<std::string_view, std::string_view>;
  EXPECT_EQ(split_comment("a = 1"), (Parts{"a = 1", ""}));
  EXPECT_EQ(split_comment("a = 1  #  est.  "), (Parts{"a = 1  ", "est."}));
  EXPECT_EQ(split_comment("a = \"x # y\" # z"), (Parts{"a = \"x # y\" ", "z"}));
  EXPECT_EQ(split_comment("a = 'x # \\' # z"), (Parts{"a = 'x # \\' ", "z"})) << "no escapes in single quotes";
  EXPECT_EQ(split_comment("a = \"x \\\" # y\" # z"), (Parts{"a = \"x \\\" # y\" ", "z"}));
  EXPECT_EQ(split_comment("a = 1 #"), (Parts{"a = 1 ", ""}));
}

TEST(Comments, AreTakenFromEachLineOfAText) {
  EXPECT_EQ(without_comments("a = 1 # x\n# y\n\nb = \"\\\" # z\" # w"), "a = 1 \n\n\nb = \"\\\" # z\" ");
  EXPECT_EQ(without_comments("a = 1\n"), "a = 1\n");
}

std::string origin(const Node& tree, const char* key) { return origin_text(*tree.entry(key)); }

TEST(OriginOfAValue, IsFileLineAndWhatStandsBehindIt) {
  const Node tree = parse_toml(
      "a = 1  # source: (P)\nb = 2\nc = 3  # from base.toml:7: source: (est.)\n[t]\nd = { e = [\n 1 ] }  # x\n",
      "/some/where/case.toml");
  EXPECT_EQ(origin(tree, "a"), "case.toml:1: source: (P)");
  EXPECT_EQ(origin(tree, "b"), "case.toml:2");
  EXPECT_EQ(origin(tree, "c"), "base.toml:7: source: (est.)") << "what rotordrop wrote names the first source";
  EXPECT_EQ(origin(*tree.find("t"), "d"), "case.toml:5");
  Node table = Node::table();
  table.set("given", Node(1), {"--set contact.air_gap", 0, 0});
  table.set("built_in", Node(1));
  EXPECT_EQ(origin(table, "given"), "--set");
  EXPECT_EQ(origin(table, "built_in"), "the program");
}

TEST(OriginOfAValue, StaysWithItWhenTablesAreMergedOrItsValueIsCompleted) {
  const Node under = parse_toml("a = 1  # under\nb = 2  # under\n[t]\nc = 3  # under\nd = 4  # under\n", "under.toml");
  Node tree = merged(under, parse_toml("b = 5  # over\n[t]\nd = 6\n", "over.toml"));
  EXPECT_EQ(origin(tree, "a"), "under.toml:1: under");
  EXPECT_EQ(origin(tree, "b"), "over.toml:1: over");
  EXPECT_EQ(origin(*tree.find("t"), "c"), "under.toml:4: under");
  EXPECT_EQ(origin(*tree.find("t"), "d"), "over.toml:3") << "not the comment of the value that it replaced";
  tree.set("a", Node(7.), position_of(tree, "a"));
  EXPECT_EQ(origin(tree, "a"), "under.toml:1: under");
  apply_setting(tree, read_setting("a=8"));
  EXPECT_EQ(origin(tree, "a"), "--set");
}

}  // namespace
}  // namespace rotordrop
