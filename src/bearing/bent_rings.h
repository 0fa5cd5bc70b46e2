#pragma once
// Bending of a bearing's rings as data: harmonics of the inner and, on an elastic bedding, of the outer ring.
#include <cstddef>
#include <vector>

#include "laws/arc_contact.h"
#include "laws/ring_bending.h"

namespace rotordrop {

/// Whether rings bend, and how the rotor touches a bent bore.
enum class RingBendingModel {
  none,   ///< rings are rigid
  point,  ///< at one point on the line of centres, with the tangential part that conserves energy
  arc     ///< over the arc where the surfaces overlap
};

/// Rings that bend. Shapes u_r = sum over n of a_n cos(n theta) + b_n sin(n theta), standing in space while the ring turns through them.
struct BentRings {
  RingBendingModel model = RingBendingModel::point;
  std::vector<RingHarmonic> inner;
  std::vector<RingHarmonic> outer;  ///< with the stiffness of its bedding; empty: a rigid outer ring
  double damping_ratio = 0;         ///< of each harmonic, of its critical damping
  double frequency_limit = 0;       ///< harmonics above get the mass that brings them down to it, in drops [Hz]
  ArcContact arc;                   ///< for the model `arc`

  /// Number of coefficients a_2, b_2, a_3, b_3, ... of a ring.
  [[nodiscard]] std::size_t n_inner() const { return 2 * inner.size(); }
  [[nodiscard]] std::size_t n_outer() const { return 2 * outer.size(); }
  [[nodiscard]] std::size_t n_shapes() const { return n_inner() + n_outer(); }
  /// Mass of a harmonic in drops [kg].
  [[nodiscard]] double dynamic_mass(const RingHarmonic& harmonic) const;
};

/// Points around the bore at which the contact over an arc is taken: 0.94 degrees apart.
inline constexpr std::size_t n_arc_points = 384;

}  // namespace rotordrop
