#include <array>
#include <cstdio>
#include <span>

#include "hedgerow/build.h"

// Builds a tetrahedron and walks round its first vertex: done when three faces were met.
int main() {
  const std::array<hedgerow::Index, 12> corners = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
  const auto built =
      hedgerow::build(hedgerow::FaceList::triangles(std::span<const hedgerow::Index>(corners), 4),
                      {}, hedgerow::Execution::current_arena());
  if (!built) {
    std::printf("%s\n", hedgerow::name(built.error().code));
    return 1;
  }
  const hedgerow::TriangleView mesh = built->mesh.triangles();
  const hedgerow::HalfedgeId start = mesh.outgoing[hedgerow::VertexId(0)];
  int valence = 0;
  hedgerow::HalfedgeId h = start;
  do {
    ++valence;
    h = mesh.next(mesh.opposite[h]);
  } while (h != start);
  std::printf("valence %d\n", valence);
  return valence == 3 ? 0 : 1;
}
