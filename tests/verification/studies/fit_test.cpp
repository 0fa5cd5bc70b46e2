// [fit] by the code path of a study; only the drop is replaced by a free oscillation that dies out,
//   x(t) = a exp(-d t) cos(w t),  a = 1 mm times an angle in half turns, d = 100 /s times another one, w = 2 pi 100 Hz,
// measured 200 times in 20 ms with normal noise (Box & Muller's numbers from the seeded generator of the studies). A first-order sensor of bandwidth b
// shows of exp(s t), s = -d + i w, the particular solution exp(s t) / (1 + s tau) and what is left of its start, exp(-t / tau) (1 - 1 / (1 + s tau)).
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "search_test.h"
#include "study/many/random_bits.h"

using namespace rotordrop;

namespace {

constexpr double pi = std::numbers::pi, omega = 2. * pi * 100.;

PointResult oscillation(const PointRequest& request) {
  const auto& rotor = request.drop_case.parameters.rotor;
  const double a = 1e-3 * rotor.unbalance[0].angle / pi, d = 100. * rotor.unbalance[1].angle / pi;
  PointResult result;
  result.is_done = true;
  result.scalars = {{"a", a}};
  PointSeries orbit{"/bearings/TB1/orbit", "m", "orbit", 2, {}, {}};
  for (int i = 0; i <= 2000; ++i) {
    const double t = 1e-5 * i;
    orbit.time.push_back(t);
    orbit.values.push_back(a * std::exp(-d * t) * std::cos(omega * t));
    orbit.values.push_back(7.);
  }
  result.series.push_back(std::move(orbit));
  return result;
}

double normal_number(std::uint64_t seed, std::uint64_t i) {
  return std::sqrt(-2. * std::log(uniform_number(seed, i, 0))) * std::cos(2. * pi * uniform_number(seed, i, 1));
}

const double true_a = 0.4, true_d = 0.6;  // of half turns

class FitTest : public test::SearchTest {
 protected:
  /// 200 samples in um over ms of what a sensor shows.
  void measure(std::uint64_t seed, double noise, double tau = 0., double delay = 0.) {
    std::ofstream file(folder_.path() / "measured.csv");
    file << "t [ms];y [um]\n";
    const std::complex<double> s(-100. * true_d, omega);
    for (int i = 0; i < 200; ++i) {
      const double t = 1e-4 * i, at = t - delay;
      std::complex<double> x = std::exp(s * std::max(at, 0.));
      if (tau > 0.) x = x / (1. + s * tau) + std::exp(-std::max(at, 0.) / tau) * (1. - 1. / (1. + s * tau));
      file << 1e3 * t << ";"
           << 1e6 * (1e-3 * true_a * x.real() + noise * normal_number(seed, static_cast<std::uint64_t>(i))) << "\n";
    }
  }
  nlohmann::json run(const std::string& more = "", const std::string& output = "out", unsigned n_workers = 2,
                     const Evaluator& evaluate = oscillation) {
    const std::string text =
        "[vary]\n"
        "\"rotor.unbalance[0].angle\" = { range = [\"10 deg\", \"180 deg\"], reference = \"150 deg\" }\n"
        "\"rotor.unbalance[1].angle\" = { range = [\"10 deg\", \"180 deg\"], reference = \"20 deg\" }\n" +
        more_of_fit_ + "[[fit.measured]]\nfile = \"measured.csv\"\nseries = \"/bearings/TB1/orbit\"\n" + more;
    const auto found = search(text, oscillation, evaluate, output, n_workers);
    return is_complete_ ? found["fit"] : found;
  }
  static const nlohmann::json& parameter(const nlohmann::json& j, int k) {
    return j["parameters"]["rotor.unbalance[" + std::to_string(k) + "].angle"];
  }
  static bool covers(const nlohmann::json& p, double truth) {
    return p["low"].get<double>() <= truth && truth <= p["high"].get<double>();
  }
  std::string more_of_fit_ = "[fit]\n";
};

}  // namespace

// Straight lines between samples 10 us apart are off by (w h)^2 / 8 = 5e-6 of the amplitude; digits of the table: 6.
TEST_F(FitTest, FindsTheParametersOfAMeasurementWithoutNoise) {
  measure(1, 0.);
  const auto j = run();
  EXPECT_NEAR(parameter(j, 0)["value"].get<double>() / pi, true_a, 2e-5);
  EXPECT_NEAR(parameter(j, 1)["value"].get<double>() / pi, true_d, 2e-4);
  EXPECT_LT(j["measured"][0]["rms"].get<double>(), 1e-8);
  EXPECT_GT(j["measured"][0]["rms_start"].get<double>(), 1e-5);
  EXPECT_GT(j["measured"][0]["share"].get<double>(), 0.999999);
}

TEST_F(FitTest, KnowsWhatASensorWithBandwidthAndDelayShows) {
  const double tau = 1. / (2. * pi * 150.);
  measure(1, 0., tau, 0.7e-3);
  more_of_fit_ = "[fit]\n";
  const std::string sensor = "bandwidth = \"150 Hz\"\ndelay = \"0.7 ms\"\nfrom = \"0.8 ms\"\n";
  const auto j = run(sensor);
  // straight lines between samples, as above; the sensor's equation is solved exactly on them
  EXPECT_NEAR(parameter(j, 0)["value"].get<double>() / pi, true_a, 2e-5);
  EXPECT_NEAR(parameter(j, 1)["value"].get<double>() / pi, true_d, 2e-4);
  const auto blind = run("", "blind");
  EXPECT_GT(std::fabs(parameter(blind, 0)["value"].get<double>() / pi - true_a), 0.01);
}

// The number of covering intervals of 40 is binomial with 0.95: fewer than 33 has a probability of 3e-4.
TEST_F(FitTest, HasIntervalsThatCoverTheTruthAsOftenAsTheySay) {
  int covered_a = 0, covered_d = 0, known_a = 0;
  double width = 0.;
  constexpr int n = 40;
  for (int k = 0; k < n; ++k) {
    measure(100 + static_cast<std::uint64_t>(k), 20e-6);
    const auto j = run("", "out" + std::to_string(k));
    covered_a += covers(parameter(j, 0), true_a * pi);
    covered_d += covers(parameter(j, 1), true_d * pi);
    width += (parameter(j, 0)["high"].get<double>() - parameter(j, 0)["low"].get<double>()) / n;
    const auto given = run("deviation = 20\nunit = \"um\"\n", "given" + std::to_string(k));
    known_a += covers(parameter(given, 0), true_a * pi);
    EXPECT_NEAR(given["chi_square_per_freedom"].get<double>(), 1.,
                0.5);  // five standard deviations, sqrt(2 / 198) each
  }
  EXPECT_GE(covered_a, 33);
  EXPECT_GE(covered_d, 33);
  EXPECT_GE(known_a, 33);
  // No wider than they must be: d is known from the shape, so half of the samples' squared slope at least tells a.
  EXPECT_LT(width / pi, 0.1);
}

// Noise of 20 um: a given deviation of twice and half as much is just within what is let pass, as its estimate has 5 %.
TEST_F(FitTest, WarnsWhereWhatDiffersIsFarFromTheGivenNoise) {
  measure(7, 20e-6);
  const auto doubt = [&](const std::string& deviation) {
    const auto j = run("deviation = \"" + deviation + "\"\nunit = \"um\"\n", "with" + deviation);
    return j.value("noise_doubt", "");
  };
  for (const char* near : {"20 um", "12 um", "35 um"}) EXPECT_EQ(doubt(near), "") << near;
  EXPECT_NE(doubt("20 mm").find("the intervals are too wide"), std::string::npos);
  EXPECT_NE(doubt("60 um").find("times the given deviation only"), std::string::npos);
  EXPECT_NE(doubt("7 um").find("the intervals are too narrow"), std::string::npos);
  EXPECT_NE(doubt("20 nm").find("the intervals are too narrow"), std::string::npos);
}

TEST_F(FitTest, GivesTheSameBitsForAnyWorkersAndInterruptions) {
  measure(3, 20e-6);
  more_of_fit_ = "[fit]\nsearches = 2\n";
  run("", "one", 1);
  run("", "three", 3);
  EXPECT_EQ(bytes("three"), bytes("one"));
  std::atomic<int> left{0};
  int n_interruptions = 0;
  do {
    left = 7;
    stop_ = 0;
    run("", "broken", 2, [&](const PointRequest& request) {
      if (--left < 0) stop_ = 1;
      auto result = oscillation(request);
      result.is_interrupted = stop_ != 0;
      result.is_done = !result.is_interrupted;
      return result;
    });
  } while (!is_complete_ && ++n_interruptions < 100);
  EXPECT_GT(n_interruptions, 2);
  EXPECT_EQ(bytes("broken"), bytes("one"));
}

// Residuals are of the same instants in every drop: one that ends before the last of them is no drop of the fit.
TEST_F(FitTest, TakesADropThatEndsBeforeTheLastMeasuredValueAsFailed) {
  measure(1, 0.);
  const auto ends_early = [](const PointRequest& request) {
    PointResult result = oscillation(request);
    auto& orbit = result.series.front();
    orbit.time.resize(1501);
    orbit.values.resize(3002);
    return result;
  };
  try {
    run("", "early", 2, ends_early);
    FAIL() << "was fitted";
  } catch (const SolverError& error) {
    EXPECT_NE(std::string(error.what()).find("it ends at 0.015 s"), std::string::npos) << error.what();
  }
  const auto j = run("until = \"15 ms\"\n", "until", 2, ends_early);
  EXPECT_EQ(j["measured"][0]["n"], 151);
  // straight lines between samples, as in the first test
  EXPECT_NEAR(parameter(j, 0)["value"].get<double>() / pi, true_a, 2e-5);
}

TEST_F(FitTest, SaysWhatCannotBeFitted) {
  measure(1, 0.);
  const auto fault_of = [&](const std::string& more) -> std::string {
    try {
      run(more, "bad");
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_NE(fault_of("component = 2\n").find("has 2 columns"), std::string::npos);
  EXPECT_NE(fault_of("value = \"x\"\n").find("no column \"x\""), std::string::npos);
  EXPECT_NE(fault_of("from = \"1 s\"\n").find("3 are needed"), std::string::npos);
  more_of_fit_ = "[fit]\nevaluations = 5\n";
  EXPECT_NE(fault_of("").find("too few"), std::string::npos);
  more_of_fit_ = "[replicates]\nn = 2\n[fit]\n";
  EXPECT_NE(fault_of("").find("no replicates"), std::string::npos);
  more_of_fit_ = "[minimise]\nresult = \"a\"\n[fit]\n";
  EXPECT_NE(fault_of("").find("either [fit] or [minimise]"), std::string::npos);
  more_of_fit_ = "[fit]\n";
  std::ofstream(folder_.path() / "measured.csv") << "t [ms];y [N]\n0;1\n1;2\n2;3\n";
  EXPECT_NE(fault_of("").find("is in m, but the measured values"), std::string::npos);
  std::ofstream(folder_.path() / "measured.csv") << "t [ms];y [um]\n0;1\n1;2\n0.5;3\n3;4\n";
  EXPECT_NE(fault_of("").find("do not rise"), std::string::npos);
  std::ofstream(folder_.path() / "measured.csv") << "t [ms];y [um]\n0;5.3\n1;5.3\n2;5.3\n";
  EXPECT_NE(fault_of("").find("do not vary"), std::string::npos);
  EXPECT_NE(fault_of("").find("Give deviation"), std::string::npos);
  EXPECT_NO_THROW(
      folder_.read("[vary]\n\"rotor.unbalance[0].angle\" = { range = [0, 1] }\n[[fit.measured]]\n"
                   "file = \"measured.csv\"\nseries = \"/bearings/TB1/orbit\"\ndeviation = 1\n"));
  std::ofstream(folder_.path() / "measured.csv") << "t [ms];y [um]\n0;1\n1;x\n";
  EXPECT_NE(fault_of("").find("measured.csv:3"), std::string::npos);
}
