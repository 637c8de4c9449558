#pragma once

#include <span>
#include <utility>
#include <vector>

#include "at.h"
#include "edit/edit.h"
#include "parallel/parallel.h"

namespace hedgerow {

/// What a batch needs: new elements, and entries of the record, of each list at the most.
struct BatchRoom {
  Index vertices = 0;  ///< that are made
  Index halfedges = 0;
  Index faces = 0;
  std::size_t writes = 0;  ///< of the record
};

/// One batch of edits: asks all, chooses those that do not meet, does them.
///
/// `Kind` is one sort of edit, with
///  Plan                what is to be known of an edit when it is done
///  check(h)            whether it can be done
///  plan(h)             of one that can; both are asked in parallel
///  claim(plan)         false if an earlier one that claimed its place stands in the way
///  room()              of the edits that claimed their place: what they need
///  record(edit, plan)  does it, with a record
///  scatter(range, plans, columns)  does many, in parallel and without
///
/// Nothing is allocated once something is written, so that a lack of memory changes nothing.
template <class Kind>
[[nodiscard]] EditBatch run_batch(EditMesh& mesh, Kind kind, std::span<const HalfedgeId> wanted,
                                  const Execution& execution) {
  constexpr Index kBatchGrain = 1 << 12;  // edits a task
  std::vector<typename Kind::Plan> plans(wanted.size());
  std::vector<char> is_possible(wanted.size());
  par::for_each_range(execution, static_cast<Index>(wanted.size()), kBatchGrain,
                      [&](IndexRange range) {
                        for (Index i = range.begin; i < range.end; ++i) {
                          is_possible[at(i)] = kind.check(wanted[at(i)]) ? 1 : 0;
                          if (is_possible[at(i)] != 0) plans[at(i)] = kind.plan(wanted[at(i)]);
                        }
                      });
  EditBatch batch;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (is_possible[i] == 0) {
      batch.refused.push_back(wanted[i]);
    } else if (!kind.claim(plans[i])) {
      batch.rest.push_back(wanted[i]);
    } else {
      plans[batch.done.size()] = plans[i];
      batch.done.push_back(wanted[i]);
    }
  }
  plans.resize(batch.done.size());
  const BatchRoom room = kind.room();
  Edit::make_room(mesh, room.vertices, room.halfedges, room.faces,
                  mesh.is_recording() ? room.writes : 0);
  Edit edit(mesh);
  if (mesh.is_recording()) {
    for (const typename Kind::Plan& plan : plans) kind.record(edit, plan);
  } else {
    edit.grow(room.vertices, room.halfedges, room.faces);
    const kernels::EditColumns columns = Edit::columns(mesh);
    par::for_each_range(execution, static_cast<Index>(plans.size()), kBatchGrain,
                        [&](IndexRange range) { Kind::scatter(range, plans.data(), columns); });
  }
  batch.change = *edit.done();
  return batch;
}

}  // namespace hedgerow
