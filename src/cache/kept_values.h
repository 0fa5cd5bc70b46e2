#pragma once
#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "cache/plain_data.h"

namespace rotordrop {

/// Where values are kept: ROTORDROP_CACHE, else $XDG_CACHE_HOME/rotordrop, else ~/.cache/rotordrop. Empty: nowhere, if ROTORDROP_CACHE is "off" or
/// the folder cannot be made.
std::filesystem::path cache_folder();

/// Removes the files of the cache that were unused for longest until the others take no more than this [bytes].
void shrink_cache(const std::filesystem::path& folder, std::uintmax_t limit);

/// Values by name in one file, read as a whole when made and written as a whole when they have changed, at the latest when the object ends.
/// A file that is damaged or cannot be written does no harm: values are then computed anew.
class KeptValues {
 public:
  /// @param folder   of the cache; empty: values are kept as long as the object
  /// @param content  digest of what the values follow from
  KeptValues(const std::filesystem::path& folder, const std::string& content);
  KeptValues(const KeptValues&) = delete;
  KeptValues& operator=(const KeptValues&) = delete;
  ~KeptValues();

  /// The value of that name, or what `compute` finds, which is then kept.
  template <class T, class Compute>
  T get(const std::string& name, const Compute& compute) {
    if (T value; find(name, value)) return value;
    T value = compute();
    keep(name, plain::bytes_of(value));
    return value;
  }
  void save();

 private:
  template <class T>
  bool find(const std::string& name, T& value) const {
    const auto found = values_.find(name);
    if (found == values_.end()) return false;
    try {
      plain::Reader reader(found->second);
      reader.get(value);
      return reader.is_at_end();
    } catch (const std::out_of_range&) {
      return false;
    }
  }
  void keep(const std::string& name, std::string bytes);

  std::filesystem::path file_;
  std::string text_;                                // of the file
  std::deque<std::string> added_;                   // values that were found since
  std::map<std::string, std::string_view> values_;  // views into text_ or added_
  bool is_changed_ = false;
};

}  // namespace rotordrop
