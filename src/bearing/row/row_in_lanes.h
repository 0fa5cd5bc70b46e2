#pragma once
#include <vector>

#include "base/gather.h"
#include "bearing/row/ball_terms.h"

namespace rotordrop {

/// A row of balls of several drops side by side: rings that translate, balls without inertia or waves. As BallRow otherwise.
template <class Real>
class RowInLanes {
 public:
  /// @param rows  alike but for their numbers
  explicit RowInLanes(std::span<const BallRow* const> rows)
      : cosine_(rows.front()->cosines().begin(), rows.front()->cosines().end()),
        sine_(rows.front()->sines().begin(), rows.front()->sines().end()) {
    std::vector<const RowNumbers<double>*> numbers;
    for (const BallRow* row : rows) numbers.push_back(&row->numbers());
    numbers_ = gathered<RowNumbers, Real>(numbers);
    edges_ = {{numbers_.inner, numbers_.stiffness_root}, {numbers_.outer, numbers_.stiffness_root}};
  }
  [[nodiscard]] const RowNumbers<Real>& numbers() const { return numbers_; }
  [[nodiscard]] std::size_t n_balls() const { return cosine_.size(); }

  void evaluate_translations(const BallRowInputOf<Real>& in, BallRowOutputOf<Real>& out,
                             RowTractionsOf<Real>* tractions) const {
    tractions ? sum<true>(in, out, tractions) : sum<false>(in, out, tractions);
  }

  void ball_loads(const BallRowInputOf<Real>& in, std::span<Real> load) const {
    const RowPlaceOf<Real> place = row_place(numbers_, in, 2. * in.ball_growth);
    for (std::size_t j = 0; j < cosine_.size(); ++j) load[j] = ball(place, j).F;
  }

 private:
  [[nodiscard, gnu::always_inline]] inline BallTerms<Real> ball(const RowPlaceOf<Real>& place, std::size_t j) const {
    return ball_terms<false, false>(place, Real(cosine_[j]), Real(sine_[j]), Real(0.), BallWidening<Real>{});
  }

  template <bool with_tractions>
  void sum(const BallRowInputOf<Real>& in, BallRowOutputOf<Real>& out, RowTractionsOf<Real>* tractions) const {
    const RowPlaceOf<Real> place = row_place(numbers_, in, 2. * in.ball_growth);
    const TractionInputOf<Real> with{numbers_.centrifugal_force(in), numbers_.inner_gyroscopic_share, edges_};
    const Real zero = 0.;
    Real fx = zero, fy = zero, fz = zero, dissipated = zero, elastic_radial = zero, elastic_axial = zero,
         elastic_normal = zero, cage = zero, largest = zero, roots = zero;
    Real inner = zero, outer = zero, gyroscopic = zero, demand = zero, truncation = zero;
    for (std::size_t j = 0; j < cosine_.size(); ++j) {
      const BallTerms<Real> b = ball(place, j);
      if constexpr (with_tractions) {
        const TractionTerms<Real> t = traction_terms(with, b);
        inner += b.F;
        outer += t.outer;
        gyroscopic += t.gyroscopic;
        demand = larger(demand, t.demand);
        truncation = larger(truncation, t.beyond);
      }
      const Real F_radial = b.F * b.cos_phi;
      fx -= b.F * b.sin_phi;
      fy -= F_radial * b.c;
      fz -= F_radial * b.s;
      dissipated += (b.F - b.elastic) * b.rate;
      elastic_radial += b.elastic * b.cos_phi;
      elastic_axial += b.elastic * b.sin_phi;
      elastic_normal += b.elastic;
      cage += b.cage;
      largest = larger(largest, b.F);
      roots += b.root;
    }
    out.force_x = fx;
    out.force_y = fy;
    out.force_z = fz;
    out.moment_y = out.moment_z = zero;
    out.damping_power = dissipated;
    out.elastic_radial = elastic_radial;
    out.elastic_axial = elastic_axial;
    out.elastic_normal = elastic_normal;
    out.elastic_outer_surplus = zero;
    out.cage_torque = cage;
    out.waviness_power = zero;
    out.largest_load = out.largest_outer_load = largest;
    out.inner_load_roots = out.outer_load_roots = numbers_.stiffness_root * roots;
    out.inner_loads = out.outer_loads = elastic_normal;
    out.inertia_power = out.inertia_per_speed = zero;
    if constexpr (with_tractions)
      *tractions = {.inner_load = inner,
                    .outer_load = outer,
                    .gyroscopic = (1. - with.inner_share) * gyroscopic,
                    .largest_gyroscopic_over_load = demand,
                    .inner_gyroscopic = with.inner_share * gyroscopic,
                    .centrifugal = with.F_c,
                    .truncation = smaller(truncation, Real(1.))};
  }

  RowNumbers<Real> numbers_;
  RaceEdgesOf<Real> edges_;
  std::vector<double> cosine_, sine_;  // of the balls' azimuths at cage angle zero
};

}  // namespace rotordrop
