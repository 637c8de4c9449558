#include "command.h"

#include <algorithm>
#include <type_traits>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hedgerow::tool {
namespace {

template <class Number>
constexpr const char* kTypeName = std::is_integral_v<Number> ? "N" : "X";

template <class Number>
std::string expectation(Bounds<Number> bounds) {
  const char* kind = std::is_integral_v<Number> ? "a whole number" : "a number";
  if (bounds.most == std::numeric_limits<Number>::max()) {
    return fmt::format("{}, {} or more", kind, bounds.least);
  }
  return fmt::format("{} from {} to {}", kind, bounds.least, bounds.most);
}

/// The empty text, or what is wrong: as the library wants it.
template <class Number>
auto within(Bounds<Number> bounds) {
  return [bounds](const std::string& text) {
    Number number{};
    // Not a number is in no bounds.
    const bool is_good =
        CLI::detail::lexical_cast(text, number) && number >= bounds.least && number <= bounds.most;
    return is_good ? std::string() : fmt::format("takes {}, not \"{}\"", expectation(bounds), text);
  };
}

auto one_of(const std::vector<std::string>& words) {
  return [words](const std::string& text) {
    const bool is_good = std::find(words.begin(), words.end(), text) != words.end();
    return is_good ? std::string()
                   : fmt::format("takes {}, not \"{}\"", fmt::join(words, ", "), text);
  };
}

}  // namespace

Command& Command::word(const std::string& name, std::string& value, const std::string& help) {
  app_->add_option(name, value, help)->required()->type_name("");
  return *this;
}

Command& Command::word_of(const std::string& name, const std::vector<std::string>& words,
                          std::string& value, const std::string& help) {
  app_->add_option(name, value, help)->required()->check(one_of(words))->type_name("");
  return *this;
}

Command& Command::optional_word(const std::string& name, std::string& value,
                                const std::string& help) {
  app_->add_option(name, value, help)->type_name("");
  return *this;
}

Command& Command::text(const std::string& name, const std::string& type, std::string& value,
                       const std::string& help) {
  CLI::Option* option = app_->add_option(name, value, help)->type_name(type);
  if (!value.empty()) option->capture_default_str();
  return *this;
}

Command& Command::choice(const std::string& name, const std::vector<std::string>& words,
                         std::string& value, const std::string& help) {
  CLI::Option* option = app_->add_option(name, value, help)->check(one_of(words));
  option->type_name(fmt::format("{}", fmt::join(words, "|")));
  value.empty() ? option->required() : option->capture_default_str();
  return *this;
}

Command& Command::flag(const std::string& name, bool& value, const std::string& help) {
  app_->add_flag(name, value, help);
  return *this;
}

template <class Number>
Command& Command::number(const std::string& name, Bounds<Number> bounds, Number& value,
                         const std::string& help) {
  app_->add_option(name, value, help)
      ->check(within(bounds))
      ->type_name(kTypeName<Number>)
      ->capture_default_str();
  return *this;
}

template <class Number>
Command& Command::needed_number(const std::string& name, Bounds<Number> bounds, Number& value,
                                const std::string& help) {
  app_->add_option(name, value, help)
      ->check(within(bounds))
      ->type_name(kTypeName<Number>)
      ->required();
  return *this;
}

template <class Number>
Command& Command::optional_number(const std::string& name, Bounds<Number> bounds,
                                  std::optional<Number>& value, const std::string& help) {
  app_->add_option(name, value, help)->check(within(bounds))->type_name(kTypeName<Number>);
  return *this;
}

Command& Command::numbers(const std::string& name, int count, std::vector<double>& values,
                          const std::string& help) {
  app_->add_option(name, values, help)->delimiter(',')->expected(count)->type_name("X");
  return *this;
}

template Command& Command::number(const std::string&, Bounds<int>, int&, const std::string&);
template Command& Command::number(const std::string&, Bounds<std::int64_t>, std::int64_t&,
                                  const std::string&);
template Command& Command::number(const std::string&, Bounds<float>, float&, const std::string&);
template Command& Command::needed_number(const std::string&, Bounds<int>, int&, const std::string&);
template Command& Command::needed_number(const std::string&, Bounds<std::int64_t>, std::int64_t&,
                                         const std::string&);
template Command& Command::optional_number(const std::string&, Bounds<std::int64_t>,
                                           std::optional<std::int64_t>&, const std::string&);
template Command& Command::optional_number(const std::string&, Bounds<double>,
                                           std::optional<double>&, const std::string&);

}  // namespace hedgerow::tool
