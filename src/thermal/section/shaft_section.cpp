#include "thermal/section/shaft_section.h"

#include <algorithm>
#include <cmath>

namespace rotordrop {
namespace {

/// Layers between all radii of shaft and steps. Cells are thin at the heated surface and grow away from it.
std::vector<Layer> layers_of(double bore, double radius, const std::vector<ShaftStep>& steps, const CellSizes& sizes) {
  // Deep in the shaft nothing changes fast: its cells may become larger than the rings'.
  const double largest = 3. * sizes.largest;
  std::vector<double> cuts = {bore, radius};
  for (const auto& step : steps) cuts.insert(cuts.end(), {step.inside, step.outside});
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end(), [](double a, double b) { return b - a < same_place; }), cuts.end());
  const auto surface = std::find_if(cuts.begin(), cuts.end(), [&](double r) { return r > radius - same_place; });
  std::vector<Layer> layers;
  double cell = sizes.surface;
  for (auto at = surface; at != cuts.begin(); --at) {
    const double from = *(at - 1), to = *at;
    const Division d = graded(to - from, cell, sizes.growth, largest);
    layers.insert(layers.begin(), {from, to, reversed(d)});
    cell = std::min(largest, sizes.growth * last_cell(to - from, d));
  }
  cell = sizes.surface;
  for (auto at = surface; at + 1 != cuts.end(); ++at) {
    const double from = *at, to = *(at + 1);
    const Division d = graded(to - from, cell, sizes.growth, largest);
    layers.push_back({from, to, d});
    cell = std::min(largest, sizes.growth * last_cell(to - from, d));
  }
  return layers;
}

std::vector<Layer> between(const std::vector<Layer>& layers, double inside, double outside) {
  std::vector<Layer> some;
  for (const auto& layer : layers)
    if (layer.from > inside - same_place && layer.to < outside + same_place) some.push_back(layer);
  return some;
}

}  // namespace

void add_shaft(double bore, double radius, const Columns& columns, const std::vector<ShaftStep>& steps,
               const CellSizes& sizes, SectionBuilder& builder) {
  const auto layers = layers_of(bore, radius, steps, sizes);
  add_rectangle("shaft", columns, between(layers, bore, radius), builder);
  const double largest = 5. * sizes.largest;
  double cell = 0.;
  for (const auto& step : steps) {
    if (step.is_first)
      cell = step.is_left ? first_cell(columns.x[1] - columns.x[0], columns.divisions.front())
                          : last_cell(columns.x.back() - columns.x[columns.x.size() - 2], columns.divisions.back());
    const double length = step.to - step.from;
    const Division outwards = graded(length, cell, sizes.growth, largest);
    add_rectangle(step.name, {{step.from, step.to}, {step.is_left ? reversed(outwards) : outwards}},
                  between(layers, step.inside, step.outside), builder);
    cell = std::min(largest, sizes.growth * last_cell(length, outwards));
  }
}

}  // namespace rotordrop
