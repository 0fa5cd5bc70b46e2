#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "machine/heat/bore_history.h"
#include "study/rub/impact.h"

namespace rotordrop {

/// Temperatures of one bore, for series [K]; NaN where there is none.
struct BoreTemperatures {
  std::string bearing;
  BoreHistory history;
  std::vector<double> node, mean, local, flash, rotor_flash;  ///< [n_rows]
};

struct BoreReport {
  nlohmann::ordered_json report;  ///< docs/reference/results.md
  BoreTemperatures temperatures;
};
/// One thermal model of one run, or of none.
struct ModelOfRun {
  const RecordedDrop* drop = nullptr;
  const ThermalKind* kind = nullptr;
  explicit operator bool() const { return drop != nullptr; }
};

/// Paths of the series that rub_record() reads.
std::vector<std::string> series_of_rub(const std::string& bearing);
/// The rub of a bearing as recorded by a drop.
RubRecord rub_record(const RecordedDrop& drop, const std::string& bearing);

/// The rub of a bearing and what it heats. bore_history() of both needs nothing else, and may run beside whatever reads the drop.
struct RubbedBore {
  RubRecord rub;
  RubSurfaces surfaces;
};
/// @param band_length  of the rub along the surface [m]; none: the case's
RubbedBore rubbed_bore(const std::string& bearing, const TouchdownParameters& parameters, const RecordedDrop& drop,
                       const std::optional<double>& band_length);

/// Local temperatures of a bearing's bore from the rub that a drop recorded.
/// @param history  that of `rubbed`
/// @param circuit, section  models that give the inner ring and the mean around the bore; may be of no run
BoreReport report_bore(const std::string& bearing, const TouchdownParameters& parameters, const RecordedDrop& drop,
                       const RubbedBore& rubbed, BoreHistory history, const ModelOfRun& circuit,
                       const ModelOfRun& section, const Impact& impact, const std::vector<Instant>& instants);

}  // namespace rotordrop
