#pragma once
#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "study/recorded_drop.h"
#include "study/report/decimation.h"
#include "study/report/packed.h"
#include "study/report/rounded.h"

namespace rotordrop {

/// How a line is drawn: the page has a palette and dash patterns, each taken from the beginning again at its end.
struct LineStyle {
  std::size_t colour = 0, dash = 0;
};

/// Figures of time series as they are made, one after the other.
class Charts {
 public:
  explicit Charts(const RecordedDrop& drop) : drop_(drop) {
    for (const auto& entry : drop.parameters().bearings) names_.push_back(entry.name);
    end_ = drop.series("/energy/mechanical").times.back();
    // Points of all lines together stay near 10^5, a few megabytes.
    n_buckets_ = std::clamp<std::size_t>(3000 / std::max<std::size_t>(names_.size(), 1), 100, 500);
  }

  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  [[nodiscard]] nlohmann::ordered_json take() { return std::move(charts_); }

  /// Begins a figure; one that gets no line is left out.
  Charts& figure(const std::string& id, const std::string& section, const std::string& title,
                 const std::string& quantity, const std::string& unit, const std::string& note = "") {
    drop_empty();
    const bool is_short = end_ < 2.;
    charts_.push_back({{"id", id},
                       {"section", section},
                       {"title", title},
                       {"x", {{"label", "time"}, {"unit", is_short ? "ms" : "s"}}},
                       {"y", {{"label", quantity}, {"unit", unit}}},
                       {"note", note},
                       {"lines", nlohmann::ordered_json::array()}});
    time_scale_ = is_short ? 1e3 : 1.;
    return *this;
  }

  void line(const std::string& name, TimeSeries s, double scale, LineStyle style, double offset = 0.) {
    for (double& v : s.values) v -= offset;
    nlohmann::ordered_json line = {{"name", name}, {"colour", style.colour}, {"dash", style.dash}};
    const bool is_long = s.values.size() > 2 * n_buckets_ + 2;
    if (is_long && s.values.size() <= samples_left_) {
      samples_left_ -= s.values.size();
      line["axis"] = axis_of(s.times);
      line.update(packed(s.values, scale));
    } else {
      const TimeSeries few = decimated(s, n_buckets_);
      line["x"] = rounded(few.times, time_scale_, 6);
      line["y"] = rounded_to_range(few.values, scale);
      if (is_long) line["span"] = time_scale_ * (s.times.back() - s.times.front()) / static_cast<double>(n_buckets_);
    }
    charts_.back()["lines"].push_back(std::move(line));
  }

  /// A recorded quantity, if the run has it.
  void recorded(const std::string& path, const std::string& name, double scale, LineStyle style, std::size_t column = 0,
                double offset = 0.) {
    if (drop_.has(path)) line(name, drop_.series(path, column), scale, style, offset);
  }

  /// The same quantity of every support, each in its colour.
  void of_supports(const std::string& dataset, const std::string& name, double scale, std::size_t dash = 0,
                   std::size_t column = 0, double offset = 0.) {
    for (std::size_t i = 0; i < names_.size(); ++i)
      recorded("/bearings/" + names_[i] + "/" + dataset, names_[i] + (name.empty() ? "" : " ") + name, scale, {i, dash},
               column, offset);
  }

  /// Between two columns of a surface's table, behind the lines.
  void band(const std::string& path, LineStyle style, double scale, double offset) {
    nlohmann::ordered_json band = {{"colour", style.colour}};
    for (const auto& [key, column] : {std::pair{"low", 1}, std::pair{"high", 2}}) {
      TimeSeries s = drop_.series(path, static_cast<std::size_t>(column));
      for (double& v : s.values) v -= offset;
      const TimeSeries few = decimated(s, n_buckets_ / 2);
      band[key] = {{"x", rounded(few.times, time_scale_, 6)}, {"y", rounded(few.values, scale)}};
    }
    charts_.back()["bands"].push_back(std::move(band));
  }

  /// Begins a figure of force over travel.
  void over_itself(const std::string& id, const std::string& section, const std::string& title,
                   const std::string& note) {
    figure(id, section, title, "force", "kN", note);
    charts_.back()["x"] = {{"label", "travel"}, {"unit", "um"}};
  }
  void pairs(const std::string& name, const TimeSeries& travel, const TimeSeries& force, LineStyle style) {
    constexpr std::size_t most = 4000;
    std::vector<double> x, y;
    const std::size_t n = std::min(travel.values.size(), force.values.size());
    for (std::size_t k = 0; k < n; k += std::max<std::size_t>(n / most, 1)) {
      x.push_back(travel.values[k]);
      y.push_back(force.values[k]);
    }
    charts_.back()["lines"].push_back({{"name", name},
                                       {"colour", style.colour},
                                       {"dash", style.dash},
                                       {"x", rounded(x, 1e6)},
                                       {"y", rounded(y, 1e-3)}});
  }

  void drop_empty() {
    if (!charts_.empty() && charts_.back()["lines"].empty()) charts_.erase(charts_.size() - 1);
  }

  /// Times that lines share, packed.
  [[nodiscard]] nlohmann::ordered_json axes() const {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const auto& times : axes_) list.push_back(packed_floats(times, time_scale_));
    return list;
  }

 private:
  std::size_t axis_of(const std::vector<double>& times) {
    const auto found = std::find(axes_.begin(), axes_.end(), times);
    if (found != axes_.end()) return static_cast<std::size_t>(found - axes_.begin());
    axes_.push_back(times);
    return axes_.size() - 1;
  }

  const RecordedDrop& drop_;
  std::vector<std::vector<double>> axes_;
  std::size_t samples_left_ = 750'000;  ///< two megabytes
  std::vector<std::string> names_;
  nlohmann::ordered_json charts_ = nlohmann::ordered_json::array();
  double end_ = 0, time_scale_ = 1;
  std::size_t n_buckets_ = 500;
};

}  // namespace rotordrop
