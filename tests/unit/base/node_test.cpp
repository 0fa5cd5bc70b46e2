#include "base/node.h"

#include <gtest/gtest.h>

using namespace rotordrop;

namespace {

const SourcePosition key_place{"case.toml", 2, 1};
const SourcePosition value_place{"case.toml", 2, 8};
const SourcePosition table_place{"case.toml", 1, 1};

/// [contact]
/// gap = 1
Node contact() {
  Node table = Node::table(table_place);
  table.set("gap", Node(1, value_place), key_place);
  return table;
}

}  // namespace

TEST(Node, TablesKeepTheOrderOfTheirKeys) {
  Node table = Node::table({{"z", 1}, {"a", 2}, {"m", 3}});
  table.set("a", 5);
  EXPECT_EQ(to_text(table), "{z = 1, a = 5, m = 3}");
}

TEST(Node, AnIntegerIsANumberToo) {
  EXPECT_EQ(Node(3).number(), 3.0);
  EXPECT_EQ(Node(3.5).number(), 3.5);
  EXPECT_THROW(Node("3").number(), std::bad_variant_access);
}

TEST(Node, FindsNothingInWhatIsNoTable) {
  EXPECT_EQ(Node(3).find("a"), nullptr);
  EXPECT_EQ(Node::table().find("a"), nullptr);
}

TEST(Node, KnowsThePlaceOfKeysAndOfTheTableForMissingOnes) {
  Node tree = Node::table();
  tree.set("contact", contact(), {"case.toml", 1, 2});
  EXPECT_EQ(position_of(*tree.find("contact"), "gap"), key_place);
  EXPECT_EQ(position_of_value(*tree.find("contact"), "gap"), value_place);
  EXPECT_EQ(position_of(*tree.find("contact"), "other"), table_place);
  EXPECT_EQ(position_of(tree, "contact.gap"), key_place);
  EXPECT_EQ(position_of_value(tree, "contact.gap"), value_place);
  EXPECT_EQ(position_of(tree, "contact.other"), table_place);
}

TEST(Node, MergingTablesKeepsWhatIsNotReplacedAndReplacesArrays) {
  const Node defaults = Node::table({{"a", 1}, {"b", Node::array({1, 2})}, {"t", Node::table({{"x", 1}, {"y", 2}})}});
  const Node over = Node::table({{"c", 3}, {"b", Node::array({9})}, {"t", Node::table({{"y", 7}})}});
  EXPECT_EQ(to_text(merged(defaults, over)), "{a = 1, b = [9], t = {x = 1, y = 7}, c = 3}");
}

TEST(Node, MergingKeepsThePlaceOfEveryValue) {
  Node over = Node::table({"over.toml", 5, 1});
  over.set("other", Node(2, {"over.toml", 6, 9}), {"over.toml", 6, 1});
  const Node both = merged(contact(), over);
  EXPECT_EQ(position_of(both, "gap"), key_place);
  EXPECT_EQ(position_of(both, "other"), (SourcePosition{"over.toml", 6, 1}));
  EXPECT_EQ(both.where(), (SourcePosition{"over.toml", 5, 1}));
}
