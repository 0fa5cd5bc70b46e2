#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "bearing/touchdown_parameters.h"
#include "study/recorded_drop.h"

namespace rotordrop {

/// Checks of a run and their results, in the order of the page.
class Checks {
 public:
  void add(const std::string& name, bool is_good, const std::string& text) {
    list_.push_back({{"name", name}, {"state", is_good ? "ok" : "warning"}, {"text", text}});
  }
  void unknown(const std::string& name, const std::string& text) {
    list_.push_back({{"name", name}, {"state", "unknown"}, {"text", text}});
  }
  /// The stated value is within its limit, its bounds are not.
  void uncertain(const std::string& name, const std::string& text) {
    list_.push_back({{"name", name}, {"state", "uncertain"}, {"text", text}});
  }
  [[nodiscard]] nlohmann::ordered_json take() { return std::move(list_); }

 private:
  nlohmann::ordered_json list_ = nlohmann::ordered_json::array();
};

// Load and pressure of a bearing (load_checks.cpp). @param summary  may be null
void check_load(Checks& checks, const RecordedDrop& drop, const std::string& name, const TouchdownParameters& b);
void check_pressure(Checks& checks, const RecordedDrop& drop, const nlohmann::ordered_json& summary,
                    const std::string& name, const TouchdownParameters& b);

}  // namespace rotordrop
