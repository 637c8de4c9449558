// Marching tetrahedra over the six tetrahedra of each cube that share its main diagonal (Kuhn's
// triangulation): neighbouring cubes agree on the diagonals of their common square, so the surface
// has no cracks, and no case is ambiguous, so it is a manifold.

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "counts.h"
#include "hedgerow/shapes.h"
#include "turns.h"

namespace hedgerow::shapes {

namespace {

constexpr double kPeriods = 2;
// Lattice edges leave a node along the cube's 7 other corners, seen as bits x = 1, y = 2, z = 4.
constexpr std::size_t kDirections = 7;
// Each tetrahedron climbs from corner 0 to corner 7, one axis at a time.
struct Tetrahedron {
  std::array<unsigned, 4> corners;
  bool is_positive;  ///< right-handed
};
constexpr std::array<Tetrahedron, 6> kTetrahedra = {{{{0, 1, 3, 7}, true},
                                                     {{0, 2, 6, 7}, true},
                                                     {{0, 4, 5, 7}, true},
                                                     {{0, 2, 3, 7}, false},
                                                     {{0, 4, 6, 7}, false},
                                                     {{0, 1, 5, 7}, false}}};

// sin and cos along one axis; the field is a sum of products of them.
class Field {
 public:
  explicit Field(std::size_t nodes) {
    for (std::size_t i = 0; i < nodes; ++i) {
      // Off centre, so that no lattice point lies on a plane of symmetry.
      const double t = kPeriods * (static_cast<double>(i) + 0.137) / static_cast<double>(nodes - 1);
      sine_.push_back(sine_of_turns(t));
      cosine_.push_back(cosine_of_turns(t));
    }
  }
  [[nodiscard]] double operator()(std::size_t x, std::size_t y, std::size_t z) const {
    return sine_[x] * cosine_[y] + sine_[y] * cosine_[z] + sine_[z] * cosine_[x];
  }

 private:
  std::vector<double> sine_;
  std::vector<double> cosine_;
};

class Marcher {
 public:
  explicit Marcher(std::size_t cells)
      : cells_(cells), field_(cells + 1), low_(nodes_of_layer()), high_(nodes_of_layer()) {}

  // Without `soup` it only counts.
  void run(Soup* soup) {
    soup_ = soup;
    vertex_count_ = 0;
    triangle_count_ = 0;
    low_.reset(field_, cells_, 0);
    for (std::size_t z = 0; z < cells_; ++z) {
      high_.reset(field_, cells_, z + 1);
      for (std::size_t y = 0; y < cells_; ++y) {
        for (std::size_t x = 0; x < cells_; ++x) add_cube(x, y, z);
      }
      std::swap(low_, high_);
    }
  }
  [[nodiscard]] std::int64_t vertex_count() const { return vertex_count_; }
  [[nodiscard]] std::int64_t triangle_count() const { return triangle_count_; }

 private:
  struct Layer {
    std::vector<double> value;
    std::vector<std::int64_t> vertex;  ///< of the edge that leaves the node in each direction

    explicit Layer(std::size_t nodes) : value(nodes), vertex(kDirections * nodes) {}
    void reset(const Field& field, std::size_t cells, std::size_t z) {
      std::fill(vertex.begin(), vertex.end(), -1);
      for (std::size_t y = 0; y <= cells; ++y) {
        for (std::size_t x = 0; x <= cells; ++x) value[y * (cells + 1) + x] = field(x, y, z);
      }
    }
  };
  struct Cube {
    std::size_t x;
    std::size_t y;
    std::size_t z;
    std::array<double, 8> value;
  };

  [[nodiscard]] std::size_t nodes_of_layer() const { return (cells_ + 1) * (cells_ + 1); }
  [[nodiscard]] std::size_t node(const Cube& cube, unsigned corner) const {
    return (cube.y + (corner >> 1U & 1U)) * (cells_ + 1) + cube.x + (corner & 1U);
  }
  [[nodiscard]] Layer& layer_of(unsigned corner) { return (corner & 4U) != 0 ? high_ : low_; }

  void add_cube(std::size_t x, std::size_t y, std::size_t z) {
    Cube cube{x, y, z, {}};
    unsigned inside = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
      cube.value[corner] = layer_of(corner).value[node(cube, corner)];
      if (cube.value[corner] < 0) inside |= 1U << corner;
    }
    if (inside == 0 || inside == 255) return;
    for (const Tetrahedron& tetrahedron : kTetrahedra) add_tetrahedron(cube, tetrahedron, inside);
  }

  void add_tetrahedron(const Cube& cube, const Tetrahedron& tetrahedron, unsigned inside) {
    // Corners inside first, keeping track of handedness: then there are three cases, not sixteen.
    std::array<unsigned, 4> p = tetrahedron.corners;
    bool is_positive = tetrahedron.is_positive;
    unsigned count = 0;
    for (unsigned i = 0; i < 4; ++i) {
      if ((inside >> p[i] & 1U) == 0) continue;
      if (i != count) {
        std::swap(p[i], p[count]);
        is_positive = !is_positive;
      }
      ++count;
    }
    if (count == 1) {
      add_triangle(cube, {p[0], p[1]}, {p[0], p[2]}, {p[0], p[3]}, is_positive);
    } else if (count == 2) {
      add_triangle(cube, {p[0], p[2]}, {p[0], p[3]}, {p[1], p[3]}, is_positive);
      add_triangle(cube, {p[0], p[2]}, {p[1], p[3]}, {p[1], p[2]}, is_positive);
    } else if (count == 3) {
      add_triangle(cube, {p[0], p[3]}, {p[1], p[3]}, {p[2], p[3]}, is_positive);
    }
  }

  using LatticeEdge = std::pair<unsigned, unsigned>;

  void add_triangle(const Cube& cube, LatticeEdge a, LatticeEdge b, LatticeEdge c,
                    bool is_positive) {
    if (!is_positive) std::swap(b, c);
    const std::array<std::int64_t, 3> v = {vertex(cube, a), vertex(cube, b), vertex(cube, c)};
    if (soup_ != nullptr) {
      for (std::size_t k = 0; k < 3; ++k) {
        soup_->corners[3 * static_cast<std::size_t>(triangle_count_) + k] =
            static_cast<Index>(v[k]);
      }
    }
    ++triangle_count_;
  }

  std::int64_t vertex(const Cube& cube, LatticeEdge edge) {
    const unsigned from = std::min(edge.first, edge.second);
    const unsigned to = std::max(edge.first, edge.second);
    std::int64_t& v = layer_of(from).vertex[kDirections * node(cube, from) + (from ^ to) - 1];
    if (v < 0) {
      v = vertex_count_++;
      if (soup_ != nullptr) place(cube, from, to, v);
    }
    return v;
  }

  void place(const Cube& cube, unsigned from, unsigned to, std::int64_t v) {
    const double a = cube.value[from];
    const double b = cube.value[to];
    // Away from the ends, where vertices of several edges would meet.
    const double t = std::clamp(a / (a - b), 0.02, 0.98);
    const double scale = 1 / static_cast<double>(cells_);
    const auto coordinate = [&](std::size_t base, unsigned bit) {
      const double start = static_cast<double>(base + (from >> bit & 1U));
      return static_cast<float>(scale * (start + ((from ^ to) >> bit & 1U ? t : 0)));
    };
    float* xyz = soup_->xyz.data() + 3 * static_cast<std::size_t>(v);
    xyz[0] = coordinate(cube.x, 0);
    xyz[1] = coordinate(cube.y, 1);
    xyz[2] = coordinate(cube.z, 2);
  }

  std::size_t cells_;
  Field field_;
  Layer low_;
  Layer high_;
  Soup* soup_ = nullptr;
  std::int64_t vertex_count_ = 0;
  std::int64_t triangle_count_ = 0;
};

}  // namespace

Result<Soup> gyroid(std::int64_t cells) {
  if (auto ok = at_least(4, cells); !ok) return fail(ok.error());
  // Two periods cross each column of cubes about six times. Far beyond that nothing needs counting.
  constexpr std::int64_t kMostCells = 30'000;
  if (cells > kMostCells) {
    return fail({.code = ErrorCode::too_many_elements, .value = cells, .limit = kMostCells});
  }
  Marcher marcher(static_cast<std::size_t>(cells));
  marcher.run(nullptr);
  Result<Soup> soup = make_triangles(marcher.vertex_count(), marcher.triangle_count());
  if (soup) marcher.run(&*soup);
  return soup;
}

}  // namespace hedgerow::shapes
