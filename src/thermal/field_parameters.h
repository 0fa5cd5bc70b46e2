#pragma once
#include <string>

#include "base/errors.h"

namespace rotordrop {

/// A fault of so many fields of one section that their files would fill a disk: more than 1e5, 5 to 100 GB of files of 0.05 to 1 MB.
/// @param key       of the interval: "thermal.fe.field_interval"
/// @param interval  between fields [s]; 0: none
/// @param end       of the run [s]
void check_number_of_fields(const std::string& key, double interval, double end, const SourcePosition& where,
                            Faults& faults);

}  // namespace rotordrop
