#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "hedgerow/connectivity.h"
#include "hedgerow/execution.h"
#include "hedgerow/normals.h"
#include "hedgerow/soup.h"

/// Meshes, executions and answers that the tests of the normals share.
namespace hedgerow::test {

/// A soup from nested lists; `polygons` keeps offsets even where all faces are triangles.
[[nodiscard]] Soup make_soup(const std::vector<float>& xyz,
                             const std::vector<std::vector<Index>>& faces, bool polygons = false);

[[nodiscard]] Soup cube_of_quads();
/// A wavy grid of 2 * n * n triangles, wound round in x.
[[nodiscard]] Soup wavy_grid(Index n);
/// `n` triangles round vertex 0, half-edges in a scrambled order; the rim is wavy.
[[nodiscard]] Soup wavy_fan(Index n);
/// A subdivided octahedron of radius 1 with the given centre.
[[nodiscard]] Soup sphere(int levels, float centre = 0);
/// Any triangles or polygons over few vertices: degenerate faces, isolated vertices, several fans.
/// Corners of a face differ.
[[nodiscard]] Soup random_soup(std::uint64_t seed, Index vertex_count, Index face_count,
                               Index max_degree);
[[nodiscard]] Soup copy_of(const Soup& soup);

/// The mesh of a soup, with every defect kept or cut.
[[nodiscard]] Connectivity mesh_of(const Soup& soup);

/// The normals in packed form as bits, so that they compare exactly.
using Bits = std::vector<std::uint32_t>;
struct Answer {
  Bits bits;
  NormalStats stats;
  friend bool operator==(const Answer&, const Answer&) = default;
};

enum class Method : std::uint8_t { face, gather, scatter };

/// Runs one method with `stride_bytes` for both arrays. Bytes between the outputs are checked.
[[nodiscard]] Answer run(Method method, const Connectivity& mesh, const FaceList& faces,
                         Positions positions, const NormalOptions& options,
                         const Execution& execution, std::size_t stride_bytes = 12);
/// Both vertex methods serially and scalar code only in double: the oracle.
[[nodiscard]] std::vector<double> oracle(const FaceList& faces, Positions positions,
                                         const NormalOptions& options);
[[nodiscard]] std::vector<float> floats(const Answer& answer);
/// Largest angle in radians between the normals and the oracle's, where the oracle has one.
[[nodiscard]] double worst_angle(const Answer& answer, const std::vector<double>& expected);

/// Serial, the current arena, named arenas of 1, 2, 3, 8 and 16 threads and a callback that runs
/// its ranges backwards, each with several grains.
class Executions {
 public:
  Executions();
  ~Executions();
  Executions(const Executions&) = delete;
  Executions& operator=(const Executions&) = delete;
  [[nodiscard]] const std::vector<Execution>& all() const { return all_; }

 private:
  struct Threads;
  std::unique_ptr<Threads> threads_;
  std::vector<Execution> all_;
};

inline constexpr NormalWeight kWeights[] = {NormalWeight::uniform, NormalWeight::area,
                                            NormalWeight::angle, NormalWeight::max};

}  // namespace hedgerow::test
