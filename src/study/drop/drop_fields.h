#pragma once
#include <filesystem>
#include <limits>
#include <vector>

#include "analysis/section_coupling.h"
#include "io/hdf5/field_series.h"
#include "thermal/fe_parameters.h"

namespace rotordrop {

/// Temperature fields of a drop's sections: DIRECTORY/fields/BEARING.pvd.
class DropFields final : public FieldSink {
 public:
  /// @param start  of the run [s]; above 0 the series there is gone on with
  DropFields(const std::filesystem::path& directory, FiniteElements& elements, const FeParameters& parameters,
             double start);

  [[nodiscard]] double next() const override { return next_; }
  [[nodiscard]] bool is_due(double t) const override;
  void write(double t) override;

 private:
  FiniteElements& elements_;
  const FieldTimes times_;
  std::vector<FieldSeries> series_;
  double next_ = std::numeric_limits<double>::infinity();
};

}  // namespace rotordrop
