// Saving over a file, cut short in every way that can be brought about without a power switch: what
// is there afterwards is the whole old file or the whole new one.
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <random>
#include <sched.h>
#include <sys/mount.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include <gtest/gtest.h>

#include "hedgerow/io/atomic_file.h"
#include "hedgerow/io/write.h"
#include "support/io_cases.h"

namespace hedgerow::test {
namespace {

constexpr int kSaved = 0;
constexpr int kRefused = 1;       // an error value
constexpr int kNotPossible = 77;  // the system does not let the test do what it is about

/// A zigzag of triangles, written as PLY.
class Saving {
 public:
  explicit Saving(Index vertex_count, bool durable) {
    for (Index v = 0; v < vertex_count; ++v) {
      xyz_.insert(xyz_.end(), {static_cast<float>(v), static_cast<float>(v % 2), 0});
    }
    for (Index f = 0; f + 2 < vertex_count; ++f) {
      corners_.insert(corners_.end(), {f, f + 1 + f % 2, f + 2 - f % 2});
    }
    options_.durable = durable;
  }
  [[nodiscard]] io::IoResult<io::WriteOutput> save(const std::filesystem::path& path) const {
    const Index count = static_cast<Index>(xyz_.size() / 3);
    io::WriteInput input;
    input.positions = {xyz_.data(), count};
    input.faces = FaceList::triangles<Index>(corners_, count);
    return io::write(path, input, options_);
  }
  [[nodiscard]] std::string bytes() const {
    const TemporaryFolder folder;
    EXPECT_TRUE(save(folder / "whole.ply"));
    return file_contents(folder / "whole.ply");
  }

 private:
  std::vector<float> xyz_;
  std::vector<Index> corners_;
  io::WriteOptions options_;
};

/// Calls `body` in a process of its own, which ends with the number that it returns.
template <class Body>
pid_t start_child(const Body& body) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(body());
  EXPECT_GT(child, 0);
  return child;
}

int wait_for(pid_t child) {
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  return status;
}

bool limit_file_size(std::size_t bytes) {
  const struct rlimit limit { bytes, bytes };
  return ::setrlimit(RLIMIT_FSIZE, &limit) == 0;
}

// Three blocks of the writer's, so that there are whole writes before and behind a kill.
constexpr Index kManyVertices = 25'000;

class IoKill : public ::testing::Test {
 protected:
  void SetUp() override { put_file(target_, old_); }

  /// True if the new file is there, and fails unless it is one of the two.
  bool is_new() {
    const std::string now = file_contents(target_);
    EXPECT_TRUE(now == old_ || now == new_) << now.size() << " bytes";
    return now == new_;
  }
  void expect_nothing_else() { EXPECT_EQ(folder_.entries(), std::vector<std::string>{"a.ply"}); }
  /// What a killed process left is no obstacle to the next save; then all is as before the kill.
  void save_again_and_restore() {
    ASSERT_TRUE(saving_.save(target_));
    EXPECT_EQ(file_contents(target_), new_);
    for (const std::string& name : folder_.entries()) std::filesystem::remove(folder_ / name);
    put_file(target_, old_);
  }
  [[nodiscard]] std::vector<std::size_t> cuts() const {
    std::vector<std::size_t> cuts = {0, 1, 100, new_.size() / 2, new_.size() - 1};
    for (const std::size_t block : {std::size_t{1} << 18, std::size_t{2} << 18}) {
      cuts.insert(cuts.end(), {block - 1, block, block + 1});
    }
    return cuts;
  }

  TemporaryFolder folder_;
  const std::filesystem::path target_ = folder_ / "a.ply";
  const Saving saving_{kManyVertices, true};
  const std::string old_ = Saving(1000, false).bytes();
  const std::string new_ = saving_.bytes();
};

// Every system call of a save, before it is made and after it.
TEST_F(IoKill, AtEverySystemCallLeavesTheOldFileOrTheNew) {
  int old_count = 0;
  int new_count = 0;
  for (int stops = 1;; ++stops) {
    const pid_t child = start_child([&] {
      if (::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) return kNotPossible;
      static_cast<void>(std::raise(SIGSTOP));
      return saving_.save(target_) ? kSaved : kRefused;
    });
    int status = wait_for(child);
    if (WIFEXITED(status)) {
      ASSERT_EQ(WEXITSTATUS(status), kNotPossible);
      GTEST_SKIP() << "the system does not let a process trace another";
    }
    for (int i = 0; i < stops && WIFSTOPPED(status); ++i) {
      ASSERT_EQ(::ptrace(PTRACE_SYSCALL, child, nullptr, nullptr), 0);
      status = wait_for(child);
    }
    if (WIFSTOPPED(status)) {
      ASSERT_EQ(::kill(child, SIGKILL), 0);
      status = wait_for(child);
      ASSERT_TRUE(WIFSIGNALED(status));
    } else {
      ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == kSaved);
    }
    SCOPED_TRACE("killed at stop " + std::to_string(stops));
    const bool was_replaced = is_new();
    // Once the new file is there it stays.
    EXPECT_TRUE(was_replaced || new_count == 0);
    ++(was_replaced ? new_count : old_count);
    if (WIFEXITED(status)) break;
    save_again_and_restore();
    if (HasFailure()) break;
  }
  expect_nothing_else();
  EXPECT_GE(old_count,
            20);            // both sides of looking, creating, three writes, flushing, closing, ...
  EXPECT_GE(new_count, 4);  // ... and of what follows the renaming
}

TEST_F(IoKill, WhileTheFileGrowsLeavesTheOldFile) {
  for (const std::size_t cut : cuts()) {
    const int status = wait_for(start_child([&] {
      // A file that may not grow costs the process its life.
      std::signal(SIGXFSZ, SIG_DFL);
      if (!limit_file_size(cut)) return kNotPossible;
      return saving_.save(target_) ? kSaved : kRefused;
    }));
    ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGXFSZ) << cut << ": " << status;
    EXPECT_FALSE(is_new()) << cut;
    save_again_and_restore();
  }
}

TEST_F(IoKill, AtRandomTimesLeavesTheOldFileOrTheNew) {
  constexpr std::uint64_t kSeed = 20;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937_64 random(kSeed);
  const Saving old(1000, false);
  const Saving next(kManyVertices, false);
  for (int round = 0; round < 60 && !HasFailure(); ++round) {
    const pid_t child = start_child([&] {
      while (next.save(target_) && old.save(target_)) continue;
      return kRefused;
    });
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 5000));
    ASSERT_EQ(::kill(child, SIGKILL), 0);
    const int status = wait_for(child);
    ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) << status;
    static_cast<void>(is_new());
  }
  save_again_and_restore();
}

TEST_F(IoKill, IsNotWhatAnErrorDoes) {
  for (const std::size_t cut : cuts()) {
    const int status = wait_for(start_child([&] {
      std::signal(SIGXFSZ, SIG_IGN);
      if (!limit_file_size(cut)) return kNotPossible;
      const auto result = saving_.save(target_);
      if (result) return kSaved;
      return result.error().code == io::IoErrorCode::cannot_write ? kRefused : kNotPossible;
    }));
    ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == kRefused) << cut << ": " << status;
    EXPECT_FALSE(is_new()) << cut;
    expect_nothing_else();
  }
}

// A full disk: a file system of 256 KiB in memory, seen by the child alone.
TEST_F(IoKill, IsNotWhatAFullDiskDoes) {
  const std::filesystem::path disk = folder_ / "disk";
  std::filesystem::create_directory(disk);
  const int status = wait_for(start_child([&] {
    const bool is_root = ::geteuid() == 0;
    if (::unshare(is_root ? CLONE_NEWNS : CLONE_NEWNS | CLONE_NEWUSER) != 0) return kNotPossible;
    if (::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0) return kNotPossible;
    if (::mount("none", disk.c_str(), "tmpfs", 0, "size=256k") != 0) return kNotPossible;
    put_file(disk / "a.ply", old_);
    const auto result = saving_.save(disk / "a.ply");
    const bool is_refused = !result && result.error().code == io::IoErrorCode::cannot_write;
    const bool is_untouched = file_contents(disk / "a.ply") == old_;
    std::size_t entry_count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(disk)) {
      ++entry_count;
    }
    return is_refused && is_untouched && entry_count == 1 ? kRefused : kSaved;
  }));
  ASSERT_TRUE(WIFEXITED(status));
  if (WEXITSTATUS(status) == kNotPossible) GTEST_SKIP() << "no file system may be mounted here";
  EXPECT_EQ(WEXITSTATUS(status), kRefused);
}

TEST(IoAtomicFile, StepsOverWhatAKilledProcessOfTheSameNumberLeft) {
  const TemporaryFolder folder;
  std::string name;
  {
    const auto file = io::AtomicFile::create(folder / "a.txt");
    ASSERT_TRUE(file);
    name = folder.entries().at(0);
  }
  const std::size_t stem = name.rfind('.') + 1;
  const int number = std::atoi(name.c_str() + stem);
  for (int i = 1; i <= 3; ++i) {
    put_file(folder / (name.substr(0, stem) + std::to_string(number + i)), "left");
  }
  ASSERT_TRUE(io::write_file_atomically(folder / "a.txt", std::string_view("new")));
  EXPECT_EQ(file_contents(folder / "a.txt"), "new");
  EXPECT_EQ(folder.entries().size(), 4u);
}

}  // namespace
}  // namespace hedgerow::test
