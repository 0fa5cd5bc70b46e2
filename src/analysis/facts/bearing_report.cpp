#include "analysis/facts/bearing_report.h"

#include <fmt/format.h>

#include "bearing/contact_stiffness.h"
#include "machine/build_machine.h"

namespace rotordrop {

std::string bearing_report(const MachineParameters& p) {
  std::string text;
  for (const auto& entry : p.bearings)
    if (const auto* b = entry.touchdown()) {
      const auto stiffness = contact_stiffness(*b, p.contact, touchdown_surroundings(p, *b));
      text += contact_stiffness_words(entry.name, stiffness, p.contact.exponent) + "\n";
      if (const std::string carried = support_words(b->support, support_surroundings(*b)); !carried.empty())
        text += fmt::format("{}: support: {}\n", entry.name, carried);
    }
  return text;
}

}  // namespace rotordrop
