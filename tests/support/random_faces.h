#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "support/reference_mesh.h"

/// Small face lists made from a seed, the same on every machine: two thirds sound, one third with
/// defects of every kind.
namespace hedgerow::test {

/// Seeded numbers. Not the standard distributions, which differ between libraries.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// 0 .. count - 1
  template <std::integral Integer>
  Integer below(Integer count) {
    return static_cast<Integer>(engine_() % static_cast<std::uint64_t>(count));
  }
  bool one_in(int n) { return below(n) == 0; }
  template <class T>
  const T& any_of(const std::vector<T>& values) {
    return values[below(values.size())];
  }
  template <class T>
  void shuffle(std::vector<T>& values) {
    for (std::size_t i = values.size(); i > 1; --i) std::swap(values[i - 1], values[below(i)]);
  }

 private:
  std::mt19937_64 engine_;
};

using Corners = std::vector<std::int64_t>;

/// A patch of `width` x `height` cells, wrapped round in x, in both or not at all; cells are quads
/// or cut into two triangles, and some are missing.
inline PlainFaces random_patch(Random& random) {
  const std::int64_t width = 1 + random.below(4);
  const std::int64_t height = 1 + random.below(4);
  const bool wrap_x = width > 2 && random.one_in(3);
  const bool wrap_y = wrap_x && height > 2 && random.one_in(2);
  const bool twist = wrap_x && !wrap_y && random.one_in(3);
  const std::int64_t quads_in_ten = random.any_of<std::int64_t>({0, 0, 10, 5});
  const std::int64_t columns = wrap_x ? width : width + 1;
  const std::int64_t rows = wrap_y ? height : height + 1;
  const auto vertex = [&](std::int64_t x, std::int64_t y) {
    if (x == columns && twist) y = rows - 1 - y;  // a Moebius band
    return (y % rows) * columns + x % columns;
  };
  PlainFaces list{{}, rows * columns};
  for (std::int64_t y = 0; y < height; ++y) {
    for (std::int64_t x = 0; x < width; ++x) {
      const Corners quad = {vertex(x, y), vertex(x + 1, y), vertex(x + 1, y + 1), vertex(x, y + 1)};
      if (random.one_in(12)) continue;
      if (random.below(10) < quads_in_ten) {
        list.faces.push_back(quad);
      } else {
        list.faces.push_back({quad[0], quad[1], quad[2]});
        list.faces.push_back({quad[0], quad[2], quad[3]});
      }
    }
  }
  return list;
}

/// Triangles round one vertex, closed or open; with a lid of one polygon now and then.
inline PlainFaces random_cone(Random& random) {
  const std::int64_t count = 3 + random.below(20);
  PlainFaces list{{}, count + 1};
  const bool is_closed = random.one_in(2);
  for (std::int64_t i = 0; i + !is_closed < count; ++i) {
    list.faces.push_back({count, i, (i + 1) % count});
  }
  if (is_closed && random.one_in(2)) {
    Corners lid;
    for (std::int64_t i = count; i-- > 0;) lid.push_back(i);
    list.faces.push_back(lid);
  }
  return list;
}

/// Faces with any distinct vertices at all: mostly non-manifold.
inline PlainFaces random_clutter(Random& random) {
  PlainFaces list{{}, 3 + random.below(10)};
  const std::int64_t face_count = random.below(12);
  const std::int64_t max_degree =
      random.one_in(2) ? 3 : std::min<std::int64_t>(6, list.vertex_count);
  for (std::int64_t f = 0; f < face_count; ++f) {
    Corners all;
    for (std::int64_t v = 0; v < list.vertex_count; ++v) all.push_back(v);
    random.shuffle(all);
    all.resize(static_cast<std::size_t>(3 + random.below(max_degree - 2)));
    list.faces.push_back(all);
  }
  return list;
}

/// Adds one defect; which kinds of defect follow from it depends on the list.
inline void add_defect(PlainFaces& list, Random& random) {
  if (list.faces.empty() || list.faces[0].empty()) return;
  auto& face = list.faces[random.below(list.faces.size())];
  const auto any_vertex = [&] { return random.below(list.vertex_count); };
  switch (random.below(10)) {
    case 0:  // an index out of range
      if (!face.empty()) {
        face[random.below(face.size())] =
            random.one_in(2) ? list.vertex_count + random.below(3) : -1;
      }
      return;
    case 1:  // too few corners; a face of a triangle list cannot lose any
      face.resize(random.below(std::size_t{3}));
      return;
    case 2:  // a vertex twice in a face
      if (face.size() > 1) face[random.below(face.size())] = face[random.below(face.size())];
      return;
    case 3: {  // a face twice, turned round and perhaps over
      Corners copy = face;
      if (!copy.empty()) std::rotate(copy.begin(), copy.begin() + 1, copy.end());
      if (random.one_in(2)) std::reverse(copy.begin(), copy.end());
      list.faces.push_back(copy);
      return;
    }
    case 4:  // one more face on an edge
      if (face.size() > 2) list.faces.push_back({face[1], face[0], any_vertex()});
      return;
    case 5:  // a face turned over
      std::reverse(face.begin(), face.end());
      return;
    case 6: {  // two vertices made one: a bowtie, or worse
      const std::int64_t from = any_vertex();
      const std::int64_t to = any_vertex();
      for (Corners& f : list.faces) std::replace(f.begin(), f.end(), from, to);
      return;
    }
    case 7:  // isolated vertices
      list.vertex_count += 1 + random.below(3);
      return;
    case 8: {  // a second fan at a vertex
      const std::int64_t v = any_vertex();
      list.faces.push_back({v, list.vertex_count, list.vertex_count + 1});
      list.vertex_count += 2;
      return;
    }
    default:  // a few faces between any vertices
      for (std::int64_t i = 0; i < 3; ++i) {
        list.faces.push_back({any_vertex(), any_vertex(), any_vertex()});
      }
  }
}

/// The list of this seed. All faces are triangles in about half of the lists.
inline PlainFaces random_faces(std::uint64_t seed) {
  Random random(seed);
  const std::int64_t shape = random.below(8);
  PlainFaces list = shape < 5   ? random_patch(random)
                    : shape < 7 ? random_cone(random)
                                : random_clutter(random);
  if (random.one_in(3)) {
    const std::int64_t defects = 1 + random.below(4);
    for (std::int64_t i = 0; i < defects; ++i) add_defect(list, random);
  }
  for (Corners& face : list.faces) {
    if (face.empty()) continue;
    const auto turn = static_cast<std::ptrdiff_t>(random.below(face.size()));
    std::rotate(face.begin(), face.begin() + turn, face.end());
  }
  if (random.one_in(2)) random.shuffle(list.faces);
  return list;
}

/// The list of this seed without the faces that no mesh can hold.
inline PlainFaces random_good_faces(std::uint64_t seed) {
  PlainFaces list = random_faces(seed);
  std::erase_if(list.faces, [&](Corners face) {
    const bool in_range = std::all_of(
        face.begin(), face.end(), [&](std::int64_t v) { return v >= 0 && v < list.vertex_count; });
    std::sort(face.begin(), face.end());
    const bool repeats = std::adjacent_find(face.begin(), face.end()) != face.end();
    return !in_range || repeats || face.size() < 3;
  });
  return list;
}

/// The oracle's mesh of `random_good_faces(seed)`, with every bad edge cut.
inline ReferenceMesh random_reference_mesh(std::uint64_t seed) {
  const PlainFaces list = random_good_faces(seed);
  std::vector<std::vector<Index>> faces;
  for (const Corners& face : list.faces) faces.emplace_back(face.begin(), face.end());
  return reference_mesh(faces, static_cast<Index>(list.vertex_count));
}

}  // namespace hedgerow::test
