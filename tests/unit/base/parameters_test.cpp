#include "base/parameters/section.h"
#include "base/parameters/suggestion.h"
#include "base/parameters/value_reader.h"
#include "base/parameters/wording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

using namespace rotordrop;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

namespace {

enum class Law { radial, equivalent };

struct Wave {
  int order = 0;
  double amplitude = 0.0;
};
struct Everything {
  double gap = 0.0;
  double difference = 0.0;
  std::optional<double> static_friction;
  int rows = 0;
  std::optional<int> cells;
  bool is_dry = false;
  std::string title;
  std::optional<std::string> note;
  std::string law_name;
  Law law = Law::radial;
  std::array<double, 2> conformity{};
  std::optional<std::array<double, 3>> direction;
  std::vector<double> diameters;
  std::array<std::array<double, 2>, 2> stiffness{};
  std::vector<std::array<double, 2>> torque;
  std::vector<Wave> waviness;
  Wave main_wave;
  std::optional<Wave> second_wave;
  std::vector<std::pair<std::string, Wave>> named_waves;
  std::vector<double> gravity;
};

Section<Wave> wave_section() {
  Section<Wave> s("wave", "A wave.");
  s.integer("order", &Wave::order, {.range = at_least(1)});
  s.quantity("amplitude", &Wave::amplitude, {.unit = "m", .range = at_least(0), .fallback = "1 um"});
  return s;
}

Section<Everything> everything_section() {
  Section<Everything> s("all", "One of each kind.");
  s.quantity("gap", &Everything::gap, {.unit = "m", .range = positive(), .fallback = "250 um", .help = "Gap at rest."});
  s.quantity("difference", &Everything::difference,
             {.unit = "K", .kind = QuantityKind::temperature_difference, .fallback = "5 degC"});
  s.quantity("static_friction", &Everything::static_friction, {.range = between(0, 1)});
  s.integer("rows", &Everything::rows, {.range = between(1, 2), .fallback = 1});
  s.integer("cells", &Everything::cells, {});
  s.boolean("is_dry", &Everything::is_dry, {.fallback = true});
  s.text("title", &Everything::title, {.fallback = "drop"});
  s.text("note", &Everything::note, {});
  s.choice("law_name", &Everything::law_name, {"radial", "equivalent"}, {.fallback = "radial"});
  s.choice("law", &Everything::law, {{"radial", Law::radial}, {"equivalent", Law::equivalent}},
           {.fallback = "equivalent"});
  s.quantities("conformity", &Everything::conformity, {.range = above(0.5), .fallback = {"0.52", "0.52"}});
  s.quantities("direction", &Everything::direction, {});
  s.quantities("diameters", &Everything::diameters, {.unit = "m", .range = positive()});
  s.matrix("stiffness", &Everything::stiffness, {.unit = "N/m", .fallback = {{"1 kN/m", "2"}, {"3", "4"}}});
  s.function("torque", &Everything::torque, {.unit = "N m", .fallback = {{"0 s", "0 N m"}, {"100 ms", "2 N m"}}});
  s.list("waviness", &Everything::waviness, wave_section());
  s.table("main_wave", &Everything::main_wave, wave_section());
  s.table("second_wave", &Everything::second_wave, wave_section());
  s.tables("named_waves", &Everything::named_waves, wave_section());
  s.custom("gravity", {.unit = "m/s2", .fallback = Node(9.81)},
           [](const Node& node, Everything& target, Faults& faults) {
             const Quantity acceleration{.unit = "m/s2"};
             if (node.is_array())
               target.gravity =
                   read_quantities(node, acceleration, 3, 3, "all.gravity", faults).value_or(std::vector<double>{});
             else if (const auto g = read_quantity(node, acceleration, "all.gravity", faults))
               target.gravity = {0.0, -*g, 0.0};
           });
  return s;
}

/// Keys of a table with places that tell them apart: the n-th key is in line n.
Node placed(Node table) {
  int line = 0;
  table.set_where({"case.toml", 0 + 1, 1});
  for (auto& entry : table.entries()) {
    entry.where = {"case.toml", ++line, 1};
    entry.value.set_where({"case.toml", line, 20});
  }
  return table;
}

template <class T>
std::string faults_of(const Section<T>& section, const Node& table) {
  Faults faults;
  section.read(table, faults);
  return faults.empty() ? "" : InputError(faults).what();
}

const Node main_wave = Node::table({{"order", 2}});

/// The faults of [all] with one key, besides the required ones.
std::string faults_with(const std::string& key, const Node& value) {
  Node table = Node::table({{"main_wave", main_wave}});
  table.set(key, value);
  return faults_of(everything_section(), table);
}

Everything read_with(const std::string& key, const Node& value) {
  Node table = Node::table({{"main_wave", main_wave}});
  table.set(key, value);
  Faults faults;
  const Everything result = everything_section().read(table, faults);
  faults.throw_if_any();
  return result;
}

}  // namespace

TEST(Parameters, AbsentKeysHaveTheirDefaults) {
  const Everything all = read_with("main_wave", main_wave);
  EXPECT_EQ(all.gap, 250e-6);
  EXPECT_EQ(all.difference, 5.0);
  EXPECT_FALSE(all.static_friction);
  EXPECT_EQ(all.rows, 1);
  EXPECT_FALSE(all.cells);
  EXPECT_TRUE(all.is_dry);
  EXPECT_EQ(all.title, "drop");
  EXPECT_FALSE(all.note);
  EXPECT_EQ(all.law_name, "radial");
  EXPECT_EQ(all.law, Law::equivalent);
  EXPECT_THAT(all.conformity, ElementsAre(0.52, 0.52));
  EXPECT_FALSE(all.direction);
  EXPECT_TRUE(all.diameters.empty());
  EXPECT_THAT(all.stiffness[0], ElementsAre(1000.0, 2.0));
  EXPECT_THAT(all.stiffness[1], ElementsAre(3.0, 4.0));
  ASSERT_EQ(all.torque.size(), 2U);
  EXPECT_THAT(all.torque[1], ElementsAre(0.1, 2.0));
  EXPECT_TRUE(all.waviness.empty());
  EXPECT_EQ(all.main_wave.amplitude, 1e-6);
  EXPECT_FALSE(all.second_wave);
  EXPECT_TRUE(all.named_waves.empty());
  EXPECT_THAT(all.gravity, ElementsAre(0.0, -9.81, 0.0));
}

TEST(Parameters, GivenKeysReplaceTheDefaults) {
  EXPECT_EQ(read_with("gap", "0.3 mm").gap, 0.3e-3);
  EXPECT_EQ(read_with("gap", 1).gap, 1.0) << "an integer is a number";
  EXPECT_EQ(read_with("static_friction", 0.2).static_friction, 0.2);
  EXPECT_EQ(read_with("rows", 2).rows, 2);
  EXPECT_EQ(read_with("cells", 20).cells, 20);
  EXPECT_FALSE(read_with("is_dry", false).is_dry);
  EXPECT_EQ(read_with("note", "n").note, "n");
  EXPECT_EQ(read_with("law", "radial").law, Law::radial);
  EXPECT_THAT(read_with("conformity", Node::array({0.53, "0.54"})).conformity, ElementsAre(0.53, 0.54));
  EXPECT_THAT(*read_with("direction", Node::array({0, 0, 1})).direction, ElementsAre(0.0, 0.0, 1.0));
  EXPECT_THAT(read_with("diameters", Node::array({"70 mm", 0.078})).diameters, ElementsAre(0.07, 0.078));
  EXPECT_THAT(read_with("stiffness", Node::array({Node::array({1, 2}), Node::array({3, "4 N/mm"})})).stiffness[1],
              ElementsAre(3.0, 4000.0));
  EXPECT_THAT(read_with("gravity", Node::array({0, 0, "9.81 m/s2"})).gravity, ElementsAre(0.0, 0.0, 9.81));
  EXPECT_EQ(read_with("second_wave", Node::table({{"order", 3}})).second_wave.value().order, 3);
}

TEST(Parameters, AFunctionOfTimeMayBeAConstant) {
  const auto torque = read_with("torque", "3 N m").torque;
  ASSERT_EQ(torque.size(), 1U);
  EXPECT_THAT(torque[0], ElementsAre(0.0, 3.0));
}

TEST(Parameters, ListsAndNamedTablesKeepTheirOrder) {
  const auto wave = [](int order) { return Node::table({{"order", order}}); };
  const auto list = read_with("waviness", Node::array({wave(3), wave(2)})).waviness;
  ASSERT_EQ(list.size(), 2U);
  EXPECT_EQ(list[0].order, 3);
  EXPECT_EQ(list[1].order, 2);
  const auto named = read_with("named_waves", Node::table({{"zeta", wave(1)}, {"alpha", wave(4)}})).named_waves;
  ASSERT_EQ(named.size(), 2U);
  EXPECT_EQ(named[0].first, "zeta");
  EXPECT_EQ(named[1].second.order, 4);
}

TEST(Parameters, AMistypedKeyIsAnsweredWithTheRightName) {
  struct Contact {
    double air_gap, exponent, friction_coefficient, lambda;
  };
  Section<Contact> s("contact");
  s.quantity("friction_coefficient", &Contact::friction_coefficient, {.fallback = "0.1"});
  s.quantity("air_gap", &Contact::air_gap, {.unit = "m", .fallback = "250 um"});
  s.quantity("exponent", &Contact::exponent, {.fallback = "1.5"});
  s.quantity("lambda", &Contact::lambda, {.unit = "s/m", .fallback = "0.08"});
  EXPECT_EQ(faults_of(s, placed(Node::table({{"air_gpa", 1e-4}}))),
            "error: case.toml:1:1: unknown key \"air_gpa\" in [contact].\n"
            "       Did you mean \"air_gap\"?  Known here: air_gap, exponent, friction_coefficient, lambda.");
  EXPECT_THAT(faults_of(s, Node::table({{"friction", 0.1}})), HasSubstr("Did you mean \"friction_coefficient\"?"));
  EXPECT_THAT(faults_of(s, Node::table({{"Lambda", 0.1}})), HasSubstr("Did you mean \"lambda\"?"));
  EXPECT_THAT(faults_of(s, Node::table({{"colour", 0.1}})), Not(HasSubstr("Did you mean")));
}

TEST(Parameters, ANameIsCloseUpToAThirdOfItsLetters) {
  const std::vector<std::string> names{"rows", "air_gap", "bore_radius"};
  EXPECT_EQ(closest_name("row", names), "rows");
  EXPECT_EQ(closest_name("airgpa", names), "air_gap");
  EXPECT_EQ(closest_name("bore_radios", names), "bore_radius");
  EXPECT_EQ(closest_name("bore_diameter", names), "");
  EXPECT_EQ(closest_name("x", names), "");
}

TEST(Parameters, AKeyThatBelongsElsewhereIsSentThere) {
  struct Inner {
    double gap, mass;
  };
  struct Root {
    Inner contact;
    std::vector<std::pair<std::string, Inner>> bearings;
  };
  Section<Inner> contact("contact");
  contact.quantity("gap", &Inner::gap, {.unit = "m", .fallback = "1 mm"});
  Section<Inner> bearing("bearing");
  bearing.quantity("mass", &Inner::mass, {.unit = "kg", .fallback = "1 kg"});
  Section<Root> root("");
  root.table("contact", &Root::contact, contact);
  root.tables("bearings", &Root::bearings, bearing);
  EXPECT_THAT(faults_of(root, Node::table({{"contact", Node::table({{"mass", 1}})}})),
              AllOf(HasSubstr("unknown key \"mass\" in [contact]"), HasSubstr("It is known in [bearings.NAME].")));
  EXPECT_THAT(faults_of(root, Node::table({{"gap", 1}})),
              AllOf(HasSubstr("unknown key \"gap\" at the top level"), HasSubstr("It is known in [contact].")));
}

TEST(Parameters, AllFaultsAreReportedAtOnceInTheOrderOfTheFile) {
  const Node table =
      placed(Node::table({{"gap", -1}, {"rows", 2.5}, {"is_dri", true}, {"title", 5}, {"main_wave", main_wave}}));
  Faults faults;
  everything_section().read(table, faults);
  ASSERT_EQ(faults.size(), 4U);
  const InputError error(faults);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(error.faults()[static_cast<std::size_t>(i)].where.line, i + 1);
}

TEST(Parameters, AMissingKeyIsNamedWithItsTableAndAnExample) {
  struct Ring {
    double mass;
  };
  Section<Ring> s("ring");
  s.quantity("mass", &Ring::mass, {.unit = "kg", .range = positive(), .help = "Without balls."});
  EXPECT_EQ(faults_of(s, placed(Node::table())),
            "error: case.toml:1:1: missing key \"mass\" in [ring].\n"
            "       It must be a mass such as \"85 kg\" or a bare number in kg, > 0 kg.  Without balls.");
}

TEST(Parameters, AMissingKeyOfAnAbsentTableIsNamedToo) {
  EXPECT_THAT(faults_of(everything_section(), Node::table()), HasSubstr("missing key \"order\" in [all.main_wave]"));
}

TEST(Parameters, AValueOutOfRangeIsShownAsItWasGiven) {
  EXPECT_THAT(faults_with("gap", "-5 um"),
              AllOf(HasSubstr("all.gap = -5 um is out of range: it must be > 0 m."), HasSubstr("Gap at rest.")));
  EXPECT_THAT(faults_with("static_friction", 1.5),
              HasSubstr("all.static_friction = 1.5 is out of range: it must be between 0 and 1."));
  EXPECT_THAT(faults_with("rows", 3), HasSubstr("all.rows = 3 is out of range: it must be between 1 and 2."));
  EXPECT_THAT(faults_with("conformity", Node::array({0.52, 0.5})), HasSubstr("all.conformity#2 = 0.5 is out of range"));
  EXPECT_THAT(faults_with("cells", Node(std::int64_t{1} << 40)), HasSubstr("out of range"));
}

TEST(Parameters, AQuantityOfAnotherDimensionNamesBoth) {
  EXPECT_THAT(faults_with("gap", "5 s"), HasSubstr("5 s is a time; all.gap needs a length such as 250 um."));
}

TEST(Parameters, AValueOfAnotherTypeIsAFault) {
  EXPECT_THAT(faults_with("gap", true),
              HasSubstr("all.gap is a boolean; it must be a length such as \"250 um\" or a bare number in m."));
  EXPECT_THAT(faults_with("gap", Node()), HasSubstr("all.gap is empty (null)"));
  EXPECT_THAT(faults_with("gap", Node::table()), HasSubstr("all.gap is a table"));
  EXPECT_THAT(faults_with("static_friction", "true"), HasSubstr("\"true\" is not a number"));
  EXPECT_THAT(faults_with("rows", 2.5), HasSubstr("all.rows = 2.5; it must be an integer between 1 and 2."));
  EXPECT_THAT(faults_with("rows", 2.),
              HasSubstr("all.rows = 2.0; it must be an integer between 1 and 2.\n       Write 2, "));
  EXPECT_THAT(faults_with("rows", "2"), HasSubstr("all.rows is a text; it must be an integer"));
  EXPECT_THAT(faults_with("is_dry", "true"), HasSubstr("true or false, without quotes"));
  EXPECT_THAT(faults_with("is_dry", 1), HasSubstr("all.is_dry is an integer"));
  EXPECT_THAT(faults_with("title", 1), HasSubstr("it must be a text in quotes"));
  EXPECT_THAT(faults_with("conformity", 0.52), HasSubstr("all.conformity is a number; it must be a list of 2 values"));
  EXPECT_THAT(faults_with("conformity", Node::array({0.52})), HasSubstr("has 1 entries"));
  EXPECT_THAT(faults_with("stiffness", Node::array({1, 2})), HasSubstr("is not a 2 x 2 matrix"));
  EXPECT_THAT(faults_with("waviness", Node::table()), HasSubstr("must be an array of tables"));
  EXPECT_THAT(faults_with("waviness", Node::array({1})), HasSubstr("all.waviness#1 is an integer; it must be a table"));
  EXPECT_THAT(faults_with("named_waves", Node::table({{"a", 1}})), HasSubstr("all.named_waves.a is an integer"));
  EXPECT_THAT(faults_with("main_wave", 1), HasSubstr("all.main_wave is an integer; it must be a table"));
  EXPECT_THAT(faults_of(everything_section(), Node(1)), HasSubstr("all is an integer; it must be a table"));
}

TEST(Parameters, AFunctionOfTimeNeedsRisingTimes) {
  const auto points = [](double t0, double t1) { return Node::array({Node::array({t0, 1}), Node::array({t1, 2})}); };
  EXPECT_EQ(faults_with("torque", points(0.0, 1.0)), "");
  EXPECT_THAT(faults_with("torque", points(1.0, 1.0)), HasSubstr("all.torque#2 begins with 1, which is not larger"));
  EXPECT_THAT(faults_with("torque", Node::array({Node::array({"1 m", 1})})), HasSubstr("all.torque#1 needs a time"));
  EXPECT_THAT(faults_with("torque", Node::array({Node::array({1})})), HasSubstr("is not a pair"));
  EXPECT_THAT(faults_with("torque", Node::array()), HasSubstr("is empty"));
}

TEST(Parameters, AnUnknownChoiceIsAnsweredWithTheAllowedOnes) {
  EXPECT_THAT(faults_with("law_name", "radail"),
              AllOf(HasSubstr("all.law_name = \"radail\" is not known; it must be one of \"radial\", \"equivalent\"."),
                    HasSubstr("Did you mean \"radial\"?")));
  EXPECT_THAT(faults_with("law", "cubic"), HasSubstr("all.law = \"cubic\" is not known"));
}

TEST(Parameters, AFaultInAListNamesTheEntry) {
  EXPECT_THAT(faults_with("waviness", Node::array({main_wave, Node::table({{"order", 0}})})),
              HasSubstr("all.waviness#2.order = 0 is out of range"));
}

namespace {

struct Ring {
  double outer = 0.0;
  double pitch = 0.0;
};

Section<Ring> ring_section() {
  Section<Ring> s("ring");
  s.quantity("outer", &Ring::outer, {.unit = "m", .fallback = "1"});
  s.quantity("pitch", &Ring::pitch, {.unit = "m", .fallback = "2"});
  s.check([](const Ring& ring, const Node& table, Faults& faults) {
    if (ring.outer <= ring.pitch) faults.add(position_of_value(table, "outer"), "outer is not larger than pitch.");
  });
  return s;
}

}  // namespace

TEST(Parameters, ACheckOverSeveralKeysPointsAtOneOfThem) {
  Faults faults;
  ring_section().read(placed(Node::table({{"pitch", 4}, {"outer", 3}})), faults);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults.begin()->where, (SourcePosition{"case.toml", 2, 20}));
}

TEST(Parameters, ACheckWaitsUntilItsValuesAreSound) {
  EXPECT_THAT(faults_of(ring_section(), Node::table({{"outer", "1 s"}})), Not(HasSubstr("not larger")));
  EXPECT_THAT(faults_of(ring_section(), Node::table({{"typo", 1}})), HasSubstr("not larger"));
}

TEST(Parameters, DeclareWhatIsUsualBesideWhatIsAllowed) {
  Section<Ring> s("ring");
  s.quantity("outer", &Ring::outer,
             {.unit = "m", .range = positive(), .usual = between(5e-5, 1e-3), .fallback = "250 um"});
  const auto declared = s.erased();
  EXPECT_EQ(type_text(*declared->find("outer")), "length in m, > 0; usually between 5e-05 and 0.001");
  // Outside is no fault; who warns of it looks at the declaration.
  Faults faults;
  EXPECT_EQ(s.read(Node::table({{"outer", 0.5}}), faults).outer, 0.5);
  EXPECT_TRUE(faults.empty());
  EXPECT_FALSE(declared->find("outer")->usual.contains(0.5));
}

TEST(Parameters, FaultyDeclarationsAreOurMistake) {
  Section<Ring> s("ring");
  EXPECT_THROW(s.quantity("outer", &Ring::outer, {.unit = "m", .fallback = "5 s"}), std::logic_error);
  EXPECT_THROW(s.quantity("outer", &Ring::outer, {.unit = "m", .usual = between(0, 1), .fallback = "5 m"}),
               std::logic_error)
      << "an unusual default";
  EXPECT_THROW(s.quantity("outer", &Ring::outer, {.unit = "m", .range = positive(), .fallback = "-1"}),
               std::logic_error);
  EXPECT_THROW(s.quantity("outer", &Ring::outer, {.unit = "mm/furlong x"}), std::logic_error);
  s.quantity("outer", &Ring::outer, {.unit = "m"});
  EXPECT_THROW(s.quantity("outer", &Ring::outer, {.unit = "m"}), std::logic_error);
}

TEST(Parameters, DefaultsAreAvailableWithoutAFile) {
  struct Gap {
    double gap = 0.0;
  };
  Section<Gap> s("gap");
  s.quantity("gap", &Gap::gap, {.unit = "m", .fallback = "1 mm"});
  EXPECT_EQ(s.defaults().gap, 1e-3);
  EXPECT_THROW(everything_section().defaults(), InputError);
}

TEST(Ranges, SayWhatTheyAllow) {
  EXPECT_EQ(to_string(positive(), "m"), "> 0 m");
  EXPECT_EQ(to_string(at_least(1)), ">= 1");
  EXPECT_EQ(to_string(between(0, 1)), "between 0 and 1");
  EXPECT_EQ(to_string(between(0, 1).without_upper(), "m"), ">= 0 and < 1 m");
  EXPECT_EQ(to_string(below(2)), "< 2");
  EXPECT_EQ(to_string(any()), "any value");
  EXPECT_FALSE(between(0, 1).without_upper().contains(1.0));
  EXPECT_TRUE(between(0, 1).contains(1.0));
  EXPECT_FALSE(positive().contains(0.0));
  EXPECT_FALSE(between(0, 1).without_lower().contains(0.0));
}

// -------------------------------------------------------------------------------------------------------------
// variants

namespace {

struct Touchdown {
  double friction = 0.0;
  double mass = 0.0;
};
struct Linear {
  double stiffness = 0.0;
};
struct Machine {
  std::vector<std::pair<std::string, Touchdown>> touchdown;
  std::vector<std::pair<std::string, Linear>> linear;
};

Section<Machine> machine_section() {
  Section<Touchdown> touchdown("touchdown");
  touchdown.quantity("friction", &Touchdown::friction, {.range = at_least(0), .fallback = "0.1"});
  touchdown.quantity("mass", &Touchdown::mass, {.unit = "kg", .range = positive()});
  Section<Linear> linear("linear");
  linear.quantity("stiffness", &Linear::stiffness, {.unit = "N/m"});
  Section<Machine> s("");
  s.variants("bearings", "type",
             {variant("touchdown", &Machine::touchdown, touchdown, {.takes_defaults = true}),
              variant<Machine>("linear", linear,
                               [](Machine& machine, const std::string& name, const Linear& read) {
                                 machine.linear.emplace_back(name, read);
                               })},
             {.fallback = "touchdown"});
  return s;
}

Node bearings(std::initializer_list<std::pair<std::string, Node>> entries) {
  return Node::table({{"bearings", placed(Node::table(entries))}});
}

}  // namespace

TEST(Variants, EachNamedTableIsReadAsItsKindSays) {
  Faults faults;
  const Machine machine =
      machine_section().read(bearings({{"TB1", Node::table({{"mass", 2}})},
                                       {"magnet", Node::table({{"type", "linear"}, {"stiffness", 1e6}})}}),
                             faults);
  EXPECT_TRUE(faults.empty());
  ASSERT_EQ(machine.touchdown.size(), 1U);
  EXPECT_EQ(machine.touchdown[0].first, "TB1");
  ASSERT_EQ(machine.linear.size(), 1U);
  EXPECT_EQ(machine.linear[0].second.stiffness, 1e6);
}

TEST(Variants, WhatTheParentTableSetsHoldsForAllThatDoNotSetIt) {
  Faults faults;
  const Machine machine =
      machine_section().read(bearings({{"mass", 3},
                                       {"friction", 0.2},
                                       {"TB1", Node::table({{"mass", 2}})},
                                       {"TB2", Node::table({})},
                                       {"magnet", Node::table({{"type", "linear"}, {"stiffness", 1e6}})}}),
                             faults);
  EXPECT_TRUE(faults.empty()) << InputError(faults).what();
  ASSERT_EQ(machine.touchdown.size(), 2U);
  EXPECT_EQ(machine.touchdown[0].second.mass, 2.0);
  EXPECT_EQ(machine.touchdown[0].second.friction, 0.2);
  EXPECT_EQ(machine.touchdown[1].second.mass, 3.0);
}

TEST(Variants, AFaultyDefaultIsReportedOnceAndForItsOwnTable) {
  const std::string faults =
      faults_of(machine_section(), bearings({{"mass", -3}, {"TB1", Node::table({})}, {"TB2", Node::table({})}}));
  EXPECT_EQ(faults, "error: case.toml:1:20: bearings.mass = -3 is out of range: it must be > 0 kg.");
}

TEST(Variants, AMistypedDefaultIsAnsweredWithTheRightName) {
  EXPECT_THAT(faults_of(machine_section(), bearings({{"frcition", 0.1}})),
              AllOf(HasSubstr("unknown key \"frcition\" in [bearings]"), HasSubstr("Did you mean \"friction\"?")));
}

TEST(Variants, AnUnknownKindIsAnsweredWithTheAllowedOnes) {
  EXPECT_THAT(faults_of(machine_section(), bearings({{"TB1", Node::table({{"type", "touchdwon"}})}})),
              AllOf(HasSubstr("bearings.TB1.type = touchdwon is not known"), HasSubstr("Did you mean \"touchdown\"?"),
                    HasSubstr("\"touchdown\", \"linear\"")));
  EXPECT_THAT(faults_of(machine_section(), bearings({{"TB1", Node::table({{"type", 1}})}})),
              HasSubstr("type = 1 is not known"));
}

TEST(Variants, MissingAndUnknownKeysAreNamedInTheirTable) {
  EXPECT_THAT(
      faults_of(machine_section(), bearings({{"TB1", Node::table({{"stiffness", 1}})}})),
      AllOf(HasSubstr("missing key \"mass\" in [bearings.TB1]"),
            HasSubstr("unknown key \"stiffness\" in [bearings.TB1]"), HasSubstr("Known here: friction, mass, type.")));
}
