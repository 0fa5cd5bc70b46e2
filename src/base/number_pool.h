#pragma once
#include <cstddef>
#include <memory>
#include <vector>

namespace rotordrop {

/// Gives out room for lists of numbers that stay until it ends. From some hundred kilobytes on it comes in large pages, where the system has them: the first
/// touch of small ones costs several times as much, and more than what is written there.
class NumberPool {
 public:
  /// @returns room for n numbers, unwritten
  [[nodiscard]] double* take(std::size_t n);

 private:
  struct Free {
    std::size_t bytes = 0;
    void operator()(double* numbers) const;
  };
  using Large = std::unique_ptr<double[], Free>;
  [[nodiscard]] static Large large_piece(std::size_t bytes);
  std::vector<std::unique_ptr<double[]>> small_;
  std::vector<Large> large_;
  std::size_t n_small_ = 0;                // numbers in small pages
  std::size_t n_large_ = 0, n_taken_ = 0;  // in the last large piece
};

}  // namespace rotordrop
