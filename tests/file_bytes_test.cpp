#include "hooke/io/files.h"

#include <gtest/gtest.h>

#include "errors.h"
#include "hooke/core/error.h"
#include "hooke/core/parallel.h"
#include "temporary_folder.h"

namespace hooke {
namespace {

// Every byte another than the ones about it, and blocks of any size unlike each other.
std::string content_of(size_t size) {
  std::string content(size, 0);
  for (size_t i = 0; i < size; ++i) content[i] = static_cast<char>((i * i / 7 + i) & 0x7f);
  return content;
}

TEST(FileBytes, AreAllThereInOrderWhateverTheSize) {
  const test::TemporaryFolder folder;
  const size_t block = size_t{1} << 22;
  for (size_t size : {size_t{1}, size_t{1000}, block - 1, block, block + 1, 3 * block + 12345}) {
    const std::string content = content_of(size);
    const std::filesystem::path path = folder / "bytes";
    test::write_text(path, content);
    for (int threads : {1, 2}) {
      const ThreadLimit limit(threads);
      const FileBytes file = read_regular_file(path);
      EXPECT_TRUE(file.text() == content) << size;
    }
  }
}

TEST(FileBytes, OfAFileThatDoesNotTellItsSizeAreAllThere) {
  const std::filesystem::path path = "/proc/self/status";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
  ASSERT_EQ(std::filesystem::file_size(path), 0u);
  const FileBytes file = read_regular_file(path);
  EXPECT_GT(file.text().size(), 100u);
  EXPECT_TRUE(file.text().starts_with("Name:"));
  EXPECT_TRUE(file.text().ends_with('\n'));
}

TEST(FileBytes, OfAnEmptyFileAreAnError) {
  const test::TemporaryFolder folder;
  test::write_text(folder / "bytes", "");
  const std::string message = test::message_of<InputError>([&] { read_regular_file(folder / "bytes"); });
  EXPECT_TRUE(test::has(message, "the file is empty")) << message;
}

}  // namespace
}  // namespace hooke
