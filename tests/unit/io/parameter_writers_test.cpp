#include "io/text/parameter_writers.h"

#include "base/parameters/section.h"
#include "io/text/toml_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <map>
#include <regex>

using namespace rotordrop;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

namespace {

struct Support {
  double mass = 0.0;
  std::array<std::array<double, 2>, 2> stiffness{};
  bool operator==(const Support&) const = default;
};
struct Wave {
  int order = 0;
  double amplitude = 0.0;
  bool operator==(const Wave&) const = default;
};
struct Touchdown {
  double contact_stiffness = 0.0;
  double friction = 0.0;
  std::optional<double> static_friction;
  std::string ball;
  std::vector<Wave> waviness;
  Support support;
  bool operator==(const Touchdown&) const = default;
};
struct Linear {
  double stiffness = 0.0;
  bool operator==(const Linear&) const = default;
};
struct Material {
  double density = 0.0;
  bool operator==(const Material&) const = default;
};
struct Case {
  double end_time = 0.0;
  double initial_speed = 0.0;
  std::string law;
  bool is_recorded = false;
  std::optional<int> n_modes;
  std::vector<std::array<double, 2>> torque;
  std::vector<double> gravity;
  std::optional<Wave> shock;
  std::vector<std::pair<std::string, Touchdown>> touchdown;
  std::vector<std::pair<std::string, Linear>> linear;
  std::vector<std::pair<std::string, Material>> materials;
  bool operator==(const Case&) const = default;
};

Section<Wave> wave_section() {
  Section<Wave> s("wave", "A wave.");
  s.integer("order", &Wave::order, {.range = at_least(1), .help = "Number of waves around the ring."});
  s.quantity("amplitude", &Wave::amplitude, {.unit = "m", .fallback = "1 um", .help = "Half of peak to peak."});
  return s;
}

Section<Touchdown> touchdown_section() {
  Section<Support> support("support", "What carries the outer ring.");
  support.quantity("mass", &Support::mass, {.unit = "kg", .range = positive(), .fallback = "85 kg"});
  support.matrix("stiffness", &Support::stiffness, {.unit = "N/m", .fallback = {{"2.7e9", "0"}, {"0", "1.5 GN/m"}}});
  Section<Touchdown> s("touchdown", "A touchdown bearing.");
  s.quantity("contact_stiffness", &Touchdown::contact_stiffness, {.unit = "N/m^n", .range = positive()});
  s.quantity("friction", &Touchdown::friction, {.range = at_least(0), .fallback = "0.1"});
  s.quantity("static_friction", &Touchdown::static_friction, {});
  s.choice("ball", &Touchdown::ball, {"steel", "Si3N4"}, {.fallback = "steel"});
  s.list("waviness", &Touchdown::waviness, wave_section());
  s.table("support", &Touchdown::support, support);
  return s;
}

/// One section for the whole file, as the program has it.
Section<Case> case_section() {
  Section<Case> run("run", "How long, from which speed.");
  run.quantity("end_time", &Case::end_time, {.unit = "s", .range = positive(), .help = "The run ends here."});
  run.quantity(
      "initial_speed", &Case::initial_speed,
      {.unit = "rad/s", .fallback = "15200 rpm", .source = "Neisi 2019", .help = "Spin when the rotor is let go."});
  run.choice("law", &Case::law, {"radial", "equivalent"}, {.fallback = "radial"});
  run.boolean("is_recorded", &Case::is_recorded, {.fallback = true});
  run.integer("n_modes", &Case::n_modes, {.range = between(1, 50)});
  run.function("torque", &Case::torque, {.unit = "N m", .fallback = {{"0 s", "0 N m"}, {"1 s", "-1 N m"}}});
  run.custom("gravity",
             {.unit = "m/s2",
              .accepts = "a number, or [x, y, z]",
              .json_types = {"number", "string", "array"},
              .fallback = Node(9.81)},
             [](const Node& node, Case& target, Faults& faults) {
               target.gravity = {read_quantity(node, {.unit = "m/s2"}, "run.gravity", faults).value_or(0.0)};
             });
  run.table("shock", &Case::shock, wave_section());
  run.variants("bearings", "type",
               {variant("touchdown", &Case::touchdown, touchdown_section(), {.takes_defaults = true}),
                variant<Case>(
                    "linear",
                    [] {
                      Section<Linear> s("linear", "A linear spring.");
                      s.quantity("stiffness", &Linear::stiffness, {.unit = "N/m"});
                      return s;
                    }(),
                    [](Case& c, const std::string& name, const Linear& l) { c.linear.emplace_back(name, l); })},
               {.fallback = "touchdown", .help = "Bearings by name."});
  Section<Material> material("material", "Properties of a material.");
  material.quantity("density", &Material::density, {.unit = "kg/m3", .fallback = "7800 kg/m3"});
  run.tables("materials", &Case::materials, material,
             {.fallback = Node::table({{"steel", Node::table({{"density", 7800.5}})}})});
  return run;
}

Case read(const std::string& text) {
  const Node tree = parse_toml(text, "case.toml");
  Faults faults;
  const Case result = case_section().read(*tree.find("run"), faults);
  faults.throw_if_any();
  return result;
}

std::vector<ErasedSection> sections() { return {case_section().erased()}; }
/// Without files and lines of origins: "  # from [run.bearings], case.toml:3" only says of which table a value is.
std::string resolved_text(const std::vector<ErasedSection>& of, const Node& tree) {
  const std::string tables =
      std::regex_replace(resolve(of, tree).text, std::regex(R"((  # from \[[^\]\n]*\]), [^\n]*)"), "$1");
  return std::regex_replace(tables, std::regex(R"(  # from [^\[\n][^\n]*)"), "");
}
std::string resolved(const std::string& text) { return resolved_text(sections(), parse_toml(text, "case.toml")); }

const char* const full_case = R"(
[run]
end_time = "300 ms"
initial_speed = 1591.7402778800001
law = "equivalent"
n_modes = 5
torque = [["0 s", 0.1], [0.30000000000000004, "2 N m"]]
[run.shock]
order = 3
[run.bearings]
friction = 0.15
waviness = [{ order = 7 }]
[run.bearings.support]
mass = 51
[run.bearings.TB1]
contact_stiffness = 1.144e9
waviness = [{ order = 2, amplitude = "0.5 um" }, { order = 3 }]
support = { stiffness = [[1.0, 0], [0, "2 N/m"]] }
[run.bearings."TB 2"]
type = "touchdown"
friction = 0.05
contact_stiffness = 1.73e9
[run.bearings.magnet]
type = "linear"
stiffness = 1e6
[run.materials.glass]
)";
const char* const short_case = "[run]\nend_time = 0.3\n";

}  // namespace

TEST(ResolvedParameters, ReadBackToTheSameValues) {
  for (const std::string text :
       {full_case, short_case,
        "[run]\nend_time = 1\nmaterials = {}\nbearings.TB1 = { contact_stiffness = 1e-300, waviness = [] }\n"}) {
    const std::string written = resolved(text);
    EXPECT_EQ(read(written), read(text)) << written;
    EXPECT_EQ(read(resolved(written)), read(text)) << "and once more";
  }
}

TEST(ResolvedParameters, MarkWhatWasNotGiven) {
  const std::string text = resolved(full_case);
  EXPECT_THAT(text, HasSubstr("end_time = \"300 ms\"\n"));
  EXPECT_THAT(text, HasSubstr("initial_speed = 1591.7402778800001\n"));
  EXPECT_THAT(text, HasSubstr("is_recorded = true  # default\n"));
  EXPECT_THAT(text, HasSubstr("gravity = 9.81  # default\n"));
  EXPECT_THAT(text, HasSubstr("[run.bearings.TB1]\ntype = \"touchdown\"  # default\n"));
  EXPECT_THAT(text, HasSubstr("friction = 0.15  # from [run.bearings]\n"));
  EXPECT_THAT(text, HasSubstr("[run.bearings.\"TB 2\"]\ntype = \"touchdown\"\n"));
  EXPECT_THAT(text, Not(HasSubstr("static_friction"))) << "absent and without a default";
  EXPECT_THAT(resolved(short_case), HasSubstr("[run.materials.steel]  # default\n"));
}

TEST(ResolvedParameters, TellWhereEachGivenValueIsFrom) {
  const Node tree = parse_toml(
      "[run]\nend_time = 0.3  # as long as it takes\n[run.bearings]\nfriction = 0.15  # of all\n[run.bearings.TB1]\n"
      "contact_stiffness = 1e9\nball = \"steel\"\nwaviness = [{ order = 3 }, { order = 7 }]  # measured\n",
      "/some/where/case.toml");
  std::map<std::string, std::string> origins;
  const auto resolved = resolve(sections(), tree);
  for (const auto& given : resolved.given) origins[given.name] = given.origin;
  const std::map<std::string, std::string> expected = {
      {"run.end_time", "case.toml:2: as long as it takes"},
      {"run.bearings.TB1.contact_stiffness", "case.toml:6"},
      {"run.bearings.TB1.ball", "case.toml:7"},
      {"run.bearings.TB1.friction", "[run.bearings], case.toml:4: of all"},
      {"run.bearings.TB1.waviness[0].order", "case.toml:8: measured"},
      {"run.bearings.TB1.waviness[1].order", "case.toml:8: measured"},
      {"run.materials.steel.density", "the program"}};
  EXPECT_EQ(origins, expected);
  EXPECT_EQ(resolved.given.front().unit, "s");
  EXPECT_EQ(resolved.given.front().help, "The run ends here.");
  EXPECT_FALSE(resolved.given.front().fallback);
  EXPECT_THAT(resolved.text, HasSubstr("order = 7  # from case.toml:8: measured\n"));
}

// What rotordrop has written reads back with the same origins, and defaults are defaults still.
TEST(ResolvedParameters, AreTheSameTextWhenTheyAreReadAgain) {
  const auto first = resolve(sections(), parse_toml(std::string(full_case) + "# end\n", "case.toml"));
  const auto again = resolve(sections(), parse_toml(first.text, "parameters.toml"));
  EXPECT_EQ(again.text, first.text);
  EXPECT_EQ(again.n_defaults, first.n_defaults);
  ASSERT_EQ(again.given.size(), first.given.size());
  for (std::size_t i = 0; i < first.given.size(); ++i) EXPECT_EQ(again.given[i].origin, first.given[i].origin);
}

TEST(ResolvedParameters, OfADefaultThatSomeoneChangedHaveThatOrigin) {
  const std::string text = resolve(sections(), parse_toml(short_case, "case.toml")).text;
  const std::string line = "is_recorded = true  # default";
  std::string changed = text;
  ASSERT_NE(changed.find(line), std::string::npos);
  changed.replace(changed.find(line), line.size(), "is_recorded = false  # default");
  EXPECT_THAT(resolve(sections(), parse_toml(changed, "p.toml")).text,
              HasSubstr("is_recorded = false  # from p.toml:"));
}

TEST(TomlValue, ReadsBackToTheSameDouble) {
  for (const double value : {0.1, 1.0 / 3.0, 5.0, -0.0, 1.144e9, 1e22, 1e-6, 5e-324, 1.7976931348623157e308}) {
    const Node tree = parse_toml("x = " + toml_value(value), "f");
    ASSERT_TRUE(tree.find("x")->is(Node::Kind::real)) << toml_value(value);
    EXPECT_EQ(tree.find("x")->number(), value);
  }
}

TEST(TomlValue, EscapesTextsAndQuotesKeys) {
  const Node tree =
      Node::table({{"a b", "quote \" backslash \\ line \n tab \t bell \a µm"}, {"", 1}, {"t", Node::table()}});
  EXPECT_EQ(to_text(parse_toml("x = " + toml_value(tree), "f")), "{x = " + to_text(tree) + "}");
}

TEST(Defaults, AreValidTomlAndHoldTheDefaultValues) {
  std::string text = write_defaults(sections());
  const Node tree = parse_toml(text, "defaults.toml");
  Faults faults;
  case_section().read(*tree.find("run"), faults);
  ASSERT_EQ(faults.size(), 1U) << InputError(faults).what();
  EXPECT_THAT(faults.begin()->message, HasSubstr("missing key \"end_time\""));

  const std::string required = "#end_time = ";
  text.replace(text.find(required), required.size(), "end_time = ");
  EXPECT_EQ(read(text), read("[run]\nend_time = \"2 ms\"\n"));
}

TEST(Defaults, AreAnnotated) {
  const std::string text = write_defaults(sections());
  EXPECT_THAT(text, HasSubstr("# Spin when the rotor is let go.  [angular speed in rad/s; usually between -6500 and "
                              "6500]\n# source: Neisi 2019\ninitial_speed = \"15200 rpm\"\n"));
  EXPECT_THAT(
      text,
      HasSubstr("# The run ends here.  [time in s, > 0; usually <= 2592000]\n#end_time = \"2 ms\"  # required\n"));
  EXPECT_THAT(text, HasSubstr("# [integer, between 1 and 50]\n#n_modes = 1  # optional\n"));
  EXPECT_THAT(text, HasSubstr("# [\"radial\" | \"equivalent\"]\nlaw = \"radial\"\n"));
  EXPECT_THAT(text, HasSubstr("# [a number, or [x, y, z], in m/s2]\ngravity = 9.81\n"));
  EXPECT_THAT(text, HasSubstr("#[run.bearings.NAME]"));
  EXPECT_THAT(text, HasSubstr("#type = \"linear\"  # required\n"));
  EXPECT_THAT(text, HasSubstr("# [N/m^n, > 0]\n#contact_stiffness = 1.144e9  # required\n"));
}

/// What stands behind a single "#" without a space can be switched on as it is.
TEST(Defaults, ShowTablesThatBecomeValidWhenTheirCommentSignsAreRemoved) {
  std::string text = "\n" + write_defaults(sections());
  for (std::size_t at = text.find("\n#"); at != std::string::npos; at = text.find("\n#", at + 1))
    if (text[at + 2] != ' ') text.erase(at + 1, 1);
  text.erase(
      text.find("[run.bearings.NAME]", text.find("[run.bearings.NAME]") + 1));  // the second variant has the same name
  EXPECT_NO_THROW(parse_toml(text, "defaults.toml")) << text;
  const Case shown = read(text.substr(0, text.find("[run.materials")));
  EXPECT_EQ(shown.touchdown.size(), 1U);
}

TEST(Schema, IsValidJsonOfTheRightDraft) {
  const auto schema = nlohmann::json::parse(write_json_schema(sections()));
  EXPECT_EQ(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
  EXPECT_EQ(schema["additionalProperties"], false);
  EXPECT_TRUE(schema["properties"].contains("base"));
}

TEST(Schema, DescribesEveryKindOfParameter) {
  const auto schema = nlohmann::json::parse(write_json_schema(sections()));
  const auto& run = schema["properties"]["run"];
  EXPECT_EQ(run["additionalProperties"], false);
  const auto& keys = run["properties"];
  EXPECT_EQ(keys["end_time"]["type"], nlohmann::json({"number", "string"}));
  EXPECT_EQ(keys["end_time"]["exclusiveMinimum"], 0.0);
  EXPECT_EQ(keys["end_time"]["description"], "The run ends here.  [time in s, > 0; usually <= 2592000]  Required.");
  EXPECT_EQ(keys["initial_speed"]["default"], "15200 rpm");
  EXPECT_EQ(keys["law"]["enum"], nlohmann::json({"radial", "equivalent"}));
  EXPECT_EQ(keys["n_modes"]["maximum"], 50.0);
  EXPECT_EQ(keys["is_recorded"]["type"], "boolean");
  EXPECT_EQ(keys["torque"]["anyOf"][1]["items"]["prefixItems"].size(), 2U);
  EXPECT_EQ(keys["gravity"]["type"], nlohmann::json({"number", "string", "array"}));
  EXPECT_EQ(keys["shock"]["additionalProperties"], false);
  EXPECT_EQ(keys["materials"]["additionalProperties"]["properties"]["density"]["type"][1], "string");

  const auto& bearings = keys["bearings"];
  EXPECT_TRUE(bearings["properties"].contains("friction")) << "as a default for all bearings";
  const auto& kinds = bearings["additionalProperties"]["anyOf"];
  ASSERT_EQ(kinds.size(), 2U);
  EXPECT_EQ(kinds[0]["properties"]["type"]["const"], "touchdown");
  for (const auto& kind : kinds) EXPECT_FALSE(kind.contains("required")) << "a case's base may say the kind";
  EXPECT_EQ(kinds[0]["properties"]["contact_stiffness"]["type"], "number") << "N/m^n takes no unit";
  EXPECT_EQ(kinds[0]["properties"]["support"]["properties"]["stiffness"]["minItems"], 2);
  EXPECT_EQ(kinds[0]["properties"]["waviness"]["items"]["properties"]["order"]["type"], "integer");
}

TEST(Sections, AreTablesOfTheirOwnWhenSeveralAreGiven) {
  Section<Material> first("first");
  first.quantity("density", &Material::density, {.unit = "kg/m3", .fallback = "1"});
  Section<Wave> top("", "The top level.");
  top.integer("order", &Wave::order, {.fallback = 2});
  const std::vector<ErasedSection> both{first.erased(), top.erased()};
  EXPECT_EQ(to_text(parse_toml(write_defaults(both), "f")), "{order = 2, first = {density = 1}}");
  EXPECT_EQ(to_text(parse_toml(resolved_text(both, Node::table()), "f")), "{order = 2, first = {density = 1}}");
  EXPECT_THAT(nlohmann::json::parse(write_json_schema(both))["properties"].size(), 3U);
}
