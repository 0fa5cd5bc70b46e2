#include "study/heat/heat_balance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "model/run_warning.h"
#include "study/drop/warning_summary.h"
#include "study/json_number.h"

namespace rotordrop {
namespace {

using Json = nlohmann::ordered_json;

double number(const Json& balance, const char* key) {
  return balance[key].is_number() ? balance[key].get<double>() : std::nan("");
}

}  // namespace

Json heat_balance(double input, double stored, double lost) {
  return {{"input", json_number(input)},
          {"stored", json_number(stored)},
          {"lost", json_number(lost)},
          {"residual", json_number(input - stored - lost)}};
}

std::string heat_balance_text(const std::string& of, const Json& balance) {
  return fmt::format("Energy{}: {:.6g} J in, {:.6g} J stored, {:.6g} J lost, residual {:.1e} J\n", of,
                     number(balance, "input"), number(balance, "stored"), number(balance, "lost"),
                     number(balance, "residual"));
}

Json heat_balance_warnings(const std::string& model, const Json& balance) {
  const double residual = std::fabs(number(balance, "residual"));
  double all = 0.;
  for (const char* key : {"input", "stored", "lost"}) all = std::max(all, std::fabs(number(balance, key)));
  if (residual <= residual_limit * all) return Json::array();
  RunWarning warning;
  warning.kind = find_warning_kind("heat-residual");
  warning.part = model;
  warning.worst = residual / all;
  warning.limit = residual_limit;
  Json list = warnings_json({warning});
  list[0]["text"] =
      fmt::format("{:.2g} % of the heat{} is not accounted for (limit {:.2g} %)", 100. * warning.worst,
                  model.empty() ? "" : fmt::format(" of the thermal model \"{}\"", model), 100. * warning.limit);
  return list;
}

}  // namespace rotordrop
