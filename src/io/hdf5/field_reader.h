#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace rotordrop {

/// One file of a series of fields.
struct FieldFile {
  double time = 0;  ///< [s]
  std::filesystem::path file;
};

/// The fields that a series' list (.pvd) names, in its order. @throws InputError if it cannot be read
std::vector<FieldFile> list_fields(const std::filesystem::path& pvd);

/// Temperature over a section, on quadrilaterals. Every cell has points of its own; neighbours' lie at the same places.
struct TemperatureField {
  std::vector<double> x, r;                         ///< of the points [m]
  std::vector<double> rise;                         ///< at the points, over the initial temperature [K]
  std::vector<std::array<std::uint32_t, 4>> cells;  ///< their corners, around
  std::vector<int> body;                            ///< of each cell
};

/// A file that the finite-element room wrote (VTU: base64 of blocks packed by zlib). @throws InputError
TemperatureField read_field(const std::filesystem::path& vtu);

}  // namespace rotordrop
