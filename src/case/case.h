#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "analysis/output_parameters.h"
#include "base/parameters/declaration.h"
#include "case/limits.h"
#include "integrate/integration_parameters.h"
#include "io/text/parameter_writers.h"
#include "machine/machine_parameters.h"
#include "thermal/heating/prescribed_heat_parameters.h"

namespace rotordrop {

/// All parameters of a case.
struct CaseParameters : MachineParameters {
  std::optional<std::string> title, note;        ///< the user's words about the case, for its readers
  std::optional<PrescribedHeatParameters> heat;  ///< of `rotordrop heat` alone
  IntegrationParameters integration;
  OutputParameters output;
  std::vector<Limit> limits;
};

/// A case as read, checked and completed.
struct Case {
  std::filesystem::path file;
  std::string name;  ///< the file's name without its ending
  Node tree;         ///< with its bases, bearings' catalogue data, rotor geometry and overrides merged in
  CaseParameters parameters;
  ResolvedParameters resolved;
  std::vector<Fault> warnings;  ///< what is allowed but unusual, most often a slip
};

/// Reads and checks a case. @throws InputError with all faults
/// @param overrides  such as "contact.friction_coefficient=0.05"
Case read_case(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// Names of the touchdown bearings that an option --bearing takes: the one it names, or all if it is empty.
/// @throws InputError for a name that none has
std::vector<std::string> chosen_touchdowns(const Case& c, const std::string& bearing);

/// The declarations of a case file, for defaults, schema and resolved parameters.
std::vector<ErasedSection> case_sections();

}  // namespace rotordrop
