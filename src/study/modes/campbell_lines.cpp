#include "study/modes/campbell_lines.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace rotordrop {
namespace {

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

/// Pairs of modes at two neighbouring speeds, in their order: the sum of all changes, and of a price for each mode that is left alone, is least.
Pairs alike(const std::vector<WhirlMode>& a, const std::vector<WhirlMode>& b, double largest_frequency) {
  // Changes are relative to the diagram's height and the frequency. Two modes are rather left alone than joined over a tenth: of 60 steps a line needs none so large.
  constexpr double price = 0.05;
  const auto change = [&](std::size_t i, std::size_t j) {
    const double f = a[i].frequency, g = b[j].frequency;
    return std::fabs(f - g) / (largest_frequency + std::max(f, g));
  };
  const std::size_t n = a.size(), m = b.size(), width = m + 1;
  std::vector<double> least((n + 1) * width);  // of those from i and from j on
  for (std::size_t i = n + 1; i-- > 0;)
    for (std::size_t j = m + 1; j-- > 0;) {
      double& cost = least[i * width + j];
      cost = price * static_cast<double>(n - i + m - j);
      if (i < n) cost = std::min(cost, price + least[(i + 1) * width + j]);
      if (j < m) cost = std::min(cost, price + least[i * width + j + 1]);
      if (i < n && j < m) cost = std::min(cost, change(i, j) + least[(i + 1) * width + j + 1]);
    }
  Pairs pairs;
  for (std::size_t i = 0, j = 0; i < n && j < m;) {
    const double cost = least[i * width + j];
    if (cost == change(i, j) + least[(i + 1) * width + j + 1])
      pairs.emplace_back(i++, j++);
    else if (cost == price + least[(i + 1) * width + j])
      ++i;
    else
      ++j;
  }
  return pairs;
}

}  // namespace

std::vector<CampbellLine> campbell_lines(const CriticalSpeedReport& report, double largest_frequency) {
  std::vector<CampbellLine> lines;
  constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::vector<std::size_t> line_of;  // of each mode at the speed before
  for (std::size_t k = 0; k < report.diagram_speeds.size(); ++k) {
    const auto& modes = report.diagram_modes[k].modes;
    std::vector<std::size_t> line_here(modes.size(), none);
    if (k > 0)
      for (const auto& [before, here] : alike(report.diagram_modes[k - 1].modes, modes, largest_frequency))
        line_here[here] = line_of[before];
    for (std::size_t i = modes.size(); i-- > 0;) {
      if (modes[i].frequency > largest_frequency) {
        line_here[i] = none;
        continue;
      }
      if (line_here[i] == none) {
        line_here[i] = lines.size();
        lines.emplace_back();
      }
      lines[line_here[i]].push_back({report.diagram_speeds[k], &modes[i]});
    }
    line_of = std::move(line_here);
  }
  return lines;
}

}  // namespace rotordrop
