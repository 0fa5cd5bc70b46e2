#include "study/many/search/minimise_keys.h"

namespace rotordrop {

std::string name_of(MinimiseMethod method) {
  static const char* const names[] = {"cobyla", "bobyqa", "subplex", "crs", "isres", "direct"};
  return names[static_cast<std::size_t>(method)];
}

bool takes_limits(MinimiseMethod method) { return method == MinimiseMethod::cobyla || method == MinimiseMethod::isres; }

bool takes_start(MinimiseMethod method) { return method != MinimiseMethod::direct; }

Section<MinimiseParameters> minimise_section() {
  using P = MinimiseParameters;
  Section<P> s("minimise", "Which values of some parameters make a result smallest, with the [limits] kept.");
  s.text("result", &P::result, {.help = "The result that becomes small; a derived one may change its sign."})
      .choice("of", &P::of, {{"mean", DropStatistic::mean}, {"quantile", DropStatistic::quantile}},
              {.fallback = "mean",
               .help = "What is taken of the drops of one evaluation, for the result and for the limited ones: their "
                       "mean, or a quantile. An evaluation has one drop for each replicate and for each row of "
                       "[design], if there are parameters that are not searched."})
      .quantity("quantile", &P::quantile,
                {.range = between(0.01, 0.999),
                 .fallback = "0.95",
                 .help = "Of of = \"quantile\". For a limit that is a minimum it counts from the other end."})
      .custom(
          "over",
          {.accepts = "names of [vary], each with a range",
           .json_types = {"array"},
           .help = "Parameters that are searched; all with a range if left out. The others are sampled by [design], "
                   "the same sample in every evaluation."},
          [](const Node& node, P& p, Faults&) { p.over = node; })
      .choice("method", &P::method,
              {{"cobyla", MinimiseMethod::cobyla},
               {"bobyqa", MinimiseMethod::bobyqa},
               {"subplex", MinimiseMethod::subplex},
               {"crs", MinimiseMethod::crs},
               {"isres", MinimiseMethod::isres},
               {"direct", MinimiseMethod::direct}},
              {.fallback = "cobyla",
               .help = "Of NLopt, without derivatives. Local: cobyla (linear models, takes limits), bobyqa (quadratic "
                       "models, for smooth results), subplex (simplices, for rough ones). Global: crs (random search), "
                       "isres (evolution, takes limits), direct (divides the box, from its middle on, wherever the "
                       "reference is)."})
      .integer("evaluations", &P::evaluations,
               {.range = between(1, 100000), .fallback = 100, .help = "At most, of each search."})
      .integer(
          "searches", &P::searches,
          {.range = between(1, 1000),
           .fallback = 1,
           .help = "The first one starts at the reference (or the case's value, or the middle of the range), the "
                   "others at points of a Latin hypercube. They run at the same time. Of method = \"direct\", which "
                   "starts in the middle of the ranges, there is one search only."})
      .quantity("first_step", &P::first_step,
                {.range = between(1e-6, 1), .fallback = "0.2", .help = "Part of each range."})
      .quantity("tolerance", &P::tolerance,
                {.range = between(1e-9, 1),
                 .fallback = "1e-3",
                 .help = "A search ends when its steps are smaller than this part of each range."});
  return s;
}

}  // namespace rotordrop
