#include "study/drop/drop_fields.h"

#include <algorithm>

namespace rotordrop {

static constexpr double rounding = 1e-9;

DropFields::DropFields(const std::filesystem::path& directory, FiniteElements& elements, const FeParameters& parameters,
                       double start)
    : elements_(elements), times_(parameters.field_times, parameters.field_interval.value_or(0.)) {
  if (times_.empty()) return;
  double last = -1.;
  for (const auto& section : elements.sections) {
    series_.emplace_back(directory / "fields", section.name, start > 0. ? start : -1.);
    last = series_.back().empty() ? -1. : series_.back().last_time();
  }
  if (!series_.empty())
    next_ = times_.after(last * (1. + rounding));  // a window's end may lie a bit before the time it stands for
}

bool DropFields::is_due(double t) const { return next_ <= t * (1. + rounding); }

void DropFields::write(double t) {
  for (std::size_t k = 0; k < elements_.sections.size(); ++k)
    series_[k].add(t, [&](const std::string& file) { elements_.sections[k].solver->write_vtu(file); });
  next_ = times_.after(std::max(t, next_));
}

}  // namespace rotordrop
