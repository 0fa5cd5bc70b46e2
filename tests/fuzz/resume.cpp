// Checkpoints whose check sum is right and whose content is not: each line of the input changes the checkpoint of a drop amid its first impact.
//   NAME INDEX VALUE   one of its numbers; NAME "time", "state" or one of extras
//   NAME size N        that many numbers
//   NAME gone          nothing of that name
// The drop then goes on for some steps, or refuses.
#include <charconv>
#include <sstream>

#include "analysis/drop.h"
#include "case/built_machine.h"
#include "input.h"

namespace {

using namespace rotordrop;

struct Prepared {
  Case drop_case = read_case(std::string(ROTORDROP_SOURCE_DIR) + "/params/neisi2019-settling.toml",
                             {"run.end_time=20 ms", "integration.method=tsitouras"});
  BuiltMachine built{drop_case};
  double time = 0;
  std::vector<double> state;
  PackedValues extras;

  [[nodiscard]] Drop drop() const {
    const auto& p = drop_case.parameters;
    return {built.machine(), p, p.integration, p.output};
  }
  Prepared() {
    Drop first = drop();
    first.run([&] { return first.loop().time() > 8e-3; });
    time = first.loop().time();
    state.assign(first.loop().state().begin(), first.loop().state().end());
    first.loop().pack(extras);
  }
};

/// Not more than a damaged file could hold.
constexpr std::size_t most_numbers = 100'000;

void change(PackedValues& values, const std::string& name, const std::string& what, const std::string& value) {
  if (what == "gone") {
    values.erase(name);
    return;
  }
  auto& numbers = values[name];
  std::size_t index = 0, size = 0;
  if (what == "size") {
    std::from_chars(value.data(), value.data() + value.size(), size);
    numbers.resize(std::min(size, most_numbers), 1.);
    return;
  }
  std::from_chars(what.data(), what.data() + what.size(), index);
  double number = 0.;
  std::from_chars(value.data(), value.data() + value.size(), number);
  if (index < numbers.size()) numbers[index] = number;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Prepared prepared;
  PackedValues values = prepared.extras;
  values["time"] = {prepared.time};
  values["state"] = prepared.state;
  std::istringstream lines{std::string(fuzz::text_of(data, size))};
  for (std::string line; std::getline(lines, line);) {
    // The name may have spaces.
    const auto last = line.rfind(' ');
    if (last == std::string::npos || last == 0) continue;
    const std::string value = line.substr(last + 1), rest = line.substr(0, last);
    if (value == "gone") {
      change(values, rest, value, "");
      continue;
    }
    const auto middle = rest.rfind(' ');
    if (middle != std::string::npos) change(values, rest.substr(0, middle), rest.substr(middle + 1), value);
  }
  const auto taken = [&](const char* name) {
    return values.contains(name) ? values.extract(name).mapped() : std::vector<double>{};
  };
  const std::vector<double> time = taken("time"), state = taken("state");
  fuzz::allow_refusal([&] {
    Drop drop = prepared.drop();
    try {
      drop.loop().unpack(time.empty() ? 0. : time.front(), state, values);
    } catch (const std::logic_error&) {
      return;  // what the program tells as a checkpoint of another kind
    }
    int steps = 0;
    drop.run([&] { return ++steps > 30; });
    static_cast<void>(drop.result());
  });
  return 0;
}
