// Findings about input: one typed record per fault, all faults of a deck in one go.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace abut {

enum class Severity { note, warning, error };

/// Where in the input a finding belongs. Empty members are not printed.
struct Place {
  std::string file;
  int line = 0;          ///< 1-based; 0 = unknown
  std::string keyword;   ///< e.g. "/INTER/TYPE3/1"
  std::string field;     ///< e.g. "Gap"
  int first_column = 0;  ///< 1-based, inclusive; 0 = no columns
  int last_column = 0;
};

/// One finding. `code` is stable (e.g. "deck.bad_real"), `message` says what is wrong and what would be right.
struct Diagnostic {
  Severity severity = Severity::error;
  std::string code;
  Place place;
  std::string message;
};

/// "file:line: /KEYWORD/id field 'Gap' (columns 41-60): message"; warnings and notes carry "warning: " / "note: " before the message.
[[nodiscard]] std::string to_string(const Diagnostic& d);

/// Collects findings in the order in which they were made.
class Diagnostics {
 public:
  void add(Diagnostic d);
  void error(std::string code, Place place, std::string message);
  void warning(std::string code, Place place, std::string message);
  void note(std::string code, Place place, std::string message);

  [[nodiscard]] bool has_errors() const { return error_count_ > 0; }
  [[nodiscard]] int error_count() const { return error_count_; }
  [[nodiscard]] int warning_count() const { return warning_count_; }
  [[nodiscard]] const std::vector<Diagnostic>& all() const { return all_; }

 private:
  std::vector<Diagnostic> all_;
  int error_count_ = 0;
  int warning_count_ = 0;
};

/// Thrown where input cannot be used; carries every finding made so far.
class InputError : public std::runtime_error {
 public:
  explicit InputError(Diagnostics d);
  [[nodiscard]] const Diagnostics& diagnostics() const { return diagnostics_; }

 private:
  Diagnostics diagnostics_;
};

/// Thrown when a run cannot go on (NaN, runaway energy, a full disk); `what()` names what went wrong first.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace abut
