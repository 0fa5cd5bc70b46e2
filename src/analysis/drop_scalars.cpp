#include "analysis/drop_scalars.h"

#include <algorithm>
#include <cmath>

#include "analysis/watch/packed_numbers.h"

namespace rotordrop {
DropScalars::DropScalars(const Machine& machine) : probes_(machine), supports_(machine) {
  const auto& list = machine.step_observables();
  for (std::size_t i = 0; i < machine.n_supports(); ++i) {
    const std::string& name = machine.support(i).name();
    const auto ball_force = columns_of(list, Observed::ball_force, name);
    if (!ball_force) continue;  // not a touchdown bearing
    const auto column_of_free = [&](Observed kind) -> std::optional<std::size_t> {
      const auto found = columns_of(list, kind, name);
      return found ? std::optional(found->first) : std::nullopt;
    };
    const auto column = [&](Observed kind) { return column_of_free(kind).value(); };
    names_.push_back(name);
    columns_.push_back({i,
                        column(Observed::orbit),
                        touch_columns(list, name).value(),
                        column(Observed::contact_force),
                        column(Observed::rub_heat_rate),
                        column(Observed::spin_lag),
                        column(Observed::load_torque),
                        column(Observed::spin_torque),
                        column(Observed::inner_heat_rate),
                        column(Observed::outer_heat_rate),
                        column(Observed::ring_speed),
                        ball_force->first,
                        column(Observed::contact_pressure),
                        ball_force->size,
                        column(Observed::clearance),
                        column(Observed::growth),
                        column(Observed::preload),
                        column(Observed::skid_demand),
                        column(Observed::gyroscopic_demand),
                        column(Observed::centrifugal_force),
                        column(Observed::ellipse_truncation),
                        column_of_free(Observed::axial_force),
                        column_of_free(Observed::axial_position)});
  }
  scalars_.resize(columns_.size());
}

void DropScalars::step(const Step& step) {
  if (step.is_observed) follow(step.time, step.found->step);
}

void DropScalars::follow(double t, std::span<const double> step) {
  if (!are_followed_elsewhere_)
    for (std::size_t i = 0; i < columns_.size(); ++i) rotordrop::follow(scalars_[i], columns_[i], true, t, step);
  probes_.follow(t, step);
  supports_.follow(t, step);
}

SkidVerdict skid_verdict(const BearingScalars& s, std::size_t n_rows) {
  SkidVerdict verdict;
  bool all_loaded = true;
  for (std::size_t row = 0; row < n_rows; ++row) {
    if (s.row_centrifugal[row].loaded_share() < relevant_loaded_share) {
      all_loaded = false;
      continue;
    }
    if (verdict.row && s.row_skid[row].speed_change_beyond <= verdict.demand.speed_change_beyond) continue;
    verdict.row = row;
    verdict.demand = s.row_skid[row];
  }
  if (all_loaded) verdict.demand = s.skid;
  return verdict;
}

double DropScalars::largest_contact_force() const {
  double largest = 0.;
  for (const auto& s : scalars_) {
    largest = std::max(largest, s.contact_force.value);
    if (std::isfinite(s.first_shoulder_contact_time))
      largest = std::max({largest, s.shoulder_force.largest, -s.shoulder_force.smallest});
  }
  return largest;
}

void DropScalars::pack(PackedValues& to) const {
  for (std::size_t i = 0; i < scalars_.size(); ++i) {
    BearingScalars s = scalars_[i];
    s.each([&](const std::string& name, const auto& numbers) {
      to["scalars/" + names_[i] + "/" + name] = packed_numbers(numbers);
    });
  }
  probes_.pack(to);
  supports_.pack(to);
}

void DropScalars::unpack(const PackedValues& from) {
  for (std::size_t i = 0; i < scalars_.size(); ++i)
    scalars_[i].each([&](const std::string& name, const auto& numbers) {
      unpack_numbers(from.at("scalars/" + names_[i] + "/" + name), numbers);
    });
  probes_.unpack(from);
  supports_.unpack(from);
}

}  // namespace rotordrop
