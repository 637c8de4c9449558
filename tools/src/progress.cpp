#include "progress.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <fmt/format.h>

namespace hedgerow::tool {
namespace {

constexpr std::chrono::milliseconds kDelay(500);
constexpr auto kPeriod = std::chrono::milliseconds(100);
constexpr int kBarWidth = 24;

std::chrono::milliseconds delay() {
  const char* text = std::getenv("HEDGEROW_PROGRESS_DELAY");
  if (text == nullptr) return kDelay;
  int value = 0;
  const char* end = text + std::strlen(text);
  const auto [rest, error] = std::from_chars(text, end, value);
  const bool is_number = error == std::errc() && rest == end && value >= 0;
  return is_number ? std::chrono::milliseconds(value) : kDelay;
}

}  // namespace

Progress::Progress(bool enabled) : enabled_(enabled), delay_(delay()) {}

void Progress::begin(int step_count) {
  finish();
  step_count_ = std::max(step_count, 1);
  steps_begun_ = 0;
  label_.clear();
  start_ = std::chrono::steady_clock::now();
  if (!enabled_) return;
  finished_ = false;
  // Without a delay the bar is there even if the work is done before the thread runs.
  if (delay_.count() == 0) draw();
  thread_ = std::thread([this] { draw_until_finished(); });
}

void Progress::step(std::string label) {
  const std::scoped_lock lock(mutex_);
  ++steps_begun_;
  part_ = 0;
  label_ = std::move(label);
}

void Progress::part(std::int64_t done, std::int64_t total) {
  const std::scoped_lock lock(mutex_);
  part_ = total > 0 ? static_cast<double>(done) / static_cast<double>(total) : 0;
}

void Progress::finish() {
  {
    const std::scoped_lock lock(mutex_);
    finished_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Progress::draw_until_finished() {
  std::unique_lock lock(mutex_);
  const auto is_finished = [this] { return finished_; };
  if (wake_.wait_for(lock, delay_, is_finished)) return;
  do {
    draw();
  } while (!wake_.wait_for(lock, kPeriod, is_finished));
  std::fputs("\r\x1b[K", stderr);
  std::fflush(stderr);
}

void Progress::draw() const {
  std::fputs(line().c_str(), stderr);
  std::fflush(stderr);
}

std::string Progress::line() const {
  const double done = std::max(steps_begun_ - 1, 0) + std::clamp(part_, 0.0, 1.0);
  const double share = std::min(done / step_count_, 1.0);
  const int filled = static_cast<int>(kBarWidth * share);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  return fmt::format("\r\x1b[K[{:=<{}}{:<{}}] {:3}%  {:.1f} s  {}", "", filled, "",
                     kBarWidth - filled, static_cast<int>(100 * share), elapsed.count(), label_);
}

}  // namespace hedgerow::tool
