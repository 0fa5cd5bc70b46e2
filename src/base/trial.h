#pragma once
#include <sys/types.h>

#include <cstdint>
#include <functional>

namespace rotordrop {

/// Work that may crash, or never end, within another's library: it is done in a process of its own first, of which the end is all that is
/// seen. What it throws is no crash: the same work, done for good, tells it better.
class Trial {
 public:
  enum class End {
    done,
    crashed,  ///< by a signal, or by leaving the process
    out_of_time,
    out_of_memory,
    not_tried  ///< there is no process more to be had
  };

  struct Limits {
    unsigned seconds = 0;      ///< that it may take; 0: as long as it wants
    std::uint64_t memory = 0;  ///< that it may have besides this process's own [bytes]; 0: what there is
  };
  explicit Trial(const Limits& limits) : limits_(limits) {}
  /// Begins the work as a copy of this thread. A lock that another thread holds stays locked there: take the library's own before.
  void start(const std::function<void()>& work);
  /// Waits for the end of what was started.
  [[nodiscard]] End wait() const;

 private:
  Limits limits_;
  pid_t child_ = -1;
};

}  // namespace rotordrop
