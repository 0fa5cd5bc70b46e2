#include "laws/ring_growth.h"

namespace rotordrop {

RingGrowth ring_growth(double expansion, double a, double b, double r, double constraint) {
  const double factor = constraint * expansion * r / (3. * (a + b));
  return {factor * (2. * a + b), factor * (2. * b + a)};
}

}  // namespace rotordrop
