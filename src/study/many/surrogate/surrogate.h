#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace rotordrop {

/// A sample from which a surrogate is made. Inputs are independent and uniform on (0, 1).
struct SurrogateProblem {
  bool is_kriging = false;  ///< else polynomial chaos
  std::size_t degree = 6;   ///< of the polynomials, at most
  std::size_t n_inputs = 0;
  std::vector<double> x;  ///< [n, n_inputs]
  std::vector<double> y;  ///< [n]
};

/// A function that stands for drops. Its maker lies in a module that links OpenTURNS and is loaded when a study asks for it.
class Surrogate {
 public:
  Surrogate() = default;
  Surrogate(const Surrogate&) = delete;
  Surrogate& operator=(const Surrogate&) = delete;
  virtual ~Surrogate() = default;
  /// Values at places [m, n_inputs]; [m].
  [[nodiscard]] virtual std::vector<double> at(const std::vector<double>& x) const = 0;
  /// Terms of the polynomial; 0 of kriging.
  [[nodiscard]] virtual std::size_t n_terms() const = 0;
  /// Sobol indices of the polynomial, exact for it; NaN of kriging.
  [[nodiscard]] virtual double first_index(std::size_t input) const = 0;
  [[nodiscard]] virtual double total_index(std::size_t input) const = 0;
};

inline constexpr const char* make_surrogate_name = "rotordrop_make_surrogate";
/// The caller owns what it gets; null with the reason in `error` if the sample gives none.
using MakeSurrogate = Surrogate*(const SurrogateProblem&, std::string& error);

/// Loads the module. @throws InputError if the program was built without it
MakeSurrogate* surrogate_maker();

}  // namespace rotordrop
