#include "report/stages.h"

#include <fmt/format.h>

#include "report/timing.h"

namespace hedgerow::tool {

void Stages::measure_on(Stage stage, int threads, const Check& check, const Work& work) {
  const std::string title =
      fmt::format("{}{}{}", stage.name, stage.variant.empty() ? "" : " ", stage.variant);
  run_.progress().step(fmt::format("{}, {} thread{}", title, threads, threads == 1 ? "" : "s"));
  const Execution execution = threads == 1 ? Execution::serial() : run_.execution();
  stage.checked = static_cast<bool>(check);
  if (check && !check(execution)) {
    fail(fmt::format("{} on {} threads", title, threads));
    return;
  }
  const Timing timing = time_median([&] { work(execution); });
  stage.threads = threads;
  stage.ms = timing.ms;
  stage.runs = timing.runs;
  stages_.push_back(std::move(stage));
}

void Stages::measure(Stage stage, const Check& check, const Work& work) {
  measure_on(stage, 1, check, work);
  if (run_.threads() > 1) measure_on(std::move(stage), run_.threads(), check, work);
}

void Stages::measure_serial(Stage stage, const Check& check, const Work& work) {
  measure_on(std::move(stage), 1, check, work);
}

void Stages::measure_unchecked(Stage stage, const Work& work) {
  measure_on(std::move(stage), 1, nullptr, work);
}

}  // namespace hedgerow::tool
