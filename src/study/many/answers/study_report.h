#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace rotordrop {

/// Everything that the page of a study shows. @throws InputError if the directory holds no study, or none of its points is finished
nlohmann::ordered_json study_report_data(const std::filesystem::path& directory);

/// The study as one HTML page that needs nothing else.
std::string study_report_page(const nlohmann::ordered_json& data);

}  // namespace rotordrop
