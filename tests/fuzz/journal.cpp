// Journals of studies: lines of JSON, each with its check sum.
#include "study/many/journal.h"
#include "input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rotordrop;
  const auto& file = fuzz::file_of(data, size, ".journal");
  fuzz::allow_refusal([&] {
    const auto content = Journal::read(file);
    for (const auto& [point, record] : content.records) static_cast<void>(result_of(record, content.layouts));
  });
  return 0;
}
