#pragma once
#include <functional>
#include <string>
#include <vector>

#include "model/observer.h"

namespace rotordrop {

/// Tells once of every fit that begins to open.
class FitWatch final : public RowSink {
 public:
  using Tell = std::function<void(const std::string&)>;
  /// @param observables  of the row, the first of which stands at `first`
  /// @param follows      whether growth follows the opening
  FitWatch(const std::vector<Observable>& observables, std::size_t first, bool follows, Tell tell);
  void row(double time, std::span<const double> row) override;

 private:
  struct Fit {
    ObservedColumns at;
    bool is_told = false;
  };
  std::vector<Fit> fits_;
  bool follows_;
  Tell tell_;
};

}  // namespace rotordrop
