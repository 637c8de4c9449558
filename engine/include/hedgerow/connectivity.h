#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "hedgerow/buffer.h"
#include "hedgerow/execution.h"
#include "hedgerow/index.h"
#include "hedgerow/topology.h"

namespace hedgerow {

/// How the boundary is stored.
enum class Form : std::uint8_t {
  open,    ///< default: `opposite` is -1 on the boundary; no half-edge exists outside the faces
  closed,  ///< a half-edge with face -1 runs along each boundary edge, as in a DCEL
};

/// The storage of one column: owned, or the caller's array, which must then outlive the mesh.
/// Move-only; what it was moved from is empty.
class ColumnStorage {
 public:
  ColumnStorage() noexcept = default;
  ColumnStorage(Buffer<Index>&& owned) noexcept  // NOLINT(google-explicit-constructor)
      : owned_(std::move(owned)), view_(owned_.span()) {}
  [[nodiscard]] static ColumnStorage borrow(std::span<const Index> values) noexcept {
    ColumnStorage storage;
    storage.view_ = values;
    return storage;
  }
  ColumnStorage(ColumnStorage&& other) noexcept
      : owned_(std::move(other.owned_)), view_(std::exchange(other.view_, {})) {}
  ColumnStorage& operator=(ColumnStorage&& other) noexcept {
    owned_ = std::move(other.owned_);
    view_ = std::exchange(other.view_, {});
    return *this;
  }
  ColumnStorage(const ColumnStorage&) = delete;
  ColumnStorage& operator=(const ColumnStorage&) = delete;
  ~ColumnStorage() = default;

  [[nodiscard]] const Index* data() const noexcept { return view_.data(); }
  [[nodiscard]] Index size() const noexcept { return static_cast<Index>(view_.size()); }
  [[nodiscard]] bool empty() const noexcept { return view_.empty(); }
  [[nodiscard]] std::span<const Index> span() const noexcept { return view_; }
  [[nodiscard]] bool is_borrowed() const noexcept { return owned_.empty() && !view_.empty(); }

 private:
  Buffer<Index> owned_;
  std::span<const Index> view_;
};

/// The columns of a mesh before they become a `Connectivity`; what the builder and the conversions
/// hand over. Lengths: origin and opposite H; outgoing V; next and face H, first F + 1, all three
/// empty where `all_triangles` makes them arithmetic.
struct ConnectivityColumns {
  ColumnStorage origin;
  ColumnStorage opposite;
  ColumnStorage outgoing;
  ColumnStorage next;
  ColumnStorage face;
  ColumnStorage first;
  Buffer<FanStart> fans;
  Form form = Form::open;
  bool all_triangles = false;  ///< every face is a triangle and half-edge 3f + k leaves corner k
};

/// Connectivity of an oriented mesh of triangles or polygons, with boundary, as flat columns.
///
/// Layout     See the drawing in engine/DESIGN.md. The half-edge as record: D. Muller and F.
///            Preparata, "Finding the intersection of two convex polyhedra", 1978; as numbers, with
///            `next` and `face` of triangles computed: Campagna, Kobbelt and Seidel, 1998.
/// Invariants I1 to I8 are listed in engine/DESIGN.md and checked by `validate`.
/// Cost       A triangle mesh stores origin, opposite and outgoing: 26 bytes a triangle; `next` and
///            `face` are arithmetic until `materialise` stores them.
/// Threads    Const members may be called concurrently; non-const ones need exclusive access. Two
///            meshes share nothing.
/// Lifetime   Views are valid until a non-const member is called or the mesh is moved or destroyed.
class Connectivity {
 public:
  /// A mesh without elements.
  Connectivity() noexcept { columns_.all_triangles = true; }
  /// \pre the lengths agree as `ConnectivityColumns` says; nothing else is checked, see `validate`.
  explicit Connectivity(ConnectivityColumns&& columns) noexcept;

  [[nodiscard]] Index vertex_count() const noexcept { return columns_.outgoing.size(); }
  [[nodiscard]] Index halfedge_count() const noexcept { return columns_.origin.size(); }
  [[nodiscard]] Index face_count() const noexcept { return face_count_; }
  [[nodiscard]] Form form() const noexcept { return columns_.form; }

  /// True if `triangles()` may be called: all faces are triangles, in the default form.
  [[nodiscard]] bool is_implicit() const noexcept {
    return columns_.all_triangles && columns_.form == Form::open;
  }
  /// True if `polygons()` may be called: `next`, `face` and `first` are stored.
  [[nodiscard]] bool is_explicit() const noexcept { return !columns_.first.empty(); }
  /// True if every face is a triangle and half-edge 3f + k leaves corner k of face f, in either
  /// form.
  [[nodiscard]] bool is_triangle_mesh() const noexcept { return columns_.all_triangles; }

  /// \pre is_implicit()
  [[nodiscard]] TriangleView triangles() const noexcept;
  /// \pre is_explicit()
  [[nodiscard]] PolygonView polygons() const noexcept;

  /// Calls `function` with the cheapest view that this mesh has, and returns its result. The view
  /// is a temporary: the function must not keep it.
  template <class Function>
  decltype(auto) visit(Function&& function) const {
    if (is_implicit()) return std::forward<Function>(function)(triangles());
    return std::forward<Function>(function)(polygons());
  }

  /// Stores `next`, `face` and `first` of an implicit mesh (which stays implicit too).
  /// Complexity O(H); writes 2 H + F indices. Nothing to do on an explicit mesh. Throws
  /// std::bad_alloc, and has then changed nothing.
  void materialise(const Execution& execution);

  // The stored columns as plain arrays of H, H and V indices, and the table of further fans.
  [[nodiscard]] std::span<const Index> origin() const noexcept { return columns_.origin.span(); }
  [[nodiscard]] std::span<const Index> opposite() const noexcept {
    return columns_.opposite.span();
  }
  [[nodiscard]] std::span<const Index> outgoing() const noexcept {
    return columns_.outgoing.span();
  }
  [[nodiscard]] FanTable fans() const noexcept { return columns_.fans.span(); }
  /// True if the `origin` column is the caller's own index buffer.
  [[nodiscard]] bool borrows_origin() const noexcept { return columns_.origin.is_borrowed(); }

  /// Bytes of all columns and the fan table, borrowed ones included.
  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  ConnectivityColumns columns_;
  Index face_count_ = 0;
};

}  // namespace hedgerow
