#include "study/many/search/fit_keys.h"

namespace rotordrop {

Section<FitParameters> fit_section() {
  using P = FitParameters;
  Section<P> s(
      "fit", "Values of all parameters with a range at which the drop shows what was measured, with their confidence.");
  s.list("measured", &P::measured, measured_section(),
         {.help = "[[fit.measured]]: one table for each measured quantity."})
      .integer("evaluations", &P::evaluations,
               {.range = between(3, 100000),
                .fallback = 200,
                .help = "Drops of each search, at most; two more for each parameter give the confidence."})
      .integer("searches", &P::searches,
               {.range = between(1, 1000),
                .fallback = 1,
                .help = "The first one starts at the reference (or the case's value, or the middle of the range), the "
                        "others at points of a Latin hypercube: a check against false minima."})
      .quantity(
          "difference", &P::difference,
          {.range = between(1e-9, 0.1), .fallback = "1e-3", .help = "Step of the derivatives, as part of each range."})
      .quantity("tolerance", &P::tolerance,
                {.range = between(1e-12, 0.1),
                 .fallback = "1e-5",
                 .help = "A search ends when its steps are smaller than this part of each range."});
  return s;
}

}  // namespace rotordrop
