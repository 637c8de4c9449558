#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace hedgerow::tool {

/// What a number may be, both ends included.
template <class Number>
struct Bounds {
  Number least;
  Number most = std::numeric_limits<Number>::max();
};

/// What one command takes. The library that reads arguments costs seconds in each file that
/// includes it, so commands name what they take in the few kinds that there are.
///
/// Lifetime   A view of the `Program`. A variable given here is written when the command line is
///            read, and has to live until then; the value that it has when given is the default,
///            and shown in the help.
class Command {
 public:
  explicit Command(CLI::App& app) : app_(&app) {}

  /// A word that has to be there, in the order of the calls.
  Command& word(const std::string& name, std::string& value, const std::string& help);
  /// The same, of those that are listed.
  Command& word_of(const std::string& name, const std::vector<std::string>& words,
                   std::string& value, const std::string& help);
  /// A word that may be left out.
  Command& optional_word(const std::string& name, std::string& value, const std::string& help);

  /// An option with text; `type` stands for the text in the help.
  Command& text(const std::string& name, const std::string& type, std::string& value,
                const std::string& help);
  /// An option with one of the words. Has to be given if `value` is empty.
  Command& choice(const std::string& name, const std::vector<std::string>& words,
                  std::string& value, const std::string& help);
  Command& flag(const std::string& name, bool& value, const std::string& help);

  /// An option with a number: of int, std::int64_t or float.
  template <class Number>
  Command& number(const std::string& name, Bounds<Number> bounds, Number& value,
                  const std::string& help);
  /// The same, of int or std::int64_t; has to be given.
  template <class Number>
  Command& needed_number(const std::string& name, Bounds<Number> bounds, Number& value,
                         const std::string& help);
  /// The same, of std::int64_t or double; may be left out.
  template <class Number>
  Command& optional_number(const std::string& name, Bounds<Number> bounds,
                           std::optional<Number>& value, const std::string& help);
  /// An option with `count` numbers and commas between them; `values` stays empty without it.
  Command& numbers(const std::string& name, int count, std::vector<double>& values,
                   const std::string& help);

 private:
  CLI::App* app_;
};

}  // namespace hedgerow::tool
