// hedgerow/winged_edge.h, corner_table.h and the other representations, beside the core and the
// textbook meshes of pointers: the same questions, asked of all of them.
#include <algorithm>
#include <malloc.h>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "representations/expected.h"
#include "representations/representation.h"
#include "runner.h"

namespace hedgerow::bench {

namespace {

constexpr const char* kOtherAnswer = "another answer than the reference; not measured";

/// The representation of a dataset, kept while others of the same dataset are asked for: making
/// one takes longer than most measurements.
std::shared_ptr<Representation> made(const RepresentationKind& kind, const Dataset& data) {
  static const void* corners = nullptr;
  static std::map<std::string, std::weak_ptr<Representation>> kept;
  if (corners != data.faces().corners) kept.clear();
  corners = data.faces().corners;
  std::shared_ptr<Representation> representation = kept[kind.name].lock();
  if (!representation) representation = kind.build(data.faces(), data.positions());
  kept[kind.name] = representation;
  return representation;
}

Work prepare_question(const Dataset& data, const RepresentationKind& kind, Question question) {
  const auto mesh = made(kind, data);
  const auto answer = std::make_shared<std::uint64_t>();
  Work work;
  work.run = [mesh, question, answer] { *answer = mesh->answer(question).value_or(0); };
  work.check = [&data, question, &kind, answer] {
    return *answer == expected_answer(data, question, kind.is_closed) ? "" : kOtherAnswer;
  };
  work.digest = [answer] { return *answer; };
  work.notes = [&data, question]() -> Notes {
    return {{"elements", question_elements(data, question)}};
  };
  return work;
}

Work prepare_normals(const Dataset& data, const RepresentationKind& kind) {
  const auto mesh = made(kind, data);
  Work work;
  work.run = [mesh] { mesh->compute_vertex_normals(); };
  work.check = [&data, mesh] {
    return compare_normals(mesh->vertex_normals(), data.reference().area_normals, kNormalTolerance,
                           vertices_with_several_fans(data.mesh));
  };
  work.digest = [mesh] { return digest_of(mesh->vertex_normals()); };
  work.notes = [&data]() -> Notes { return {{"elements", counts_of(data).vertices}}; };
  return work;
}

/// What a mesh that was just built is asked: every pair counts.
constexpr Question kBuildCheck = Question::edge_faces;

Work prepare_build(const Dataset& data, const RepresentationKind& kind) {
  const auto mesh = std::make_shared<std::unique_ptr<Representation>>();
  Work work;
  work.run = [mesh, &kind, &data] { *mesh = kind.build(data.faces(), data.positions()); };
  // The allocator tidies up after millions of small blocks when the next large one is asked for:
  // that would be part of the time of whoever comes next.
  work.cleanup = [mesh] {
    mesh->reset();
    malloc_trim(0);
  };
  work.check = [&data, &kind, mesh] {
    return (*mesh)->answer(kBuildCheck) == expected_answer(data, kBuildCheck, kind.is_closed)
               ? ""
               : kOtherAnswer;
  };
  work.digest = [mesh] { return (*mesh)->answer(kBuildCheck).value_or(0); };
  work.notes = [&data, mesh]() -> Notes {
    const double edges = question_elements(data, Question::euler);
    const auto bytes = static_cast<double>((*mesh)->bytes());
    return {{"elements", edges},
            {"bytes_per_edge", bytes / edges},
            {"bytes_per_halfedge", bytes / counts_of(data).halfedges}};
  };
  return work;
}

void add_rows(const DatasetKey& key, const RepresentationKind& kind) {
  const auto no_traffic = [](const Dataset&) { return Traffic{}; };
  add({"represent_build", key, 1, kind.name,
       [&kind](const Dataset& data, const Execution&) { return prepare_build(data, kind); },
       no_traffic, Mix::read});
  for (std::size_t i = 0; i < kQuestionCount; ++i) {
    const auto question = static_cast<Question>(i);
    if (!is_asked(kind, question)) continue;
    add({"represent_" + std::string(name(question)), key, 1, kind.name,
         [&kind, question](const Dataset& data, const Execution&) {
           return prepare_question(data, kind, question);
         },
         no_traffic, Mix::read});
  }
  if (!has_vertex_normals(kind)) return;
  add({"represent_vertex_normals", key, 1, kind.name,
       [&kind](const Dataset& data, const Execution&) { return prepare_normals(data, kind); },
       no_traffic, Mix::read});
}

}  // namespace

void add_representations(const Plan& plan) {
  for (const DatasetKey& key : plan.represented) {
    for (const RepresentationKind& kind : representation_kinds()) add_rows(key, kind);
  }
}

}  // namespace hedgerow::bench
