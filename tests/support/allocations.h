#pragma once

namespace hedgerow::test {

/// How often this program has allocated so far: by operator new, or by aligned_alloc, which the
/// engine's buffers use. Every thread counts.
[[nodiscard]] int allocation_count() noexcept;

}  // namespace hedgerow::test
