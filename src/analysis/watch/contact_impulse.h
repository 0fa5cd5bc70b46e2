#pragma once
#include <memory>
#include <vector>

#include "analysis/drop_scalars.h"
#include "machine/machine.h"
#include "machine/machine_parameters.h"
#include "model/observer.h"

namespace rotordrop {

/// Length of the means that summaries call "_end" [s].
inline constexpr double averaging_time = 0.05;

/// Impulses of the contacts before the last part of a run, for the mean contact forces of that part.
class ContactImpulse : public Observer {
 public:
  /// When the mean begins [s].
  [[nodiscard]] virtual double start() const = 0;
  /// Impulse of each touchdown bearing until then [N s].
  [[nodiscard]] virtual std::vector<double> before() const = 0;
};

/// One for a run to a given time, one that slides along for a run whose end is not known before.
std::unique_ptr<ContactImpulse> make_contact_impulse(const Machine& machine, const DropScalars& bearings,
                                                     const RunParameters& run);

}  // namespace rotordrop
