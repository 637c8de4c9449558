#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "baselines/bandwidth.h"
#include "run.h"

namespace hedgerow::tool {

using baselines::Bandwidth;

/// The loop whose mix of reads and writes is nearest to that of a stage.
enum class Mix : std::uint8_t { read, copy, triad };

/// One measured operation.
struct Stage {
  std::string name{};
  std::string variant{};  ///< empty: there is only one
  int threads = 1;
  double ms = 0;  ///< median
  int runs = 0;
  std::int64_t elements = 0;
  std::string unit{};      ///< what the elements are: "vertex", "face", "half-edge"
  std::int64_t bytes = 0;  ///< that had to move: each array that is read or written, once
  Mix mix = Mix::copy;
  std::optional<double> pointer_ms{};
  std::optional<double> aos_ms{};
  bool checked = false;

  [[nodiscard]] double ns_per_element() const noexcept;
  [[nodiscard]] double gb_per_s() const noexcept;
  [[nodiscard]] double share_of(const Bandwidth& bandwidth) const noexcept;
};

[[nodiscard]] Json stage_json(const Stage& stage, const Bandwidth& bandwidth);
/// One table for each group of stages, with the speed-ups as ratios.
[[nodiscard]] std::string stages_text(const std::vector<Stage>& stages, const Bandwidth& bandwidth,
                                      bool colour);

}  // namespace hedgerow::tool
