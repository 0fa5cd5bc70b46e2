#pragma once
#include <algorithm>
#include <vector>

#include "base/gather.h"
#include "base/sine_cosine.h"
#include "bearing/row/ball_terms.h"
#include "bearing/row/inertial_in_lanes.h"

namespace rotordrop {

/// A row of balls of several drops side by side: rings that translate. As BallRow otherwise.
template <class Real>
class RowInLanes {
 public:
  /// @param rows  alike but for their numbers
  explicit RowInLanes(std::span<const BallRow* const> rows)
      : cosine_(rows.front()->cosines().begin(), rows.front()->cosines().end()),
        sine_(rows.front()->sines().begin(), rows.front()->sines().end()),
        inertial_(rows) {
    std::vector<const RowNumbers<double>*> numbers;
    for (const BallRow* row : rows) numbers.push_back(&row->numbers());
    numbers_ = gathered<RowNumbers, Real>(numbers);
    for (std::size_t k = 0; k < rows.front()->waves().size(); ++k) {
      const BallRow::Wave& form = rows.front()->waves()[k];
      Wave wave{
          form.wave.on_inner_race, static_cast<double>(form.wave.order), Real(0.), Real(0.), form.cosine, form.sine};
      for (int lane = 0; lane < n_lanes; ++lane) {
        const auto at = std::min(static_cast<std::size_t>(lane), rows.size() - 1);
        wave.amplitude.set(lane, rows[at]->waves()[k].wave.amplitude);
        wave.phase.set(lane, rows[at]->waves()[k].wave.phase);
      }
      waves_.push_back(std::move(wave));
    }
  }
  [[nodiscard]] const RowNumbers<Real>& numbers() const { return numbers_; }
  [[nodiscard]] std::size_t n_balls() const { return cosine_.size(); }

  void evaluate_translations(const BallRowInputOf<Real>& in, BallRowOutputOf<Real>& out,
                             RowTractionsOf<Real>* tractions) const {
    if (!inertial_.has_inertia()) return evaluate_massless(in, out, tractions);
    const Turning turning(numbers_, in);
    if (any(turning.is)) inertial_.evaluate(numbers_, in, turning, waves_at(in), !waves_.empty(), out, tractions);
    const MaskOf<Real> stands = !turning.is;
    if (!any(stands)) return;
    BallRowOutputOf<Real> still;
    RowTractionsOf<Real> still_tractions;
    evaluate_massless(in, still, tractions ? &still_tractions : nullptr);
    out = select_all(stands, still, out);
    if (tractions) *tractions = select_all(stands, still_tractions, *tractions);
  }
  void ball_loads(const BallRowInputOf<Real>& in, std::span<Real> load) const {
    if (!inertial_.has_inertia()) return massless_loads(in, load);
    const Turning turning(numbers_, in);
    if (any(turning.is)) inertial_.ball_loads(numbers_, in, turning, waves_at(in), !waves_.empty(), load);
    const MaskOf<Real> stands = !turning.is;
    if (!any(stands)) return;
    std::vector<Real> still(load.size());
    massless_loads(in, still);
    for (std::size_t j = 0; j < load.size(); ++j) load[j] = select(stands, still[j], load[j]);
  }
  [[nodiscard]] Real energy(const BallRowInputOf<Real>& in) const {
    if (!inertial_.has_inertia()) return massless_energy(in);
    const Turning turning(numbers_, in);
    Real energy = 0.;
    if (any(turning.is)) energy = inertial_.energy(numbers_, in, turning, waves_at(in), !waves_.empty());
    const MaskOf<Real> stands = !turning.is;
    return any(stands) ? select(stands, massless_energy(in), energy) : energy;
  }

 private:
  using Turning = typename InertialRowInLanes<Real>::Turning;
  struct Wave {
    bool on_inner_race;
    double order;
    Real amplitude, phase;
    std::vector<double> cosine, sine;  // of order * azimuth at cage angle zero
  };
  /// A wave at an instant: amplitude times cosine and sine of how far it has turned, and its speed of travel [rad/s].
  struct Travel {
    Real cosine, sine, speed;
  };
  using Travels = std::vector<Travel>;
  [[nodiscard]] Travels travelling(const BallRowInputOf<Real>& in) const {
    Travels travels;
    for (const Wave& w : waves_) {
      const Real angle = w.on_inner_race ? in.cage_angle - in.ring_angle : in.cage_angle;
      const Real speed = w.on_inner_race ? in.cage_speed - in.ring_speed : in.cage_speed;
      const auto turned = sine_cosine(w.order * angle + w.phase);
      travels.push_back({w.amplitude * turned.cosine, w.amplitude * turned.sine, w.order * speed});
    }
    return travels;
  }
  /// What the waves add to a ball's penetration [m], and the rate of that by their travel [m/s].
  struct Waved {
    Real added, rate;
  };
  [[nodiscard]] Waved waved(const Travels& travels, std::size_t j) const {
    Waved sum{Real(0.), Real(0.)};
    for (std::size_t k = 0; k < travels.size(); ++k) {
      const Waved one = waved_by(travels, k, j);
      sum.added += one.added;
      sum.rate += one.rate;
    }
    return sum;
  }
  [[nodiscard]] Waved waved_by(const Travels& travels, std::size_t k, std::size_t j) const {
    const Travel& t = travels[k];
    const double c = waves_[k].cosine[j], s = waves_[k].sine[j];
    return {s * t.cosine + c * t.sine, t.speed * (c * t.cosine - s * t.sine)};
  }
  /// By ball, what the waves add on either race, and the rates of that.
  [[nodiscard]] auto waves_at(const BallRowInputOf<Real>& in) const {
    return [this, travels = travelling(in)](std::size_t j) {
      BallWavesOf<Real> at{Real(0.), Real(0.), Real(0.), Real(0.)};
      for (std::size_t k = 0; k < travels.size(); ++k) {
        const Waved one = waved_by(travels, k, j);
        (waves_[k].on_inner_race ? at.inner : at.outer) += one.added;
        (waves_[k].on_inner_race ? at.inner_rate : at.outer_rate) += one.rate;
      }
      return at;
    };
  }
  [[nodiscard, gnu::always_inline]] inline BallTerms<Real> penetration(const RowPlaceOf<Real>& place, const Real& added,
                                                                       std::size_t j) const {
    return ball_penetration<false, false>(place, Real(cosine_[j]), Real(sine_[j]), added, BallWidening<Real>{});
  }

  void evaluate_massless(const BallRowInputOf<Real>& in, BallRowOutputOf<Real>& out,
                         RowTractionsOf<Real>* tractions) const {
    if (waves_.empty())
      tractions ? sum<true, false>(in, out, tractions) : sum<false, false>(in, out, tractions);
    else
      tractions ? sum<true, true>(in, out, tractions) : sum<false, true>(in, out, tractions);
  }
  void massless_loads(const BallRowInputOf<Real>& in, std::span<Real> load) const {
    const RowPlaceOf<Real> place = row_place(numbers_, in, 2. * in.ball_growth);
    const auto travels = travelling(in);
    for (std::size_t j = 0; j < cosine_.size(); ++j) {
      BallTerms<Real> b = penetration(place, waved(travels, j).added, j);
      press_ball(place, b);
      load[j] = b.F;
    }
  }
  [[nodiscard]] Real massless_energy(const BallRowInputOf<Real>& in) const {
    const RowPlaceOf<Real> place = row_place(numbers_, in, 2. * in.ball_growth);
    const auto travels = travelling(in);
    Real sum = 0.;
    for (std::size_t j = 0; j < cosine_.size(); ++j) {
      const Real delta = penetration(place, waved(travels, j).added, j).delta;
      sum += delta * delta * sqrt(delta);
    }
    return 0.4 * numbers_.stiffness * sum;
  }
  template <bool with_tractions, bool is_wavy>
  void sum(const BallRowInputOf<Real>& in, BallRowOutputOf<Real>& out, RowTractionsOf<Real>* tractions) const {
    const RowPlaceOf<Real> place = row_place(numbers_, in, 2. * in.ball_growth);
    const TractionInputOf<Real> with{numbers_.centrifugal_force(in), numbers_.inner_gyroscopic_share, numbers_.edges};
    const Real zero = 0.;
    ForceSumsOf<Real> forces;
    [[maybe_unused]] TractionSumsOf<Real> traction_sums;
    Real waviness = zero;
    [[maybe_unused]] Travels travels;
    if constexpr (is_wavy) travels = travelling(in);
    for (std::size_t j = 0; j < cosine_.size(); ++j) {
      Waved by_waves{zero, zero};
      if constexpr (is_wavy) by_waves = waved(travels, j);
      BallTerms<Real> b = penetration(place, by_waves.added, j);
      // Where no drop's ball is pressed it adds nothing but the centrifugal force in its outer contact. What is not a number goes on.
      if (!any(!(b.delta <= 0.))) {
        if constexpr (with_tractions) traction_sums.outer += with.F_c;
        continue;
      }
      press_ball(place, b);
      if constexpr (is_wavy) waviness += b.elastic * by_waves.rate;
      if constexpr (with_tractions) traction_sums.add(with, b);
      forces.template add<false>(place, b, Real(cosine_[j]), Real(sine_[j]));
    }
    put<false>(forces, place, numbers_.stiffness_root, out);
    out.waviness_power = waviness;
    if constexpr (with_tractions) put(traction_sums, with, *tractions);
  }

  RowNumbers<Real> numbers_;
  std::vector<double> cosine_, sine_;  // of the balls' azimuths at cage angle zero
  std::vector<Wave> waves_;
  InertialRowInLanes<Real> inertial_;
};

}  // namespace rotordrop
