#pragma once
#include <sys/types.h>

#include <cstdint>
#include <filesystem>
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
  /// Begins the work as a copy of this thread, which ends with it. A lock that another thread holds stays locked there: take the library's own before.
  void start(const std::function<void()>& work);
  /// Waits for the end of what was started.
  [[nodiscard]] End wait() const;

 private:
  Limits limits_;
  pid_t child_ = -1;
};

/// What reading takes by the size of a file.
struct ReadingRates {
  std::uint64_t bytes_per_second;
  std::uint64_t memory_per_byte = 0, memory_besides = 0;  ///< [bytes]; both 0: not limited
};
/// @param patience  what reading may take besides the time of its size [s]
Trial::Limits limits_of_reading(const std::filesystem::path& file, unsigned patience, const ReadingRates& rates);

}  // namespace rotordrop
