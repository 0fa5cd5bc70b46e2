#pragma once
#include <optional>

namespace rotordrop {

/// Processes of one study that were started together (mpirun, srun). Its maker lies in a module that links MPI and is loaded only then.
/// All calls come from one thread.
class Ranks {
 public:
  enum class Kind : long {
    want,    ///< a rank asks for a point
    give,    ///< rank 0 gives one; -1: there is no further one
    done,    ///< a point is in the rank's journal
    failed,  ///< the same, and it failed
    alive,   ///< nothing else to say for a while
    bye,     ///< the rank's journal is complete and on the disk
    part     ///< rank 0 to those that leave: somebody is lost, nobody waits for anybody
  };
  struct Message {
    int from = 0;
    Kind kind = Kind::alive;
    long point = -1;
  };
  Ranks() = default;
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;
  virtual ~Ranks() = default;
  [[nodiscard]] virtual int rank() const = 0;
  [[nodiscard]] virtual int size() const = 0;
  /// Called once by every rank: waits until rank 0 has said whether the work begins.
  virtual bool begin(bool does_begin) = 0;
  [[nodiscard]] virtual bool has_begun() const = 0;  ///< begin() was called
  virtual void send(int to, Kind kind, long point) = 0;
  /// A message if one has come.
  virtual std::optional<Message> receive() = 0;
  /// Leaves; the last call. @param is_anyone_lost  then nobody waits for the others any more
  virtual void leave(bool is_anyone_lost) = 0;
};

inline constexpr const char* make_ranks_name = "rotordrop_make_ranks";
using MakeRanks = Ranks*();

/// The ranks with which this process was started; null if it was started alone. @throws InputError without the module
Ranks* ranks_of_this_process();

}  // namespace rotordrop
