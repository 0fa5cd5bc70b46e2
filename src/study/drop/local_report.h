#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

// Local temperature and wear of rotor and bore, for every run: summary, screen.
namespace rotordrop {

class RecordedDrop;
struct TouchdownParameters;

/// The entries `local` and `wear` of a bearing in summary.json, added to it.
void add_local_report(const RecordedDrop& drop, const std::string& bearing, const TouchdownParameters& parameters,
                      nlohmann::ordered_json& summary);
/// Lines for the screen on a bearing's entry of summary.json; empty without a rub.
std::string local_text(const std::string& bearing, const nlohmann::ordered_json& summary);

}  // namespace rotordrop
