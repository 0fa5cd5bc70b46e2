#pragma once
#include <pybind11/pybind11.h>

#include <vector>

#include "base/errors.h"

namespace rotordrop::python {

/// As a tuple of rotordrop.Fault.
pybind11::tuple faults_to_python(const std::vector<Fault>& faults);

}  // namespace rotordrop::python
