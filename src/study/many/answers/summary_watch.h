#pragma once
#include <csignal>
#include <functional>
#include <string>

namespace rotordrop {

/// Thrown where a summary that is being made is stopped from outside: the drops that it is made of are kept.
struct SummaryStopped {};

/// Follows a summary while it is made, which takes minutes where it has surrogates of many points.
struct SummaryWatch {
  const volatile std::sig_atomic_t* stop = nullptr;  ///< as of StudyOptions
  std::function<void(const std::string&)> tell;      ///< what is made next
  /// @throws SummaryStopped
  void begins(const std::string& what) const {
    if (tell) tell(what);
    if (stop && *stop) throw SummaryStopped();
  }
};

}  // namespace rotordrop
