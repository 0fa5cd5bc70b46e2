#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace rotordrop {

/// A parameter that differs from its default.
struct GivenValue {
  std::string name;      ///< "bearings.TB1.node"
  std::string value;     ///< with its unit, if it has one
  std::string fallback;  ///< likewise; a dash if there is none
  std::string
      source;  ///< file, line and what their author wrote there; "--set"; empty for runs of programs that did not keep it
  std::string help;
};

struct GivenValues {
  std::vector<GivenValue> list;
  std::size_t n_defaults = 0;  ///< parameters besides these
};

/// The given parameters of a run, as its parameters.toml records them.
GivenValues given_values(const std::filesystem::path& parameters);

}  // namespace rotordrop
