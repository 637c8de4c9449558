#include "json_text.h"

#include <charconv>
#include <string>

#include <nlohmann/json.hpp>

namespace hedgerow::io {

namespace {

// Keeps nothing of the values: only the depth and the first error.
class JsonChecker : public nlohmann::json_sax<nlohmann::json> {
 public:
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return ++depth_ <= kDeepestJson; }
  bool key(string_t&) override { return true; }
  bool end_object() override { return leave(); }
  bool start_array(std::size_t) override { return ++depth_ <= kDeepestJson; }
  bool end_array() override { return leave(); }
  bool parse_error(std::size_t position, const std::string& last_token,
                   const nlohmann::json::exception&) override {
    position_ = position == 0 ? 0 : position - 1;
    token_ = last_token;
    has_error_ = true;
    return false;
  }

  [[nodiscard]] bool is_too_deep() const noexcept { return depth_ > kDeepestJson; }
  [[nodiscard]] bool has_error() const noexcept { return has_error_; }
  [[nodiscard]] std::size_t position() const noexcept { return position_; }
  [[nodiscard]] const std::string& token() const noexcept { return token_; }

 private:
  bool leave() {
    --depth_;
    return true;
  }

  int depth_ = 0;
  bool has_error_ = false;
  std::size_t position_ = 0;
  std::string token_;
};

// Where nesting first exceeds the limit. \pre it does.
std::size_t too_deep_at(std::string_view text) noexcept {
  int depth = 0;
  bool is_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (is_string) {
      if (c == '\\') ++i;
      is_string = c != '"';
    } else if (c == '"') {
      is_string = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kDeepestJson) return i;
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return text.size();
}

// Walks over text that is known to be JSON.
class JsonWalker {
 public:
  explicit JsonWalker(std::string_view text) noexcept : text_(text) { skip_space(); }

  [[nodiscard]] std::size_t at() const noexcept { return at_; }

  // Into the member or item `step` of the value here. False: there is none, and nothing has moved.
  bool enter(std::string_view step) noexcept {
    const std::size_t start = at_;
    const bool is_found = peek() == '{'   ? enter_member(step)
                          : peek() == '[' ? enter_item(step)
                                          : false;
    if (!is_found) at_ = start;
    return is_found;
  }

 private:
  [[nodiscard]] char peek() const noexcept { return at_ < text_.size() ? text_[at_] : '\0'; }
  void skip_space() noexcept {
    while (peek() == ' ' || peek() == '\n' || peek() == '\r' || peek() == '\t') ++at_;
  }
  void step_over() noexcept {
    if (at_ < text_.size()) ++at_;
    skip_space();
  }

  void skip_string() noexcept {
    for (++at_; at_ < text_.size() && text_[at_] != '"'; ++at_) {
      if (text_[at_] == '\\') ++at_;
    }
    if (at_ < text_.size()) ++at_;
  }
  void skip_value() noexcept {
    int depth = 0;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '"') {
        skip_string();
      } else {
        if (depth == 0 && (c == ',' || c == '}' || c == ']')) break;
        depth += c == '{' || c == '[' ? 1 : c == '}' || c == ']' ? -1 : 0;
        ++at_;
      }
    }
    skip_space();
  }

  bool enter_member(std::string_view key) noexcept {
    step_over();
    while (peek() == '"') {
      const std::size_t start = at_ + 1;
      skip_string();
      const std::string_view name = text_.substr(start, at_ - 1 - start);
      skip_space();
      step_over();  // the colon
      if (name == key) return true;
      skip_value();
      if (peek() == ',') step_over();
    }
    return false;
  }
  bool enter_item(std::string_view step) noexcept {
    std::size_t index = 0;
    std::from_chars(step.data(), step.data() + step.size(), index);
    step_over();
    for (; index > 0 && peek() != ']' && peek() != '\0'; --index) {
      skip_value();
      if (peek() == ',') step_over();
    }
    return peek() != ']' && peek() != '\0';
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

std::optional<Failure> check_json(std::string_view text) {
  JsonChecker checker;
  if (nlohmann::json::sax_parse(text.begin(), text.end(), &checker)) return std::nullopt;
  if (checker.is_too_deep()) {
    return Failure{IoErrorCode::bad_json, too_deep_at(text), Place::text,
                   "more than " + std::to_string(kDeepestJson) + " objects and arrays nested"};
  }
  const std::size_t offset = std::min(checker.position(), text.size());
  return Failure{IoErrorCode::bad_json, offset, Place::text, "this is not JSON"};
}

std::size_t locate_json(std::string_view text, std::string_view pointer) noexcept {
  JsonWalker walker(text);
  while (!pointer.empty()) {
    pointer.remove_prefix(1);
    const std::size_t length = std::min(pointer.find('/'), pointer.size());
    if (!walker.enter(pointer.substr(0, length))) break;
    pointer.remove_prefix(length);
  }
  return walker.at();
}

}  // namespace hedgerow::io
