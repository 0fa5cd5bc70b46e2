// The module that is loaded under mpirun or srun: the only file that sees MPI.
#include <mpi.h>

#include <array>
#include <chrono>
#include <thread>

#include "study/many/ranks/ranks.h"

namespace rotordrop {
namespace {

constexpr int tag = 1;

class MpiRanks final : public Ranks {
 public:
  MpiRanks() {
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    // A rank that is lost must not end the others where the launcher lets them live; mpirun of Open MPI ends all by itself.
    MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
  }
  [[nodiscard]] int rank() const override { return rank_; }
  [[nodiscard]] int size() const override { return size_; }

  bool begin(bool does_begin) override {
    has_begun_ = true;
    int told = does_begin ? 1 : 0;
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibcast(&told, 1, MPI_INT, 0, MPI_COMM_WORLD, &request);
    wait(request);
    return told != 0;
  }

  [[nodiscard]] bool has_begun() const override { return has_begun_; }

  void send(int to, Kind kind, long point) override {
    const std::array<long, 2> message{static_cast<long>(kind), point};
    MPI_Send(message.data(), 2, MPI_LONG, to, tag, MPI_COMM_WORLD);  // two numbers leave at once, without a receiver
  }

  std::optional<Message> receive() override {
    int is_there = 0;
    MPI_Status status{};
    if (MPI_Iprobe(MPI_ANY_SOURCE, tag, MPI_COMM_WORLD, &is_there, &status) != MPI_SUCCESS || !is_there) return {};
    std::array<long, 2> message{};
    if (MPI_Recv(message.data(), 2, MPI_LONG, status.MPI_SOURCE, tag, MPI_COMM_WORLD, &status) != MPI_SUCCESS)
      return {};
    return Message{status.MPI_SOURCE, static_cast<Kind>(message[0]), message[1]};
  }

  void leave(bool is_anyone_lost) override {
    if (has_left_) return;
    has_left_ = true;
    // MPI_Finalize would wait for the lost one, and so would those who do not know of it.
    if (is_anyone_lost) {
      for (int k = 1; rank_ == 0 && k < size_; ++k) send(k, Kind::part, -1);
      return;
    }
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibarrier(MPI_COMM_WORLD, &request);
    bool parts = false;
    wait(request, [&] {
      const auto message = receive();
      return parts = message && message->kind == Kind::part;
    });
    if (!parts) MPI_Finalize();
  }

 private:
  /// Sleeps meanwhile; MPI's own waiting would take a core from the workers.
  /// @param is_vain  asked meanwhile; true: what is waited for will not come
  template <class IsVain>
  static void wait(MPI_Request& request, IsVain&& is_vain) {
    for (int is_there = 0; !is_there && !is_vain(); std::this_thread::sleep_for(std::chrono::milliseconds(1)))
      if (MPI_Test(&request, &is_there, MPI_STATUS_IGNORE) != MPI_SUCCESS) return;
  }
  static void wait(MPI_Request& request) {
    wait(request, [] { return false; });
  }
  int rank_ = 0, size_ = 1;
  bool has_begun_ = false, has_left_ = false;
};

}  // namespace
}  // namespace rotordrop

extern "C" rotordrop::Ranks* rotordrop_make_ranks() {
  static rotordrop::MpiRanks ranks;
  return &ranks;
}
