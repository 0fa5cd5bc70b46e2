#pragma once
#include <filesystem>
#include <functional>

#include "model/section_mesh.h"
#include "model/section_plan.h"

namespace rotordrop {

/// The mesh of a plan, kept by the plan's content.
/// @param folder  of the cache; empty: none
/// @param module  tells one version of the mesh generator from another
/// @param make    asks the generator
SectionMesh kept_mesh(const std::filesystem::path& folder, const std::string& module, const SectionPlan& plan,
                      const std::function<SectionMesh(const SectionPlan&)>& make);

}  // namespace rotordrop
