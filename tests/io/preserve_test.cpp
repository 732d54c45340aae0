#include "hooke/io/preserve.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hooke/core/error.h"
#include "hooke/io/read_mesh.h"
#include "hooke/io/sha256.h"
#include "support/errors.h"
#include "support/temporary_folder.h"

namespace hooke::preserve_test {

using test::read_text;
using test::TemporaryFolder;
using test::write_text;

SourceFile source_of(const std::filesystem::path& path, const LoadedMesh& loaded) {
  return {path, loaded.format, loaded.sha256, loaded.connectivity_sha256};
}

const std::string sheet = "o a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1.0 0\nf 1 2 3 4\n";

TEST(Preserve, WritesTheSourceWithThePointsOfTheMesh) {
  const TemporaryFolder folder;
  write_text(folder / "in.obj", sheet);
  LoadedMesh loaded = read_mesh(folder / "in.obj");
  vertex_points(loaded.mesh).col(0).x() = -.5;
  PreservedMesh result =
      prepare_preserved_mesh(folder / "out.obj", loaded.mesh, source_of(folder / "in.obj", loaded));
  ASSERT_TRUE(result.mesh);
  EXPECT_EQ(result.obstacle, "");
  EXPECT_EQ(folder.file_count(), 2u) << "not yet in its place";
  result.mesh->file.commit();
  EXPECT_EQ(read_text(folder / "out.obj"), "o a\nv -0.5 0 0\nv 1 0 0\nv 1 1 0\nv 0 1.0 0\nf 1 2 3 4\n");
  EXPECT_EQ(result.mesh->sha256, sha256(read_text(folder / "out.obj")));
  EXPECT_EQ(result.mesh->connectivity_sha256, loaded.connectivity_sha256);
}

TEST(Preserve, ASourceThatChangedIsRefused) {
  const TemporaryFolder folder;
  const auto path = folder / "in.obj";
  write_text(path, sheet);
  const LoadedMesh loaded = read_mesh(path);
  const auto write = [&] {
    prepare_preserved_mesh(folder / "out.obj", loaded.mesh, source_of(path, loaded));
  };
  for (const std::string& other : {sheet + "\n", sheet.substr(0, 40), std::string("v 0 0 0\n")}) {
    write_text(path, other);
    EXPECT_ERROR(InputError, path.native() + ": has changed since it was read", write());
  }
  std::filesystem::remove(path);
  EXPECT_ERROR(InputError, path.native() + ": cannot be opened", write());
  EXPECT_EQ(folder.file_count(), 0u);
}

TEST(Preserve, SinglePrecisionThatTurnsFacesOverIsAnObstacle) {
  const TemporaryFolder folder;
  const auto path = folder / "in.ply";
  std::string rows;
  for (const auto& [x, y] : {std::pair{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}})
    rows += fmt::format("{} {} 0\n", 4 * x + 16777216, y);
  write_text(path,
             "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
             "element face 2\nproperty list uchar int vertex_index\nend_header\n" +
                 rows + "3 0 1 2\n3 0 2 3\n");
  LoadedMesh loaded = read_mesh(path);
  vertex_points(loaded.mesh)(0, 2) = 16777216.25;  // then all of a triangle has the same x
  vertex_points(loaded.mesh)(0, 1) = 16777216.5;
  const PreservedMesh result =
      prepare_preserved_mesh(folder / "out.ply", loaded.mesh, source_of(path, loaded));
  EXPECT_FALSE(result.mesh);
  EXPECT_TRUE(test::has(result.obstacle, "single precision")) << result.obstacle;
}

}  // namespace hooke::preserve_test
