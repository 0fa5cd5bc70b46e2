#pragma once
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "model/observable.h"
#include "model/ports.h"
#include "model/thermo_elasticity.h"
#include "thermal/heating/bearing_heat.h"
#include "thermal/section/fit_opening.h"

namespace rotordrop {

/// What elasticity needs to know of a bearing beyond its heat problem.
struct BearingElasticData {
  struct Material {
    double E = 0, nu = 0, density = 0, expansion = 0;  ///< [Pa], [-], [kg/m^3], [1/K]
  };
  Material ring;                    ///< of rings and housing
  Material shaft;                   ///< of a meshed shaft, under the bearing and beside it
  double housing_interference = 0;  ///< by radius [m]
  FitKind housing_fit = FitKind::frictionless;
};

/// Pressures below this are none: roundoff of a fit without interference [Pa].
inline constexpr double no_pressure = 1e3;
/// What models report of the fit: mean pressure and lowest one of a node, and the part of the area that pulls (where the fit is taken as closed) or is open.
std::vector<Observable> housing_fit_observables(const std::string& path, const std::string& bearing);

/// Long name of growth by elasticity where the formula is fed back.
inline constexpr const char* judged_growth_name =
    "thermal growth by elasticity of the section; fed back is the formula's";
/// What every row of balls feels of the growth by elasticity.
Observable row_growth_observable(const std::string& path, std::size_t n_rows);

/// The section of bearing_heat_problem() as elastic bodies: outer ring in its housing, inner ring (turning) and shaft free.
/// @param mesh  that of the heat solver
ElasticProblem bearing_elastic_problem(const HeatConductionProblem& heat, const SectionMesh& mesh,
                                       const BearingElasticData& data);

/// Growth of the surfaces that clearances and ball loads see, as functionals of all unknowns of the heat problem, over the joined, cold and standing
/// state. A raceway's radial growth is the mean of its strips' radial displacement, as a hoop strain brought from the strip's mean radius to the contact
/// points'. The growth of a ring's width is the slope of the strips' axial displacements over their positions, times the width; with fewer than two
/// rows of strips, of the ring's end faces. A strip's mean radius and position are what a uniform rise of all bodies moves, which expand alike.
class ElasticGrowth {
 public:
  /// @param elastic  of bearing_elastic_problem(), whose last solve was at rest; must outlive this
  /// @param formula  of the lump of shaft, if it is not meshed, and of the balls
  /// @param races    contact points and width
  ElasticGrowth(ElasticSolver& elastic, const ElasticProblem& problem, const HeatConductionProblem& heat,
                const GrowthPerRise& formula, const RaceSurfaces& races, std::size_t n_unknowns);

  /// Weights of each surface [growth_surfaces.size()][n_unknowns], while the fits stay closed.
  [[nodiscard]] const std::array<std::vector<double>, growth_surfaces.size()>& weights() const { return weights_; }
  [[nodiscard]] Expansion linear(std::span<const double> temperatures) const;

  /// Where the strips of a row lie along the axis, from the bearing's middle [m].
  struct RowStrips {
    double inner = 0, outer = 0;
  };
  /// What the inner contact point of a row moves more than its outer one, as weights [n_unknowns].
  struct RowWeights {
    std::vector<double> radial, axial;
  };
  /// Each row by itself, while the fits stay closed; none if the section has not one strip for each row on each ring. Axial displacements count
  /// from where a ring's middle is.
  /// @param rows  in the order of the strips
  [[nodiscard]] std::vector<RowWeights> row_weights(std::span<const RowStrips> rows) const;
  /// With the fits as they must be: by the functionals and what openings add, or by a solve where the solver knows no openings.
  [[nodiscard]] Expansion solved(std::span<const double> temperatures);
  /// Growth of the inner ring's surfaces per speed squared [m s^2]; the others' is zero.
  [[nodiscard]] const Expansion& per_speed_squared() const { return per_speed_squared_; }

  /// Pressure of the fit's nodes, while it stays closed.
  struct FitNodes {
    std::vector<ElasticInfluence> node;  ///< their weights as long as the heat problem's unknowns
    std::vector<double> share;           ///< of the fit's area
    ElasticInfluence mean;
  };
  [[nodiscard]] const FitNodes& housing_fit() const { return housing_fit_; }
  /// After solved().
  [[nodiscard]] FitState fit_state() const { return opening_ ? opening_->state() : elastic_.fit(0); }

 private:
  /// A sum of outputs of the elastic problem.
  struct Sum {
    struct Term {
      std::size_t output;
      double factor;
    };
    std::vector<Term> terms;
    double at_rest = 0;
  };
  [[nodiscard]] std::vector<Sum::Term> row_difference_terms() const;
  /// Asks the solver, once.
  void find_openings();

  ElasticSolver& elastic_;
  double zero_;
  std::array<Sum, growth_surfaces.size()> sums_;
  std::array<std::vector<double>, growth_surfaces.size()> weights_;
  struct Strips {
    std::vector<std::vector<double>> radial;  ///< each at the contact points' radius
    std::vector<std::vector<double>> axial;   ///< fewer than two: the ring's end faces
    std::vector<double> width;                ///< of the ring's width
  };
  std::array<Strips, 2> strips_;  ///< inner and outer
  double width_;
  Expansion per_speed_squared_;
  FitNodes housing_fit_;
  std::optional<FitOpening> opening_;
  bool has_asked_ = false;
  std::vector<double> pressures_, sizes_;  ///< of the fit's nodes if it stays closed, and of what adds up to them
  std::vector<double> per_rise_;           ///< of that, at most, per kelvin of the largest rise
};

}  // namespace rotordrop
