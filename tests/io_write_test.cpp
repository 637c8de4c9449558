#include <array>
#include <bit>
#include <csignal>
#include <fcntl.h>
#include <limits>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "hedgerow/io/atomic_file.h"
#include "hedgerow/io/read.h"
#include "hedgerow/io/write.h"
#include "support/io_cases.h"

namespace hedgerow::test {
namespace {

// Coordinates that a careless writer damages.
constexpr std::array<float, 18> kPoints = {0.1f,
                                           -0.0f,
                                           1e-45f,
                                           16777216.0f,
                                           std::numeric_limits<float>::max(),
                                           -1.0f / 3.0f,
                                           3,
                                           4,
                                           5,
                                           6,
                                           7,
                                           8,
                                           9,
                                           10,
                                           11,
                                           1.17549435e-38f,
                                           13,
                                           14};

struct Mesh {
  std::vector<Index> corners;
  std::vector<Index> offsets;
  [[nodiscard]] io::WriteInput input() const {
    const std::span<const Index> all(corners);
    return {{kPoints.data(), 6},
            offsets.empty() ? FaceList::triangles<Index>(all, 6)
                            : FaceList::polygons<Index>(all, offsets, 6),
            {}};
  }
};
const Mesh kTriangles = {{0, 1, 2, 3, 4, 5, 2, 1, 3}, {}};
const Mesh kMixed = {{0, 1, 2, 3, 4, 5, 2, 1, 3, 0, 1, 2, 3, 4, 5}, {0, 3, 7, 9, 15}};

std::vector<std::uint32_t> bits_of(std::span<const float> values) {
  std::vector<std::uint32_t> bits;
  for (const float value : values) bits.push_back(std::bit_cast<std::uint32_t>(value));
  return bits;
}

void expect_round_trip(const Mesh& mesh, const char* name, io::PlyEncoding ply, bool has_normals) {
  const TemporaryFolder folder;
  const auto path = folder / name;
  io::WriteInput input = mesh.input();
  if (has_normals) input.normals = {kPoints.data(), 6};
  io::WriteOptions options;
  options.ply = ply;
  const auto written = io::write(path, input, options);
  ASSERT_TRUE(written) << io::to_string(written.error());
  EXPECT_EQ(static_cast<std::uintmax_t>(written->byte_count), std::filesystem::file_size(path));
  const auto read = io::read(path);
  ASSERT_TRUE(read) << io::to_string(read.error());
  EXPECT_EQ(bits_of(read->soup.xyz.span()), bits_of(kPoints));
  EXPECT_TRUE(std::ranges::equal(read->soup.corners.span(), mesh.corners));
  EXPECT_TRUE(std::ranges::equal(read->soup.offsets.span(), mesh.offsets));
  EXPECT_TRUE(read->warnings.empty());
  // What was read writes the same bytes.
  const auto again = folder / (std::string("again-") + name);
  io::WriteInput copy{read->soup.positions(), read->soup.face_list(), input.normals};
  ASSERT_TRUE(io::write(again, copy, options));
  EXPECT_EQ(file_contents(again), file_contents(path));
}

TEST(IoWrite, ReadsBackBitForBit) {
  for (const Mesh* mesh : {&kTriangles, &kMixed}) {
    for (const bool has_normals : {false, true}) {
      expect_round_trip(*mesh, "a.OBJ", {}, has_normals);
      expect_round_trip(*mesh, "a.off", {}, has_normals);
      for (const auto ply : {io::PlyEncoding::ascii, io::PlyEncoding::binary_little_endian,
                             io::PlyEncoding::binary_big_endian}) {
        expect_round_trip(*mesh, "a.ply", ply, has_normals);
      }
    }
  }
}

TEST(IoWrite, WritesStlThatReadsBackWelded) {
  const TemporaryFolder folder;
  for (const auto stl : {io::StlEncoding::ascii, io::StlEncoding::binary}) {
    io::WriteOptions options;
    options.stl = stl;
    const auto written = io::write(folder / "a.stl", kMixed.input(), options);
    ASSERT_TRUE(written) << io::to_string(written.error());
    EXPECT_EQ(written->split_face_count, 2);
    EXPECT_EQ(written->dropped_face_count, 1);
    const auto read = io::read(folder / "a.stl");
    ASSERT_TRUE(read) << io::to_string(read.error());
    EXPECT_EQ(bits_of(read->soup.xyz.span()), bits_of(kPoints));
    EXPECT_EQ(faces_of(read->soup),
              (std::vector<std::vector<Index>>{
                  {0, 1, 2}, {3, 4, 5}, {3, 5, 2}, {0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}));
  }
}

TEST(IoWrite, GivesALargeFaceAWideCount) {
  const TemporaryFolder folder;
  for (const Index degree : {255, 256}) {
    Mesh mesh;
    for (Index k = 0; k < degree; ++k) mesh.corners.push_back(k % 6);
    mesh.offsets = {0, degree};
    ASSERT_TRUE(io::write(folder / "a.ply", mesh.input()));
    const auto read = io::read(folder / "a.ply");
    ASSERT_TRUE(read) << io::to_string(read.error());
    EXPECT_TRUE(std::ranges::equal(read->soup.corners.span(), mesh.corners));
  }
}

TEST(IoWrite, TakesIndicesOfEveryWidthAndStride) {
  const TemporaryFolder folder;
  const std::array<std::uint16_t, 4> records = {2, 1, 0, 99};  // one face, padded
  io::WriteInput input = kTriangles.input();
  input.faces = FaceList{records.data(), IndexFormat::uint16, 8, nullptr, 1, 6};
  ASSERT_TRUE(io::write(folder / "a.off", input));
  EXPECT_TRUE(file_contents(folder / "a.off").ends_with("\n3 2 1 0\n"));
}

TEST(IoWrite, RefusesWhatIsNoMeshAndWritesNothing) {
  const TemporaryFolder folder;
  const Mesh wrong = {{0, 1, 6}, {}};
  const auto result = io::write(folder / "a.ply", wrong.input());
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, io::IoErrorCode::bad_mesh);
  io::WriteInput input = kTriangles.input();
  input.normals = {kPoints.data(), 5};
  EXPECT_EQ(io::write(folder / "a.ply", input).error().code, io::IoErrorCode::bad_mesh);
  EXPECT_EQ(io::write(folder / "a.glb", kTriangles.input()).error().code,
            io::IoErrorCode::unknown_extension);
  EXPECT_TRUE(folder.entries().empty());
}

TEST(IoAtomicFile, LeavesTheOldFileAndNothingElseWhenAWriteFails) {
  const TemporaryFolder folder;
  put_file(folder / "a.off", "old");
  // Files may not grow beyond 10 bytes: the kernel then refuses as it would on a full disk.
  struct rlimit before {};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  const struct rlimit small { 10, before.rlim_max };
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const auto result = io::write(folder / "a.off", kTriangles.input());
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, old_handler);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, io::IoErrorCode::cannot_write);
  EXPECT_EQ(file_contents(folder / "a.off"), "old");
  EXPECT_EQ(folder.entries(), std::vector<std::string>{"a.off"});
}

TEST(IoAtomicFile, ReportsAFullDevice) {
  if (::access("/dev/full", W_OK) != 0) GTEST_SKIP() << "there is no /dev/full";
  const auto result = io::write_file_atomically("/dev/full", std::string_view("text"));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, io::IoErrorCode::cannot_write);
}

TEST(IoAtomicFile, RefusesAMissingDirectoryAndADirectory) {
  const TemporaryFolder folder;
  const auto missing = io::write_file_atomically(folder / "no/a.txt", std::string_view("x"));
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, io::IoErrorCode::cannot_create);
  const auto directory = io::write_file_atomically(folder.path(), std::string_view("x"));
  ASSERT_FALSE(directory);
  EXPECT_EQ(directory.error().code, io::IoErrorCode::cannot_create);
}

TEST(IoAtomicFile, RefusesAFileThatMayNotBeWritten) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everything";
  const TemporaryFolder folder;
  put_file(folder / "a.txt", "old");
  ASSERT_EQ(::chmod((folder / "a.txt").c_str(), 0400), 0);
  EXPECT_FALSE(io::write_file_atomically(folder / "a.txt", std::string_view("new")));
  EXPECT_EQ(file_contents(folder / "a.txt"), "old");
}

TEST(IoAtomicFile, KeepsLinksAndModes) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "in");
  put_file(folder / "in/real.txt", "old");
  ASSERT_EQ(::chmod((folder / "in/real.txt").c_str(), 0640), 0);
  std::filesystem::create_symlink("in/real.txt", folder / "link.txt");
  std::filesystem::create_symlink("link.txt", folder / "link2.txt");
  ASSERT_TRUE(io::write_file_atomically(folder / "link2.txt", std::string_view("new")));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.txt"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link2.txt"));
  EXPECT_EQ(file_contents(folder / "in/real.txt"), "new");
  struct stat status {};
  ASSERT_EQ(::stat((folder / "in/real.txt").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0640u);
  std::filesystem::create_symlink("b.txt", folder / "a.txt");
  std::filesystem::create_symlink("a.txt", folder / "b.txt");
  EXPECT_FALSE(io::write_file_atomically(folder / "a.txt", std::string_view("x")));
}

TEST(IoAtomicFile, RemovesTheTemporaryFileWithoutACommit) {
  const TemporaryFolder folder;
  {
    auto file = io::AtomicFile::create(folder / "a.txt");
    ASSERT_TRUE(file);
    ASSERT_TRUE(file->write(std::string_view("half")));
    EXPECT_EQ(folder.entries().size(), 1u);
  }
  EXPECT_TRUE(folder.entries().empty());
}

TEST(IoAtomicFile, TakesLongAndStrangeNames) {
  const TemporaryFolder folder;
  for (const std::string& name : {std::string(255, 'n'), std::string("a b\n\xc3\xa4.txt")}) {
    ASSERT_TRUE(io::write_file_atomically(folder / name, std::string_view("x")));
    EXPECT_EQ(file_contents(folder / name), "x");
  }
  EXPECT_FALSE(io::write_file_atomically(folder / std::string(256, 'n'), std::string_view("x")));
}

TEST(IoRead, RefusesWhatIsNoRegularFile) {
  const TemporaryFolder folder;
  const auto code = [](const std::filesystem::path& path) {
    const auto result = io::read(path);
    return result ? std::string("ok") : std::string(io::name(result.error().code));
  };
  EXPECT_EQ(code(folder / "none.obj"), "cannot-open");
  EXPECT_EQ(code(folder / "none.txt"), "unknown-extension");
  EXPECT_EQ(code(folder / "none"), "unknown-extension");
  std::filesystem::create_directory(folder / "d.obj");
  EXPECT_EQ(code(folder / "d.obj"), "not-a-regular-file");
  ASSERT_EQ(::mkfifo((folder / "pipe.obj").c_str(), 0600), 0);
  EXPECT_EQ(code(folder / "pipe.obj"), "not-a-regular-file");
  std::filesystem::create_symlink("/dev/zero", folder / "zero.obj");
  EXPECT_EQ(code(folder / "zero.obj"), "not-a-regular-file");
  put_file(folder / "good.Obj", "v 0 0 0\n");
  std::filesystem::create_symlink("good.Obj", folder / "link.obj");
  EXPECT_EQ(code(folder / "link.obj"), "ok");
}

TEST(IoRead, ReportsProgressUpToTheEnd) {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += "v 0 0 0\n";
  io::ReadOptions options;
  std::vector<std::int64_t> seen;
  options.progress = [&](std::int64_t done, std::int64_t total) {
    EXPECT_EQ(total, 8000);
    seen.push_back(done);
  };
  ASSERT_TRUE(read_exact(text, io::Format::obj, options));
  EXPECT_TRUE(std::ranges::is_sorted(seen));
  EXPECT_GT(seen.size(), 50u);
  EXPECT_LT(seen.size(), 200u);
  EXPECT_EQ(seen.back(), 8000);
}

TEST(IoError, IsOneLineAndDetails) {
  io::IoError error;
  error.code = io::IoErrorCode::size_mismatch;
  error.path = "a\nb.stl";
  error.byte = 80;
  error.message = "what";
  error.details = {"more"};
  EXPECT_EQ(io::to_string(error), "a\\x0ab.stl@80: error: size-mismatch: what\n  more");
}

}  // namespace
}  // namespace hedgerow::test
