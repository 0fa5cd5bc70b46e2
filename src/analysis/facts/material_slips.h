#pragma once
#include <optional>
#include <string>
#include <vector>

namespace rotordrop {

/// What is known of a material, in SI.
struct MaterialFacts {
  double rho = 0;                             ///< density [kg/m3]
  std::optional<double> E;                    ///< Young's modulus [Pa]
  std::optional<double> k, c;                 ///< conductivity [W/(m K)], specific heat capacity [J/(kg K)]
  std::optional<double> nu = {}, alpha = {};  ///< Poisson's ratio [1], thermal expansion [1/K]
};

/// A value that does not go with the others of its material.
struct MaterialSlip {
  std::string key, message, advice;
};

/// Heat capacity by volume of solids lies between 1 and 4.5 MJ/(m3 K) (Dulong and Petit's rule: their atoms are about equally close), metals
/// conduct heat and sound: what is outside is a wrong unit or digit more often than a material.
/// @param name  of the material, for the messages
[[nodiscard]] std::vector<MaterialSlip> material_slips(const std::string& name, const MaterialFacts& material);

}  // namespace rotordrop
