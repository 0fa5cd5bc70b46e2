#pragma once
#include <string>
#include <vector>

#include "base/node.h"
#include "base/parameters/section.h"

namespace rotordrop {

enum class MinimiseMethod { cobyla, bobyqa, subplex, crs, isres, direct };
enum class DropStatistic { mean, quantile };

/// [minimise]: a result that is made as small as possible within the ranges of some parameters.
struct MinimiseParameters {
  std::string result;
  DropStatistic of = DropStatistic::mean;
  double quantile = 0.95;
  Node over;  ///< names of parameters; null: all with a range
  MinimiseMethod method = MinimiseMethod::cobyla;
  int evaluations = 100;  ///< at most, of each search
  int searches = 1;
  double first_step = 0.2;  ///< part of each range
  double tolerance = 1e-3;  ///< part of each range
};

std::string name_of(MinimiseMethod method);
/// Whether a method takes limits.
bool takes_limits(MinimiseMethod method);

/// Whether a method starts where it is told; if not, all its searches are one.
bool takes_start(MinimiseMethod method);

Section<MinimiseParameters> minimise_section();

}  // namespace rotordrop
