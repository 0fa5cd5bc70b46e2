#pragma once
#include <memory>

#include "case/case.h"
#include "machine/heat/finite_elements.h"
#include "machine/machine.h"

namespace rotordrop {

/// The machine of a case with what it was built from: finite elements where the case has them, and the growth that an earlier run recorded
/// where thermal.driver requires it. Several threads may build machines; those with finite elements one after the other, since meshes come
/// from one generator for the whole process.
class BuiltMachine {
 public:
  /// @param drop_case  must outlive it
  /// @throws InputError if the recorded growth, or one of the case's bearings in it, is not there
  explicit BuiltMachine(const Case& drop_case);
  BuiltMachine(const BuiltMachine&) = delete;
  BuiltMachine& operator=(const BuiltMachine&) = delete;

  [[nodiscard]] const Machine& machine() const { return *machine_; }
  [[nodiscard]] FiniteElements& elements() { return elements_; }

 private:
  FiniteElements elements_;
  std::unique_ptr<Machine> machine_;
};

}  // namespace rotordrop
