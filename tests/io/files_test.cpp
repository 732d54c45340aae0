#include "hooke/io/files.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "hooke/core/error.h"
#include "hooke/core/parallel.h"
#include "support/errors.h"
#include "support/temporary_folder.h"

namespace hooke::files_test {

namespace fs = std::filesystem;
using test::read_text;
using test::TemporaryFolder;
using test::write_text;

mode_t mode_of(const fs::path& path) {
  struct stat status {};
  EXPECT_EQ(::stat(path.c_str(), &status), 0);
  return status.st_mode & 07777;
}

void write_now(const fs::path& path, std::string_view bytes) {
  PendingFile(path, bytes).commit();
}

TEST(AtomicWrite, NothingHasChangedBeforeTheCommit) {
  const TemporaryFolder folder;
  write_text(folder / "f", "old");
  { const PendingFile dropped(folder / "f", "new"); }
  EXPECT_EQ(folder.file_count(), 1u);
  {
    PendingFile file(folder / "f", "new");
    EXPECT_EQ(read_text(folder / "f"), "old");
    PendingFile moved = std::move(file);
    moved.commit();
    EXPECT_EQ(read_text(folder / "f"), "new");
  }
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(AtomicWrite, WritesAllBytesAndNothingElse) {
  const TemporaryFolder folder;
  const std::string bytes("a\0b\n", 4);
  const mode_t old_mask = ::umask(027);
  write_now(folder / "f", bytes);
  ::umask(old_mask);
  EXPECT_EQ(read_text(folder / "f"), bytes);
  EXPECT_EQ(mode_of(folder / "f"), 0640u);
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(AtomicWrite, ReplacesAFileAndKeepsItsMode) {
  const TemporaryFolder folder;
  write_text(folder / "f", "old and longer");
  ::chmod((folder / "f").c_str(), 0604);
  write_now(folder / "f", "new");
  EXPECT_EQ(read_text(folder / "f"), "new");
  EXPECT_EQ(mode_of(folder / "f"), 0604u);
}

TEST(AtomicWrite, IsUndoneByTakingItBack) {
  const TemporaryFolder folder;
  const fs::path old = folder / "old", young = folder / "young";
  write_text(old, "before");
  {
    PendingFile over_old(old, "after"), new_one(young, "after");
    over_old.commit();
    new_one.commit();
    EXPECT_EQ(read_text(old), "after");
    if (!over_old.take_back()) GTEST_SKIP() << "this file system cannot exchange names";
    EXPECT_TRUE(new_one.take_back());
  }
  EXPECT_EQ(read_text(old), "before");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "."), fs::directory_iterator()), 1);
}

TEST(AtomicWrite, FollowsALinkAndLeavesOtherNamesOfTheOldFile) {
  const TemporaryFolder folder;
  write_text(folder / "real", "old");
  fs::create_hard_link(folder / "real", folder / "hard");
  fs::create_symlink("real", folder / "link");
  write_now(folder / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(read_text(folder / "real"), "new");
  EXPECT_EQ(read_text(folder / "hard"), "old");
}

TEST(AtomicWrite, RefusesWhatIsNotAPlaceForAFile) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "folder");
  fs::create_symlink("/dev/full", folder / "full");
  fs::create_symlink("gone", folder / "dangling");
  fs::create_symlink("loop", folder / "loop");
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  const size_t before = folder.file_count();
  for (const char* name : {"folder", "full", "dangling", "loop", "pipe", "no/such/file", "folder/"}) {
    const fs::path path = folder / name;
    EXPECT_ERROR(OutputError, path.native() + ": ", require_writable(path));
    EXPECT_ERROR(OutputError, path.native() + ": ", write_now(path, "x"));
  }
  EXPECT_THROW(require_writable(""), OutputError);
  EXPECT_EQ(folder.file_count(), before);
}

/// Root may write everywhere: during its lifetime, root acts as a user who owns the folder. Other users are
/// not changed.
class OrdinaryUser {
 public:
  explicit OrdinaryUser(const fs::path& folder) {
    constexpr uid_t nobody = 65534;
    was_root_ = ::geteuid() == 0;
    if (!was_root_) return;
    EXPECT_EQ(::chown(folder.c_str(), nobody, static_cast<gid_t>(-1)), 0);
    EXPECT_EQ(::setresuid(nobody, nobody, 0), 0);
  }
  OrdinaryUser(const OrdinaryUser&) = delete;
  OrdinaryUser& operator=(const OrdinaryUser&) = delete;
  ~OrdinaryUser() {
    if (!was_root_) return;
    EXPECT_EQ(::setresuid(0, 0, 0), 0);
  }

 private:
  bool was_root_ = false;
};

TEST(AtomicWrite, RefusesReadOnlyPlaces) {
  const TemporaryFolder folder;
  const OrdinaryUser user(folder / "");
  write_text(folder / "f", "old");
  ::chmod((folder / "f").c_str(), 0444);
  EXPECT_THROW(require_writable(folder / "f"), OutputError);
  ::chmod((folder / "").c_str(), 0555);
  EXPECT_THROW(require_writable(folder / "g"), OutputError);
  ::chmod((folder / "").c_str(), 0755);
}

TEST(AtomicWrite, LeavesTheOldFileAloneIfTheNewOneDoesNotFit) {
  const TemporaryFolder folder;
  write_text(folder / "f", "precious");
  struct rlimit old_limit {};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &old_limit), 0);
  struct rlimit small = old_limit;
  small.rlim_cur = 1000;
  const auto old_handler = ::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string message =
      test::message_of<OutputError>([&] { write_now(folder / "f", std::string(5000, 'x')); });
  ::setrlimit(RLIMIT_FSIZE, &old_limit);
  ::signal(SIGXFSZ, old_handler);
  EXPECT_TRUE(test::has(message, "File too large")) << message;
  EXPECT_EQ(read_text(folder / "f"), "precious");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(AtomicWrite, RequireWritableLeavesNoTrace) {
  const TemporaryFolder folder;
  write_text(folder / "f", "old");
  require_writable(folder / "f");
  require_writable(folder / "g");
  EXPECT_EQ(folder.file_count(), 1u);
  EXPECT_EQ(read_text(folder / "f"), "old");
}

TEST(AtomicWrite, OneFileUnderTwoNamesIsTheSame) {
  const TemporaryFolder folder;
  write_text(folder / "f", "x");
  write_text(folder / "other", "x");
  fs::create_symlink("f", folder / "link");
  fs::create_hard_link(folder / "f", folder / "hard");
  for (const char* name : {"f", "link", "hard", "./f"})
    EXPECT_TRUE(same_file(folder / "f", folder / name)) << name;
  EXPECT_FALSE(same_file(folder / "f", folder / "other"));
  EXPECT_FALSE(same_file(folder / "f", folder / "new"));
}

TEST(AtomicWrite, OnePlaceUnderTwoNamesIsTheSameBeforeTheFileIsThere) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "real");
  fs::create_directory_symlink("real", folder / "link");
  for (const char* name : {"real/new", "./real/new", "real/../link/new", "link/new"})
    EXPECT_TRUE(same_file(folder / "real/new", folder / name)) << name;
  EXPECT_FALSE(same_file(folder / "real/new", folder / "new"));
  EXPECT_FALSE(same_file(folder / "real/new", folder / "link/newer"));
  const fs::path here = fs::current_path() / "no file of this name";
  EXPECT_TRUE(same_file(here.filename(), here));
}

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

}  // namespace hooke::files_test
