#pragma once

namespace hedgerow::baselines {

/// Simple integer instructions that one thread finishes in a nanosecond when none waits for another
/// and none for memory: the flat roof of a roofline. Takes a few milliseconds; 0 where the kernel
/// is not written for the processor.
[[nodiscard]] double instructions_per_ns() noexcept;

}  // namespace hedgerow::baselines
