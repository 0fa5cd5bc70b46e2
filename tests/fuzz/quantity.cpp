// Numbers with units, as cases and options have them.
#include "base/units.h"
#include "input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rotordrop;
  if (size == 0 || size > 400) return 0;
  static constexpr const char* units[] = {"m", "N", "K", "rad/s", "s", "N/m", "kg m2", "1"};
  const auto text = fuzz::text_of(data + 1, size - 1);
  const auto kind = static_cast<QuantityKind>((data[0] >> 3u) % 5u);
  fuzz::allow_refusal([&] { static_cast<void>(convert_to_si(text, units[data[0] & 7u], kind, "a value")); });
  return 0;
}
