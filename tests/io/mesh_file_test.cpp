#include "hooke/io/mesh_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "hooke/core/error.h"
#include "hooke/io/read_mesh.h"
#include "support/errors.h"
#include "support/temporary_folder.h"

namespace hooke::mesh_file_test {

namespace fs = std::filesystem;
using test::has;
using test::TemporaryFolder;
using test::write_text;

const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const std::string off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

std::string error_of(const fs::path& path) {
  return test::message_of<InputError>([&] { read_mesh(path); });
}

TEST(MeshFile, TheExtensionInAnyCaseIsTheFormat) {
  EXPECT_EQ(format_of("a/b.c.OBJ"), MeshFormat::obj);
  EXPECT_EQ(format_of("x.Ply"), MeshFormat::ply);
  EXPECT_EQ(format_of(".hidden.off"), MeshFormat::off);
  for (const char* name : {"", "x", "x.", "x.o", "x.vtp", "x.3ds", "obj", ".obj", "x.obj/", "x.obj.gz"})
    EXPECT_THROW(format_of(name), Error) << name;
  EXPECT_EQ(format_of("x.STL"), MeshFormat::stl);
  EXPECT_EQ(format_of("x.msh"), MeshFormat::msh);
  EXPECT_EQ(input_format_of("x.vtp"), MeshFormat::vtp);
  EXPECT_ERROR(Error, "a.3ds: unknown format; expected .obj .ply .off .stl .msh", format_of("a.3ds"));
  EXPECT_ERROR(Error, "a.vtp: VTP can only be read", format_of("a.vtp"));
  EXPECT_ERROR(InputError, "a.3ds: unknown format; expected .obj .ply .off .stl .msh .vtp",
               input_format_of("a.3ds"));
  EXPECT_TRUE(has(test::message_of<InputError>([] { input_format_of("a.3ds"); }), "meshio, gmsh or admesh"));
}

TEST(MeshFile, AByteOrderMarkIsNotContent) {
  EXPECT_EQ(parse_mesh_file("\xef\xbb\xbf" + obj, "m", MeshFormat::obj).points.cols(), 3);
  EXPECT_EQ(parse_mesh_file("\xef\xbb\xbf" + off, "m", MeshFormat::off).points.cols(), 3);
}

TEST(MeshFile, ContentOfAnotherFormatIsNamed) {
  const auto error = [](const std::string& bytes, MeshFormat format) {
    return test::message_of<InputError>([&] { parse_mesh_file(bytes, "m", format); });
  };
  EXPECT_TRUE(
      has(error(off, MeshFormat::obj), "m:1: the content looks like off; expected obj by the extension"));
  EXPECT_TRUE(has(error(off, MeshFormat::ply), "looks like off; expected ply"));
  EXPECT_TRUE(has(error(obj, MeshFormat::off), "looks like obj; expected off"));
  EXPECT_TRUE(has(error("ply\nformat ascii 1.0\n", MeshFormat::obj), "looks like ply; expected obj"));
  EXPECT_TRUE(has(error("solid x\nfacet\n", MeshFormat::obj), "looks like stl"));
  EXPECT_TRUE(
      has(error(std::string(80, 'h') + std::string("\1\0\0\0", 4) + std::string(50, '\0'), MeshFormat::obj),
          "looks like binary STL"));
  EXPECT_TRUE(has(error("\x1f\x8b\x08", MeshFormat::obj), "looks like gzip"));
  EXPECT_TRUE(has(error("<!DOCTYPE html>", MeshFormat::obj), "looks like HTML or XML"));
  EXPECT_TRUE(has(error("version https://git-lfs.github.com/spec/v1\n", MeshFormat::obj),
                  "looks like a Git LFS pointer"));
  EXPECT_TRUE(has(error(obj + std::string(3, '\0'), MeshFormat::obj), "m: byte 32 is zero"));
}

TEST(MeshFile, OnlyRegularFilesAreRead) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "folder.obj");
  ASSERT_EQ(::mkfifo((folder / "pipe.obj").c_str(), 0600), 0);
  fs::create_symlink("loop.obj", folder / "loop.obj");
  fs::create_symlink("/dev/zero", folder / "zero.obj");
  write_text(folder / "empty.obj", "");
  const auto error = [&](const char* name) {
    std::string message = error_of(folder / name);
    const std::string start = (folder / name).native() + ": ";
    EXPECT_EQ(message.substr(0, start.size()), start);
    return message;
  };
  EXPECT_TRUE(has(error("folder.obj"), "is a folder"));
  EXPECT_TRUE(has(error("pipe.obj"), "is a pipe"));
  EXPECT_TRUE(has(error("zero.obj"), "is a device"));
  EXPECT_TRUE(has(error("loop.obj"), "cannot be opened"));
  EXPECT_TRUE(has(error("missing.obj"), "No such file"));
  EXPECT_TRUE(has(error("empty.obj"), "is empty"));
  EXPECT_TRUE(has(error_of(""), "''"));
}

TEST(MeshFile, AnUnusualNameIsReadAndPrintable) {
  const TemporaryFolder folder;
  write_text(folder / "a\n%s \x1b[0m.obj", "v 0 0\n");
  const std::string message = error_of(folder / "a\n%s \x1b[0m.obj");
  EXPECT_TRUE(has(message, "a\\n%s \\x1b[0m.obj:1: z is missing")) << message;
}

}  // namespace hooke::mesh_file_test
