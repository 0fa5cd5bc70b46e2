#include "study/many/study_keys.h"

namespace rotordrop {

namespace {

Section<DesignParameters> design_section() {
  using P = DesignParameters;
  Section<P> s("design", "Which points are computed.");
  s.choice(
       "kind", &P::kind,
       {{"grid", DesignKind::grid},
        {"list", DesignKind::list},
        {"one-at-a-time", DesignKind::one_at_a_time},
        {"latin-hypercube", DesignKind::latin_hypercube},
        {"sobol-sequence", DesignKind::sobol_sequence},
        {"saltelli", DesignKind::saltelli},
        {"morris", DesignKind::morris},
        {"monte-carlo", DesignKind::monte_carlo}},
       {.fallback = "latin-hypercube",
        .help = "grid: every combination. list: the first values of all parameters, then the second ones, and so on. "
                "one-at-a-time: a reference point, and each parameter's values with the others at the reference. "
                "latin-hypercube, sobol-sequence, monte-carlo: samples of the distributions. saltelli: for Sobol "
                "indices. morris: trajectories for a screening."})
      .integer(
          "size", &P::size,
          {.range = between(1, 10'000'000),
           .help = "Points of latin-hypercube, sobol-sequence and monte-carlo; rows of each of Saltelli's two "
                   "samples (with d parameters d + 2 times as many points); trajectories of Morris (d + 1 times as "
                   "many points)."})
      .integer(
          "seed", &P::seed,
          {.range = between(0, 2147483647), .fallback = 1, .help = "The same seed gives the same points anywhere."})
      .integer(
          "levels", &P::levels,
          {.range = between(2, 100000),
           .help = "Levels of parameters without values of their own in a grid or one-at-a-time (5), and of the grid "
                   "of Morris (4; an even number). The levels of a list are its values."})
      .boolean("scramble", &P::scramble,
               {.fallback = true,
                .help = "Of sobol-sequence and saltelli: a random digital shift that follows from the seed. Without it "
                        "the points are the published sequence, which begins with the middle of all ranges."});
  return s;
}

}  // namespace

Section<StudyFile> study_section() {
  using P = StudyFile;
  Section<ReplicateParameters> replicates("replicates", "Starts next to each other: what chaos leaves of a number.");
  replicates
      .integer("n", &ReplicateParameters::n,
               {.range = between(1, 100000), .fallback = 1, .help = "Drops of each point of the design."})
      .quantity(
          "spread", &ReplicateParameters::spread,
          {.unit = "m",
           .range = positive(),
           .fallback = "1 nm",
           .help = "Each replicate starts by this much higher than the one before it (rotor.initial_offset[0])."});
  Section<CorrelationEntry> correlation("correlation", "Dependence of two parameters.");
  correlation
      .custom("parameters", {.accepts = "two names of [vary]", .json_types = {"array"}, .required = true},
              [](const Node& node, CorrelationEntry& entry, Faults&) { entry.parameters = node; })
      .quantity("rank", &CorrelationEntry::rank,
                {.range = between(-1, 1), .help = "Rank correlation (Spearman), through a normal copula."});
  Section<ChoiceEntry> choice("choose", "Which level of a parameter makes a quantile of a result smallest.");
  choice.text("parameter", &ChoiceEntry::parameter, {.help = "A parameter with values, by its name in [vary]."})
      .text("result", &ChoiceEntry::result, {.help = "A result."})
      .quantity(
          "quantile", &ChoiceEntry::quantile,
          {.range = between(0.01, 0.999), .fallback = "0.95", .help = "Of the result over all else that varies."});
  Section<KeepEntry> keep("keep", "What of each drop is kept.");
  keep.custom("results",
              {.accepts = "names of results; * stands for any text without a dot",
               .json_types = {"array"},
               .help = "Numbers of summary.json; all if left out."},
              [](const Node& node, KeepEntry& entry, Faults&) { entry.results = node; })
      .custom("series",
              {.accepts = "paths of datasets of results.h5",
               .json_types = {"array"},
               .help = "Time series, each with its own times; none if left out."},
              [](const Node& node, KeepEntry& entry, Faults&) { entry.series = node; });

  Section<P> s("", "A study: many drops of one case.");
  s.text("case", &P::case_file, {.help = "The case, beside this file or of those that come with the program."})
      .choice("on_failure", &P::on_failure,
              {{"go on", FailurePolicy::go_on}, {"stop", FailurePolicy::stop}, {"retry", FailurePolicy::retry}},
              {.fallback = "go on",
               .help = "What follows a drop that fails. go on: its reason is recorded. stop: no further drop is begun. "
                       "retry: once more with a tenth of integration.tolerance and integration.step, then go on."})
      .boolean(
          "lanes", &P::lanes,
          {.help =
               "Drops that differ in numbers alone run eight side by side in the lanes of vectors, with AVX-512 "
               "about twice as many per second, if the first point's drop can; others (docs/how-to/studies.md) "
               "run one by one. In lanes a drop is, within what rounding does to it, what `rotordrop run` makes of the "
               "point; false: the same bits. true: a note tells why, if drops do not run in lanes."})
      .custom(
          "vary",
          {.accepts = "keys of the case, each with values or a distribution",
           .json_types = {"object"},
           .required = true,
           .help = "KEY = [values], or a table with range = [from, to] (scale = \"log\" evenly in the logarithm), "
                   "distribution = \"uniform\" | \"log-uniform\" | \"normal\" | \"truncated-normal\" | "
                   "\"triangular\" | \"discrete\" with lower, upper, mean, deviation, mode, values, weights, or "
                   "formula = \"2 * OTHER\". keys = [KEY, ...] sets one value into several keys of the case; the table "
                   "may then have any name."},
          [](const Node& node, P& p, Faults&) { p.vary = node; })
      .table<DesignParameters>("design", &P::design, design_section())
      .table<ReplicateParameters>("replicates", &P::replicates, replicates)
      .list("correlation", &P::correlations, correlation,
            {.help = "Of latin-hypercube, sobol-sequence and monte-carlo."})
      .custom("limits",
              {.accepts = "results, each with max or min",
               .json_types = {"object"},
               .help = "RESULT = { max = \"6 kN\" }, { min = 1 } or both: the study tells how often it is broken."},
              [](const Node& node, P& p, Faults&) { p.limits = node; })
      .custom("derived",
              {.accepts = "names, each with a formula",
               .json_types = {"object"},
               .help = "NAME = { formula = \"max(RESULT, RESULT)\", unit = \"N\" }: further results from those of each "
                       "drop, in SI."},
              [](const Node& node, P& p, Faults&) { p.derived = node; })
      .table<ChoiceEntry>("choose", &P::choice, choice)
      .table<MinimiseParameters>("minimise", &P::minimise, minimise_section())
      .table<FitParameters>("fit", &P::fit, fit_section())
      .table<SurrogateParameters>("surrogate", &P::surrogate, surrogate_section())
      .table<KeepEntry>("keep", &P::keep, keep);
  return s;
}

}  // namespace rotordrop
