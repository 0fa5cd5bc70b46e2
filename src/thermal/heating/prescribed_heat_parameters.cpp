#include "thermal/heating/prescribed_heat_parameters.h"

#include <algorithm>
#include <functional>

#include "thermal/heating/result_name.h"

namespace rotordrop {
namespace {

bool takes_rub_heat(SourcePort port) { return port == SourcePort::rub || port == SourcePort::all; }

/// Which of three ways says what flows, and whether it is said completely.
void check_source_form(const HeatSourceParameters& p, const Node& table, const std::string& path, Faults& faults) {
  const bool has_steps = table.has("times") || table.has("values");
  const int n_ways = int{has_steps} + int{p.pulse.has_value()} + int{p.recorded.has_value()};
  if (n_ways != 1)
    faults.add(table.where(),
               path + (n_ways == 0 ? " does not define the heat." : " defines the heat in more than one way."),
               "Give one of: times and values; pulse = { height, width, ... }; recorded.");
  if (has_steps && (p.times.empty() || p.values.empty()))
    faults.add(table.where(), path + " needs times and values, at least one of each.");
  if (p.times.size() != p.values.size())
    faults.add(
        position_of_value(table, "values"),
        path + " has " + std::to_string(p.times.size()) + " times and " + std::to_string(p.values.size()) + " values.",
        "Give one value for every time.");
  if (!std::is_sorted(p.times.begin(), p.times.end(), std::less_equal<>()))
    faults.add(position_of_value(table, "times"), path + ".times must increase.");
  for (const char* key : {"bearing", "interval"})
    if (!p.recorded && table.has(key))
      faults.add(position_of(table, key), path + "." + key + " belongs to a recorded heat.",
                 "Name its file: recorded = \"out/CASE/results.h5\".");
  if (!has_steps && table.has("interpolation"))
    faults.add(position_of(table, "interpolation"), path + ".interpolation belongs to times and values.");
  if (p.port == SourcePort::all && !p.recorded)
    faults.add(position_of_value(table, "port"), path + ".port = \"all\" is for heat that a drop recorded.",
               "Name its file: recorded = \"out/CASE/results.h5\"; or take a source for each port.");
  if (p.share && !takes_rub_heat(p.port))
    faults.add(position_of(table, "share"), path + ".share divides rub heat into ring and shaft.",
               "Leave it out, or take port = \"rub\".");
}

Section<HeatSourceParameters> source_section() {
  using P = HeatSourceParameters;
  Section<P> s(
      "source",
      "Heat into a port of the bearing: over time (times and values), as pulses, or as an earlier drop recorded "
      "it. Several sources add up.");
  s.choice("port", &P::port,
           {{"rub", SourcePort::rub},
            {"rub-into-ring", SourcePort::rub_into_ring},
            {"rub-into-shaft", SourcePort::rub_into_shaft},
            {"inner", SourcePort::inner},
            {"outer", SourcePort::outer},
            {"all", SourcePort::all}},
           {.help = "Place where the heat enters. rub: rub heat, divided by `share`; rub-into-ring, rub-into-shaft: "
                    "only its part into the ring's bore or the shaft; inner, outer: friction at that raceway; all: all "
                    "of these, for recorded heat."});
  s.quantities(
      "times", &P::times,
      {.unit = "s", .range = at_least(0), .help = "Times in increasing order. No heat flows before the first."});
  s.quantities("values", &P::values,
               {.unit = "W", .help = "Heat rate from each of the times on; the last value is held."});
  s.choice(
      "interpolation", &P::interpolation, {"steps", "linear"},
      {.help = "Heat rate between two of the times. steps (the default): values[i] until the next time; or linear."});
  s.table<HeatPulseParameters>("pulse", &P::pulse, pulse_section("W"));
  s.text("recorded", &P::recorded,
         {.help = "results.h5 of an earlier drop whose heat is used row by row; a path relative to this file."});
  s.text("bearing", &P::bearing, {.help = "Bearing whose recorded heat is used; heat.bearing if omitted."});
  s.quantity("share", &P::share,
             {.range = between(0, 1),
              .help = "Share of the rub heat that enters the ring. Default: thermal.share_to_ring or, for recorded "
                      "heat, the partition of that drop."});
  s.quantity("interval", &P::interval,
             {.unit = "s",
              .range = positive(),
              .help = "For recorded heat: shortest step; rows in between are skipped. The heat stays the same and is "
                      "spread over longer steps."});
  s.check([](const P& p, const Node& table, const std::string& path, Faults& faults) {
    check_source_form(p, table, path, faults);
  });
  return s;
}

Section<BearingProbeParameters> bearing_probe_section() {
  using P = BearingProbeParameters;
  Section<P> s(
      "probe",
      "A temperature that is reported: a node or mean of a model, or of the meshed section a point (x, r) or the "
      "mean of a boundary. Without any, all nodes and means are.");
  s.text("name", &P::name, {.help = "Name of the quantity in the results."});
  s.choice("model", &P::model, thermal_kind_names(),
           {.help = "Model whose node it is; optional if only one model has this node."});
  s.text("node", &P::node,
         {.help = "Node of the circuit (inner_ring, inner_contact, ...); or, of the finite elements, the mean of a "
                  "body or surface (inner_ring, bore, inner_raceway, ...) or the balls (ball)."});
  s.text("boundary", &P::boundary,
         {.help = "Boundary of the section whose area mean is reported: BODY.inner, .outer, .left, .right, .strip_ROW "
                  "or .raceway_ROW."});
  s.quantity(
      "x", &P::x,
      {.unit = "m", .help = "Axial coordinate of a point of the section; 0 is the middle of the bearing's width."});
  s.quantity("r", &P::r, {.unit = "m", .help = "Radius of a point of the section."});
  s.text("body", &P::body, {.help = "Body of the point, needed where two bodies meet."});
  s.check([](const P& p, const Node& table, const std::string& path, Faults& faults) {
    const bool is_point = p.x && p.r;
    const int n_ways = int{is_point} + int{p.node.has_value()} + int{p.boundary.has_value()};
    if (n_ways != 1 || p.x.has_value() != p.r.has_value())
      faults.add(position_of(table, "name"),
                 path + " (\"" + p.name + "\") needs either node, or boundary, or x and r.");
    if (p.body && !is_point) faults.add(position_of(table, "body"), path + ".body belongs to a point x, r.");
    if (const auto* kind = p.model ? thermal_kind(*p.model) : nullptr; kind && !kind->meshes_sections && !p.node)
      faults.add(
          position_of_value(table, "model"),
          path + " (\"" + p.name + "\"): " + (kind->is_circuit ? "the circuit" : kind->title) + " has nodes only.",
          "Give node = \"inner_ring\", or leave out model.");
    require_result_name(p.name, table, path, faults);
  });
  return s;
}

const char* ledger_of(SourcePort port) { return port == SourcePort::inner ? "inner_heat" : "outer_heat"; }

/// Puts the sources of one case together.
class HistoryMaker {
 public:
  HistoryMaker(const ThermalParameters& thermal, const std::string& bearing, const ReadRecordedHeat& read_recorded,
               Faults& faults)
      : thermal_(thermal), bearing_(bearing), read_recorded_(read_recorded), faults_(faults) {}

  void add(const HeatSourceParameters& source, const Node& table, const std::string& name) {
    table_ = &table;
    name_ = name;
    if (source.recorded)
      add_recorded(source);
    else
      add_given(source);
  }
  BearingHeatHistory history;

 private:
  void add_given(const HeatSourceParameters& source) {
    const FluxSteps steps =
        source.pulse ? steps_of(pulse_train(*source.pulse)) : FluxSteps{source.times, source.values};
    const auto put = [&](HeatedPort port, double factor) {
      if (source.interpolation == "linear")
        history.add_linear(port, steps, factor);
      else
        history.add(port, steps, factor);
    };
    switch (source.port) {
      case SourcePort::rub: {
        if (!source.share && thermal_.heat_share == HeatShare::jaeger)
          faults_.add(position_of(*table_, "port"),
                      name_ +
                          " needs a share: thermal.heat_share = \"jaeger\" divides rub heat by surface speeds, and "
                          "nothing moves here.",
                      "Give share = 0.66, say, or sources for rub-into-ring and rub-into-shaft.");
        const double share = source.share.value_or(thermal_.share_to_ring);
        put(HeatedPort::ring, share);
        put(HeatedPort::shaft, 1. - share);
        break;
      }
      case SourcePort::rub_into_ring:
        put(HeatedPort::ring, 1.);
        break;
      case SourcePort::rub_into_shaft:
        put(HeatedPort::shaft, 1.);
        break;
      case SourcePort::inner:
        put(HeatedPort::inner, 1.);
        break;
      case SourcePort::outer:
        put(HeatedPort::outer, 1.);
        break;
      case SourcePort::all:  // of recorded heat only
        break;
    }
  }

  void add_recorded(const HeatSourceParameters& source) {
    const double interval = source.interval.value_or(0.);
    const auto put = [&](HeatedPort port, const RecordedHeat& heat, double share) {
      history.add(port, steps_of(heat, 1., share, interval));
    };
    for (const auto& [races, port] :
         {std::pair(SourcePort::inner, HeatedPort::inner), std::pair(SourcePort::outer, HeatedPort::outer)})
      if (source.port == races || source.port == SourcePort::all)
        if (const auto heat = read(source, ledger_of(races))) put(port, *heat, 1.);
    if (source.port == SourcePort::inner || source.port == SourcePort::outer) return;
    const auto rub = read(source, "rub_heat");
    if (!rub) return;
    if (source.share) {
      put(HeatedPort::ring, *rub, *source.share);
      put(HeatedPort::shaft, *rub, 1. - *source.share);
      return;
    }
    const auto into_ring = read(source, "rub_heat_into_ring");
    if (!into_ring) return;
    if (source.port != SourcePort::rub_into_shaft) put(HeatedPort::ring, *into_ring, 1.);
    if (source.port == SourcePort::rub_into_ring) return;
    RecordedHeat rest = *rub;
    for (std::size_t i = 0; i < std::min(rest.joules.size(), into_ring->joules.size()); ++i)
      rest.joules[i] -= into_ring->joules[i];
    put(HeatedPort::shaft, rest, 1.);
  }

  std::optional<RecordedHeat> read(const HeatSourceParameters& source, const char* ledger) {
    const std::size_t n_before = faults_.size();
    if (has_failed_) return {};
    auto heat = read_recorded_({*source.recorded, source.bearing.value_or(bearing_), ledger}, *table_, name_, faults_);
    has_failed_ = faults_.size() > n_before;  // the others would say the same
    return heat;
  }

  const ThermalParameters& thermal_;
  const std::string& bearing_;
  const ReadRecordedHeat& read_recorded_;
  Faults& faults_;
  const Node* table_ = nullptr;
  std::string name_;
  bool has_failed_ = false;
};

}  // namespace

Section<PrescribedHeatParameters> prescribed_heat_section() {
  using P = PrescribedHeatParameters;
  Section<P> s("heat",
               "Thermal models of a touchdown bearing under prescribed heat input, without dynamics, for `rotordrop "
               "heat` (docs/how-to/heat.md). A drop ignores it.");
  s.text("bearing", &P::bearing, {.help = "Name of the bearing; optional if there is only one."});
  s.custom("models",
           {.accepts = list_of_thermal_models(),
            .json_types = {"array"},
            .help = "Thermal models to run; thermal.models if omitted."},
           [](const Node& node, P& target, Faults& faults) {
             target.models = read_thermal_models(node, "heat.models", false, faults);
           });
  s.quantities("output_times", &P::output_times,
               {.unit = "s",
                .range = at_least(0),
                .help = "Times at which probes and growth are reported; they are met exactly."});
  s.quantity("end_time", &P::end_time,
             {.unit = "s", .range = positive(), .help = "End time; the last of output_times if omitted."});
  s.quantity("time_tolerance", &P::time_tolerance,
             {.range = between(1e-12, 1e-1),
              .fallback = "1e-6",
              .help = "Error of one time step. With a mesh in windows it is relative to the largest temperature "
                      "change, in the circuit and with few modes to the mean rise from all heat so far."});
  s.quantity("ball_load", &P::ball_load,
             {.unit = "N",
              .range = positive(),
              .help = "Normal load of every ball on both races: balls then conduct as thermal.contact_conduction = "
                      "\"rolling\" has it for this load and ring_speed. Without it and ball_conductance by the fixed "
                      "R5."});
  s.quantity("ring_speed", &P::ring_speed,
             {.unit = "rad/s",
              .range = at_least(0),
              .help = "Speed of the inner ring at which balls of ball_load roll; 0, at rest, if left out."});
  s.quantity("ball_conductance", &P::ball_conductance,
             {.unit = "W/K",
              .range = positive(),
              .help = "Conductance between each race and the balls, of all contacts together, instead of R5; nothing "
                      "passes from race to race but through the balls' bulk."});
  s.list("source", &P::sources, source_section(), {.min_count = 1, .help = "Heat into the bearing."});
  s.list("probe", &P::probes, bearing_probe_section(), {.help = "Temperatures to report."});
  s.check([](const P& p, const Node& table, Faults& faults) {
    const SourcePosition where = position_of_value(table, "output_times");
    if (!std::is_sorted(p.output_times.begin(), p.output_times.end(), std::less_equal<>()))
      faults.add(where, "heat.output_times must increase.");
    if (p.end_time && !p.output_times.empty() && p.output_times.back() > *p.end_time)
      faults.add(where, "heat.output_times go beyond heat.end_time.");
    if (!p.end_time && (p.output_times.empty() || p.output_times.back() <= 0.))
      faults.add(where, "nothing says how long to compute.", "Give heat.output_times = [...], or heat.end_time.");
    if (p.ball_load && p.ball_conductance)
      faults.add(position_of(table, "ball_conductance"),
                 "heat.ball_load and heat.ball_conductance both say what balls conduct.", "Leave one of them out.");
    if (p.ring_speed && !p.ball_load)
      faults.add(position_of(table, "ring_speed"), "heat.ring_speed says at which speed balls of heat.ball_load roll.",
                 "Give heat.ball_load, or leave it out.");
    for (std::size_t i = 0; i < p.probes.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (p.probes[i].name == p.probes[j].name)
          faults.add(position_of(table, "probe"),
                     "heat.probe#" + std::to_string(i + 1) + ": the name \"" + p.probes[i].name + "\" is taken.",
                     "Choose another name.");
  });
  return s;
}

BearingHeatHistory make_heat_history(const PrescribedHeatParameters& parameters, const Node& heat,
                                     const ThermalParameters& thermal, const std::string& bearing,
                                     const ReadRecordedHeat& read_recorded, Faults& faults) {
  HistoryMaker maker(thermal, bearing, read_recorded, faults);
  const Node* sources = heat.find("source");
  for (std::size_t i = 0; i < parameters.sources.size(); ++i)
    maker.add(parameters.sources[i], sources ? sources->items()[i] : heat, "heat.source#" + std::to_string(i + 1));
  return std::move(maker.history);
}

}  // namespace rotordrop
