#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hedgerow/index.h"

namespace hedgerow {

/// Which elements an array beside a mesh has entries for.
enum class Element : std::uint8_t { vertex, halfedge, face };

/// The columns of an `EditMesh`.
enum class EditColumn : std::uint8_t {
  origin,
  opposite,
  next,
  prev,
  face,
  outgoing,
  is_gone,
  first,
};
/// Whose column it is.
[[nodiscard]] constexpr Element element_of(EditColumn column) noexcept {
  return column <= EditColumn::face    ? Element::halfedge
         : column == EditColumn::first ? Element::face
                                       : Element::vertex;
}

/// An entry of a column that an edit wrote.
struct Write {
  EditColumn column{};
  Index index = 0;
  Index before = 0;
  Index after = 0;
};

/// An element that an edit made, and what it was made from: a value of its own follows from these.
struct Birth {
  Element element{};
  Index id = kInvalidIndex;
  Index source = kInvalidIndex;  ///< of the same kind; invalid: from nothing
  Index other = kInvalidIndex;   ///< a second one: the other end of an edge that was split
};

struct Death {
  Element element{};
  Index id = kInvalidIndex;
};

/// All that one edit did, in the order in which it did it: enough to do it again on a copy of the
/// mesh, to take it back, and to carry arrays along. A value: it may be kept and copied.
struct Change {
  std::vector<Write> writes;
  std::vector<Birth> births;  ///< ids of each kind ascend
  std::vector<Death> deaths;
  Index counts_before[3] = {};  ///< by `Element`
  Index counts_after[3] = {};
  bool is_complete = true;  ///< false: it was not recorded

  /// Elements that were there before and after and of which some entry changed, ascending.
  [[nodiscard]] std::vector<Index> changed(Element element) const;
};

/// Carries an array with one value for each `element` over the change: a new element gets the value
/// of what it was made from, or `T{}`. What died keeps its place until `compact`.
template <class T>
void apply(const Change& change, Element element, std::vector<T>& values) {
  values.resize(static_cast<std::size_t>(change.counts_after[static_cast<std::size_t>(element)]));
  for (const Birth& birth : change.births) {
    if (birth.element != element || birth.source == kInvalidIndex) continue;
    values[static_cast<std::size_t>(birth.id)] = values[static_cast<std::size_t>(birth.source)];
  }
}

/// The values of what `compact` kept, in the new order. `map[old]` is the new number.
template <class Id, class T>
[[nodiscard]] std::vector<T> compacted(const std::vector<Id>& map, const std::vector<T>& values) {
  Index count = 0;
  for (const Id id : map) count = id.value < count ? count : id.value + 1;
  std::vector<T> kept(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < map.size(); ++i) {
    if (map[i].valid()) kept[static_cast<std::size_t>(map[i].value)] = values[i];
  }
  return kept;
}

}  // namespace hedgerow
