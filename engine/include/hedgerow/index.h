#pragma once

#include <compare>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace hedgerow {

/// The integer that every column stores: 32 bits unless the CMake option HEDGEROW_INDEX_BITS=64.
#if defined(HEDGEROW_INDEX_BITS) && HEDGEROW_INDEX_BITS == 64
using Index = std::int64_t;
#else
using Index = std::int32_t;
#endif

/// The only sentinel: boundary, isolated, "none".
inline constexpr Index kInvalidIndex = -1;

/// The largest number of elements of one kind. Counts are checked against it before any allocation.
inline constexpr Index kMaxCount = std::numeric_limits<Index>::max() - 1;

/// Index of one mesh element. `Tag` keeps vertex, half-edge and face indices apart at compile time;
/// at run time an id is one `Index`, and a default-constructed id is invalid.
template <class Tag>
struct Id {
  Index value = kInvalidIndex;

  constexpr Id() noexcept = default;
  constexpr explicit Id(Index v) noexcept : value(v) {}

  [[nodiscard]] constexpr bool valid() const noexcept { return value != kInvalidIndex; }
  friend constexpr auto operator<=>(Id, Id) noexcept = default;
};

using VertexId = Id<struct VertexTag>;
using HalfedgeId = Id<struct HalfedgeTag>;
using FaceId = Id<struct FaceTag>;
/// Only representations with a record per edge number edges.
using EdgeId = Id<struct EdgeTag>;
/// Only corner tables tell corners from the half-edges that leave them.
using CornerId = Id<struct CornerTag>;

static_assert(sizeof(HalfedgeId) == sizeof(Index) && std::is_trivially_copyable_v<HalfedgeId>);

/// Half-open range [begin, end) of element numbers; what a kernel works on.
struct IndexRange {
  Index begin = 0;
  Index end = 0;

  [[nodiscard]] constexpr Index size() const noexcept { return end - begin; }
};

}  // namespace hedgerow
