#include "kernels/flip_edges.h"

namespace hedgerow::kernels {
namespace {

void link(Index h, Index g, const EditColumns& columns) noexcept {
  columns.next[h] = g;
  columns.prev[g] = h;
}

}  // namespace

void scatter_flips(IndexRange range, const Flip* flips, const EditColumns& columns) noexcept {
  for (Index i = range.begin; i < range.end; ++i) {
    const Index h = flips[i].halfedge;
    const Index o = columns.opposite[h];
    const Index n = columns.next[h];
    const Index m = columns.next[o];
    const Index p = columns.prev[h];
    const Index q = columns.prev[o];
    const Index after_n = columns.next[n];
    const Index after_m = columns.next[m];
    const Index f = columns.face[h];
    const Index g = columns.face[o];
    if (flips[i].starts_origin) columns.outgoing[columns.origin[h]] = m;
    if (flips[i].starts_target) columns.outgoing[columns.origin[o]] = n;
    // Within the two faces: the opposite of m is another flip's to write.
    columns.origin[h] = columns.origin[after_m];
    columns.origin[o] = columns.origin[after_n];
    link(h, after_n, columns);
    link(o, after_m, columns);
    link(p, m, columns);
    link(m, h, columns);
    link(q, n, columns);
    link(n, o, columns);
    columns.face[m] = f;
    columns.face[n] = g;
    if (columns.first[f] == n) columns.first[f] = h;
    if (columns.first[g] == m) columns.first[g] = o;
  }
}

}  // namespace hedgerow::kernels
