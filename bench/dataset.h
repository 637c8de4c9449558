#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hedgerow/connectivity.h"
#include "hedgerow/normals.h"
#include "hedgerow/soup.h"

namespace hedgerow::bench {

/// What a benchmark runs on, by name; cheap to copy.
struct DatasetKey {
  std::string shape;                ///< as in mesh_source.h, or the stem of a file
  std::int64_t triangle_count = 0;  ///< asked for; icospheres take the nearest that exists
  std::string path;                 ///< of the file; empty: generated

  /// "4M", "10k", "871k"
  [[nodiscard]] std::string size() const;
  /// "L1", "L2", "LLC" or "DRAM": the smallest of these that holds connectivity, positions and one
  /// normal a vertex, on a nominal processor with 32 KiB, 1 MiB and 64 MiB. So it is the same word
  /// on every machine.
  [[nodiscard]] std::string working_set() const;
  /// The shape, but for a dataset that is only measured to be compared with another one, in turns:
  /// then that one's.
  [[nodiscard]] std::string family() const;
  friend bool operator==(const DatasetKey&, const DatasetKey&) = default;
};

/// The right answers, from the array-of-structs baseline: another program, another algorithm.
struct Reference {
  std::vector<Index> opposite;
  std::vector<float> face_normals;
  std::vector<float> area_normals;     ///< of the vertices, weighted by area
  std::vector<float> uniform_normals;  ///< of the vertices, all faces counting the same
  std::vector<std::uint32_t> one_ring_sums;
  Index boundary_loops = 0;
  Index components = 0;
};

/// A mesh to measure on, with what is needed to check the answers. For one thread at a time.
struct Dataset {
  DatasetKey key;
  Soup soup;  ///< only the faces that the engine keeps, in the form that every library takes
  Connectivity mesh;

  /// Made when it is first asked for.
  [[nodiscard]] const Reference& reference() const;

  [[nodiscard]] FaceList faces() const noexcept { return soup.face_list(); }
  [[nodiscard]] Positions positions() const noexcept { return soup.positions(); }

 private:
  mutable std::optional<Reference> reference_;
};

/// Element counts, to compute bytes with.
struct Counts {
  double halfedges = 0;
  double vertices = 0;
  double faces = 0;
};
[[nodiscard]] Counts counts_of(const Dataset& data) noexcept;

/// Makes the dataset on the first call and keeps it. Seeds are fixed, so every run measures the
/// same mesh. Throws std::runtime_error with the reason if a file cannot be read.
[[nodiscard]] const Dataset& dataset(const DatasetKey& key);

/// Frees all datasets but those of the same family and size: references to them die.
void forget_other_datasets(const DatasetKey& key);

/// Empty if `normals` (three floats an element) agrees with `expected` to within `tolerance` in
/// every coordinate, else a sentence that names the first element that does not. `skipped`
/// elements, in ascending order, are not compared.
[[nodiscard]] std::string compare_normals(std::span<const float> normals,
                                          std::span<const float> expected, float tolerance,
                                          std::span<const Index> skipped);

/// The vertices with several fans, ascending: the baselines see one fan of each only.
[[nodiscard]] std::vector<Index> vertices_with_several_fans(const Connectivity& mesh);

/// Largest difference of a coordinate of a unit normal that counts as equal: float sums in another
/// order over fans of a million faces.
inline constexpr float kNormalTolerance = 2e-3F;

}  // namespace hedgerow::bench
