#include "study/many/study_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "study/result_names.h"
#include "study_inputs.h"

using namespace rotordrop;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

namespace {

std::string fault_of(const std::string& text) {
  const test::StudyFolder folder;
  try {
    Study study = folder.read(text);
    const Design design = make_design(study);
    check_points(study, design, 1);
    probe_results(study, design, evaluate_point);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

const std::string friction = "[vary]\n\"contact.friction_coefficient\" = [0.1, 0.2]\n[design]\nkind = \"grid\"\n";

}  // namespace

void expect_meanings(const std::vector<std::string>& names) {
  for (const auto& name : names) {
    EXPECT_NE(meaning_of(name).unit, "") << name;
    EXPECT_NE(meaning_of(name).long_name, "") << name;
  }
}

const std::string everything = "base = \"" ROTORDROP_SOURCE_DIR
                               "/params/neisi2019-settling.toml\"\n"
                               R"(
run.end_time = "20 ms"
[rotor]
axial_motion = "free"
axial_force = "1500 N"
windage = { law = "geometry" }
[rotor.probes]
P = { node = 6, clearance = "0.2 mm", contact = { stiffness = "1e8 N/m" } }
Q = { node = 10, clearance = "0.2 mm" }
[bearings]
ring_motion = "free"
[bearings.TB1]
C = "39.7 kN"
cage = "free"
support.stop = { gap = "0.1 mm", stiffness = "1e9 N/m" }
[bearings.TB2.shoulders]
gap_minus_x = "0.3 mm"
[bearings.M]
type = "magnet"
node = 6
stiffness = [["1e7 N/m", 0], [0, "1e7 N/m"]]
damping = [["5e3 N s/m", 0], [0, "5e3 N s/m"]]
release_time = ["2 ms", "2 ms"]
)";

TEST(StudyFile, TakesUnitsAsACaseDoes) {
  const test::StudyFolder folder;
  const Study study = folder.read(R"(
[vary]
contact.air_gap = { range = ["200 um", "0.3 mm"] }
run.ambient = { distribution = "truncated-normal", mean = "20 degC", deviation = "5 degC", lower = "0 degC", upper = "40 degC" }
"rotor.unbalance[0].angle" = { values = ["0 deg", "90 deg"], weights = [1, 3] }
bearings.TB1.catalogue = ["6014", "6016"]
[design]
size = 4
)");
  ASSERT_EQ(study.parameters.size(), 4U);
  EXPECT_DOUBLE_EQ(study.parameters[0].distribution.lower, 200e-6);
  EXPECT_DOUBLE_EQ(study.parameters[0].distribution.upper, 300e-6);
  EXPECT_DOUBLE_EQ(study.parameters[1].distribution.mean, 293.15);
  EXPECT_DOUBLE_EQ(study.parameters[1].distribution.deviation, 5.);
  EXPECT_DOUBLE_EQ(study.parameters[2].distribution.values[1].number(), std::acos(-1.) / 2.);
  EXPECT_DOUBLE_EQ(study.parameters[2].distribution.weights[1], 0.75);
  EXPECT_FALSE(study.parameters[3].is_numeric());
}

TEST(StudyFile, TellsWhatIsWrongBeforeAnythingRuns) {
  const std::string design = "[design]\nsize = 4\n";
  EXPECT_THAT(fault_of("[vary]\n\"contact.frction_coefficient\" = [0.1]\n" + design),
              AllOf(HasSubstr("unknown key"), HasSubstr("Did you mean \"contact.friction_coefficient\"?"),
                    HasSubstr("study.toml:3")));
  EXPECT_THAT(fault_of("[vary]\n\"contact.friction_coefficient\" = { range = [0.3, 0.1] }\n" + design),
              HasSubstr("range is empty"));
  EXPECT_THAT(fault_of("[vary]\n\"contact.air_gap\" = { range = [\"200 N\", \"300 um\"] }\n" + design),
              HasSubstr("length"));
  EXPECT_THAT(fault_of("[vary]\n\"contact.friction_coefficient\" = []\n" + design),
              HasSubstr("list of values is empty"));
  EXPECT_THAT(
      fault_of("[vary]\n\"contact.friction_coefficient\" = { range = [0.1, 0.2], distribution = \"normal\" }\n" +
               design),
      HasSubstr("either values, a range, a distribution or a formula"));
  EXPECT_THAT(fault_of("[vary]\n\"contact.friction_coefficient\" = { distribution = \"norml\", mean = 1 }\n" + design),
              AllOf(HasSubstr("Did you mean \"normal\"?"), HasSubstr("triangular, discrete")));
  for (const char* lognormal : {"lognormal", "log-normal", "Log_Normal"})
    EXPECT_THAT(fault_of("[vary]\n\"contact.friction_coefficient\" = { distribution = \"" + std::string(lognormal) +
                         "\", mean = 1, deviation = 1 }\n" + design),
                AllOf(HasSubstr("log-uniform, normal, truncated-normal"), HasSubstr("by its quantiles as values"),
                      Not(HasSubstr("Did you mean"))));
  const auto one_at_a_time = [](const std::string& reference) {
    return "[vary]\nrun.ambient = { range = [280, 300], reference = " + reference +
           " }\n[design]\nkind = \"one-at-a-time\"\n";
  };
  EXPECT_THAT(fault_of(one_at_a_time("500")),
              AllOf(HasSubstr("study.toml:3"), HasSubstr("reference = 500 is not in the range from 280 to 300 K")));
  EXPECT_EQ(fault_of(one_at_a_time("\"26.85 degC\"")), "");
  EXPECT_THAT(fault_of("[vary]\n\"rotor.unbalance[2].me\" = [1e-6]\n" + design), HasSubstr("no entry 2"));
  EXPECT_THAT(fault_of("[vary]\n\"bearings.TB3.f2\" = [1]\n" + design), HasSubstr("Did you mean \"bearings.TB"));
  EXPECT_THAT(fault_of("[vary]\n\"contact.friction_coefficient\" = [0.1]\n"), HasSubstr("needs design.size"));
  EXPECT_THAT(fault_of("[vary]\n\"contact.friction_coefficient\" = { range = [0, 1], levels = 100000 }\n"
                       "\"contact.air_gap\" = { range = [1e-4, 2e-4], levels = 100000 }\n"
                       "\"rotor.modal_damping\" = { range = [0, 0.1], levels = 100 }\n[design]\nkind = \"grid\"\n"),
              AllOf(HasSubstr("1e+12 drops"), HasSubstr("at most 1e+07")));
  EXPECT_THAT(fault_of("[vary]\n\"contact.friction_coefficient\" = [0.1]\n[design]\nsize = 1000000000000\n"),
              HasSubstr("design.size"));
  EXPECT_THAT(fault_of("[vary]\n\"contact.friction_coefficient\" = [0.1, -0.1]\n[design]\nkind = \"list\"\n"),
              AllOf(HasSubstr("point 1 is no valid case"), HasSubstr("friction_coefficient = -0.1")));
  EXPECT_THAT(
      fault_of(friction + "[limits]\n\"bearings.TB1.peak_contact_frce\" = { max = \"6 kN\" }\n"),
      AllOf(HasSubstr("the limit is on nothing"), HasSubstr("Did you mean \"bearings.TB1.peak_contact_force\"?")));
  EXPECT_THAT(fault_of(friction + "[limits]\n\"bearings.TB1.peak_contact_force\" = { max = \"6 K\" }\n"),
              HasSubstr("force"));
  EXPECT_THAT(fault_of(friction + "[derived.peak]\nformula = \"max(bearings.TB1.peak_force, 1)\"\n"),
              HasSubstr("no result is called"));
  EXPECT_THAT(fault_of(friction + "[keep]\nseries = [\"/bearings/TB1/contact_frce\"]\n"),
              HasSubstr("Did you mean \"/bearings/TB1/contact_force\"?"));
  EXPECT_THAT(fault_of(friction + "[choose]\nparameter = \"friction\"\nresult = \"rotor_speed_end\"\n"),
              HasSubstr("is not varied"));
  const auto chosen_by_formula = [](const std::string& values) {
    return "[vary]\n\"contact.friction_coefficient\" = " + values +
           "\n\"rotor.modal_damping\" = { formula = \"0.1 * contact.friction_coefficient\" }\n[design]\nsize = 4\n"
           "[choose]\nparameter = \"rotor.modal_damping\"\nresult = \"rotor_speed_end\"\n";
  };
  EXPECT_THAT(fault_of(chosen_by_formula("{ range = [0.1, 0.2] }")),
              AllOf(HasSubstr("needs values"), HasSubstr("by its formula it follows contact.friction_coefficient"),
                    HasSubstr("Write contact.friction_coefficient = [first, second, ...]")));
  EXPECT_EQ(fault_of(chosen_by_formula("[0.1, 0.2]")), "");
  EXPECT_THAT(
      fault_of(
          "[vary]\n\"contact.friction_coefficient\" = { range = [0, 1] }\n\"rotor.modal_damping\" = { range = [0, 0.1] "
          "}\n"
          "[design]\nsize = 4\nkind = \"saltelli\"\n[[correlation]]\nparameters = [\"contact.friction_coefficient\", "
          "\"rotor.modal_damping\"]\nrank = 0.5\n"),
      HasSubstr("needs independent parameters"));
  EXPECT_EQ(fault_of(friction), "");
}

TEST(StudyFile, FitsPatternsWithinOnePartOfAName) {
  EXPECT_TRUE(fits("bearings.TB1.peak_contact_force", "bearings.*.peak_contact_force"));
  EXPECT_TRUE(fits("bearings.TB1.rows[1].truncation", "bearings.*.rows*.trunc*"));
  EXPECT_FALSE(fits("bearings.TB1.preload.end", "bearings.*.end"));
  EXPECT_FALSE(fits("bearings.TB1.peak_contact_force_time", "bearings.*.peak_contact_force"));
}

TEST(ResultNames, HaveUnitsAndMeanings) {
  EXPECT_EQ(meaning_of("bearings.TB1.peak_contact_force").unit, "N");
  EXPECT_EQ(meaning_of("bearings.TB1.peak_contact_force").long_name, "TB1: peak contact force in the bore");
  EXPECT_EQ(meaning_of("bearings.TB2.rows[1].largest_contact_pressure_time").unit, "s");
  EXPECT_EQ(meaning_of("bearings.TB2.growth.bore.largest_time").unit, "s");
  EXPECT_EQ(meaning_of("bearings.TB2.growth.bore.largest").unit, "m");
  EXPECT_EQ(meaning_of("energy.residual").unit, "J");
  EXPECT_EQ(meaning_of("probes.P.smallest_clearance").long_name,
            "P: smallest clearance left at the probe, negative beyond it");
  EXPECT_EQ(meaning_of("probes.P.contact.damping").unit, "J");
  EXPECT_EQ(meaning_of("bearings.TB2.shoulder.stiffness").unit, "N/m");
  EXPECT_EQ(meaning_of("bearings.TB2.shoulder.sides[0].force_by_energy.stiffness").unit, "N");
  EXPECT_EQ(meaning_of("bearings.TB2.fe.surface_rise.bore.highest_mean").unit, "K");
  EXPECT_EQ(meaning_of("bearings.TB2.fe.surface_rise.bore.highest_time").unit, "s");
  EXPECT_EQ(meaning_of("bearings.TB2.temperature_rise_end.clearance").unit, "K") << "a node of a case's own";
}

TEST(ResultNames, CoverEveryNumberOfADropsSummary) {
  const test::StudyFolder folder;
  Study study = folder.read(friction);
  const auto probed = probe_results(study, make_design(study), evaluate_point);
  EXPECT_GT(probed.names.size(), 200U);
  expect_meanings(probed.names);
}

// Whatever adds numbers to a summary: shoulders, probes with and without contact, a magnet, a support of its own, windage, ratings, a free cage.
TEST(ResultNames, CoverEveryNumberOfADropWithEverything) {
  const test::StudyFolder folder;
  std::ofstream(folder.path() / "everything.toml") << everything;
  std::ofstream(folder.path() / "study.toml") << "case = \"everything.toml\"\n" << friction;
  Study study = read_study(folder.path() / "study.toml");
  const auto probed = probe_results(study, make_design(study), evaluate_point);
  const std::set<std::string> names(probed.names.begin(), probed.names.end());
  for (const char* part :
       {"probes.P.contact.damping", "probes.Q.smallest_clearance", "bearings.TB2.shoulder.sides[0].gap",
        "bearings.TB2.axial.shoulder_force.smallest", "bearings.TB1.support.meets_stop", "energy.windage",
        "bearings.TB1.damage.fatigue.share", "bearings.TB1.spin_up"})
    EXPECT_TRUE(names.contains(part)) << part;
  expect_meanings(probed.names);
}
