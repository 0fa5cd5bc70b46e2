#include "cache/kept_mesh.h"

#include "cache/kept_values.h"
#include "io/sha256.h"

namespace rotordrop {

SectionMesh kept_mesh(const std::filesystem::path& folder, const std::string& module, const SectionPlan& plan,
                      const std::function<SectionMesh(const SectionPlan&)>& make) {
  if (folder.empty()) return make(plan);
  KeptValues values(folder, sha256_of(module + "\nmesh\n" + plain::digest_of(plan)));
  return values.get<SectionMesh>("mesh", [&] { return make(plan); });
}

}  // namespace rotordrop
