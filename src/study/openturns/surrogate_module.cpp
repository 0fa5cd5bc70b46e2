// The module that is loaded for [surrogate]: the only file that sees OpenTURNS.
#include <algorithm>
#include <cmath>
#include <limits>
#include <openturns/BasisSequenceFactory.hxx>
#include <openturns/ComposedDistribution.hxx>
#include <openturns/ConstantBasisFactory.hxx>
#include <openturns/CorrectedLeaveOneOut.hxx>
#include <openturns/FixedStrategy.hxx>
#include <openturns/FunctionalChaosAlgorithm.hxx>
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
#include <openturns/TBBImplementation.hxx>
#include <openturns/Uniform.hxx>
#include <vector>

#include "study/many/surrogate/surrogate.h"

namespace {

using namespace OT;
constexpr UnsignedInteger most_terms = 2000;
constexpr double most_work = 1e9;   // points times the square of terms: some seconds
constexpr double roundoff = 1e-20;  // of a relative error, which is a square

Sample sample_of(const std::vector<double>& values, std::size_t width) {
  Sample sample(values.size() / width, width);
  for (std::size_t i = 0; i < values.size(); ++i) sample(i / width, i % width) = values[i];
  return sample;
}

/// Values about their mean, and how large they are: what is made must not depend on the unit.
struct Scaled {
  double mean = 0, size = 0;
  Sample y;
  explicit Scaled(const std::vector<double>& values) : y(values.size(), 1) {
    const auto n = static_cast<double>(values.size());
    for (const double value : values) mean += value / n;
    for (const double value : values) size = std::max(size, std::fabs(value - mean));
    if (!(size > 0.)) size = 1.;
    for (std::size_t i = 0; i < values.size(); ++i) y(i, 0) = (values[i] - mean) / size;
  }
};

class OpenTurnsSurrogate final : public rotordrop::Surrogate {
 public:
  explicit OpenTurnsSurrogate(const rotordrop::SurrogateProblem& p) : n_inputs_(p.n_inputs), scaled_(p.y) {
    Log::Show(Log::NONE);
    TBBImplementation::Disable();  // a study says how many cores it takes
    RandomGenerator::SetSeed(1);
    const Sample x = sample_of(p.x, p.n_inputs);
    if (p.is_kriging) {
      KrigingAlgorithm kriging(x, scaled_.y, MaternModel(Point(p.n_inputs, 0.5), Point(1, 1.), 2.5),
                               ConstantBasisFactory(p.n_inputs).build());
      kriging.run();
      function_ = kriging.getResult().getMetaModel();
      return;
    }
    const LinearEnumerateFunction enumerate(p.n_inputs);
    const FunctionalChaosResult result = best_chaos(x, enumerate, p.degree);
    function_ = result.getMetaModel();
    n_terms_ = result.getCoefficients().getSize();
    find_indices(result, enumerate);
  }
  [[nodiscard]] std::vector<double> at(const std::vector<double>& x) const override {
    const Sample y = function_(sample_of(x, n_inputs_));
    std::vector<double> values(y.getSize());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = scaled_.mean + scaled_.size * y(i, 0);
    return values;
  }
  [[nodiscard]] std::size_t n_terms() const override { return n_terms_; }
  [[nodiscard]] double first_index(std::size_t input) const override { return first_.empty() ? nan : first_[input]; }
  [[nodiscard]] double total_index(std::size_t input) const override { return total_.empty() ? nan : total_[input]; }

 private:
  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();

  /// Of degrees from 1 on the one with the least leave-one-out error: many terms to choose from mislead where there are few points. Where that is
  /// below a half already, two degrees that are no better end the search.
  [[nodiscard]] FunctionalChaosResult best_chaos(const Sample& x, const LinearEnumerateFunction& enumerate,
                                                 std::size_t highest) const {
    const ComposedDistribution inputs(ComposedDistribution::DistributionCollection(n_inputs_, Uniform(0., 1.)));
    const OrthogonalProductPolynomialFactory basis(
        OrthogonalProductPolynomialFactory::PolynomialFamilyCollection(n_inputs_, LegendreFactory()), enumerate);
    const LeastSquaresMetaModelSelectionFactory least_angles{BasisSequenceFactory(LARS()),
                                                             FittingAlgorithm(CorrectedLeaveOneOut())};
    FunctionalChaosResult best;
    double least = std::numeric_limits<double>::infinity();
    std::size_t best_degree = 1;
    for (std::size_t degree = 1; degree <= highest; ++degree) {
      const UnsignedInteger n = enumerate.getStrataCumulatedCardinal(degree);
      const double work = static_cast<double>(x.getSize()) * static_cast<double>(n) * static_cast<double>(n);
      if (degree > 1 && (n > most_terms || work > most_work || (least < 0.5 && degree > best_degree + 2))) break;
      FunctionalChaosAlgorithm chaos(x, scaled_.y, inputs, AdaptiveStrategy(FixedStrategy(basis, n)),
                                     ProjectionStrategy(LeastSquaresStrategy(x, scaled_.y, least_angles)));
      chaos.run();
      const FunctionalChaosResult found = chaos.getResult();
      const double error = found.getRelativeErrors()[0];
      if (degree > 1 && !(error < least) && std::isfinite(least)) continue;
      best = found;
      best_degree = degree;
      least = error;
      if (error < roundoff) break;
    }
    return best;
  }
  /// The terms are orthonormal: their squares are their variances (Sudret 2008). Which of them is the constant, if any is, the search has left open.
  void find_indices(const FunctionalChaosResult& result, const LinearEnumerateFunction& enumerate) {
    const Indices terms = result.getIndices();
    const Sample coefficients = result.getCoefficients();
    std::vector<double> first(n_inputs_), total(n_inputs_);
    double variance = 0.;
    for (std::size_t k = 0; k < n_terms_; ++k) {
      const Indices powers = enumerate(terms[k]);
      const double square = coefficients(k, 0) * coefficients(k, 0);
      const auto acts = [&](std::size_t input) { return powers[input] > 0; };
      std::size_t n_acting = 0;
      for (std::size_t i = 0; i < n_inputs_; ++i) n_acting += acts(i);
      if (n_acting > 0) variance += square;
      for (std::size_t i = 0; i < n_inputs_; ++i) {
        if (!acts(i)) continue;
        total[i] += square;
        if (n_acting == 1) first[i] += square;
      }
    }
    if (!(variance > 0.)) return;
    for (auto* list : {&first, &total})
      for (double& value : *list) value /= variance;
    first_ = std::move(first);
    total_ = std::move(total);
  }

  std::size_t n_inputs_, n_terms_ = 0;
  Scaled scaled_;
  Function function_;
  std::vector<double> first_, total_;  // empty: it has none
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
