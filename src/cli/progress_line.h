#pragma once
#include <string>

#include "study/drop/drop_run.h"

namespace rotordrop {

/// One line that moves on a terminal; nothing elsewhere.
class ProgressLine {
 public:
  ProgressLine();
  [[nodiscard]] bool is_shown() const { return is_terminal_; }
  void show(const Progress& progress);
  /// Leaves the line standing.
  void finish();

 private:
  bool is_terminal_;
  bool was_shown_ = false;
};

/// "t = 0.1243 s of 0.3 s  41 %  |  15190 rpm  |  peak force 5.2 kN  |  T inner 295.1 K  |  about 2 s left".
std::string progress_text(const Progress& progress);

}  // namespace rotordrop
