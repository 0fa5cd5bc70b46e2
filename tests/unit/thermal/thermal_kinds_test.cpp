// Thermal models that cases can name.
#include "thermal/thermal_kinds.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "thermal/thermal_parameters.h"

namespace rotordrop {
namespace {

struct PlateParameters {
  double area = 0;
};
Section<PlateParameters> plate_section() {
  Section<PlateParameters> s("plate");
  s.quantity("area", &PlateParameters::area, {.unit = "m2", .range = positive(), .fallback = "2 m2"});
  return s;
}

ThermalKind named(const std::string& name) {
  ThermalKind kind;
  kind.name = name;
  return kind;
}
ThermalKind kind_called(const std::string& name) {
  ThermalKind kind = named(name);
  kind.make = [](const ThermalGeometry&) { return std::unique_ptr<ThermalModel>(); };
  return kind;
}

ThermalParameters read(const Node& table, Faults& faults) { return thermal_section().read(table, faults); }
Node models(std::initializer_list<const char*> names) {
  Node::Array list;
  for (const char* name : names) list.emplace_back(name);
  return Node::table({{"models", Node::array(std::move(list))}});
}

TEST(ThermalKinds, OursComeFirst) {
  const auto kinds = thermal_kinds();
  ASSERT_GE(kinds.size(), 2u);
  EXPECT_TRUE(kinds[0]->is_circuit);
  EXPECT_EQ(kinds[0]->prefix(), "") << "its keys are older than other models";
  EXPECT_TRUE(kinds[1]->meshes_sections);
  EXPECT_EQ(kinds[1]->prefix(), kinds[1]->name + "_");
}

// One test: the registry is the program's.
TEST(ThermalKinds, OfOthersAreReadLikeOurs) {
  Faults unknown;
  (void)read(models({"plate"}), unknown);
  EXPECT_FALSE(unknown.empty()) << "before it is registered";

  double made_area = 0.;
  add_thermal_kind(
      thermal_kind_of(named("plate"), plate_section(), [&](const ThermalGeometry&, const PlateParameters& p) {
        made_area = p.area;
        return std::unique_ptr<ThermalModel>();
      }));
  Faults faults;
  Node table = models({"plate", "lumped"});
  const ThermalParameters chosen = read(table, faults);
  ASSERT_TRUE(faults.empty());
  EXPECT_EQ(chosen.models, (std::vector<std::string>{"lumped", "plate"})) << "in the order of the registry";
  EXPECT_EQ(driver_of(chosen), "lumped") << "the first one that runs";
  EXPECT_TRUE(chosen.runs_circuit());
  EXPECT_FALSE(chosen.runs_sections());

  maker_of(chosen, *thermal_kind("plate"), faults)({});
  EXPECT_DOUBLE_EQ(made_area, 2.) << "m2, its default";
  table.set("plate", Node::table({{"area", Node("50 cm2")}}));
  table.set("driver", "plate");
  const ThermalParameters with_keys = read(table, faults);
  ASSERT_TRUE(faults.empty());
  maker_of(with_keys, *thermal_kind("plate"), faults)({});
  EXPECT_DOUBLE_EQ(made_area, 5e-3) << "m2";
  EXPECT_EQ(driver_of(with_keys), "plate");
  EXPECT_EQ(thermal_kind("plate")->group, "/plate/");

  Faults out_of_range;
  table.set("plate", Node::table({{"area", Node("-1 m2")}}));
  (void)read(table, out_of_range);
  EXPECT_FALSE(out_of_range.empty()) << "its own ranges hold";
}

TEST(ThermalKinds, RefuseNamesThatMeanSomethingElse) {
  for (const char* taken :
       {"lumped", "fe", "none", "recorded", "automatic", "growth", "node", "bearings", "energy", "whirl"})
    EXPECT_THROW(add_thermal_kind(kind_called(taken)), std::invalid_argument) << taken;
  for (const char* wrong : {"", "two words", "a/b"})
    EXPECT_THROW(add_thermal_kind(kind_called(wrong)), std::invalid_argument) << wrong;
  EXPECT_THROW(add_thermal_kind(named("nothing-makes-it")), std::invalid_argument);
}

TEST(ThermalKinds, RefuseWhatIsOursAlone) {
  ThermalKind group = kind_called("copper"), unmarked = group, meshes = group, title = group;
  group.group = "/energy/";
  unmarked.is_unmarked = true;
  meshes.meshes_sections = true;
  title.title = "\xff";
  for (const ThermalKind& kind : {group, unmarked, meshes, title})
    EXPECT_THROW(add_thermal_kind(kind), std::invalid_argument);
  EXPECT_EQ(thermal_kind("copper"), nullptr);
}

TEST(ThermalKinds, UnknownOnesAreExplained) {
  Faults faults;
  (void)read(models({"lumpd"}), faults);
  try {
    faults.throw_if_any();
    FAIL();
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("Did you mean \"lumped\"?"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace rotordrop
