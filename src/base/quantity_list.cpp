#include "base/quantity_list.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/errors.h"
#include "base/trimmed.h"

namespace rotordrop {
namespace {

std::vector<std::string> entries_of(const std::string& text) {
  std::vector<std::string> entries;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t comma = std::min(text.find(',', from), text.size());
    entries.emplace_back(trimmed(std::string_view(text).substr(from, comma - from)));
    from = comma + 1;
  }
  return entries;
}

/// "krpm" of "5 krpm"; empty if there is none. @param entry  that can be converted
std::string unit_of(const std::string& entry) {
  for (std::size_t end = entry.size(); end > 0; --end)
    if (bare_number(trimmed(std::string_view(entry).substr(0, end))))
      return std::string(trimmed(std::string_view(entry).substr(end)));
  return "";
}

bool is_zero(const std::string& entry) {
  const auto number = bare_number(entry);
  return number && *number == 0.;
}

/// Entries that have no unit, are not 0, and stand beside some that have one.
std::vector<std::string> entries_without_unit(const std::vector<std::string>& entries) {
  std::vector<std::string> bare;
  bool has_units = false;
  for (const auto& entry : entries) {
    const bool is_bare = unit_of(entry).empty();
    has_units = has_units || !is_bare;
    if (is_bare && !is_zero(entry)) bare.push_back(entry);
  }
  return has_units ? bare : std::vector<std::string>{};
}

}  // namespace

std::vector<double> quantities_in(const std::string& text, const std::string& option, const std::string& si_unit,
                                  QuantityKind kind, const std::string& name) {
  const auto entries = entries_of(text);
  std::vector<double> values;
  Faults faults;
  for (const auto& entry : entries) {
    const auto read = convert_to_si(entry, si_unit, kind, name);
    if (read)
      values.push_back(read.value);
    else
      faults.add({option, 0, 0}, read.error, read.advice);
  }
  faults.throw_if_any();
  if (const auto bare = entries_without_unit(entries); !bare.empty())
    throw InputError({option, 0, 0},
                     fmt::format("{} {} no unit, but other entries of the list have one.", fmt::join(bare, ", "),
                                 bare.size() == 1 ? "has" : "have"),
                     fmt::format("Write it as: {} '{}'\nA number without a unit is in {}; beside others that have one, "
                                 "only 0 may go without.",
                                 option, list_with_units(text), si_unit));
  return values;
}

std::string list_with_units(const std::string& text) {
  auto entries = entries_of(text);
  // A unit behind several numbers most often is of all of them; numbers behind the last unit have that.
  std::string unit;
  for (const auto& entry : entries)
    if (const auto own = unit_of(entry); !own.empty()) unit = own;
  for (std::size_t k = entries.size(); k-- > 0;)
    if (const auto own = unit_of(entries[k]); !own.empty())
      unit = own;
    else if (!unit.empty() && !is_zero(entries[k]))
      entries[k] += " " + unit;
  return fmt::format("{}", fmt::join(entries, ", "));
}

}  // namespace rotordrop
