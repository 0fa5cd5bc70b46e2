#pragma once

// The case of a bearing under given heat: read, checked and built.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "case/case.h"
#include "machine/build_machine.h"
#include "study/heat/heated_bearing.h"

namespace rotordrop {

/// A touchdown bearing of a drop's case under given heat (`rotordrop heat`, table [heat]), as read, checked and built.
struct BearingHeatCase {
  Case drop;  ///< thermal.models are those of [heat]
  std::string bearing;
  BearingHeatHistory history;
  double end_time = 0;               ///< [s]
  std::vector<double> output_times;  ///< rising; end_time is the last of them
  FiniteElements elements;
  std::optional<BallConduction> ball_conduction;  ///< given; none: R5
  ThermalParts parts;
  struct Model {
    std::string name;  ///< of its kind
    std::unique_ptr<HeatedBearing> heated;
  };
  std::vector<Model> models;
  struct Probe {
    std::string name;
    std::size_t model = 0;
    std::optional<std::size_t> node;       ///< among the model's names
    std::optional<HeatBoundary> boundary;  ///< of its section
    std::size_t body = 0;                  ///< otherwise a point of it
    double x = 0, r = 0;
  };
  std::vector<Probe> probes;
};

/// Whether a case of heat alone is one of a drop's bearing. @throws InputError if it cannot be read
bool is_bearing_heat_case(const std::filesystem::path& file);

/// Reads, checks and builds. @throws InputError with all faults
std::unique_ptr<BearingHeatCase> read_bearing_heat_case(const std::filesystem::path& file,
                                                        const std::vector<std::string>& overrides = {});

/// Describes a case in a few lines.
std::string bearing_heat_case_text(const BearingHeatCase& heat_case);
/// That the case's limits are not assessed; empty if it has none.
std::string limits_left_out_text(const BearingHeatCase& heat_case);

}  // namespace rotordrop
