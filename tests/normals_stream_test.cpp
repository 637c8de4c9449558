#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/execution.h"
#include "hedgerow/normals.h"
#include "hedgerow/shapes.h"
#include "hedgerow/workspace.h"
#include "kernels/face_normals.h"
#include "kernels/scatter_normals.h"
#include "support/normal_meshes.h"

namespace hedgerow {
namespace {

constexpr float kUntouched = -7;

// Writes `count` normals to an output that starts `shift` floats behind a boundary of 32 bytes, and
// returns all of the memory, of which nothing else may have changed.
template <class Write>
std::vector<float> written(Index count, int shift, bool is_streamed, const Write& write) {
  std::vector<float> memory(3 * static_cast<std::size_t>(count) + 32, kUntouched);
  const auto address = reinterpret_cast<std::uintptr_t>(memory.data()) / sizeof(float);
  const auto begin = static_cast<std::ptrdiff_t>((8 - address % 8) % 8) + shift;
  write(kernels::NormalWriter{{memory.data() + begin, count}, DegeneratePolicy::zero, is_streamed});
  std::rotate(memory.begin(), memory.begin() + begin, memory.end());
  return memory;
}

// Bit for bit, where streaming has to find its own aligned start.
TEST(NormalStreams, WriteWhatPlainStoresWrite) {
  const Soup soup = test::sphere(3);
  const kernels::FaceSource faces(soup.face_list());
  const kernels::Points points{soup.positions()};
  const auto sums = [&](Index size) {
    std::vector<kernels::VertexSum> all(static_cast<std::size_t>(size));
    for (Index i = 0; i < size; ++i) {
      const auto x = static_cast<float>(i);
      // One in ten has no direction, and one in ten is out of range.
      const float y = i % 10 == 3 ? 1e30F : 1;
      all[static_cast<std::size_t>(i)] = {
          i % 10 == 7 ? kernels::Float3{0, 0, 0} : kernels::Float3{x, y, -x}, 0};
    }
    return all;
  };
  for (int shift = 0; shift < 8; ++shift) {
    for (const Index count : {1, 7, 8, 9, 31, 200}) {
      const auto write_faces = [&](const kernels::NormalWriter& writer) {
        static_cast<void>(
            kernels::face_normals({0, count}, faces, points, PolygonMethod::newell, writer));
      };
      EXPECT_EQ(written(count, shift, true, write_faces), written(count, shift, false, write_faces))
          << "faces, shift " << shift << ", count " << count;
      const auto write_sums = [&](const kernels::NormalWriter& writer) {
        auto all = sums(count);
        Index again = 0;
        static_cast<void>(kernels::finish_sums({0, count, all.data()}, writer, again));
      };
      EXPECT_EQ(written(count, shift, true, write_sums), written(count, shift, false, write_sums))
          << "sums, shift " << shift << ", count " << count;
    }
  }
}

// Output large enough to be streamed, next to the same normals written in strides, which are not.
TEST(NormalStreams, GiveTheBitsOfStridedOutput) {
  const Result<Soup> soup = shapes::terrain(1200, 1200);
  ASSERT_TRUE(soup.has_value());
  const FaceList faces = soup->face_list();
  ASSERT_GE(faces.vertex_count * std::int64_t{sizeof(float[3])}, std::int64_t{1} << 24U);
  for (const Execution& execution : {Execution::serial(), Execution::current_arena()}) {
    Workspace workspace;
    const auto run = [&](std::size_t floats, std::vector<float>& out) {
      const NormalsOut view{out.data(), faces.vertex_count, floats * sizeof(float)};
      const auto stats =
          scatter_vertex_normals(faces, soup->positions(), view, {}, execution, workspace);
      ASSERT_TRUE(stats.has_value());
      EXPECT_EQ(stats->degenerate_count, 0);
    };
    std::vector<float> packed(3 * static_cast<std::size_t>(faces.vertex_count));
    std::vector<float> strided(4 * static_cast<std::size_t>(faces.vertex_count));
    run(3, packed);
    run(4, strided);
    std::int64_t different = 0;
    for (std::size_t v = 0; v < packed.size() / 3; ++v) {
      for (std::size_t c = 0; c < 3; ++c) {
        different += std::bit_cast<std::uint32_t>(packed[3 * v + c]) !=
                     std::bit_cast<std::uint32_t>(strided[4 * v + c]);
      }
    }
    EXPECT_EQ(different, 0);
  }
}

}  // namespace
}  // namespace hedgerow
