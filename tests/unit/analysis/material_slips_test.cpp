#include "analysis/facts/material_slips.h"

#include <gtest/gtest.h>

namespace rotordrop {
namespace {

struct Known {
  const char* name;
  MaterialFacts facts;
};

// Textbook values (density, Young's modulus, conductivity, heat capacity at room temperature; Incropera & DeWitt, table A.1, and makers' sheets).
TEST(MaterialSlips, AreNotFoundInMaterialsOfMachines) {
  for (const auto& [name, m] : {Known{"plain steel", {7850, 2.1e11, 50, 460}},
                                {"stainless steel", {7900, 1.93e11, 14.9, 477}},
                                {"Inconel X-750", {8510, 2.14e11, 11.7, 439}},
                                {"bronze", {8800, 1.1e11, 52, 420}},
                                {"copper", {8933, 1.2e11, 401, 385}},
                                {"aluminium", {2702, 7e10, 237, 903}},
                                {"titanium", {4500, 1.16e11, 21.9, 522}},
                                {"tungsten", {19300, 4.0e11, 174, 132}},
                                {"silicon nitride", {3200, 3.1e11, 30, 690}},
                                {"zirconia", {6050, 2.0e11, 2.5, 450}},
                                {"PEEK", {1320, 3.6e9, 0.25, 1340}},
                                {"carbon fibre", {1600, 1.4e11, 5, 900}},
                                {"magnesium", {1740, 4.5e10, 156, 1024, 0.29, 26e-6}},
                                {"Invar", {8050, 1.48e11, 10.2, 515, 0.29, 1.2e-6}},
                                {"glass", {2500.1, 7e10, 1.4, 750, 0.22, 9e-6}},
                                {"a limit case", {7850, 2.1e11, 50, 460, 0., 0.}}})
    EXPECT_TRUE(material_slips(name, m).empty()) << name;
}

TEST(MaterialSlips, AreFoundInSteelWithAWrongDigitOrUnit) {
  const auto key = [](const MaterialFacts& m) {
    const auto found = material_slips("steel", m);
    return found.size() == 1 ? found.front().key : "";
  };
  EXPECT_EQ(key({785, 2.1e11, 50, 460}), "c");    // a lost digit
  EXPECT_EQ(key({7850, 2.1e11, 50, 0.46}), "c");  // kJ
  EXPECT_EQ(key({7850, 2.1e11, 0.5, 460}), "k");  // W/(cm K)
  EXPECT_EQ(key({7850, 2.1e10, 50, 460}), "E");   // a lost digit
  EXPECT_EQ(key({7850, {}, {}, {}}), "");         // nothing else is known
  EXPECT_EQ(key({7850, 2.1e11, 50, 460, 0.003, 11e-6}), "nu");
  EXPECT_EQ(key({7850, 2.1e11, 50, 460, 0.3, 11e-9}), "alpha");  // per mK
  EXPECT_EQ(key({3200, 3.1e9, 30, 690}), "E");
  EXPECT_EQ(key({3200, 3.1e11, 0.3, 690}), "k");  // W/(cm K)
}

}  // namespace
}  // namespace rotordrop
