#pragma once

#include <compare>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/shared_text.h"

namespace rotordrop {

/// A place in an input: a file with line and column (both from 1), or an option of the command line such as
/// "--set contact.air_gap" with line 0.
struct SourcePosition {
  SharedText file;
  int line = 0;
  int column = 0;

  bool is_known() const { return !file.empty(); }
  bool operator==(const SourcePosition&) const = default;
};

/// "file:line:column"; only "file" where the line is 0.
std::string to_string(const SourcePosition& where);

/// One thing that is wrong with the input.
struct Fault {
  SourcePosition where;
  std::string message;  ///< what is wrong, what was given, what is allowed
  std::string advice;   ///< what to do next; may be empty; may hold several lines
  /// The parameter in question, such as "contact.air_gap"; empty where the input is not about one, or has not been read that far.
  std::string key = {};

  bool operator==(const Fault&) const = default;
};

/// Collects faults, so that a user sees all of them at once.
class Faults {
 public:
  /// A fault that is already in the list (same place, same words) is not added again.
  void add(Fault fault);
  void add(SourcePosition where, std::string message, std::string advice = "");
  void add(const std::vector<Fault>& others);
  void add(const Faults& others);

  bool empty() const { return faults_.empty(); }
  std::size_t size() const { return faults_.size(); }
  auto begin() const { return faults_.begin(); }
  auto end() const { return faults_.end(); }

  /// Throws an InputError with all faults, if there are any.
  void throw_if_any() const;

 private:
  std::vector<Fault> faults_;
};

/// The input is wrong. what() shows all faults: files in the order in which they were first named, each by line and
/// column.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const Faults& faults);
  InputError(SourcePosition where, std::string message, std::string advice = "");
  /// Faults in the order in which another error has them.
  static InputError with(std::vector<Fault> sorted_faults);

  const std::vector<Fault>& faults() const { return faults_; }

 private:
  explicit InputError(std::vector<Fault> sorted);
  std::vector<Fault> faults_;
};

/// The numerics failed; the message carries the state that explains it.
class SolverError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A part that is not the program's, a support or thermal model of a module, threw; the message names it.
class PartError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// "error: FILE:LINE:COLUMN: message" and the advice on indented lines below; no line break at the end.
std::string rendered(const Fault& fault);

}  // namespace rotordrop
