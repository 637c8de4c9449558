#include "hedgerow/build.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "build/duplicate_faces.h"
#include "build/input_faces.h"
#include "build/pair.h"
#include "build/repair.h"
#include "build/scratch.h"
#include "build/survey.h"
#include "kernels/materialise.h"
#include "parallel/parallel.h"

namespace hedgerow {

namespace {

constexpr Index kPolygonGrain = 1 << 14;  // polygons a task

// One build: the phases in order, each of which may change `faces_`.
class Builder {
 public:
  Builder(const BuildOptions& options, const Execution& execution)
      : options_(options),
        execution_(execution),
        scratch_(options.workspace != nullptr ? options.workspace->scratch() : own_scratch_) {}

  Result<void> run(const FaceList& list) {
    faces_ = detail::take_faces(list, options_.borrow_corners, execution_);
    if (auto ok = check_single_faces(list); !ok) return ok;
    if (auto ok = treat_duplicates(); !ok) return ok;
    pair();
    note_defects();
    if (auto ok = check_fail_policies(); !ok) return ok;
    apply_skip_and_split();
    return {};
  }

  ConnectivityColumns take_columns() {
    ConnectivityColumns columns;
    columns.all_triangles = faces_.first.empty();
    const auto halfedges = static_cast<std::size_t>(faces_.corners.size());
    if (!columns.all_triangles) {
      Buffer<Index> next(halfedges);
      Buffer<Index> face(halfedges);
      par::for_each_range(
          execution_, faces_.first.size() - 1, kPolygonGrain, [&](IndexRange range) {
            kernels::fill_polygon_columns(range, faces_.first.data(), next.data(), face.data());
          });
      columns.next = std::move(next);
      columns.face = std::move(face);
    }
    columns.origin = std::move(faces_.corners);
    columns.first = std::move(faces_.first);
    columns.opposite = std::move(paired_.opposite);
    columns.outgoing = std::move(paired_.outgoing);
    columns.fans = Buffer<FanStart>::copy_of(paired_.fans);
    return columns;
  }

  BuildOutput take_output(ConnectivityColumns&& columns) {
    BuildOutput output;
    output.stats.edge_count = paired_.stats.paired_count / 2 + paired_.stats.boundary_count +
                              paired_.stats.bad_edge_count;
    output.stats.boundary_edge_count = paired_.stats.boundary_count;
    output.stats.step_count = paired_.stats.step_count;
    output.stats.strategy = paired_.strategy;
    if (paired_.strategy == BuildStrategy::window) {
      output.stats.scan_per_mille = survey_.scan_per_mille;
    }
    for (const Defect& d : defects_) ++output.stats.defect_count[static_cast<std::size_t>(d.kind)];
    output.defects = Buffer<Defect>::copy_of(defects_);
    output.faces_new_to_old = std::move(faces_.faces_new_to_old);
    output.vertices_new_to_old = std::move(faces_.vertices_new_to_old);
    output.mesh = Connectivity(std::move(columns));
    return output;
  }

 private:
  Result<void> check_single_faces(const FaceList& list) {
    survey_ = detail::survey(faces_.columns(), scratch_, execution_);
    if (survey_.check.bad_count == 0 && survey_.check.large_count == 0) return {};
    if (auto ok = detail::repair_single_faces(faces_, list, options_.policies, defects_); !ok) {
      return ok;
    }
    if (!defects_.empty()) survey_ = detail::survey(faces_.columns(), scratch_, execution_);
    return {};
  }

  // Duplicate triangles turn up while pairing, so they need a pass of their own only if something
  // is to be done about them before.
  Result<void> treat_duplicates() {
    const Action action = options_.policies[DefectKind::duplicate_face];
    const kernels::FaceColumns columns = faces_.columns();
    has_own_duplicates_ = action != Action::keep || !columns.is_triangles();
    if (!has_own_duplicates_) return {};
    const std::vector<Defect> found = detail::find_duplicate_faces(columns, execution_);
    for (Defect d : found) {
      d.value = faces_.input_face(static_cast<Index>(d.value));
      d.face = FaceId(faces_.input_face(d.face.value));
      defects_.push_back(d);
    }
    if (found.empty() || action == Action::keep) return {};
    if (action == Action::fail) {
      return fail(detail::error_of(defects_[defects_.size() - found.size()], 0,
                                   static_cast<std::int64_t>(found.size())));
    }
    change_duplicates(found, action);
    return {};
  }

  void change_duplicates(const std::vector<Defect>& found, Action action) {
    const kernels::FaceColumns columns = faces_.columns();
    std::vector<std::uint8_t> marked(static_cast<std::size_t>(columns.face_count), 0);
    std::vector<Index> corners;
    for (const Defect& d : found) {
      marked[static_cast<std::size_t>(d.face.value)] = 1;
      const Index begin = columns.begin(d.face.value);
      for (Index k = 0; k < columns.degree(d.face.value); ++k) corners.push_back(begin + k);
    }
    if (action == Action::cut) {
      cut_faces_ = std::move(marked);
      return;
    }
    if (action == Action::split) {
      detail::split_corners(faces_, corners);
    } else {
      for (std::uint8_t& m : marked) m = m == 0;
      detail::drop_faces(faces_, marked);
    }
    survey_ = detail::survey(faces_.columns(), scratch_, execution_);
  }

  void pair() {
    const kernels::FaceColumns columns = faces_.columns();
    std::vector<std::uint8_t> cut_halfedges;
    for (std::size_t f = 0; f < cut_faces_.size(); ++f) {
      const Index degree = columns.degree(static_cast<Index>(f));
      cut_halfedges.insert(cut_halfedges.end(), static_cast<std::size_t>(degree), cut_faces_[f]);
    }
    paired_ = detail::pair_halfedges(columns, survey_,
                                     cut_halfedges.empty() ? nullptr : cut_halfedges.data(),
                                     options_.strategy, scratch_, execution_);
  }

  // The table speaks of the input: what later rounds of a policy meet is not added.
  void note_defects() {
    for (Defect d : paired_.defects) {
      if (d.kind == DefectKind::duplicate_face) {
        if (has_own_duplicates_) continue;
        d.value = faces_.input_face(static_cast<Index>(d.value));
      }
      if (d.face.valid()) d.face = FaceId(faces_.input_face(d.face.value));
      defects_.push_back(d);
    }
    std::stable_sort(defects_.begin(), defects_.end(),
                     [](const Defect& a, const Defect& b) { return a.kind < b.kind; });
  }

  [[nodiscard]] Result<void> check_fail_policies() const {
    for (const Defect& d : defects_) {
      if (options_.policies[d.kind] != Action::fail) continue;
      const auto count = std::count_if(defects_.begin(), defects_.end(),
                                       [&](const Defect& other) { return other.kind == d.kind; });
      return fail(detail::error_of(d, 0, count));
    }
    return {};
  }

  void apply_skip_and_split() {
    while (true) {
      const auto keep = detail::faces_to_drop(faces_.columns(), paired_, options_.policies);
      if (keep.empty()) break;
      if (!cut_faces_.empty()) {
        std::size_t kept = 0;
        for (std::size_t f = 0; f < keep.size(); ++f) {
          if (keep[f] != 0) cut_faces_[kept++] = cut_faces_[f];
        }
        cut_faces_.resize(kept);
      }
      detail::drop_faces(faces_, keep);
      pair_again();
    }
    if (detail::split_fans(faces_, paired_, options_.policies)) pair_again();
    if (options_.policies[DefectKind::isolated_vertex] == Action::skip &&
        std::find(paired_.outgoing.begin(), paired_.outgoing.end(), kInvalidIndex) !=
            paired_.outgoing.end()) {
      detail::drop_isolated_vertices(faces_);
      pair_again();
    }
  }

  void pair_again() {
    survey_ = detail::survey(faces_.columns(), scratch_, execution_);
    pair();
  }

  const BuildOptions& options_;
  const Execution& execution_;
  detail::BuildScratch own_scratch_;
  detail::BuildScratch& scratch_;
  detail::InputFaces faces_;
  detail::Survey survey_;
  detail::PairOutput paired_;
  std::vector<Defect> defects_;
  std::vector<std::uint8_t> cut_faces_;
  bool has_own_duplicates_ = false;
};

Result<void> check_policies(const Policies& policies) {
  for (std::size_t k = 0; k < kDefectKindCount; ++k) {
    const auto kind = static_cast<DefectKind>(k);
    if (is_supported(kind, policies[kind])) continue;
    return fail({ErrorCode::unsupported_policy, static_cast<Index>(k),
                 static_cast<std::int64_t>(policies[kind])});
  }
  return {};
}

}  // namespace

BuildWorkspace::BuildWorkspace() : scratch_(std::make_unique<detail::BuildScratch>()) {}
BuildWorkspace::BuildWorkspace(BuildWorkspace&&) noexcept = default;
BuildWorkspace& BuildWorkspace::operator=(BuildWorkspace&&) noexcept = default;
BuildWorkspace::~BuildWorkspace() = default;

bool is_supported(DefectKind kind, Action action) noexcept {
  using enum Action;
  switch (kind) {
    case DefectKind::out_of_range:
    case DefectKind::too_few_corners:
      return action == fail || action == skip;
    case DefectKind::repeated_vertex:
      return action == fail || action == skip || action == split;
    case DefectKind::nonmanifold_edge:
    case DefectKind::inconsistent_edge:
      return action != keep;
    case DefectKind::isolated_vertex:
      return action == fail || action == skip || action == keep;
    default:
      return true;
  }
}

Result<BuildOutput> build(const FaceList& faces, const BuildOptions& options,
                          const Execution& execution) {
  if (auto ok = check(faces); !ok) return fail(ok.error());
  if (auto ok = check_policies(options.policies); !ok) return fail(ok.error());
  Builder builder(options, execution);
  if (auto ok = builder.run(faces); !ok) return fail(ok.error());
  return builder.take_output(builder.take_columns());
}

Result<BuildOutput> build(Buffer<Index>&& corners, Buffer<Index>&& offsets,
                          std::int64_t vertex_count, const BuildOptions& options,
                          const Execution& execution) {
  const FaceList faces =
      offsets.empty() ? FaceList::triangles<Index>(corners.span(), vertex_count)
                      : FaceList::polygons<Index>(corners.span(), offsets.span(), vertex_count);
  BuildOptions borrowing = options;
  borrowing.borrow_corners = true;
  if (auto ok = check(faces); !ok) return fail(ok.error());
  if (auto ok = check_policies(options.policies); !ok) return fail(ok.error());
  Builder builder(borrowing, execution);
  if (auto ok = builder.run(faces); !ok) return fail(ok.error());
  // The build borrowed; what it still borrows now becomes the mesh's own.
  ConnectivityColumns columns = builder.take_columns();
  if (columns.origin.is_borrowed()) columns.origin = std::move(corners);
  if (columns.first.is_borrowed()) columns.first = std::move(offsets);
  return builder.take_output(std::move(columns));
}

}  // namespace hedgerow
