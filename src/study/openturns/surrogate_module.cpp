// The module that is loaded for [surrogate]: the only file that sees OpenTURNS.
#include <cmath>
#include <limits>
#include <openturns/BasisSequenceFactory.hxx>
#include <openturns/ComposedDistribution.hxx>
#include <openturns/ConstantBasisFactory.hxx>
#include <openturns/CorrectedLeaveOneOut.hxx>
#include <openturns/FixedStrategy.hxx>
#include <openturns/FunctionalChaosAlgorithm.hxx>
#include <openturns/FunctionalChaosSobolIndices.hxx>
#include <openturns/KrigingAlgorithm.hxx>
#include <openturns/LARS.hxx>
#include <openturns/LeastSquaresMetaModelSelectionFactory.hxx>
#include <openturns/LeastSquaresStrategy.hxx>
#include <openturns/LegendreFactory.hxx>
#include <openturns/LinearEnumerateFunction.hxx>
#include <openturns/Log.hxx>
#include <openturns/MaternModel.hxx>
#include <openturns/OrthogonalProductPolynomialFactory.hxx>
#include <openturns/RandomGenerator.hxx>
#include <openturns/Uniform.hxx>
#include <optional>

#include "study/many/surrogate/surrogate.h"

namespace {

using namespace OT;
constexpr UnsignedInteger most_terms = 2000;

Sample sample_of(const std::vector<double>& values, std::size_t width) {
  Sample sample(values.size() / width, width);
  for (std::size_t i = 0; i < values.size(); ++i) sample(i / width, i % width) = values[i];
  return sample;
}

class OpenTurnsSurrogate final : public rotordrop::Surrogate {
 public:
  explicit OpenTurnsSurrogate(const rotordrop::SurrogateProblem& p) : n_inputs_(p.n_inputs) {
    Log::Show(Log::NONE);
    RandomGenerator::SetSeed(1);
    const Sample x = sample_of(p.x, p.n_inputs), y = sample_of(p.y, 1);
    if (p.is_kriging) {
      KrigingAlgorithm kriging(x, y, MaternModel(Point(p.n_inputs, 0.5), Point(1, 1.), 2.5),
                               ConstantBasisFactory(p.n_inputs).build());
      kriging.run();
      function_ = kriging.getResult().getMetaModel();
      return;
    }
    const ComposedDistribution inputs(ComposedDistribution::DistributionCollection(p.n_inputs, Uniform(0., 1.)));
    const LinearEnumerateFunction enumerate(p.n_inputs);
    const OrthogonalProductPolynomialFactory basis(
        OrthogonalProductPolynomialFactory::PolynomialFamilyCollection(p.n_inputs, LegendreFactory()), enumerate);
    UnsignedInteger degree = p.degree;
    while (degree > 1 && enumerate.getStrataCumulatedCardinal(degree) > most_terms) --degree;
    const AdaptiveStrategy terms(FixedStrategy(basis, enumerate.getStrataCumulatedCardinal(degree)));
    const LeastSquaresMetaModelSelectionFactory least_angles{BasisSequenceFactory(LARS()),
                                                             FittingAlgorithm(CorrectedLeaveOneOut())};
    FunctionalChaosAlgorithm chaos(x, y, inputs, terms, ProjectionStrategy(LeastSquaresStrategy(x, y, least_angles)));
    chaos.run();
    const FunctionalChaosResult result = chaos.getResult();
    function_ = result.getMetaModel();
    n_terms_ = result.getCoefficients().getSize();
    if (n_terms_ > 1) indices_.emplace(result);
  }
  [[nodiscard]] std::vector<double> at(const std::vector<double>& x) const override {
    const Sample y = function_(sample_of(x, n_inputs_));
    std::vector<double> values(y.getSize());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = y(i, 0);
    return values;
  }
  [[nodiscard]] std::size_t n_terms() const override { return n_terms_; }
  [[nodiscard]] double first_index(std::size_t input) const override {
    return indices_ ? indices_->getSobolIndex(input) : std::numeric_limits<double>::quiet_NaN();
  }
  [[nodiscard]] double total_index(std::size_t input) const override {
    return indices_ ? indices_->getSobolTotalIndex(input) : std::numeric_limits<double>::quiet_NaN();
  }

 private:
  std::size_t n_inputs_, n_terms_ = 0;
  Function function_;
  std::optional<FunctionalChaosSobolIndices> indices_;
};

}  // namespace

extern "C" rotordrop::Surrogate* rotordrop_make_surrogate(const rotordrop::SurrogateProblem& problem,
                                                          std::string& error) {
  try {
    return new OpenTurnsSurrogate(problem);
  } catch (const std::exception& failed) {
    error = failed.what();
    return nullptr;
  }
}
