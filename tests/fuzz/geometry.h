#pragma once
#include "case/case.h"
#include "input.h"

namespace rotordrop::fuzz {

/// Reads a case whose rotor's geometry is the input. @param ending  of the geometry's file, which says what it is
inline void read_as_geometry(const std::uint8_t* data, std::size_t size, const std::string& ending) {
  const auto& file = file_of(data, size, ending);
  static const auto drop_case = [&] {
    const auto made = file.parent_path() / "drop.toml";
    std::ofstream(made) << "[run]\nend_time = 1e-3\ninitial_speed = 100\n[rotor]\ngeometry = \"input" << ending
                        << "\"\n[bearings.A]\ntype = \"linear\"\nnode = 1\nstiffness = [[1e7, 0.0], [0.0, 1e7]]\n";
    return made;
  }();
  allow_refusal([] { static_cast<void>(read_case(drop_case)); });
}

}  // namespace rotordrop::fuzz
