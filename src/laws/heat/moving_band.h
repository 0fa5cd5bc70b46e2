#pragma once
// Local temperature of a rubbing spot: a heated band that moves over a surface, and what its track keeps.
// A mean over the circumference, as an axisymmetric model gives, says nothing of it.

#include <cstddef>
#include <limits>
#include <vector>

#include "base/aligned_numbers.h"

namespace rotordrop {

/// A band of even heat, long across its motion, on the surface of a half space that moves past it at constant speed.
/// Rises are over the temperature that the half space had before (its bulk).
/// Sources: Jaeger, J. Proc. Roy. Soc. NSW 76 (1942) 203-224; Carslaw & Jaeger, Conduction of Heat in Solids, 2nd ed. (1959), 10.7 (moving) and
/// 10.5 (at rest); Tian & Kennedy, J. Tribology 116 (1994) 167-174, for the range of Peclet numbers and for joining its ends in one formula.
/// Valid: half_width far below the radius of curvature and the axial width; constant properties; no loss from the surface; until heat has crossed
/// the wall behind the surface.
struct MovingBand {
  double half_width = 0;    ///< b [m], > 0
  double speed = 0;         ///< v, of the band over the surface [m/s], any sign
  double flux = 0;          ///< q, into this body [W/m2]
  double conductivity = 0;  ///< k [W/(m K)], > 0
  double capacity = 0;      ///< rho c [J/(m3 K)], > 0

  /// L = |v| b / (2 kappa), kappa = k/(rho c). Above 10 heat goes straight down; below 0.1 the band is as good as at rest.
  [[nodiscard]] double peclet() const;

  /// Rise after the time t [s] of motion and heating, at a place x [m] from the band's middle, positive ahead of it, by quadrature:
  ///   T = q/(2k) sqrt(kappa/pi) integral_0^t [erf((x + v s + b)/sqrt(4 kappa s)) - erf((x + v s - b)/sqrt(4 kappa s))] s^(-1/2) ds
  [[nodiscard]] double rise(double x, double t) const;
  /// Rise after any length of time, v not 0:
  ///   T = 2 q kappa/(pi k v) integral_(X-L)^(X+L) exp(-u) K0|u| du,  X = x v/(2 kappa)
  /// by the integrals of exp(u) K0(u) and exp(-u) K0(u), which are closed (Bessel functions K0, K1).
  [[nodiscard]] double steady_rise(double x) const;

  /// The largest rise after the time t [s], found by search.
  [[nodiscard]] double largest_rise(double t) const;

  /// The largest rise in one expression, within 4 % of largest_rise() for all L and t, and exact at the ends of both:
  ///   theta(Fo) = 2 sqrt(Fo/pi) erf(1/(2 sqrt(Fo))) + E1(1/(4 Fo))/pi,  T = (q b/k) theta: a band at rest, Carslaw & Jaeger 10.5
  ///   at Fo = (Fo_t^-n + Fo_L^-n)^(-1/n),  n = 1.4 + 1.6 sqrt(L)
  ///   Fo_t = kappa t/b^2,  Fo_L = [1 + (exp(-gamma)/L)^1.4]^(1/1.4) / L,  gamma Euler's constant
  /// Fo_L is the time in which a band at rest gets as hot as the moving one ever does: b v/2 long ones (L large) and b^2/v^2 ones (L small) have
  /// that limit exactly. The exponents are ours, fitted to the integrals.
  [[nodiscard]] double largest_rise_estimate(double t = std::numeric_limits<double>::infinity()) const;
};

/// Rise of a half space's surface under an even flux q from time 0 on, 2 q sqrt(t/(pi k rho c)) [K].
double surface_rise(double flux, double time, double conductivity, double capacity);

/// The inner ring's bore (or any circle) that a rubbing spot runs over.
struct BoreSurface {
  double radius = 0;          ///< [m], > 0
  double conductivity = 0;    ///< [W/(m K)], > 0
  double capacity = 0;        ///< rho c [J/(m3 K)], > 0
  double wall_thickness = 0;  ///< of the ring [m], > 0; says for how long the half space is one
};

/// A rub during one interval.
struct RubbingSpot {
  double heat_rate = 0;  ///< into this surface, mean over the interval [W]; 0: not in contact
  double contact_angle =
      0;  ///< where the contact is, at the interval's end [rad]; any number of turns more or less is the same place
  double ring_angle = 0;   ///< how far the surface itself has turned, at the interval's end [rad]
  double half_width = 0;   ///< of the contact along the surface [m], > 0 in contact
  double axial_width = 0;  ///< of the contact [m], > 0 in contact
};

/// Local temperature rise along the circumference of a bore, from the history of a rub.
///
/// The circumference is cut into cells that turn with the ring. The spot's heat is spread evenly over its 2 b, moved at an even pace from where it was
/// at the interval's beginning to where it is at its end; each cell gets what passes over it, so that the cells together get all the heat. Each cell
/// is a half space of its own,
///   T(t) = (pi k rho c)^(-1/2) integral_0^t q(s) (t - s)^(-1/2) ds,
/// the last interval exactly, what went before by a sum of exponentials for the root: with 1/sqrt(s) = pi^(-1/2) integral exp(-s e^z) e^(z/2) dz the
/// trapezoid rule in z converges so fast that the kernel is met to 4e-4. Cost and memory: touched cells times about 17 terms.
///
/// Valid: until heat has crossed the wall, see valid_until(); with no heat going sideways, sqrt(kappa t) below the spot's half width (in steel 0.2 mm after
/// 3 ms): later the rise of the hot track is an upper bound. No loss from the surface. Rises are over the temperature at the start.
class SweptArcHistory {
 public:
  struct Options {
    std::size_t n_cells = 1000;        ///< cells_for() says how many are enough
    double shortest_interval = 50e-6;  ///< [s]; shorter ones than a fifth miss a little of the heat of just before
    double duration = 10;              ///< [s]; heat older than this fades too fast
  };
  /// Cells so that they are narrower than half of the half width [m], 720 at least.
  static std::size_t cells_for(double radius, double half_width);

  SweptArcHistory(const BoreSurface& surface, const Options& options, double start_time = 0.);

  /// Goes on to the time [s], above the last one. Between two intervals in contact the spot has moved the shorter way round.
  void advance(double time, const RubbingSpot& spot);

  struct State {
    double time = 0;                ///< [s]
    double largest_rise = 0;        ///< of all places [K]
    double largest_rise_angle = 0;  ///< where that is, in the ring's frame [rad], from 0 to 2 pi
    double rise_at_contact = 0;     ///< under the middle of the spot [K]; 0 without contact
    double mean_rise =
        0;  ///< over the circumference [K]: the same heat, spread. What the local rise has over it belongs on top of an
            ///< axisymmetric model's bore temperature
    double arc_of_contact = 0;  ///< way of the spot's middle since contact began [rad]; 0 without contact
    double arc_total = 0;       ///< the same of all contacts together [rad]
    double heated_arc = 0;      ///< part of the circumference that was ever heated [rad]
    double ring_turns = 0;      ///< of the surface since the first interval's end [1]
  };
  [[nodiscard]] const State& state() const { return state_; }

  [[nodiscard]] std::size_t n_cells() const { return slot_of_cell_.size(); }
  /// Local rise of every cell [K] [n_cells]; cell i spans the angles 2 pi i/n to 2 pi (i + 1)/n in the ring's frame.
  [[nodiscard]] std::vector<double> rises() const;
  /// Heat that every cell has got [J] [n_cells].
  [[nodiscard]] std::vector<double> heat() const;

  /// Time [s] up to which an insulated back of the wall changes the rise by less than 0.4 % under a steady flux, from the start of heating:
  /// thickness^2/(4 kappa).
  [[nodiscard]] double valid_until() const;

 private:
  void set_interval(double step);
  void deposit(double from, double to, const RubbingSpot& spot, double heat);
  std::size_t slot_for(std::size_t cell);
  void decay_and_heat(double step);

  static constexpr std::size_t untouched = static_cast<std::size_t>(-1);
  BoreSurface surface_;
  std::vector<std::size_t> slot_of_cell_;  ///< [n_cells]
  std::vector<std::size_t> cell_of_slot_;  ///< [touched]
  std::vector<double> rate_, weight_;      ///< of the terms [1/s], [s^-1/2]; [n_terms]
  std::vector<double> decay_, gain_;       ///< of the terms over the present interval [n_terms]
  /// Of cells in vectors of eight, filled up with cold ones.
  AlignedNumbers memory_;               ///< weight times integral of flux times exponential [vectors][n_terms][8]
  AlignedNumbers flux_, rise_, total_;  ///< [W/m2], [K], [J]; [touched, filled up]
  double interval_ = 0, last_angle_ = 0, start_ring_angle_ = 0;
  bool was_in_contact_ = false, has_begun_ = false;
  State state_;
};

}  // namespace rotordrop
