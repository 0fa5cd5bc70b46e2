#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/rotation.h"
#include "study/modes/campbell_lines.h"
#include "study/modes/critical_speeds_report.h"

namespace rotordrop {
namespace {

constexpr double width = 560, height = 420, left = 70, top = 40, bottom = 60, right = 20;

/// A step of 1, 2 or 5 times a power of ten with about five steps in a range.
double round_step(double range) {
  const double power = std::pow(10., std::floor(std::log10(range / 5.)));
  const double part = range / 5. / power;
  return power * (part < 1.5 ? 1. : part < 3.5 ? 2. : part < 7.5 ? 5. : 10.);
}

const char* colour(Whirl whirl) {
  switch (whirl) {
    case Whirl::forward:
      return "#0b62a4";
    case Whirl::backward:
      return "#c0392b";
    default:
      return "#666666";
  }
}

/// Axes of one diagram in a picture; x may be logarithmic.
struct Axes {
  double offset, x_from, x_to, y_to;
  bool is_log = false;

  [[nodiscard]] double x(double value) const {
    const double part =
        is_log ? std::log(value / x_from) / std::log(x_to / x_from) : (value - x_from) / (x_to - x_from);
    return offset + left + part * (width - left - right);
  }
  [[nodiscard]] double y(double value) const { return top + (1. - value / y_to) * (height - top - bottom); }

  [[nodiscard]] std::string frame(const std::string& title, const std::string& x_label,
                                  const std::string& y_label) const {
    std::string svg =
        fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" class=\"frame\"/>\n",
                    offset + left, top, width - left - right, height - top - bottom);
    const auto tick = [&](double at, const std::string& text) {
      svg += fmt::format(
          "<path d=\"M{0:.1f} {1:.1f}V{2:.1f}\" class=\"grid\"/><text x=\"{0:.1f}\" y=\"{3:.1f}\" "
          "text-anchor=\"middle\">{4}</text>\n",
          x(at), top, height - bottom, height - bottom + 18, text);
    };
    if (is_log)
      for (double decade = std::pow(10., std::ceil(std::log10(x_from) - 1e-9)); decade <= x_to * (1 + 1e-9);
           decade *= 10.)
        tick(decade, fmt::format("1e{:.0f}", std::log10(decade)));
    else
      for (double at = x_from; at <= x_to * (1 + 1e-9); at += round_step(x_to - x_from))
        tick(at, fmt::format("{:g}", at));
    for (double at = 0; at <= y_to * (1 + 1e-9); at += round_step(y_to))
      svg += fmt::format(
          "<path d=\"M{0:.1f} {1:.1f}H{2:.1f}\" class=\"grid\"/><text x=\"{3:.1f}\" y=\"{4:.1f}\" "
          "text-anchor=\"end\">{5:g}</text>\n",
          offset + left, y(at), offset + width - right, offset + left - 6, y(at) + 4, at);
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
                       offset + (left + width - right) / 2, height - 18, x_label);
    svg += fmt::format("<text transform=\"translate({:.1f} {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                       offset + 16, (top + height - bottom) / 2, y_label);
    return svg + fmt::format("<text x=\"{:.1f}\" y=\"22\" class=\"title\">{}</text>\n", offset + left, title);
  }
};

std::string campbell(const CriticalSpeedReport& report, double up_to, double operating) {
  const Axes axes{0, 0, up_to * to_rpm, 1.25 * up_to / two_pi};
  std::string svg = axes.frame("Campbell diagram", "spin speed, rpm", "frequency, Hz");
  svg += fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" class=\"spin\"/>\n", axes.x(0), axes.y(0),
                     axes.x(up_to * to_rpm), axes.y(up_to / two_pi));
  for (const CampbellLine& line : campbell_lines(report, axes.y_to))
    for (std::size_t k = 1; k < line.size(); ++k) {
      const WhirlMode &from = *line[k - 1].mode, &to = *line[k].mode;
      svg += fmt::format("<path d=\"M{:.2f} {:.2f}L{:.2f} {:.2f}\" stroke=\"{}\"{}/>\n",
                         axes.x(line[k - 1].speed * to_rpm), axes.y(from.frequency), axes.x(line[k].speed * to_rpm),
                         axes.y(to.frequency), colour(to.whirl),
                         to.damping_ratio > 0.3 ? " stroke-dasharray=\"3 3\"" : "");
    }
  const bool shows_operating = operating > 0. && operating <= up_to;
  if (shows_operating)
    svg += fmt::format("<path d=\"M{0:.1f} {1:.1f}V{2:.1f}\" class=\"operating\"/>\n", axes.x(operating * to_rpm), top,
                       height - bottom);
  for (const auto& one : report.speeds)
    svg +=
        fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"4\" fill=\"{}\"><title>{:.1f} rpm, {}</title></circle>\n",
                    axes.x(one.speed * to_rpm), axes.y(one.speed / two_pi), colour(one.whirl), one.speed * to_rpm,
                    to_string(one.whirl));
  const double y = height - 36;
  svg += fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"legend\"><tspan fill=\"#0b62a4\">forward</tspan>  <tspan "
      "fill=\"#c0392b\">backward</tspan>  "
      "<tspan fill=\"#666666\">planar or mixed</tspan>{}  long dashes: 1x  short: damping above 30 %</text>\n",
      10., y + 33, shows_operating ? "  <tspan fill=\"#2e8b57\">operating speed</tspan>" : "");
  return svg;
}

std::string map(const CriticalSpeedReport& report, double up_to, double operating) {
  const Axes axes{width, report.map_stiffness.front(), report.map_stiffness.back(), up_to * to_rpm, true};
  std::string svg = axes.frame("Undamped critical-speed map", "stiffness of each support, N/m", "critical speed, rpm");
  for (std::size_t i = 0; i + 1 < report.map_stiffness.size(); ++i)
    for (std::size_t k = 0; k < std::min(report.map_speeds[i].size(), report.map_speeds[i + 1].size()); ++k)
      svg += fmt::format("<path d=\"M{:.2f} {:.2f}L{:.2f} {:.2f}\" stroke=\"#333333\"/>\n",
                         axes.x(report.map_stiffness[i]), axes.y(report.map_speeds[i][k] * to_rpm),
                         axes.x(report.map_stiffness[i + 1]), axes.y(report.map_speeds[i + 1][k] * to_rpm));
  if (operating > 0. && operating <= up_to)
    svg += fmt::format("<path d=\"M{:.1f} {:.1f}H{:.1f}\" class=\"operating\"/>\n", axes.x(axes.x_from),
                       axes.y(operating * to_rpm), axes.x(axes.x_to));
  return svg;
}

}  // namespace

std::string campbell_picture(const CriticalSpeedReport& report, double up_to, double operating_speed) {
  const bool has_map = report.map_stiffness.size() > 1;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\">\n<style>text{{font:12px "
      "sans-serif;fill:#222}}.title{{font-weight:bold}}path{{fill:none;stroke-width:1.6}}.frame{{fill:none;stroke:#444}"
      "}"
      ".grid{{stroke:#ddd;stroke-width:1}}.spin{{stroke:#222;stroke-dasharray:7 4;stroke-width:1.2}}"
      ".operating{{stroke:#2e8b57;stroke-width:1.2}}.legend{{font-size:11px}}</style>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      has_map ? 2 * width : width, height);
  svg += campbell(report, up_to, operating_speed);
  if (has_map) svg += map(report, up_to, operating_speed);
  return svg + "</svg>\n";
}

}  // namespace rotordrop
