#include "io/text/toml_reader.h"

#include "base/errors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

using namespace rotordrop;
using testing::AllOf;
using testing::HasSubstr;

namespace {

/// A directory of its own for each test, removed afterwards.
class TomlFiles : public testing::Test {
 protected:
  TomlFiles() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    directory_ =
        std::filesystem::temp_directory_path() / ("rotordrop_" + std::to_string(::getpid()) + "_" + test->name());
    std::filesystem::create_directories(directory_ / "sub");
  }
  ~TomlFiles() override { std::filesystem::remove_all(directory_); }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(directory_ / name) << text;
    return directory_ / name;
  }
  std::filesystem::path directory_;
};

template <class Action>
std::string error_of(Action action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string error_of_override(const std::string& assignment) {
  Node tree = Node::table({{"contact", Node::table({{"friction", 0.1}})}});
  return error_of([&] { apply_override(tree, assignment); });
}

Node with_override(const std::string& assignment) {
  Node tree = parse_toml("[contact]\nfriction = 0.1\ngap = 1e-4\n", "case.toml");
  apply_override(tree, assignment);
  return tree;
}

}  // namespace

TEST(Toml, KeepsTheOrderOfTheFileAndTheTypesOfValues) {
  const Node tree =
      parse_toml("z = 1\na = 2.5\nb = true\ns = \"x\"\nl = [1, \"2 m\"]\nt = { y = 1, b = 2 }\n", "case.toml");
  EXPECT_EQ(to_text(tree), "{z = 1, a = 2.5, b = true, s = x, l = [1, 2 m], t = {y = 1, b = 2}}");
  EXPECT_TRUE(tree.find("z")->is(Node::Kind::integer));
  EXPECT_TRUE(tree.find("a")->is(Node::Kind::real));
}

TEST(Toml, KnowsThePlaceOfTablesKeysAndValues) {
  const Node tree =
      parse_toml("top = 1\n\n[contact]\n  gap = \"1 mm\"\n[bearings.TB1]\nmass = 2\n[[wave]]\n[[wave]]\nn = [1,\n 2]\n",
                 "case.toml");
  const Node& contact = *tree.find("contact");
  EXPECT_EQ(to_string(contact.where()), "case.toml:3:1");
  EXPECT_EQ(to_string(position_of(contact, "gap")), "case.toml:4:3");
  EXPECT_EQ(to_string(position_of_value(contact, "gap")), "case.toml:4:9");
  EXPECT_EQ(to_string(position_of(tree, "bearings.TB1.mass")), "case.toml:6:1");
  EXPECT_EQ(to_string(tree.find("bearings")->find("TB1")->where()), "case.toml:5:1");
  EXPECT_EQ(to_string(tree.find("wave")->items()[1].where()), "case.toml:8:1");
  EXPECT_EQ(to_string(tree.find("wave")->items()[1].find("n")->items()[1].where()), "case.toml:10:2");
}

TEST(Toml, ASyntaxErrorIsReportedWithItsPlace) {
  EXPECT_THAT(error_of([] { parse_toml("a = 1\nb = = 2\n", "case.toml"); }),
              AllOf(HasSubstr("error: case.toml:2:5: "), HasSubstr("not valid TOML")));
  EXPECT_THAT(error_of([] { parse_toml("a = 1\na = 2\n", "case.toml"); }), HasSubstr("error: case.toml:2:"));
  EXPECT_THAT(error_of([] { parse_toml("a = 15200 rpm\n", "case.toml"); }),
              AllOf(HasSubstr("error: case.toml:1:"), HasSubstr("Write it as: a = \"15200 rpm\"")));
}

TEST(Toml, DatesAreRefused) {
  EXPECT_THAT(error_of([] { parse_toml("a = 2026-01-01\n", "case.toml"); }),
              AllOf(HasSubstr("case.toml:1:5"), HasSubstr("dates and times")));
}

TEST_F(TomlFiles, AMissingFileIsNamed) {
  EXPECT_THAT(error_of([&] { read_toml(directory_ / "none.toml"); }), AllOf(HasSubstr("none.toml\" cannot be read")));
  EXPECT_THAT(error_of([&] { read_toml(directory_ / "sub"); }), HasSubstr("cannot be read"));
}

TEST_F(TomlFiles, AFileStandsOnItsBase) {
  write("base.toml", "[contact]\ngap = 1\nfriction = 0.1\nlist = [1, 2, 3]\n[run]\nend = 2\n");
  const Node tree = read_toml(write("case.toml", "base = \"base.toml\"\n[contact]\nfriction = 0.2\nlist = [9]\n"));
  EXPECT_EQ(to_text(tree), "{contact = {gap = 1, friction = 0.2, list = [9]}, run = {end = 2}}");
  EXPECT_EQ(position_of(tree, "contact.gap").file, (directory_ / "base.toml").string());
  EXPECT_EQ(position_of(tree, "contact.friction").file, (directory_ / "case.toml").string());
}

TEST_F(TomlFiles, BasesMayHaveBasesRelativeToThemselves) {
  write("root.toml", "a = 1\nb = 1\nc = 1\n");
  write("sub/middle.toml", "base = \"../root.toml\"\nb = 2\nc = 2\n");
  EXPECT_EQ(to_text(read_toml(write("case.toml", "base = \"sub/middle.toml\"\nc = 3\n"))), "{a = 1, b = 2, c = 3}");
}

TEST_F(TomlFiles, ACircleOfBasesIsReportedWhereItCloses) {
  write("a.toml", "base = \"b.toml\"\n");
  write("b.toml", "x = 1\nbase = \"sub/../a.toml\"\n");
  EXPECT_THAT(error_of([&] { read_toml(directory_ / "a.toml"); }),
              AllOf(HasSubstr("b.toml:2:8"), HasSubstr("refers back"), HasSubstr("a.toml -> b.toml -> a.toml")));
  write("self.toml", "base = \"self.toml\"\n");
  EXPECT_THAT(error_of([&] { read_toml(directory_ / "self.toml"); }), HasSubstr("self.toml -> self.toml"));
}

TEST_F(TomlFiles, AMissingBaseIsReportedWhereItIsNamed) {
  EXPECT_THAT(error_of([&] { read_toml(write("case.toml", "base = \"none.toml\"\n")); }),
              AllOf(HasSubstr("case.toml:1:8"), HasSubstr("none.toml\" cannot be read")));
  EXPECT_THAT(error_of([&] { read_toml(write("case.toml", "base = 1\n")); }), HasSubstr("base is an integer"));
}

TEST(Override, ReplacesOneValueAndKeepsTheOthers) {
  EXPECT_EQ(to_text(with_override("contact.friction=0.05")), "{contact = {friction = 0.05, gap = 0.0001}}");
}

TEST(Override, ReadsTomlValuesAndTakesEverythingElseAsText) {
  EXPECT_TRUE(with_override("a=1").find("a")->is(Node::Kind::integer));
  EXPECT_TRUE(with_override("a = 0.5 ").find("a")->is(Node::Kind::real));
  EXPECT_TRUE(with_override("a=true").find("a")->is(Node::Kind::boolean));
  EXPECT_TRUE(with_override("a=[1, 2]").find("a")->is_array());
  EXPECT_TRUE(with_override("a={ x = 1 }").find("a")->is_table());
  EXPECT_EQ(with_override("a=\"text\"").find("a")->text(), "text");
  EXPECT_EQ(with_override("a=15200 rpm").find("a")->text(), "15200 rpm");
  EXPECT_EQ(with_override("a=steel").find("a")->text(), "steel");
  EXPECT_EQ(with_override("a=2026-01-01").find("a")->text(), "2026-01-01");
  EXPECT_EQ(with_override("a=x=y").find("a")->text(), "x=y");
}

TEST(Override, MakesTheTablesOnItsWay) {
  EXPECT_EQ(to_text(*with_override("bearings.TB1.mass=2").find("bearings")), "{TB1 = {mass = 2}}");
}

TEST(Override, SaysInPositionsThatItCameFromTheCommandLine) {
  const Node tree = with_override("contact.friction=[1, 2]");
  EXPECT_EQ(to_string(position_of(tree, "contact.friction")), "--set contact.friction");
  EXPECT_EQ(to_string(tree.find("contact")->find("friction")->items()[1].where()), "--set contact.friction");
  EXPECT_EQ(to_string(position_of(tree, "contact.gap")), "case.toml:3:1");
}

TEST(Override, WhatIsNoAssignmentIsRefused) {
  for (const char* assignment :
       {"", "contact.friction", "=5", "contact.friction=", "a..b=5", "a b=5", ".a=1", "[a]\nb=1"})
    EXPECT_THAT(error_of_override(assignment), HasSubstr("error: --set")) << assignment;
  EXPECT_THAT(error_of_override("a=[1, 2"), AllOf(HasSubstr("--set a: this is not valid TOML"), HasSubstr("[1, 2")));
}

TEST(Override, NothingCanBeSetInAValue) {
  EXPECT_THAT(error_of_override("contact.friction.static=1"),
              HasSubstr("\"friction\" is a number, so nothing can be set in it"));
}
