#pragma once
#include <string>

#include "machine/machine_parameters.h"
#include "model/section_mesher.h"
#include "model/section_plan.h"

/// Data of the meshed section of a touchdown bearing, from the parameters of a case.
namespace rotordrop {

/// The plan of a bearing's section. @throws InputError if its dimensions cannot be meshed
SectionPlan section_plan(const MachineParameters& parameters, const Node& case_node, const std::string& bearing);

/// A user's mesh as a bearing's section. @throws InputError with all that does not fit the bearing
SectionMesh own_section_of_bearing(const MeshFileContent& content, const MachineParameters& parameters,
                                   const std::string& bearing, const std::string& file);

}  // namespace rotordrop
