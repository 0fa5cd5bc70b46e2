#pragma once
#include <vector>

#include "base/gather.h"
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
        is_radial_(rows.front()->is_radial()),
        inertial_(rows) {
    std::vector<const RowNumbers<double>*> numbers;
    for (const BallRow* row : rows) numbers.push_back(&row->numbers());
    numbers_ = gathered<RowNumbers, Real>(numbers);
    for (const RaceWaves::Wave& wave : rows.front()->waves().list()) {
      const auto of_all = [&, k = waves_.size()](double RaceWave::*number) {
        return side_by_side<Real>(rows.size(), [&](std::size_t i) { return rows[i]->waves().list()[k].form.*number; });
      };
      waves_.push_back({wave.form, of_all(&RaceWave::amplitude), of_all(&RaceWave::phase), wave.sine, wave.cosine, {}});
    }
  }
  [[nodiscard]] const RowNumbers<Real>& numbers() const { return numbers_; }
  [[nodiscard]] std::size_t n_balls() const { return cosine_.size(); }

  void evaluate_translations(const BallRowInputOf<Real>& in, BallRowOutputOf<Real>& out,
                             RowTractionsOf<Real>* tractions) const {
    if (!inertial_.has_inertia()) return evaluate_massless(in, out, tractions);
    const Turning turning(numbers_, in);
    if (any(turning.is)) inertial_.evaluate(numbers_, in, turning, passed_waves(in), !waves_.empty(), out, tractions);
    const MaskOf<Real> stands = !turning.is;
    if (!any(stands)) return;
    BallRowOutputOf<Real> still;
    RowTractionsOf<Real> still_tractions;
    evaluate_massless(in, still, tractions ? &still_tractions : nullptr);
    out = select_all(stands, still, out);
    if (tractions) *tractions = select_all(stands, still_tractions, *tractions);
  }
  /// @param outer_load  of balls with inertia
  void ball_loads(const BallRowInputOf<Real>& in, std::span<Real> load, std::span<Real> outer_load = {}) const {
    if (!inertial_.has_inertia()) return massless_loads(in, load);
    const Turning turning(numbers_, in);
    if (any(turning.is))
      inertial_.ball_loads(numbers_, in, turning, passed_waves(in), !waves_.empty(), load, outer_load);
    const MaskOf<Real> stands = !turning.is;
    if (!any(stands)) return;
    std::vector<Real> still(load.size());
    massless_loads(in, still);
    for (std::size_t j = 0; j < load.size(); ++j) {
      load[j] = select(stands, still[j], load[j]);
      outer_load[j] = select(stands, still[j], outer_load[j]);
    }
  }
  [[nodiscard]] Real energy(const BallRowInputOf<Real>& in) const {
    if (!inertial_.has_inertia()) return massless_energy(in);
    const Turning turning(numbers_, in);
    Real energy = 0.;
    if (any(turning.is)) energy = inertial_.energy(numbers_, in, turning, passed_waves(in), !waves_.empty());
    const MaskOf<Real> stands = !turning.is;
    return any(stands) ? select(stands, massless_energy(in), energy) : energy;
  }

 private:
  using Turning = typename InertialRowInLanes<Real>::Turning;
  struct Wave {
    RaceWave form;  // of the first drop
    Real amplitude, phase;
    AlignedNumbers sine, cosine;  // as in RaceWaves
    PassedWaveOf<Real> now;       // at the instant that is being evaluated
  };
  /// Brings the waves to an instant.
  void pass(const BallRowInputOf<Real>& in) const {
    for (Wave& w : waves_) w.now = {w.form, w.amplitude, w.phase, in};
  }
  /// What they add there at a ball.
  [[nodiscard, gnu::always_inline]] inline BallWavesOf<Real> waves_at(std::size_t j) const {
    BallWavesOf<Real> at{Real(0.), Real(0.), Real(0.), Real(0.)};
    for (const Wave& w : waves_) {
      (w.form.on_inner_race ? at.inner : at.outer) += w.now.wave.height(w.sine[j], w.cosine[j]);
      (w.form.on_inner_race ? at.inner_rate : at.outer_rate) += w.now.speed * w.now.wave.slope(w.sine[j], w.cosine[j]);
    }
    return at;
  }
  [[nodiscard]] auto passed_waves(const BallRowInputOf<Real>& in) const {
    pass(in);
    return [this](std::size_t j) { return waves_at(j); };
  }
  template <GrooveMotion motion = GrooveMotion::translating>
  [[nodiscard, gnu::always_inline]] inline BallTerms<Real> penetration(const RowPlaceOf<Real>& place, const Real& added,
                                                                       std::size_t j) const {
    return ball_penetration<motion, false>(place, Real(cosine_[j]), Real(sine_[j]), added, BallWidening<Real>{});
  }

  void evaluate_massless(const BallRowInputOf<Real>& in, BallRowOutputOf<Real>& out,
                         RowTractionsOf<Real>* tractions) const {
    is_radial_ ? sum<GrooveMotion::in_plane>(in, out, tractions) : sum<GrooveMotion::translating>(in, out, tractions);
  }
  template <GrooveMotion motion>
  void sum(const BallRowInputOf<Real>& in, BallRowOutputOf<Real>& out, RowTractionsOf<Real>* tractions) const {
    if (waves_.empty())
      tractions ? sum<motion, true, false>(in, out, tractions) : sum<motion, false, false>(in, out, tractions);
    else
      tractions ? sum<motion, true, true>(in, out, tractions) : sum<motion, false, true>(in, out, tractions);
  }
  void massless_loads(const BallRowInputOf<Real>& in, std::span<Real> load) const {
    const RowPlaceOf<Real> place = row_place(numbers_, in, 2. * in.ball_growth);
    pass(in);
    for (std::size_t j = 0; j < cosine_.size(); ++j) {
      BallTerms<Real> b = penetration(place, waves_at(j).added(), j);
      press_ball(place, b);
      load[j] = b.F;
    }
  }
  [[nodiscard]] Real massless_energy(const BallRowInputOf<Real>& in) const {
    const RowPlaceOf<Real> place = row_place(numbers_, in, 2. * in.ball_growth);
    pass(in);
    Real sum = 0.;
    for (std::size_t j = 0; j < cosine_.size(); ++j) {
      const Real delta = penetration(place, waves_at(j).added(), j).delta;
      sum += delta * delta * sqrt(delta);
    }
    return 0.4 * numbers_.stiffness * sum;
  }
  template <GrooveMotion motion, bool with_tractions, bool is_wavy>
  void sum(const BallRowInputOf<Real>& in, BallRowOutputOf<Real>& out, RowTractionsOf<Real>* tractions) const {
    const RowPlaceOf<Real> place = row_place(numbers_, in, 2. * in.ball_growth);
    const TractionInputOf<Real> with{numbers_.centrifugal_force(in), numbers_.inner_gyroscopic_share, numbers_.edges};
    const Real zero = 0.;
    ForceSumsOf<Real> forces;
    [[maybe_unused]] TractionSumsOf<Real> traction_sums;
    Real waviness = zero;
    if constexpr (is_wavy) pass(in);
    for (std::size_t j = 0; j < cosine_.size(); ++j) {
      BallWavesOf<Real> by_waves{zero, zero, zero, zero};
      if constexpr (is_wavy) by_waves = waves_at(j);
      BallTerms<Real> b = penetration<motion>(place, by_waves.added(), j);
      // Where no drop's ball is pressed it adds nothing but the centrifugal force in its outer contact. What is not a number goes on.
      if (!any(!(b.delta <= 0.))) {
        if constexpr (with_tractions) traction_sums.outer += with.F_c;
        continue;
      }
      press_ball(place, b);
      if constexpr (is_wavy) waviness += b.elastic * by_waves.rate();
      if constexpr (with_tractions) traction_sums.template add<motion>(with, b);
      forces.template add<motion>(place, b, Real(cosine_[j]), Real(sine_[j]));
    }
    put<false>(forces, place, numbers_.stiffness_root, out);
    out.waviness_power = waviness;
    if constexpr (with_tractions) put(traction_sums, with, *tractions);
  }

  RowNumbers<Real> numbers_;
  std::vector<double> cosine_, sine_;  // of the balls' azimuths at cage angle zero
  bool is_radial_ = false;
  mutable std::vector<Wave> waves_;
  InertialRowInLanes<Real> inertial_;
};

}  // namespace rotordrop
