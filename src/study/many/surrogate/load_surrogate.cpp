#include "case/modules/load_module.h"
#include "study/many/surrogate/surrogate.h"

namespace rotordrop {

MakeSurrogate* surrogate_maker() {
  static MakeSurrogate* const make =
      function_in_module<MakeSurrogate>({"rotordrop_surrogate.so", "the surrogate module", "[surrogate]",
                                         "Install libopenturns-dev and build again, or remove [surrogate]."},
                                        Symbols::at_once, make_surrogate_name);
  return make;
}

}  // namespace rotordrop
