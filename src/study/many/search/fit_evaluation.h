#pragma once
#include <Eigen/Dense>
#include <filesystem>
#include <string>
#include <vector>

#include "study/many/evaluate_point.h"
#include "study/many/search/fit_keys.h"
#include "study/many/study_file.h"

namespace rotordrop {

/// Datasets that a study needs of each drop: those that it keeps, and those that were measured.
std::vector<std::string> series_of_study(const Study& study);

/// Path under which a drop keeps what a sensor would have shown of it: "/measured/1".
std::string measured_path(std::size_t k);
/// Replaces measured datasets by what the sensors would have shown, at the times of the measurement. A drop that ends before the last of them fails.
void show_measured(const Study& study, PointResult& result);

/// Computed - measured over the noise's deviation; without one over the deviation of the measured values. Empty if the drop failed.
Eigen::VectorXd residuals_of(const Fit& fit, const std::vector<PointSeries>& series);

/// What was measured, as a table beside a study's results; from there the study can be read again.
void write_measured(const std::vector<Measured>& measured, const std::filesystem::path& directory);
/// The same numbers, if a directory holds them.
void read_measured_of(const std::filesystem::path& directory, std::vector<Measured>& measured);

}  // namespace rotordrop
