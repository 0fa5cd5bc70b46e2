#pragma once
#include <optional>
#include <string>
#include <vector>

#include "model/section_plan.h"

namespace rotordrop {

/// Points closer than this along a side are one [m].
inline constexpr double same_place = 1e-9;

/// Cells along a curve.
struct Division {
  int cells = 1;
  double ratio = 1;  ///< of neighbours
};

/// Sizes of cells as they are used, after refinement [m].
struct CellSizes {
  double surface, largest, growth, strip;
};

/// Cells from `first` on, growing by no more than `growth` to no more than `largest`.
Division graded(double length, double first, double growth, double largest);

/// Cells between wanted sizes at both ends.
Division between_sizes(double length, double at_start, double at_end);

/// The same cells from the other end.
inline Division reversed(Division d) { return {d.cells, 1. / d.ratio}; }

/// Size of the first cell [m].
double first_cell(double length, Division d);
/// Size of the last cell [m].
inline double last_cell(double length, Division d) { return first_cell(length, reversed(d)); }

/// Columns of one body that follow those of another over their common length.
struct Columns {
  std::vector<double> x;  ///< [n_columns + 1]
  std::vector<Division> divisions;
};

/// A range of radii, and cells across it.
struct Layer {
  double from, to;  ///< [m]
  Division upwards;
};

/// Adds points and curves once each, and blocks.
class SectionBuilder {
 public:
  SectionPlan plan;

  std::size_t body(const std::string& name);
  std::size_t point(double x, double r);
  std::vector<std::size_t> points(const std::vector<double>& x, double r);
  std::size_t curve(std::size_t from, std::size_t to, Division d, std::optional<HeatBoundary> boundary = {},
                    int arc = -1);
  /// Upright curves from one row of points to another; the first and the last are faces of the body.
  std::vector<std::size_t> uprights(const std::vector<std::size_t>& low, const std::vector<std::size_t>& high,
                                    Division d, std::size_t body);
  /// Straight curves along a row of points.
  std::vector<std::size_t> along(const std::vector<std::size_t>& row, const std::vector<Division>& d,
                                 std::optional<HeatBoundary> boundary = {});
  void blocks(const std::vector<std::size_t>& low, const std::vector<std::size_t>& high,
              const std::vector<std::size_t>& uprights, std::size_t body);
};

/// A rectangle with columns and layers.
/// @param layers  by rising radius, each beginning where the one before it ends; at least one
void add_rectangle(const std::string& name, const Columns& columns, const std::vector<Layer>& layers,
                   SectionBuilder& builder);

}  // namespace rotordrop
