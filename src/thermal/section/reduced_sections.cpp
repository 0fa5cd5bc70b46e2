#include "thermal/section/reduced_sections.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "laws/heat/heat_flow.h"
#include "thermal/section/modal_sums.h"

namespace rotordrop {

namespace {

const ReducedHeat::Output& find(const std::vector<ReducedHeat::Output>& list, const std::string& name) {
  for (const auto& output : list)
    if (output.name == name) return output;
  throw std::invalid_argument("the reduced section has no \"" + name + "\"");
}

std::vector<double> times(double factor, std::vector<double> v) {
  for (double& x : v) x *= factor;
  return v;
}

/// Shapes of growth_surfaces, each so much per rise of a mean.
std::array<std::vector<double>, growth_surfaces.size()> growth_of_means(const ReducedHeat& heat,
                                                                        const GrowthPerRise& g) {
  const auto& inner = find(heat.bodies, "inner_ring").shape;
  const auto &outer = find(heat.bodies, "outer_ring"), &housing = find(heat.bodies, "housing");
  std::vector<double> outside = outer.shape;
  if (g.is_housed)
    for (std::size_t i = 0; i < outside.size(); ++i)
      outside[i] =
          (outer.capacity * outer.shape[i] + housing.capacity * housing.shape[i]) / (outer.capacity + housing.capacity);
  const bool is_lump =
      std::any_of(heat.nodes.begin(), heat.nodes.end(), [](const auto& o) { return o.name == "shaft"; });
  return {times(g.shaft, find(is_lump ? heat.nodes : heat.bodies, "shaft").shape),
          times(g.bore, inner),
          times(g.inner_race, inner),
          times(g.outer_race, outside),
          times(g.ball, find(heat.nodes, "ball").shape),
          times(g.inner_width, inner),
          times(g.outer_width, outer.shape)};
}

// What observe() writes for a surface.
const std::vector<std::string> surface_columns = {"mean", "lowest", "highest"};
constexpr std::array<std::size_t, 4> bearing_surfaces = {bore_port, inner_raceway_port, outer_raceway_port,
                                                         housing_port};

/// Those, and of rows that are heated apart each row's strips.
std::vector<std::size_t> observed_ports(const ReducedSection& section) {
  std::vector<std::size_t> ports(bearing_surfaces.begin(), bearing_surfaces.end());
  for (const auto& row : section.rows) ports.insert(ports.end(), {row.inner, row.outer});
  return ports;
}

/// The ports that heat enters: of a bearing, and of rows that are heated apart their strips.
std::vector<std::size_t> heated_ports(const ReducedSection& section) {
  std::vector<std::size_t> ports(n_bearing_ports);
  std::iota(ports.begin(), ports.end(), std::size_t{0});
  for (const auto& row : section.rows) ports.insert(ports.end(), {row.inner, row.outer});
  return ports;
}

/// The part of an input's heat that no mode stores.
double not_stored(const std::vector<double>& input, const std::vector<double>& stored) {
  constexpr double roundoff = 1e-12;
  const double part = 1. - std::inner_product(input.begin(), input.end(), stored.begin(), 0.);
  return std::fabs(part) < roundoff ? 0. : part;
}

/// All sums over the modes that are observed, in order.
ModalShapes observed_shapes(const ReducedSection& section, const std::vector<std::size_t>& surface_ports) {
  ModalShapes shapes(section.heat.n_modes());
  for (const auto* outputs : {&section.heat.bodies, &section.heat.nodes})
    for (const auto& output : *outputs) shapes.add(output.shape);
  for (const std::size_t port : surface_ports) shapes.add(section.heat.ports[port].shape);
  if (!section.elastic) return shapes;
  const auto& elastic = *section.elastic;
  if (elastic.drives) {
    shapes.add(elastic.mean_pressure.shape);
    for (const auto& node : elastic.node_pressure) shapes.add(node.shape);
  } else {
    for (const auto& shape : elastic.growth) shapes.add(shape);
  }
  for (const auto& shape : elastic.rows) shapes.add(shape);
  return shapes;
}

}  // namespace

ReducedSections::ReducedSections(std::vector<ReducedSection> sections, double ambient)
    : sections_(std::move(sections)), ambient_(ambient) {
  std::size_t first = 0;
  for (const auto& section : sections_) {
    const ReducedHeat& heat = section.heat;
    Place p;
    p.first = first;
    p.n = heat.n_modes();
    p.modes = ModalRates(heat.rate);
    p.means = p.growth = p.stored = ModalShapes(p.n);
    first += p.n;
    std::vector<double> stored(p.n, 0.);
    for (const auto* list : {&heat.bodies, &heat.nodes})
      for (const auto& output : *list)
        for (std::size_t i = 0; i < p.n; ++i) stored[i] += output.capacity * output.shape[i];
    p.stored.add(stored);
    const std::vector<std::size_t> heated = heated_ports(section);
    if (filled_up(heated.size() + 1) > std::tuple_size_v<HeatedPorts>)
      throw std::invalid_argument("a reduced section has too many rows of balls");
    for (const std::size_t port : heated) {
      const auto& output = heat.ports.at(port);
      const std::vector<double> input = times(1. / heat.capacity, output.shape);
      p.modes.add(input);
      p.means.add(output.shape);
      p.at_once.push_back(output.at_once);
      p.lost_at_once.push_back(not_stored(input, stored));
    }
    p.loss = p.means.add(heat.loss);
    p.loss_shape.assign(heat.loss.begin(), heat.loss.end());
    p.loss_shape.resize(filled_up(p.n), 0.);
    p.film_area = heat.ports[housing_port].area;
    for (const auto& row : section.rows)
      p.rows.push_back({heat.ports[row.inner].area / heat.ports[inner_raceway_port].area,
                        heat.ports[row.outer].area / heat.ports[outer_raceway_port].area});
    const bool is_elastic = section.elastic && section.elastic->drives;
    const auto by_formula = growth_of_means(heat, section.growth);
    for (std::size_t i = 0; i < by_formula.size(); ++i)
      p.growth.add(is_elastic ? section.elastic->growth[i] : by_formula[i]);
    p.has_widths = is_elastic || section.growth.inner_width != 0. || section.growth.outer_width != 0.;
    const std::vector<std::size_t> observed = observed_ports(section);
    for (const std::size_t port : observed) {
      p.surfaces.emplace_back(p.n, heat.ports[port].points, heat.ports[port].points_at_once);
      p.surface_inputs.push_back(static_cast<std::size_t>(std::ranges::find(heated, port) - heated.begin()));
    }
    p.observed = observed_shapes(section, observed);
    places_.push_back(std::move(p));
  }
}

std::vector<StateEntry> ReducedSections::state_entries() const {
  std::vector<StateEntry> entries;
  for (const auto& section : sections_)
    for (std::size_t i = 0; i < section.heat.n_modes(); ++i)
      entries.push_back({section.name + "/mode " + std::to_string(i + 1), "K", 1.,
                         "amplitude of a thermal mode of the section, over zero at ambient"});
  return entries;
}

void ReducedSections::initial_state(std::span<double> state) const { std::fill(state.begin(), state.end(), ambient_); }

void ReducedSections::add_growth(std::size_t k, std::span<const double> values, double zero, Expansion& out) const {
  const Place& p = places_[k];
  std::array<double, filled_up(growth_surfaces.size())> u;
  p.growth.sums(values.data() + p.first, zero, u.data());
  out = {.shaft = u[0], .bore = u[1], .inner_race = u[2], .outer_race = u[3], .ball = u[4]};
  if (!p.has_widths) return;
  out.inner_width = u[5];
  out.outer_width = u[6];
}

void ReducedSections::growth(std::span<const double> state, std::span<Expansion> out) const {
  for (std::size_t k = 0; k < places_.size(); ++k) add_growth(k, state, ambient_, out[k]);
}

void ReducedSections::growth_rates(std::span<const double> rate, std::span<Expansion> out) const {
  for (std::size_t k = 0; k < places_.size(); ++k) add_growth(k, rate, 0., out[k]);
}

void ReducedSections::heat_raceways(std::size_t k, const double* rises, const HeatInput& heat,
                                    HeatedPorts& watts) const {
  const Place& p = places_[k];
  const bool rolls = sections_[k].balls_roll;
  double from_balls = 0.;
  const auto heat_pair = [&](std::size_t inner, std::size_t outer, const auto& given) {
    ContactHeat q;
    if (rolls)
      q = contact_heat(given.balls, rises[inner] + p.at_once[inner] * given.inner,
                       rises[outer] + p.at_once[outer] * given.outer, rises[ball_port], p.at_once[inner], 0.,
                       p.at_once[outer]);
    watts[inner] = given.inner + q.inner;
    watts[outer] = given.outer + q.outer;
    from_balls += q.from_balls();
  };
  if (p.rows.empty()) heat_pair(inner_raceway_port, outer_raceway_port, heat);
  for (std::size_t i = 0; i < p.rows.size(); ++i)
    heat_pair(n_bearing_ports + 2 * i, n_bearing_ports + 2 * i + 1, heat.rows[i]);
  watts[ball_port] = -from_balls;
}

double ReducedSections::port_heats(std::size_t k, const double* y, const HeatInput& heat, HeatedPorts& rises,
                                   HeatedPorts& watts) const {
  const Place& p = places_[k];
  p.means.sums(y, ambient_, rises.data());
  std::fill_n(watts.begin(), p.at_once.size(), 0.);
  // Eq. (16) with the mean rise of the housing's surface.
  const double film_loss = housing_convection(rises[housing_port]) * p.film_area * rises[housing_port];
  watts[housing_port] = -film_loss;
  watts[bore_port] = heat.rub_into_ring;
  watts[shaft_port] = heat.rub - heat.rub_into_ring;
  if (const auto& link = sections_[k].contact_link) {
    const double q = (rises[bore_port] - rises[shaft_port]) / (heat.is_in_contact ? link->touching : link->apart);
    watts[bore_port] -= q;
    watts[shaft_port] += q;
  }
  heat_raceways(k, rises.data(), heat, watts);
  return std::inner_product(p.lost_at_once.begin(), p.lost_at_once.end(), watts.begin(), film_loss);
}

double ReducedSections::rates(std::span<const double> state, std::span<const HeatInput> heat,
                              std::span<double> dydt) const {
  double lost = 0.;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const Place& p = places_[k];
    const double* y = state.data() + p.first;
    HeatedPorts rises, watts;
    lost += port_heats(k, y, heat[k], rises, watts);
    lost += rises[p.loss];
    p.modes.rates(y, ambient_, watts.data(), dydt.data() + p.first);
  }
  return lost;
}

double ReducedSections::advance(double step, std::span<const double> from, std::span<const HeatInput> heat,
                                std::span<double> to) const {
  double lost = 0.;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const Place& p = places_[k];
    const double* y = from.data() + p.first;
    HeatedPorts rises, watts;
    lost += port_heats(k, y, heat[k], rises, watts);
    lost += p.modes.advance(y, ambient_, watts.data(), step, p.loss_shape, to.data() + p.first);
  }
  return lost * step;
}

std::vector<Observable> ReducedSections::observables() const {
  std::vector<Observable> list;
  for (const auto& section : sections_) {
    for (const auto* outputs : {&section.heat.bodies, &section.heat.nodes})
      for (const auto& output : *outputs)
        list.push_back({section.name + "/" + output.name,
                        "K",
                        "volume mean of " + output.name,
                        1,
                        {},
                        output.name == "inner_ring" ? Observed::inner_ring_temperature : Observed::temperature,
                        section.name});
    for (const std::size_t port : observed_ports(section)) {
      const std::string& name = section.heat.ports[port].name;
      list.push_back({section.name + "/" + name, "K",
                      "temperature of a surface, over its circumference the mean: " + name, 3, surface_columns});
    }
    if (!section.elastic) continue;
    if (section.elastic->drives)
      for (auto& o : housing_fit_observables(section.name + "/", section.name)) list.push_back(std::move(o));
    else
      list.push_back(growth_observable(section.name + "/elastic_growth", judged_growth_name));
    if (const std::size_t n = section.elastic->rows.size() / 2; n > 0)
      list.push_back(row_growth_observable(section.name + "/", n));
  }
  return list;
}

void ReducedSections::surface_heats(std::size_t k, const double* rises, const HeatInput& heat,
                                    HeatedPorts& watts) const {
  std::fill_n(watts.begin(), places_[k].at_once.size(), 0.);
  watts[bore_port] = heat.rub_into_ring;
  heat_raceways(k, rises, heat, watts);
}

void ReducedSections::put_surfaces(std::size_t k, const HeatedPorts& watts, const RiseRange* ranges,
                                   double* out) const {
  const Place& p = places_[k];
  for (std::size_t i = 0; i < p.surface_inputs.size(); ++i) {
    out[3 * i] += p.at_once[p.surface_inputs[i]] * watts[p.surface_inputs[i]];
    out[3 * i + 1] = ambient_ + ranges[i].lowest;
    out[3 * i + 2] = ambient_ + ranges[i].highest;
  }
  // A raceway is its rows' strips together.
  for (std::size_t race = 0; race < 2 && !p.rows.empty(); ++race) {
    double* whole = out + 3 * (1 + race);
    std::fill(whole, whole + 3, 0.);
    for (std::size_t i = 0; i < p.rows.size(); ++i) {
      const double* row = out + 3 * (bearing_surfaces.size() + 2 * i + race);
      whole[0] += (race == 0 ? p.rows[i].inner_share : p.rows[i].outer_share) * row[0];
      whole[1] = i == 0 ? row[1] : std::min(whole[1], row[1]);
      whole[2] = i == 0 ? row[2] : std::max(whole[2], row[2]);
    }
  }
}

double* ReducedSections::put_observed(std::size_t k, const double* sum, const HeatedPorts& watts,
                                      const RiseRange* ranges, double* to) const {
  const Place& p = places_[k];
  for (const auto* outputs : {&sections_[k].heat.bodies, &sections_[k].heat.nodes})
    for (std::size_t i = 0; i < outputs->size(); ++i) *to++ = ambient_ + *sum++;
  for (std::size_t i = 0; i < p.surfaces.size(); ++i) to[3 * i] = ambient_ + *sum++;
  put_surfaces(k, watts, ranges, to);
  to += 3 * p.surfaces.size();
  const auto& elastic = sections_[k].elastic;
  if (!elastic) return to;
  if (elastic->drives) {
    *to++ = elastic->mean_pressure.at_rest + *sum++;
    double lowest = std::numeric_limits<double>::infinity(), pulling = 0.;
    for (std::size_t i = 0; i < elastic->node_pressure.size(); ++i) {
      const double pressure = elastic->node_pressure[i].at_rest + *sum++;
      lowest = std::min(lowest, pressure);
      if (pressure < -no_pressure) pulling += elastic->node_share[i];
    }
    *to++ = lowest;
    *to++ = pulling;
  } else {
    to = std::copy_n(sum, elastic->growth.size(), to);
    sum += elastic->growth.size();
  }
  return std::copy_n(sum, elastic->rows.size(), to);
}

void ReducedSections::observe(std::span<const double> state, std::span<const HeatInput> heats,
                              std::span<double> out) const {
  std::vector<double> sums;
  std::vector<RiseRange> ranges;
  double* to = out.data();
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const Place& p = places_[k];
    const double* y = state.data() + p.first;
    HeatedPorts rises, watts;
    p.means.sums(y, ambient_, rises.data());
    surface_heats(k, rises.data(), heats[k], watts);
    ranges.clear();
    for (std::size_t i = 0; i < p.surfaces.size(); ++i)
      ranges.push_back(p.surfaces[i].extremes(y, ambient_, watts[p.surface_inputs[i]]));
    p.observed.sums(y, ambient_, sums);
    to = put_observed(k, sums.data(), watts, ranges.data(), to);
  }
}

void ReducedSections::observe_tile(std::span<const double> state, std::span<const HeatInput> heats,
                                   std::span<double> out) const {
  constexpr std::size_t width = RowTile::width;
  std::vector<double> rises(state.size()), means, sums, of_one(out.size() / width);
  std::transform(state.begin(), state.end(), rises.begin(), [this](double T) { return T - ambient_; });
  std::array<HeatedPorts, width> watts;
  std::vector<std::array<RiseRange, width>> ranges;  // of each surface
  std::vector<RiseRange> ranges_of_one;
  const std::size_t n_heats = heats.size() / width;
  std::size_t first = 0;  // of what is observed
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const Place& p = places_[k];
    const double* of_place = rises.data() + p.first * width;
    const std::size_t n_means = filled_up(p.means.size()), n_sums = filled_up(p.observed.size());
    means.resize(width * n_means);
    sums.resize(width * n_sums);
    p.means.sums_of_tile(of_place, means.data());
    p.observed.sums_of_tile(of_place, sums.data());
    for (std::size_t l = 0; l < width; ++l)
      surface_heats(k, means.data() + l * n_means, heats[l * n_heats + k], watts[l]);
    ranges.resize(p.surfaces.size());
    ranges_of_one.resize(p.surfaces.size());
    for (std::size_t i = 0; i < p.surfaces.size(); ++i) {
      std::array<double, width> into;
      for (std::size_t l = 0; l < width; ++l) into[l] = watts[l][p.surface_inputs[i]];
      p.surfaces[i].extremes_of_tile(of_place, into.data(), ranges[i].data());
    }
    std::size_t end = first;
    for (std::size_t l = 0; l < width; ++l) {
      for (std::size_t i = 0; i < ranges.size(); ++i) ranges_of_one[i] = ranges[i][l];
      const double* behind = put_observed(k, sums.data() + l * n_sums, watts[l], ranges_of_one.data(), of_one.data());
      end = first + static_cast<std::size_t>(behind - of_one.data());
      for (std::size_t i = first; i < end; ++i) out[i * width + l] = of_one[i - first];
    }
    first = end;
  }
}

double ReducedSections::stored_energy(std::span<const double> state) const {
  double stored = 0.;
  for (const auto& p : places_) {
    Octet sum;
    p.stored.sums(state.data() + p.first, ambient_, sum.value.data());
    stored += sum[0];
  }
  return stored;
}

}  // namespace rotordrop
