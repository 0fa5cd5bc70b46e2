#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "io/hdf5/field_reader.h"

namespace rotordrop {

/// A field as a picture of points on a regular grid.
struct SectionPicture {
  double x_low = 0, x_high = 0, r_low = 0, r_high = 0;  ///< the section's box [m]
  std::size_t columns = 0, rows = 0;
  double low = 0, high = 0;  ///< rises of level 1 and 255 [K]: the smallest and largest of the field
  /// [rows * columns], from the largest radius downwards, along x: 0 outside the section, else 1 + 254 sqrt((rise - low)/(high - low)), rounded: the root shows thin
  /// hot layers and warm bodies at once.
  std::vector<std::uint8_t> levels;
};

/// @param n_points  of the picture, at most; points are as far apart along x as along r
SectionPicture picture_of(const TemperatureField& field, std::size_t n_points);

/// Edges of the bodies as segments x1, r1, x2, r2 [m]: those that belong to one cell alone, or to cells of different bodies.
std::vector<std::array<double, 4>> body_edges(const TemperatureField& field);

}  // namespace rotordrop
