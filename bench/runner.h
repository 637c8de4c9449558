#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "dataset.h"
#include "hedgerow/digest.h"
#include "hedgerow/execution.h"

namespace hedgerow::bench {

/// What a row says besides its time, by name.
using Notes = std::map<std::string, double>;

/// The work of one benchmark, ready to be timed.
struct Work {
  std::function<void()> setup;    ///< not timed, before each run; may be empty
  std::function<void()> run;      ///< timed
  std::function<void()> cleanup;  ///< not timed, after each run; may be empty

  // Asked after a run, before its cleanup:
  std::function<std::string()> check;     ///< why the answer is wrong; "" if it is right
  std::function<std::uint64_t()> digest;  ///< of the answer: equal for equal answers
  std::function<Notes()> notes;           ///< may be empty

  std::string error;  ///< why there is nothing to run; else ""
};

/// What the first run gave.
struct Answer {
  std::string error;  ///< why the work must not be timed; else ""
  std::uint64_t digest = 0;
  Notes notes;
};
/// Runs the work once, asks for its answer and cleans up. Without `is_checked` the answer is not
/// compared with the reference: for whoever compares the digests of two programs.
[[nodiscard]] Answer first_answer(const Work& work, bool is_checked);

/// The digest of a mesh, and of a range of plain values.
[[nodiscard]] std::uint64_t digest_of(const Connectivity& mesh);
template <class Range>
[[nodiscard]] std::uint64_t digest_of(const Range& values) {
  return digest(std::as_bytes(std::span(values.data(), values.size())));
}

/// Bytes that any implementation of an operation has to move: each input column read once, each
/// output column written once, nothing for lines that are read before they are overwritten.
struct Traffic {
  double read = 0;
  double written = 0;

  [[nodiscard]] double total() const noexcept { return read + written; }
};

/// Which bandwidth kernel mixes reads and writes as an operation does.
enum class Mix {
  read,   ///< reads only, or nearly
  copy,   ///< as much written as read
  triad,  ///< twice as much read as written, or more
};
/// "read", "copy", "triad"
[[nodiscard]] const char* name(Mix mix) noexcept;

/// One benchmark, named `operation/dataset/size/threads`, with `/variant` behind it if it is not
/// the engine that is measured, or the engine in another way.
struct Case {
  std::string operation;
  DatasetKey data;
  int threads = 1;
  std::string variant;
  /// Sets the work up.
  std::function<Work(const Dataset&, const Execution&)> prepare;
  std::function<Traffic(const Dataset&)> traffic;
  Mix mix = Mix::triad;
  /// Cases of one family on one dataset run in turns, so that the ratio of two of them is not that
  /// of two moments; empty: the operation.
  std::string family{};

  [[nodiscard]] std::string name() const;
  /// The name, and behind it the class of its working set: "build/grid/4M/1/DRAM".
  [[nodiscard]] std::string name_with_class() const;
  [[nodiscard]] std::string group() const;
};

/// What to register: from the command line.
struct Plan {
  std::vector<DatasetKey> all;          ///< the main operations
  std::vector<DatasetKey> with_peers;   ///< baselines and peer libraries as well
  std::vector<DatasetKey> large;        ///< variants and whole-mesh operations as well
  std::vector<DatasetKey> disordered;   ///< the two strategies of the builder, and nothing else
  std::vector<DatasetKey> represented;  ///< every representation, and nothing else
  std::vector<DatasetKey> imr;          ///< the six tests of the IMR 2011 suite, and nothing else
  std::vector<DatasetKey> planar;       ///< triangulations and what changes meshes, no other
  std::vector<int> threads;
  bool is_smoke = false;  ///< tiny meshes, one iteration each

  [[nodiscard]] bool has_peers(const DatasetKey& key) const;
};

/// Registers one benchmark. An item is a half-edge, always.
void add(Case benchmark);

/// All that were registered, in that order. Lifetime: until the next one is added.
[[nodiscard]] const std::vector<Case>& all_cases();

/// An arena of `threads` threads, kept for the whole run; serial for 1.
[[nodiscard]] Execution execution_with(int threads);

/// Seconds that all threads of this process have run. Far below the time that passed (times the
/// threads): others had the processors meanwhile.
[[nodiscard]] double processor_time() noexcept;

// One for each source file of benchmarks.
void add_bandwidth(const Plan& plan);
void add_boundary(const Plan& plan);
void add_buffer(const Plan& plan);
void add_build(const Plan& plan);
void add_circulate(const Plan& plan);
void add_decimate(const Plan& plan);
void add_dirty(const Plan& plan);
void add_imr(const Plan& plan);
void add_normals(const Plan& plan);
void add_planar(const Plan& plan);
void add_query(const Plan& plan);
void add_reorder(const Plan& plan);
void add_representations(const Plan& plan);
void add_subdivide(const Plan& plan);
void add_validate(const Plan& plan);

/// What the connectivity of `mesh` takes.
[[nodiscard]] double bytes_per_halfedge(const Connectivity& mesh);

/// Bytes of one index, as a factor for `Case::traffic`.
inline constexpr double kIndexBytes = sizeof(Index);
inline constexpr double kPointBytes = 3 * sizeof(float);

}  // namespace hedgerow::bench
