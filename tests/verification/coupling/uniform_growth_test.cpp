// Uniform heating of the meshed section of a bearing of one material: the growth of its surfaces is alpha T times radius or width, by volume
// means and by elasticity alike, and the pair's preload stays (tests/verification/preload/uniform_heating_test.cpp).
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/preload/build_preload.h"
#include "drops.h"
#include "study/preload/preload_tables.h"

namespace rotordrop {
namespace {

using namespace rotordrop::testing;

constexpr double ambient = 293.15, alpha = 11.8e-6;

TEST(UniformHeating, OfTheMeshedSectionLeavesThePreload) {
  for (const char* arrangement : {"X", "O"})
    for (const char* expansion : {"formula", "elastic"}) {
      auto drop = settling_drop({std::string("bearings.TB2.arrangement=") + arrangement,
                                 std::string("thermal.expansion=") + expansion, "thermal.models=[\"fe\"]",
                                 "thermal.fe.coupling=windowed", "thermal.fe.refinement=0.5", "bearings.TB1.ball=steel",
                                 "bearings.TB2.housing_fit=\"10 um\"", "bearings.TB1.housing_fit=\"10 um\""});
      ASSERT_EQ(drop->elements.sections.size(), 2u);
      const auto running = build_running_bearing(drop->settings.parameters, "TB2", 0., rest_finder("TB2"));
      for (auto& section : drop->elements.sections)
        for (const double T : {-50., 50., 150.}) {
          const std::vector<double> field(section.solver->field().size(), ambient + T);
          section.solver->set_field(field, 0., 0., 0.);
          std::vector<Expansion> found = {growth_of(section)};
          if (section.elastic) found.push_back(section.elastic->linear(field));
          const bool is_first = section.name == "TB1";
          // d_m / 2 -+ d / 2 cos phi; TB1 is a deep-groove bearing. Widths 20 and 2 x 16 mm.
          const double projected = is_first ? 5.953e-3 : 4.7625e-3 * 0.9063077870366499,
                       middle = is_first ? 45e-3 : 42.5e-3;
          const Expansion expected = {.shaft = 34.75e-3,
                                      .bore = 35e-3,
                                      .inner_race = middle - projected,
                                      .outer_race = middle + projected,
                                      .ball = is_first ? 5.953e-3 : 4.7625e-3,
                                      .inner_width = is_first ? 20e-3 : 32e-3,
                                      .outer_width = is_first ? 20e-3 : 32e-3};
          for (const auto& growth : found) {
            for (std::size_t s = 0; s < growth_surfaces.size(); ++s)
              EXPECT_NEAR(growth.*growth_surfaces[s], alpha * T * expected.*growth_surfaces[s],
                          1e-6 * alpha * 50. * 45e-3)
                  << "m, " << section.name << ", " << growth_surface_names[s] << ", " << expansion;
            if (is_first) continue;
            const double preload = running->at(growth).preload;
            printf("%s, %s, %+.0f K: %.6f N\n", arrangement, expansion, T, preload);
            EXPECT_NEAR(preload, 290., 290. * (std::fabs(T) > 100. ? 4e-3 : 1e-3)) << "N, " << expansion << " " << T;
          }
        }
    }
}

}  // namespace
}  // namespace rotordrop
