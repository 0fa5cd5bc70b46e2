#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "model/section_mesh.h"
#include "model/section_plan.h"

namespace rotordrop {

/// "inner_ring.strip_1": the name of a part of an outline, as mesh files have it; rows count from 1 there.
std::string boundary_name(const SectionMesh& mesh, const HeatBoundary& boundary);
/// The side and row of "strip_1"; nothing if there is no such side. The body is left at 0.
std::optional<HeatBoundary> boundary_of_name(const std::string& side);

/// What a mesh file holds, before anybody has asked whether it is a section.
struct MeshFileContent {
  struct Element {
    int n_vertices = 0;                      ///< 2: edge, 3: triangle, 4: quadrilateral; others: something else
    std::array<unsigned int, 4> vertices{};  ///< of edges and quadrilaterals
    std::vector<std::string> groups;         ///< physical groups that it is in
  };
  std::vector<std::array<double, 3>> vertices;  ///< x, r, and what should be zero
  std::vector<Element> edges, faces;
};

enum class MeshFileFormat { msh_2_2, msh_4_1 };

/// The mesh generator. Calls must not overlap.
class SectionMesher {
 public:
  SectionMesher() = default;
  SectionMesher(const SectionMesher&) = delete;
  SectionMesher& operator=(const SectionMesher&) = delete;
  virtual ~SectionMesher() = default;

  /// The same plan gives the same mesh to the last bit. @throws SolverError
  [[nodiscard]] virtual SectionMesh mesh(const SectionPlan& plan) = 0;
  /// Physical groups BODY (surfaces) and BODY.SIDE (curves). @throws SolverError
  virtual void write(const SectionMesh& mesh, const std::string& file, MeshFileFormat format) = 0;
  /// A mesh, or a recipe (.geo) that is meshed as it says. @throws SolverError with the generator's words if it cannot read the file, std::bad_alloc
  [[nodiscard]] virtual MeshFileContent read(const std::string& file) = 0;
};

/// What the mesh room's module exports under the name `rotordrop_section_mesher`: one generator, which the module keeps.
using GetSectionMesher = SectionMesher*();
inline constexpr const char* get_section_mesher_name = "rotordrop_section_mesher";

}  // namespace rotordrop
