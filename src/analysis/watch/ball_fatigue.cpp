#include "analysis/watch/ball_fatigue.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "bearing/touchdown_bearing.h"

namespace rotordrop {
namespace {

std::vector<RatedRow> rated_rows(const TouchdownBearing& bearing, double C) {
  const auto& rows = bearing.data().rows;
  std::vector<RatedRow> rated;
  for (const auto& row : rows)
    rated.push_back({row.n_balls, row.ball_diameter, row.pitch_diameter, row.contact_angle,
                     rating_of_row(C, static_cast<int>(rows.size())), row.inner_conformity, row.outer_conformity});
  return rated;
}

std::string name_of(const std::string& bearing, std::size_t race, const char* what, std::size_t i) {
  return fmt::format("fatigue/{}/{}{} {}", bearing, race == 0 ? "" : "outer race, ", what, i + 1);
}

}  // namespace

LoadCycles LoadCycles::finished() const {
  LoadCycles all = *this;
  open_.finish(all);
  return all;
}

void LoadCycles::operator()(double range, double cycles) {
  static_assert(load_life_exponent == 3.);
  sum_ += cycles * range * range * range;
  largest_ = std::max(largest_, range);
}

std::vector<double> LoadCycles::packed() const {
  std::vector<double> values = {sum_, largest_};
  values.insert(values.end(), open_.open().begin(), open_.open().end());
  return values;
}

void LoadCycles::unpack(const std::vector<double>& from) {
  if (from.size() < 2) throw std::invalid_argument("load cycles of another kind");
  sum_ = from[0];
  largest_ = from[1];
  open_.set_open({from.begin() + 2, from.end()});
}

void OverTurns::follow(double t, double of_all, double speed) {
  const double rate = of_all * std::fabs(speed) / (2. * std::numbers::pi);
  if (std::isfinite(time_)) sum_ += 0.5 * (rate_ + rate) * (t - time_);
  rate_ = rate;
  time_ = t;
}

void OverTurns::unpack(const std::vector<double>& from) {
  if (from.size() != 3) throw std::invalid_argument("rolling of another kind");
  sum_ = from[0];
  rate_ = from[1];
  time_ = from[2];
}

BallFatigue::BallFatigue(const Machine& machine, const MachineParameters& parameters) {
  for (std::size_t i = 0; i < machine.n_supports(); ++i) {
    const auto* touchdown = dynamic_cast<const TouchdownBearing*>(&machine.support(i));
    const auto detail = [&](const char* name) {
      return column_of(machine.detail_observables(), machine.support(i).results_path() + name);
    };
    const auto inner = detail("/ball_loads"), outer = detail("/outer_ball_loads");
    const auto ring_speed = column_of(machine.step_observables(), machine.support(i).results_path() + "/ring_speed");
    if (!touchdown || !inner || !ring_speed) continue;
    for (const auto& entry : parameters.bearings) {
      if (entry.name != touchdown->name() || !entry.touchdown() || !entry.touchdown()->C) continue;
      Bearing b;
      b.name = entry.name;
      b.rating = *entry.touchdown()->C;
      b.ring_speed = *ring_speed;
      b.rows = rated_rows(*touchdown, b.rating);
      std::size_t n_balls = 0;
      for (const auto& row : b.rows) n_balls += static_cast<std::size_t>(row.n_balls);
      for (const auto& column : {inner, outer})
        if (column)
          b.races.push_back({*column, std::vector<OverTurns>(b.rows.size()), std::vector<LoadCycles>(n_balls)});
      bearings_.push_back(std::move(b));
    }
  }
}

void BallFatigue::step(const Step& step) {
  if (!step.is_observed) return;
  for (Bearing& b : bearings_)
    for (Race& race : b.races) {
      const double* load = &step.found->details[race.column];
      for (std::size_t j = 0; j < race.balls.size(); ++j) race.balls[j].follow(load[j]);
      for (std::size_t row = 0; row < b.rows.size(); ++row) {
        double of_all = 0.;
        for (int j = 0; j < b.rows[row].n_balls; ++j, ++load) of_all += *load * *load * *load;
        race.rolling[row].follow(step.time, of_all, step.found->step[b.ring_speed]);
      }
    }
}

std::optional<FatigueShare> BallFatigue::of(const std::string& bearing) const {
  for (const Bearing& b : bearings_) {
    if (b.name != bearing) continue;
    FatigueShare found;
    found.rating = b.rating;
    double worst_ball = 0.;
    std::size_t first_ball = 0;
    for (std::size_t i = 0; i < b.rows.size(); ++i) {
      const RatedRow& row = b.rows[i];
      std::vector<double> by_cycles, by_rolling;  // of each race
      for (const Race& race : b.races) {
        double sum = 0.;
        for (int j = 0; j < row.n_balls; ++j) {
          const LoadCycles cycles = race.balls[first_ball + static_cast<std::size_t>(j)].finished();
          sum += cycles.sum_of_cubes();
          found.load_over_rating = std::max(found.load_over_rating, cycles.largest() / ball_load_at_rating(row));
          if (&race != &b.races.front()) continue;
          found.largest_cycle = std::max(found.largest_cycle, cycles.largest());
          worst_ball = std::max(worst_ball, cycles.sum_of_cubes());
        }
        by_cycles.push_back(life_share(row, sum));
        by_rolling.push_back(life_share(row, cycles_of_rolling(row, race.rolling[i].integral())));
      }
      first_ball += static_cast<std::size_t>(row.n_balls);
      const auto of_races = [&](const std::vector<double>& shares) {
        return shares.size() > 1 ? of_both_races(row, shares[0], shares[1]) : shares[0];
      };
      found.by_cycles = together(found.by_cycles, of_races(by_cycles));
      found.by_rolling = together(found.by_rolling, of_races(by_rolling));
      found.rows.push_back(std::max(of_races(by_cycles), of_races(by_rolling)));
      found.share = together(found.share, found.rows.back());
    }
    const double largest = found.largest_cycle;
    if (largest > 0.) found.equivalent_cycles = worst_ball / (largest * largest * largest);
    return found;
  }
  return {};
}

void BallFatigue::pack(PackedValues& to) const {
  for (const Bearing& b : bearings_)
    for (std::size_t k = 0; k < b.races.size(); ++k) {
      const Race& race = b.races[k];
      for (std::size_t j = 0; j < race.balls.size(); ++j) to[name_of(b.name, k, "ball", j)] = race.balls[j].packed();
      for (std::size_t j = 0; j < race.rolling.size(); ++j) to[name_of(b.name, k, "row", j)] = race.rolling[j].packed();
    }
}

void BallFatigue::unpack(const PackedValues& from) {
  for (Bearing& b : bearings_)
    for (std::size_t k = 0; k < b.races.size(); ++k) {
      Race& race = b.races[k];
      for (std::size_t j = 0; j < race.balls.size(); ++j) race.balls[j].unpack(from.at(name_of(b.name, k, "ball", j)));
      for (std::size_t j = 0; j < race.rolling.size(); ++j)
        race.rolling[j].unpack(from.at(name_of(b.name, k, "row", j)));
    }
}

}  // namespace rotordrop
