#pragma once
#include <string>

#include "model/section_mesher.h"

namespace rotordrop {

/// The mesh generator gmsh: one model per call, one thread, silent. Its session lasts as long as this object; there can be only one.
class GmshMesher final : public SectionMesher {
 public:
  GmshMesher();
  ~GmshMesher() override;

  [[nodiscard]] SectionMesh mesh(const SectionPlan& plan) override;
  void write(const SectionMesh& mesh, const std::string& file, MeshFileFormat format) override;
  [[nodiscard]] MeshFileContent read(const std::string& file) override;
};

}  // namespace rotordrop
