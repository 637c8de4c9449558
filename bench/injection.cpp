#include "injection.h"

#include <charconv>
#include <cstdlib>
#include <string_view>

#include "google.h"

namespace hedgerow::bench {

namespace {

using Clock = std::chrono::steady_clock;

struct Injection {
  std::string name;
  double share = 0;
};

/// "NAME:+5%"; names have no colon, but the last one counts anyway.
Injection injection_from_environment() {
  const char* setting = std::getenv("PERFGATE_INJECT");
  const std::string_view text = setting == nullptr ? "" : setting;
  if (text.empty()) return {};
  const std::size_t colon = text.rfind(":+");
  double percent = 0;
  if (colon != std::string_view::npos && text.ends_with('%')) {
    const char* begin = text.data() + colon + 2;
    const char* end = text.data() + text.size() - 1;
    const auto [stop, error] = std::from_chars(begin, end, percent);
    if (error == std::errc() && stop == end && percent >= 0) {
      return {std::string(text.substr(0, colon)), percent / 100};
    }
  }
  throw UsageError("PERFGATE_INJECT=" + std::string(text) + ": NAME:+PERCENT% is wanted");
}

}  // namespace

double inject_delay(const std::string& name, Clock::time_point start) {
  static const Injection injection = injection_from_environment();
  if (injection.name != name) return 0;
  const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  const double before = seconds();
  double after = before;
  while (after < before * (1 + injection.share)) after = seconds();
  return after - before;
}

}  // namespace hedgerow::bench
