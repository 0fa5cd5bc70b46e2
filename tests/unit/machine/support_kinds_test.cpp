#include <gtest/gtest.h>

#include <stdexcept>

#include "machine/supports.h"

namespace rotordrop {
namespace {

struct MagnetParameters {
  int node = 0;
  double stiffness = 0;
};

Section<MagnetParameters> magnet_section() {
  Section<MagnetParameters> s("clamp");
  s.integer("node", &MagnetParameters::node, {.range = at_least(1)});
  s.quantity("stiffness", &MagnetParameters::stiffness, {.unit = "N/m", .range = positive()});
  return s;
}

/// Supports of a case.
struct Bearings {
  std::vector<SupportEntry> bearings;
};

Bearings read(const Node& case_node, Faults& faults) {
  Section<Bearings> section("");
  declare_bearings<Bearings>(section, &Bearings::bearings);
  return section.read(case_node, faults);
}

Node magnet_at_node(int node) {
  return Node::table(
      {{"bearings", Node::table({{"M", Node::table({{"type", "clamp"}, {"node", node}, {"stiffness", "2 kN/mm"}})}})}});
}

// One test: the registry is the program's.
TEST(SupportKinds, OfOtherProgramsAreReadLikeOurs) {
  Faults unknown;
  (void)read(magnet_at_node(3), unknown);
  EXPECT_FALSE(unknown.empty()) << "before it is registered";

  double made_stiffness = 0.;
  std::string made_name;
  add_support_kind("clamp", magnet_section(), [&](const std::string& name, const MagnetParameters& p) {
    made_name = name;
    made_stiffness = p.stiffness;
    return std::unique_ptr<Support>();
  });
  Faults faults;
  const Bearings made = read(magnet_at_node(3), faults);
  ASSERT_TRUE(faults.empty());
  ASSERT_EQ(made.bearings.size(), 1u);
  EXPECT_EQ(made.bearings[0].name, "M");
  EXPECT_EQ(made.bearings[0].node(), 3);
  EXPECT_EQ(made.bearings[0].touchdown(), nullptr);
  EXPECT_EQ(made.bearings[0].linear(), nullptr);
  ASSERT_NE(made.bearings[0].other(), nullptr);
  made.bearings[0].other()->make("M");
  EXPECT_EQ(made_name, "M");
  EXPECT_DOUBLE_EQ(made_stiffness, 2e6);

  Faults out_of_range;
  (void)read(magnet_at_node(0), out_of_range);
  EXPECT_FALSE(out_of_range.empty()) << "its own ranges hold";

  const auto nothing = [](const std::string&, const MagnetParameters&) { return std::unique_ptr<Support>(); };
  for (const char* taken : {"clamp", "touchdown", "linear"})
    EXPECT_THROW(add_support_kind(taken, magnet_section(), nothing), std::invalid_argument) << taken;
}

TEST(SupportKinds, ThatNoCaseCouldUseAreRefused) {
  const auto nothing = [](const std::string&, const MagnetParameters&) { return std::unique_ptr<Support>(); };
  for (const char* type : {"", "two words", "a\xff", "a\"]"})
    EXPECT_THROW(add_support_kind(type, magnet_section(), nothing), std::invalid_argument) << type;
  SupportKind bare;
  bare.type = "bare";
  EXPECT_THROW(add_support_kind(bare), std::invalid_argument) << "it has no keys";
  for (const char* key : {"type", "a.b", "", "k\xff"}) {
    auto section = magnet_section();
    section.quantity(key, &MagnetParameters::stiffness, {.unit = "N/m"});
    EXPECT_THROW(add_support_kind("keyed", section, nothing), std::invalid_argument) << key;
  }
  for (const SupportKind& kind : support_kinds()) EXPECT_TRUE(kind.type == "clamp") << "nothing else came in";
}

}  // namespace
}  // namespace rotordrop
