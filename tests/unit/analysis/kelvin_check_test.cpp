#include "analysis/watch/kelvin_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "base/errors.h"

namespace rotordrop {
namespace {

const std::vector<Observable> observables = {
    {"/bearings/TB1/orbit", "m", "", 2, {}},
    {"/thermal/TB1/inner_ring", "K", "", 1, {}, Observed::inner_ring_temperature},
    {"/fe/TB1/bore", "K", "", 3, {"mean", "lowest", "highest"}, Observed::temperature},
    {"/bearings/TB1/rise", "K", "", 1, {}}};

TEST(KelvinCheck, LooksAtTemperaturesOfThermalModelsAndAtNothingElse) {
  KelvinCheck check(observables, 1);
  const std::vector<double> row = {-5., -1e-6, -1e-6, 300., 290., 280., 310., -7.};  // a rise may be negative
  EXPECT_NO_THROW(check.row(0.1, row));
}

TEST(KelvinCheck, NamesWhatIsNotAboveZero) {
  KelvinCheck check(observables, 1);
  for (const auto& [at, name] : {std::pair(3, "/thermal/TB1/inner_ring"), std::pair(5, "/fe/TB1/bore (lowest)")}) {
    for (const double T : {0., -20., std::numeric_limits<double>::quiet_NaN()}) {
      std::vector<double> row = {0., 0., 0., 300., 290., 280., 310., 5.};
      row[static_cast<std::size_t>(at)] = T;
      try {
        check.row(0.25, row);
        ADD_FAILURE() << name << " at " << T << " K passes";
      } catch (const SolverError& error) {
        const std::string message = error.what();
        const std::string told = std::isnan(T) ? "the temperature of " + std::string(name) + " is not a number at"
                                               : std::string(name) + " is cooled below 0 K at";
        EXPECT_NE(message.find(told + " t = 0.25 s"), std::string::npos) << message;
      }
    }
  }
}

}  // namespace
}  // namespace rotordrop
