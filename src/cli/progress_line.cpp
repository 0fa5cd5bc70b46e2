#include "cli/progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

#include "base/rotation.h"

namespace rotordrop {

std::string progress_text(const Progress& p) {
  std::string text =
      fmt::format("t = {:.4f} s of {:.4g} s  {:3.0f} %  |  {:.0f} rpm  |  peak force {:.2f} kN", p.time, p.end_time,
                  100. * p.time / p.end_time, p.rotor_speed * to_rpm, p.largest_contact_force * 1e-3);
  if (std::isfinite(p.inner_ring_temperature)) text += fmt::format("  |  T inner {:.2f} K", p.inner_ring_temperature);
  const double left = std::ceil(p.wall_time_left);
  if (p.time < p.end_time)
    text += left < 90.
                ? fmt::format("  |  about {:.0f} s left", left)
                : fmt::format("  |  about {:.0f} min {:02.0f} s left", std::floor(left / 60.), std::fmod(left, 60.));
  return text;
}

ProgressLine::ProgressLine() : is_terminal_(isatty(STDERR_FILENO) != 0) {}

void ProgressLine::show(const Progress& progress) {
  if (!is_terminal_) return;
  fmt::print(stderr, "\r\033[K{}", progress_text(progress));
  std::fflush(stderr);
  was_shown_ = true;
}

void ProgressLine::finish() {
  if (was_shown_) fmt::print(stderr, "\n");
  was_shown_ = false;
}

}  // namespace rotordrop
