#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <benchmark/benchmark.h>

#include "machine.h"
#include "mesh_source.h"
#include "runner.h"

namespace {

using hedgerow::bench::DatasetKey;
using hedgerow::bench::Plan;

constexpr std::string_view kHelp =
    "hedgerow_bench [--mesh FILE] [--smoke] [--benchmark_...]\n"
    "\n"
    "  --mesh FILE   also measure on this mesh (default: the environment's HEDGEROW_MESH, if set)\n"
    "  --smoke       every benchmark once, on tiny meshes; exit status 1 if one gives a wrong "
    "answer\n"
    "\n"
    "Benchmarks are named operation/dataset/size/threads, with /variant behind it for a baseline "
    "or\n"
    "a peer library. An item is a half-edge. Each answer is checked before it is timed.\n"
    "Example: hedgerow_bench --benchmark_filter='^build/grid/4M'\n";

/// Takes `--name VALUE` and `--name=VALUE` out of the arguments; the last one counts.
std::string take_value(std::vector<char*>& arguments, std::string_view name) {
  std::string value;
  for (std::size_t i = 1; i < arguments.size();) {
    const std::string_view argument = arguments[i];
    const bool is_joined =
        argument.size() > name.size() && argument.starts_with(name) && argument[name.size()] == '=';
    const bool is_split = argument == name && i + 1 < arguments.size();
    if (!is_joined && !is_split) {
      ++i;
      continue;
    }
    value = is_joined ? argument.substr(name.size() + 1) : std::string_view(arguments[i + 1]);
    const auto first = arguments.begin() + static_cast<std::ptrdiff_t>(i);
    arguments.erase(first, first + (is_joined ? 1 : 2));
  }
  return value;
}

bool take_switch(std::vector<char*>& arguments, std::string_view name) {
  return std::erase_if(arguments, [&](const char* argument) { return argument == name; }) > 0;
}

bool has_prefix(const std::vector<char*>& arguments, std::string_view prefix) {
  for (const std::string_view argument : arguments) {
    if (argument.starts_with(prefix)) return true;
  }
  return false;
}

Plan make_plan(bool is_smoke, const std::string& mesh) {
  Plan plan;
  plan.is_smoke = is_smoke;
  const auto processors = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  for (int threads = 1; threads < processors; threads *= 2) plan.threads.push_back(threads);
  plan.threads.push_back(processors);
  if (is_smoke) {
    plan.large = {{"grid", 200, ""}, {"shuffled", 200, ""}};
    plan.all = {{"grid", 200, ""}, {"shuffled", 200, ""}, {"icosphere", 320, ""}, {"fan", 300, ""}};
  } else {
    // One size for each of: second-level cache, last-level cache, memory.
    plan.large = {{"grid", 4'000'000, ""}, {"shuffled", 4'000'000, ""}};
    plan.all = {{"grid", 10'000, ""},        {"grid", 1'000'000, ""},      {"grid", 4'000'000, ""},
                {"shuffled", 4'000'000, ""}, {"icosphere", 1'310'720, ""}, {"fan", 1'000'000, ""}};
  }
  if (!mesh.empty()) {
    const std::int64_t face_count = hedgerow::bench::read_soup(mesh).face_count();
    const DatasetKey key{std::filesystem::path(mesh).stem().string(), face_count, mesh};
    plan.large.push_back(key);
    plan.all.push_back(key);
  }
  return plan;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<char*> arguments(argv, argv + argc);
  if (take_switch(arguments, "--help")) {
    std::cout << kHelp;
    return 0;
  }
  const bool is_smoke = take_switch(arguments, "--smoke");
  std::string mesh = take_value(arguments, "--mesh");
  const char* environment_mesh = std::getenv("HEDGEROW_MESH");
  if (mesh.empty() && environment_mesh != nullptr && !is_smoke) mesh = environment_mesh;
  const bool has_output_file = has_prefix(arguments, "--benchmark_out=");

  auto count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
  hedgerow::bench::add_machine_context();

  Plan plan;
  try {
    plan = make_plan(is_smoke, mesh);
  } catch (const std::runtime_error& error) {
    std::cerr << "hedgerow_bench: " << error.what() << "\n";
    return 3;
  }
  hedgerow::bench::add_bandwidth(plan);
  hedgerow::bench::add_buffer(plan);
  hedgerow::bench::add_build(plan);
  hedgerow::bench::add_boundary(plan);
  hedgerow::bench::add_normals(plan);
  hedgerow::bench::add_circulate(plan);
  hedgerow::bench::add_query(plan);
  hedgerow::bench::add_validate(plan);
  hedgerow::bench::add_reorder(plan);
  const int error_count = hedgerow::bench::run_all(has_output_file);
  benchmark::Shutdown();
  return error_count == 0 ? 0 : 1;
}
