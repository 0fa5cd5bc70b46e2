// [minimise] by the code path of a study; only the drop is replaced by closed forms of two angles of the case, x and y in (-1, 1) half turns:
//   sum        x^2 + y^2 under x + y >= 1: smallest at x = y = 1/2, where it is 1/2 (by symmetry and Lagrange's rule)
//   valley     Rosenbrock's (1 - 2x)^2 + 100 (2y - 4x^2)^2: 0 at 2x = 2y = 1
//   waves      Rastrigin's of 5x - 1, 5y + 1: 0 at x = 0.2, y = -0.2, with a hundred other minima, the next ones 1
//   spread     (x - u)^2 with u uniform on (0, 1): the mean over u is smallest at 1/2, where it is the variance 1/12
//   slope      x + y: smallest at the corner of the box x = y = -1
//   x          under a curved function of x that is 1/4 at its edge: smallest at the edge
//   rough      (x - 0.3)^2 + 0.1 n, n of +-1 by the replicate's height: chaos whose mean is known
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "search_test.h"
#include "study/many/answers/search_summary.h"
#include "study/many/random_bits.h"

using namespace rotordrop;

namespace {

constexpr double pi = std::numbers::pi;

PointResult closed_forms(const PointRequest& request) {
  const auto& rotor = request.drop_case.parameters.rotor;
  const double x = rotor.unbalance[0].angle / pi, y = rotor.unbalance[1].angle / pi, u = rotor.initial_orbit.angle / pi;
  const auto wave = [](double z) { return 10. + z * z - 10. * std::cos(2. * pi * z); };
  const auto bits = static_cast<std::uint64_t>(std::llround(rotor.initial_offset[0] * 1e9));
  const double n = mixed(bits) & 1U ? 1. : -1.;
  PointResult result;
  result.is_done = true;
  result.scalars = {{"sum", x * x + y * y},
                    {"x_plus_y", x + y},
                    {"valley", std::pow(1. - 2. * x, 2) + 100. * std::pow(2. * y - 4. * x * x, 2)},
                    {"waves", wave(5. * x - 1.) + wave(5. * y + 1.)},
                    {"slope", x + y},
                    {"x", x},
                    {"minus_x", -x},
                    {"exp_3x", std::exp(3. * x)},
                    {"cubic", x * x * x + 0.5 * x},
                    {"sharp", std::sqrt(x + 1.)},
                    {"spread", std::pow(x - u, 2)},
                    {"rough", std::pow(x - 0.3, 2) + 0.1 * n}};
  return result;
}

PointResult fails_beyond_the_minimum(const PointRequest& request) {
  const auto& rotor = request.drop_case.parameters.rotor;
  if (rotor.unbalance[0].angle / pi > 0.55) {
    PointResult failed;
    failed.reason = "a trial";
    return failed;
  }
  return closed_forms(request);
}

const char* const both =
    "[vary]\n"
    "\"rotor.unbalance[0].angle\" = { range = [\"-180 deg\", \"180 deg\"], reference = \"0 deg\" }\n"
    "\"rotor.unbalance[1].angle\" = { range = [\"-180 deg\", \"180 deg\"], reference = \"0 deg\" }\n";
const char* const one = "[vary]\n\"rotor.unbalance[0].angle\" = { range = [\"-180 deg\", \"180 deg\"] }\n";

class Minimise : public test::SearchTest {
 protected:
  nlohmann::json run(const std::string& text, const Evaluator& evaluate = closed_forms,
                     const std::string& output = "out", unsigned n_workers = 2) {
    const auto found = search(text, closed_forms, evaluate, output, n_workers);
    return is_complete_ ? found["minimise"] : found;
  }
  static double best(const nlohmann::json& j, int angle) {
    return j["best"]["parameters"]["rotor.unbalance[" + std::to_string(angle) + "].angle"].get<double>() / pi;
  }
};

}  // namespace

// Steps end at 1e-4 of the range (2): value and place are known to some of them.
TEST_F(Minimise, KeepsALimitAtWhichTheMinimumLies) {
  const auto j =
      run(std::string(both) + "[limits]\nx_plus_y = { min = 1 }\n[minimise]\nresult = \"sum\"\ntolerance = 1e-4\n");
  EXPECT_NEAR(j["best"]["value"].get<double>(), 0.5, 1e-3);
  EXPECT_NEAR(best(j, 0), 0.5, 0.02);  // along the limit the value is flat: a place to the root of the value's error
  EXPECT_NEAR(best(j, 1), 0.5, 0.02);
  EXPECT_GE(j["best"]["limits"][0]["lower_value"].get<double>(), 1.);
  EXPECT_EQ(j["start"]["value"], 0.);
  EXPECT_FALSE(j["start"]["within_limits"].get<bool>());
  EXPECT_NE(minimise_text(nlohmann::ordered_json(j)).find("at the start 0, outside the limits"), std::string::npos);
  EXPECT_TRUE(j["best"]["at_end_of_range"].empty());
}

// Linear models of a curved limit lead to a place a hair outside it: the best allowed evaluation must come to the edge all the same, 0.3 in each.
// The steps end at 1e-3 of the range (2).
TEST_F(Minimise, ComesToTheEdgeOfACurvedLimitFromItsAllowedSide) {
  const std::pair<const char*, double> limits[] = {
      {"exp_3x", std::exp(0.9)}, {"cubic", 0.3 * 0.3 * 0.3 + 0.15}, {"sharp", std::sqrt(1.3)}};
  int n = 0;
  for (const auto& [limit, edge] : limits)
    for (const bool is_min : {true, false})
      for (const double start : {-170., -50., 20., 100., 160.}) {
        std::string text = one;
        text.replace(text.find(" }"), 2, ", reference = \"" + std::to_string(start) + " deg\" }");
        text += "[limits]\n" + std::string(limit) + (is_min ? " = { min = " : " = { max = ") + std::to_string(edge) +
                " }\n[minimise]\nresult = \"" + (is_min ? "x" : "minus_x") + "\"\nevaluations = 60\n";
        const auto j = run(text, closed_forms, "edge-" + std::to_string(n++));
        EXPECT_NEAR(best(j, 0), 0.3, 0.004) << text;
        EXPECT_TRUE(j["best"]["within_limits"].get<bool>());
        EXPECT_FALSE(j["searches"][0]["ended_outside_limits"].get<bool>()) << text;
      }
}

// Where the slope of a limit grows towards its edge, linear models lead beyond it.
TEST_F(Minimise, SaysThatItEndedOutsideALimitWhereNoEvaluationIsLeft) {
  int n_told = 0;
  for (int n = 3; n < 12; ++n) {
    const auto j = run(
        std::string(one) +
            "[limits]\nsharp = { min = 0.5 }\n[minimise]\nresult = \"x\"\nevaluations = " + std::to_string(n) + "\n",
        closed_forms, "few-" + std::to_string(n));
    const auto& last = j["course"].back();
    const bool is_told = j["searches"][0]["ended_outside_limits"].get<bool>();
    n_told += is_told;
    if (is_told) {
      EXPECT_FALSE(last["within_limits"].get<bool>());
      EXPECT_LT(last["value"].get<double>(), j["best"]["value"].get<double>());
      EXPECT_NE(minimise_text(j).find("ended outside a limit"), std::string::npos);
    }
  }
  EXPECT_GT(n_told, 0);
}

TEST_F(Minimise, FollowsACurvedValley) {
  for (const char* method : {"bobyqa", "subplex"}) {
    const auto j =
        run(std::string(both) + "[minimise]\nresult = \"valley\"\ntolerance = 1e-5\nevaluations = 1000\nmethod = \"" +
                method + "\"\n",
            closed_forms, method);
    EXPECT_LT(j["best"]["value"].get<double>(), 1e-4) << method;
    EXPECT_NEAR(best(j, 0), 0.5, 0.01) << method;
    EXPECT_NEAR(best(j, 1), 0.5, 0.02) << method;
  }
}

TEST_F(Minimise, FindsTheLowestOfManyMinimaBySeveralMethods) {
  for (const std::string method : {"direct", "crs"}) {
    const auto j =
        run(std::string(both) + "[minimise]\nresult = \"waves\"\nevaluations = 900\nmethod = \"" + method + "\"\n",
            closed_forms, method);
    EXPECT_LT(j["best"]["value"].get<double>(), 0.9) << method;  // the next minima are near 1
    EXPECT_NEAR(best(j, 0), 0.2, 0.02) << method;
    EXPECT_NEAR(best(j, 1), -0.2, 0.02) << method;
  }
}

// Points of a method that have all met in a corner come back to it: known places cost nothing and count as no evaluation.
TEST_F(Minimise, EndsWhereTheMinimumLiesInACorner) {
  for (const std::string method : {"cobyla", "bobyqa", "subplex", "crs", "isres", "direct"}) {
    const auto j =
        run(std::string(both) + "[minimise]\nresult = \"slope\"\nevaluations = 500\nmethod = \"" + method + "\"\n",
            closed_forms, method);
    EXPECT_NEAR(best(j, 0) + best(j, 1), -2., 0.1) << method;  // evolution comes within a fortieth of the ranges
    EXPECT_EQ(notes_.size(), method == "crs" ? 1U : 0U) << method;
    if (method != "cobyla") continue;
    EXPECT_EQ(j["best"]["at_end_of_range"], (nlohmann::json{"rotor.unbalance[0].angle", "rotor.unbalance[1].angle"}));
    const std::string told = minimise_text(nlohmann::ordered_json(j));
    EXPECT_NE(told.find("<- end of its range"), std::string::npos);
    EXPECT_EQ(told.find("outside the limits"), std::string::npos);
  }
}

TEST_F(Minimise, StopsOnceAskedAlsoWhereTheMethodComesBackToKnownPlaces) {
  int n_drops = 0;
  const auto counts = [&](const PointRequest& request) {
    ++n_drops;
    return closed_forms(request);
  };
  const std::string text = std::string(both) + "[minimise]\nresult = \"slope\"\nevaluations = 500\nmethod = \"crs\"\n";
  run(text, counts, "whole", 1);
  ASSERT_TRUE(is_complete_);
  const int n_all = std::exchange(n_drops, 0);
  ASSERT_LT(n_all, 500);
  run(
      text,
      [&](const PointRequest& request) {
        if (++n_drops == n_all) stop_ = 1;  // no further drop comes
        return closed_forms(request);
      },
      "stopped", 1);
  EXPECT_FALSE(is_complete_);
}

TEST_F(Minimise, TakesTheMeanOverWhatIsNotSearched) {
  const auto j = run(std::string(one) +
                     "\"rotor.initial_orbit.angle\" = { range = [\"0 deg\", \"180 deg\"] }\n"
                     "[design]\nsize = 40\n[minimise]\nresult = \"spread\"\nover = "
                     "[\"rotor.unbalance[0].angle\"]\ntolerance = 1e-5\n");
  // A Latin hypercube of 40 has its mean within 4e-3 (one number per stratum: sigma 1 / 40 / sqrt(12 * 40) = 1.1e-3).
  EXPECT_NEAR(best(j, 0), 0.5, 4e-3);
  EXPECT_NEAR(j["best"]["value"].get<double>(), 1. / 12., 2e-3);
  EXPECT_LT(j["best"]["low"].get<double>(), 1. / 12.);
  EXPECT_GT(j["best"]["high"].get<double>(), 1. / 12.);
  EXPECT_EQ(j["drops_of_evaluation"], 40);
}

TEST_F(Minimise, SeesThroughChaosByReplicates) {
  const auto j = run(std::string(one) + "[replicates]\nn = 40\n[minimise]\nresult = \"rough\"\nmethod = \"subplex\"\n");
  // Steps end at 1e-3 of the range of 2: the place is known to some of them.
  EXPECT_NEAR(best(j, 0), 0.3, 0.01);
  // The mean of 40 numbers of +-0.1 has a standard error of 0.016.
  EXPECT_NEAR(j["best"]["value"].get<double>(), 0., 3. * 0.1 / std::sqrt(40.));
  EXPECT_LT(j["best"]["low"].get<double>(), j["best"]["high"].get<double>());
}

TEST_F(Minimise, TakesFailedDropsAsWorseThanAllOthers) {
  const auto j =
      run(std::string(both) + "[limits]\nx_plus_y = { min = 1 }\n[minimise]\nresult = \"sum\"\nsearches = 4\n",
          fails_beyond_the_minimum);
  // Steps end at 1e-3 of the range of 2, and the value rises by as much along each of both.
  EXPECT_NEAR(j["best"]["value"].get<double>(), 0.5, 0.02);
}

TEST_F(Minimise, GivesTheSameBitsForAnyWorkersAndInterruptions) {
  const std::string text =
      std::string(both) + "[replicates]\nn = 2\n[minimise]\nresult = \"valley\"\nsearches = 3\nevaluations = 40\n";
  run(text, closed_forms, "one", 1);
  for (const unsigned n : {2U, 3U}) {
    run(text, closed_forms, std::to_string(n), n);
    EXPECT_EQ(bytes(std::to_string(n)), bytes("one"));
  }
  std::atomic<int> left{0};
  int n_interruptions = 0;
  for (int attempt = 0; attempt < 50; ++attempt) {
    left = 17;
    stop_ = 0;
    run(
        text,
        [&](const PointRequest& request) {
          if (--left < 0) stop_ = 1;
          auto result = closed_forms(request);
          result.is_interrupted = stop_ != 0;
          result.is_done = !result.is_interrupted;
          return result;
        },
        "broken");
    if (is_complete_) break;
    ++n_interruptions;
  }
  EXPECT_TRUE(is_complete_);
  EXPECT_GT(n_interruptions, 5);
  EXPECT_EQ(bytes("broken"), bytes("one"));
}

TEST_F(Minimise, SaysWhatCannotBeSearched) {
  const auto fault_of = [&](const std::string& text) -> std::string {
    try {
      Study study = folder_.read(text);
      probe_results(study, SearchSpace(study).corners(), closed_forms);
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  const std::string two = both, search = "[minimise]\nresult = \"sum\"\n";
  EXPECT_NE(fault_of(two + "[minimise]\nresult = \"summ\"\n").find("Did you mean \"sum\""), std::string::npos);
  EXPECT_NE(fault_of(two + search + "over = [\"rotor.unbalance[0].angel\"]\n").find("is not varied"),
            std::string::npos);
  EXPECT_NE(fault_of(std::string(one) + search + "method = \"bobyqa\"\n").find("two parameters"), std::string::npos);
  EXPECT_NE(fault_of(two + search + "method = \"direct\"\n[limits]\nsum = { max = 1 }\n").find("takes no limits"),
            std::string::npos);
  EXPECT_NE(fault_of("[vary]\ncontact.friction_coefficient = [0.1, 0.2]\n" + search).find("nothing to search"),
            std::string::npos);
  EXPECT_NE(fault_of(two + search + "over = [\"rotor.unbalance[0].angle\"]\n").find("needs design.size"),
            std::string::npos);
  EXPECT_NE(fault_of(two + search + "[design]\nsize = 7\n").find("no meaning"), std::string::npos);
  const std::string outside =
      "[vary]\n\"rotor.unbalance[0].angle\" = { range = [\"-90 deg\", \"90 deg\"], reference = \"100 deg\" }\n";
  EXPECT_NE(
      fault_of(outside + search).find("study.toml:3:75: vary.rotor.unbalance[0].angle: the search starts at reference"),
      std::string::npos)
      << fault_of(outside + search);
  EXPECT_NE(fault_of(outside + search).find("but the range is -1.5707963267948966 to 1.5707963267948966 rad"),
            std::string::npos)
      << fault_of(outside + search);
}

TEST_F(Minimise, RefusesSeveralSearchesFromTheMiddleAndWarnsOfReferencesThere) {
  const std::string direct = std::string(both) + "[minimise]\nresult = \"sum\"\nmethod = \"direct\"\n";
  try {
    (void)folder_.read(direct + "searches = 2\n");
    FAIL() << "was taken";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("study.toml:8:12: minimise.searches = 2"), std::string::npos)
        << error.what();
  }
  const auto warnings = folder_.read(direct).base.warnings;
  const auto of_references = std::count_if(warnings.begin(), warnings.end(), [](const Fault& warning) {
    return warning.message.find("the reference has no effect") != std::string::npos;
  });
  EXPECT_EQ(of_references, 2);
  const std::string at_an_end =
      "[vary]\n\"rotor.unbalance[0].angle\" = { range = [\"0 deg\", \"180 deg\"], reference = \"0 deg\" }\n";
  const auto j = run(at_an_end + "[minimise]\nresult = \"sum\"\nmethod = \"direct\"\nevaluations = 9\n");
  EXPECT_NEAR(j["start"]["parameters"]["rotor.unbalance[0].angle"].get<double>(), pi / 2, 1e-12);
  EXPECT_NE(minimise_text(nlohmann::ordered_json(j)).find("in the middle of the ranges"), std::string::npos);
}

// A number at an end of its range stays there whatever rounding its unit brings; the case's value need not lie in the range.
TEST_F(Minimise, StartsAtTheReferenceOrTheCasesValueOrInTheMiddle) {
  const auto start_of = [&](const std::string& range) {
    const Study study = folder_.read("[vary]\ncontact.air_gap = { " + range + " }\n[minimise]\nresult = \"sum\"\n");
    return SearchSpace(study).starts(1).front().front();
  };
  EXPECT_EQ(start_of("range = [\"0.1 mm\", \"0.3 mm\"], reference = \"300 um\""), 1.);
  EXPECT_EQ(start_of("range = [\"0.1 mm\", \"0.3 mm\"], reference = 1e-4"), 0.);
  EXPECT_NEAR(start_of("range = [\"100 um\", \"300 um\"]"), 0.75, 1e-12);  // 250 um
  EXPECT_EQ(start_of("range = [\"100 um\", \"200 um\"]"), 0.5);
}
