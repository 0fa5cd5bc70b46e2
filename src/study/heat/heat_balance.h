#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace rotordrop {

/// The heat balance of a computation of heat in its summary: input, stored, lost and residual [J].
nlohmann::ordered_json heat_balance(double input, double stored, double lost);

/// "Energy, fe: 5 J in, ..." as a line. @param of  ", fe", or nothing; @param balance  as heat_balance() makes it
std::string heat_balance_text(const std::string& of, const nlohmann::ordered_json& balance);

/// A warning "heat-residual", as those of a drop's summary, where more than 0.1 % of the largest of input, stored and lost is not accounted for: a list of
/// one or none. @param model  whose balance it is; empty where there is one alone
nlohmann::ordered_json heat_balance_warnings(const std::string& model, const nlohmann::ordered_json& balance);

}  // namespace rotordrop
