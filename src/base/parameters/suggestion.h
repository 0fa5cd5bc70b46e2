#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rotordrop {

/// The name closest to `word` among `names`, if it is close enough to be meant (Damerau-Levenshtein distance);
/// otherwise empty.
std::string closest_name(std::string_view word, const std::vector<std::string>& names);

/// Advice on a word that is none of `known`: `Did you mean "x"?` if one of them is close, then `rest`.
/// @param path  what stands before such a name: "contact."
std::string suggestion(std::string_view word, const std::vector<std::string>& known, const std::string& rest,
                       std::string_view path = "");
/// Advice that ends with the list of all that is known.
std::string suggestion(std::string_view word, const std::vector<std::string>& known);

}  // namespace rotordrop
