#include "edit/edit.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <tuple>
#include <utility>

#include "closed_columns.h"
#include "parallel/parallel.h"

namespace hedgerow {

namespace {

constexpr Index kEditGrain = 1 << 16;
constexpr std::array kColumns = {EditColumn::origin,  EditColumn::opposite, EditColumn::next,
                                 EditColumn::prev,    EditColumn::face,     EditColumn::outgoing,
                                 EditColumn::is_gone, EditColumn::first};

// The entry of an element of which nothing is known.
constexpr Index none_of(EditColumn which) noexcept {
  return which == EditColumn::is_gone ? 0 : kInvalidIndex;
}

}  // namespace

Edit::Edit(EditMesh& mesh) noexcept : m_(mesh) {
  Change& change = m_.change_;
  change.writes.clear();
  change.births.clear();
  change.deaths.clear();
  change.is_complete = m_.is_recording_;
  change.counts_before[0] = m_.vertex_count();
  change.counts_before[1] = m_.halfedge_count();
  change.counts_before[2] = m_.face_count();
}

EditResult Edit::done() {
  Change& change = m_.change_;
  change.counts_after[0] = m_.vertex_count();
  change.counts_after[1] = m_.halfedge_count();
  change.counts_after[2] = m_.face_count();
  return &change;
}

void Edit::set(EditColumn column, Index index, Index value) {
  Index& entry = m_.column(column)[static_cast<std::size_t>(index)];
  if (m_.is_recording_ && entry != value) {
    m_.change_.writes.push_back({column, index, entry, value});
  }
  entry = value;
}

void Edit::note_birth(const Birth& birth) {
  if (m_.is_recording_) m_.change_.births.push_back(birth);
}
void Edit::note_death(const Death& death) {
  if (m_.is_recording_) m_.change_.deaths.push_back(death);
}

void Edit::give(HalfedgeId begin, HalfedgeId end, FaceId f) {
  for (HalfedgeId h = begin; h != end; h = next(h)) set_face(h, f);
}

VertexId Edit::add_vertex(VertexId source, VertexId other) {
  const VertexId v(m_.vertex_count());
  m_.outgoing_.push_back(kInvalidIndex);
  m_.is_gone_.push_back(0);
  note_birth({Element::vertex, v.value, source.value, other.value});
  return v;
}

HalfedgeId Edit::add_halfedge(VertexId origin, FaceId face, HalfedgeId source) {
  const HalfedgeId h(m_.halfedge_count());
  for (auto* column : {&m_.origin_, &m_.opposite_, &m_.next_, &m_.prev_, &m_.face_}) {
    column->push_back(kInvalidIndex);
  }
  set_origin(h, origin);
  set_face(h, face);
  note_birth({Element::halfedge, h.value, source.value});
  return h;
}

FaceId Edit::add_face(HalfedgeId first, FaceId source) {
  const FaceId f(m_.face_count());
  m_.first_.push_back(kInvalidIndex);
  set_first(f, first);
  note_birth({Element::face, f.value, source.value});
  return f;
}

void Edit::remove(VertexId v) {
  set_outgoing(v, HalfedgeId());
  set(EditColumn::is_gone, v.value, 1);
  note_death({Element::vertex, v.value});
}

void Edit::remove(HalfedgeId h) {
  for (const EditColumn column : {EditColumn::origin, EditColumn::opposite, EditColumn::next,
                                  EditColumn::prev, EditColumn::face}) {
    set(column, h.value, kInvalidIndex);
  }
  note_death({Element::halfedge, h.value});
}

void Edit::remove(FaceId f) {
  set_first(f, HalfedgeId());
  note_death({Element::face, f.value});
}

kernels::EditColumns Edit::columns(EditMesh& mesh) noexcept {
  return {mesh.origin_.data(), mesh.opposite_.data(), mesh.next_.data(),    mesh.prev_.data(),
          mesh.face_.data(),   mesh.outgoing_.data(), mesh.is_gone_.data(), mesh.first_.data()};
}

void Edit::make_room(EditMesh& mesh, Index vertices, Index halfedges, Index faces,
                     std::size_t writes) {
  for (GrowingColumn* column :
       {&mesh.origin_, &mesh.opposite_, &mesh.next_, &mesh.prev_, &mesh.face_}) {
    column->make_room(static_cast<std::size_t>(halfedges));
  }
  mesh.outgoing_.make_room(static_cast<std::size_t>(vertices));
  mesh.is_gone_.make_room(static_cast<std::size_t>(vertices));
  mesh.first_.make_room(static_cast<std::size_t>(faces));
  const auto reserve = [writes](auto& list) {
    if (writes > list.capacity()) list.reserve(writes);
  };
  reserve(mesh.change_.writes);
  reserve(mesh.change_.births);
  reserve(mesh.change_.deaths);
}

void Edit::grow(Index vertices, Index halfedges, Index faces) noexcept {
  for (GrowingColumn* column : {&m_.origin_, &m_.opposite_, &m_.next_, &m_.prev_, &m_.face_}) {
    column->extend(static_cast<std::size_t>(halfedges));
  }
  m_.outgoing_.extend(static_cast<std::size_t>(vertices));
  std::fill_n(m_.is_gone_.data() + m_.is_gone_.size(), vertices, Index{0});
  m_.is_gone_.extend(static_cast<std::size_t>(vertices));
  m_.first_.extend(static_cast<std::size_t>(faces));
}

// ---- the mesh

namespace {

constexpr const char* kRefusalNames[] = {
    "none",         "no-such-element", "boundary",       "same-face",      "other-face",
    "adjacent",     "same-vertex",     "duplicate-edge", "duplicate-face", "link-condition",
    "several-fans", "too-few-corners", "not-a-path",     "too-many",       "other-state"};
static_assert(std::size(kRefusalNames) == static_cast<std::size_t>(Refusal::other_state) + 1);

}  // namespace

const char* name(Refusal refusal) noexcept {
  return kRefusalNames[static_cast<std::size_t>(refusal)];
}

Result<EditMesh> EditMesh::of(const Connectivity& mesh, const Execution& execution) {
  auto columns = detail::closed_columns(mesh, execution);
  if (!columns) return fail(columns.error());
  Buffer<Index> prev(columns->next.size());
  // `next` is a permutation.
  par::for_each_range(execution, static_cast<Index>(prev.size()), kEditGrain,
                      [&](IndexRange range) {
                        for (Index h = range.begin; h < range.end; ++h)
                          prev[at(columns->next[at(h)])] = h;
                      });
  EditMesh made;
  made.form_ = mesh.form();
  made.is_gone_ = GrowingColumn(Buffer<Index>(columns->outgoing.size(), 0));
  made.fans_.assign(columns->fans.begin(), columns->fans.end());
  columns->first.truncate(at(mesh.face_count()));
  made.origin_ = GrowingColumn(std::move(columns->origin));
  made.opposite_ = GrowingColumn(std::move(columns->opposite));
  made.next_ = GrowingColumn(std::move(columns->next));
  made.prev_ = GrowingColumn(std::move(prev));
  made.face_ = GrowingColumn(std::move(columns->face));
  made.outgoing_ = GrowingColumn(std::move(columns->outgoing));
  made.first_ = GrowingColumn(std::move(columns->first));
  return made;
}

GrowingColumn& EditMesh::column(EditColumn which) noexcept {
  switch (which) {
    case EditColumn::origin:
      return origin_;
    case EditColumn::opposite:
      return opposite_;
    case EditColumn::next:
      return next_;
    case EditColumn::prev:
      return prev_;
    case EditColumn::face:
      return face_;
    case EditColumn::outgoing:
      return outgoing_;
    case EditColumn::is_gone:
      return is_gone_;
    default:
      return first_;
  }
}

HalfedgeId EditMesh::find(VertexId a, VertexId b) const noexcept {
  const EditView mesh = view();
  for (const HalfedgeId h : outgoing_halfedges(mesh, a)) {
    if (mesh.target(h) == b) return h;
  }
  return {};
}

void EditMesh::reserve(Index vertices, Index halfedges, Index faces, Index writes) {
  for (auto* column : {&origin_, &opposite_, &next_, &prev_, &face_}) {
    column->reserve(at(halfedges));
  }
  outgoing_.reserve(at(vertices));
  is_gone_.reserve(at(vertices));
  first_.reserve(at(faces));
  change_.writes.reserve(at(writes));
  change_.births.reserve(at(writes));
  change_.deaths.reserve(at(writes));
}

std::vector<Index> Change::changed(Element element) const {
  const Index old_count = counts_before[static_cast<std::size_t>(element)];
  std::vector<Write> own;
  for (const Write& write : writes) {
    if (element_of(write.column) == element && write.index < old_count) own.push_back(write);
  }
  std::stable_sort(own.begin(), own.end(), [](const Write& a, const Write& b) {
    return std::tie(a.index, a.column) < std::tie(b.index, b.column);
  });
  std::vector<Index> dead;
  for (const Death& death : deaths) {
    if (death.element == element) dead.push_back(death.id);
  }
  std::sort(dead.begin(), dead.end());
  // An entry may be written several times, and end as it began.
  std::vector<Index> ids;
  for (std::size_t begin = 0, end = 0; begin < own.size(); begin = end) {
    const auto is_same_entry = [&](const Write& write) {
      return write.index == own[begin].index && write.column == own[begin].column;
    };
    while (end < own.size() && is_same_entry(own[end])) ++end;
    const Index id = own[begin].index;
    if (own[begin].before == own[end - 1].after || (!ids.empty() && ids.back() == id)) continue;
    if (!std::binary_search(dead.begin(), dead.end(), id)) ids.push_back(id);
  }
  return ids;
}

namespace {

bool has_counts(const EditMesh& mesh, const Index (&counts)[3]) noexcept {
  return mesh.vertex_count() == counts[0] && mesh.halfedge_count() == counts[1] &&
         mesh.face_count() == counts[2];
}

}  // namespace

EditCheck EditMesh::undo(const Change& change) {
  if (!change.is_complete || !has_counts(*this, change.counts_after)) {
    return {Refusal::other_state, kInvalidIndex};
  }
  // An entry may have been written several times: only the last value stands there now.
  std::size_t undone = change.writes.size();
  for (; undone > 0; --undone) {
    const Write& write = change.writes[undone - 1];
    Index& entry = column(write.column)[at(write.index)];
    if (entry != write.after) break;
    entry = write.before;
  }
  if (undone > 0) {
    const EditCheck refused{Refusal::other_state, change.writes[undone - 1].index};
    for (std::size_t i = undone; i < change.writes.size(); ++i) {
      const Write& write = change.writes[i];
      column(write.column)[at(write.index)] = write.after;
    }
    return refused;
  }
  for (const EditColumn which : kColumns) {
    column(which).resize(at(change.counts_before[static_cast<std::size_t>(element_of(which))]),
                         none_of(which));
  }
  return {};
}

EditCheck EditMesh::replay(const Change& change) {
  if (!change.is_complete || !has_counts(*this, change.counts_before)) {
    return {Refusal::other_state, kInvalidIndex};
  }
  for (const EditColumn which : kColumns) {
    column(which).resize(at(change.counts_after[static_cast<std::size_t>(element_of(which))]),
                         none_of(which));
  }
  for (std::size_t i = 0; i < change.writes.size(); ++i) {
    const Write& write = change.writes[i];
    Index& entry = column(write.column)[at(write.index)];
    if (entry == write.before) {
      entry = write.after;
      continue;
    }
    for (; i > 0; --i) {
      const Write& done = change.writes[i - 1];
      column(done.column)[at(done.index)] = done.before;
    }
    for (const EditColumn which : kColumns) {
      column(which).resize(at(change.counts_before[static_cast<std::size_t>(element_of(which))]),
                           none_of(which));
    }
    return {Refusal::other_state, write.index};
  }
  return {};
}

}  // namespace hedgerow
