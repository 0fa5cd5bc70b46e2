#include "study/many/surrogate/surrogate_keys.h"

namespace rotordrop {

Section<SurrogateParameters> surrogate_section() {
  using P = SurrogateParameters;
  Section<P> s("surrogate", "Functions of the parameters that stand for results, made from the points of a sample.");
  s.custom("results",
           {.accepts = "names of results",
            .json_types = {"array"},
            .required = true,
            .help = "Results for which a surrogate is made; OpenTURNS does it, in a module of its own."},
           [](const Node& node, P& p, Faults&) { p.results = node; })
      .choice("kind", &P::kind,
              {{"polynomial-chaos", SurrogateKind::polynomial_chaos}, {"kriging", SurrogateKind::kriging}},
              {.fallback = "polynomial-chaos",
               .help = "polynomial-chaos: sparse Legendre polynomials (least angles, corrected leave-one-out), with "
                       "their Sobol indices. kriging: Matern's covariance 5/2, for up to 1000 points."})
      .integer(
          "degree", &P::degree,
          {.range = between(1, 20),
           .fallback = 6,
           .help = "Of the polynomials, at most: the degree with the least leave-one-out error is taken, and none with "
                   "more than 2000 terms to choose from, or with points times terms squared beyond 1e9."})
      .integer(
          "folds", &P::folds,
          {.range = between(2, 50),
           .fallback = 5,
           .help = "Parts of the points for the validation: each is predicted by a surrogate made from the others."});
  return s;
}

}  // namespace rotordrop
