#include "graph/evaluate/file_store.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/graph/toys.h"

namespace kinegraph {
namespace {

namespace fs = std::filesystem;

class FileStoreTest : public testing::Test {
 protected:
  static std::string code_of(FileStore& store, const std::string& path) {
    try {
      store.read(path);
      return "";
    } catch (const Failure& failure) {
      return failure.diagnostic().code;
    }
  }
  static void set_age(const std::string& path, int seconds) {
    const timespec times[2] = {{::time(nullptr) - seconds, 0}, {::time(nullptr) - seconds, 0}};
    ASSERT_EQ(::utimensat(AT_FDCWD, path.c_str(), times, 0), 0);
  }
  toys::Folder folder;
};

TEST_F(FileStoreTest, GivesTheBytesAndTheirDigest) {
  const std::string text(3'000'000, 'k');
  toys::write(folder / "a", text);
  toys::write(folder / "empty", "");
  FileStore store;
  EXPECT_EQ(*store.read(folder / "a"), text);
  EXPECT_EQ(store.read_hashed(folder / "a", {}).digest, digest(text));
  EXPECT_EQ(store.digest_of(folder / "a"), digest(text));
  EXPECT_EQ(store.digest_of(folder / "empty"), digest(""));
  EXPECT_TRUE(store.exists(folder / "a"));
  EXPECT_FALSE(store.exists(folder / "b"));
  EXPECT_EQ(store.list(folder.path), (std::vector<std::string>{"a", "empty"}));
}

TEST_F(FileStoreTest, ReadsRegularFilesOnly) {
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  fs::create_directory(folder / "folder");
  FileStore store;
  EXPECT_EQ(code_of(store, folder / "pipe"), "not-a-regular-file") << "and did not wait for a writer";
  EXPECT_EQ(code_of(store, folder / "folder"), "not-a-regular-file");
  EXPECT_EQ(code_of(store, "/dev/zero"), "not-a-regular-file");
  EXPECT_FALSE(store.exists(folder / "pipe"));
}

TEST_F(FileStoreTest, AMissingFileNamesThePathAsWrittenAndTheNearest) {
  toys::write(folder / "walk.bvh", "x");
  FileStore store;
  try {
    store.read_hashed(folder / "wlak.bvh", {"clips/wlak.bvh", {}, {}});
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.diagnostic().code, "missing-file");
    EXPECT_NE(failure.diagnostic().message.find("'clips/wlak.bvh'"), std::string::npos);
    EXPECT_NE(failure.diagnostic().hint.find("walk.bvh"), std::string::npos);
  }
}

TEST_F(FileStoreTest, RemembersDigestsOfFilesOlderThanTwoSeconds) {
  toys::write(folder / "a", "walk");
  FileStore store;
  store.digest_of(folder / "a");
  store.digest_of(folder / "a");
  EXPECT_EQ(store.digests_made(), 2u) << "a young file isn't trusted";

  // The time of change can't be set, so an old file is one of the system's own.
  FileStore other;
  other.digest_of("/etc/passwd");
  other.digest_of("/etc/passwd");
  EXPECT_EQ(other.digests_made(), 1u);
}

TEST_F(FileStoreTest, SeesAChangeThatKeepsSizeInodeAndModificationTime) {
  toys::write(folder / "a", "walk");
  set_age(folder / "a", 100);
  FileStore store;
  const auto before = store.digest_of(folder / "a");
  toys::write(folder / "a", "jump");
  set_age(folder / "a", 100);
  EXPECT_NE(store.digest_of(folder / "a"), before);
}

TEST_F(FileStoreTest, ASandboxHoldsLinksAndDotsWithin) {
  toys::write(folder / "in/a", "inside");
  toys::write(folder / "inner/a", "a folder whose name only begins alike");
  toys::write(folder / "out/secret", "outside");
  fs::create_symlink("a", folder / "in/good");
  fs::create_symlink(folder / "in/a", folder / "in/absolute");
  fs::create_symlink("../out/secret", folder / "in/bad");
  fs::create_directory_symlink(folder / "out", folder / "in/folder");
  fs::create_symlink("../out/none", folder / "in/dangling");
  FileStore store({folder / "in"});
  EXPECT_EQ(code_of(store, folder / "in/a"), "");
  EXPECT_EQ(code_of(store, folder / "in/good"), "");
  EXPECT_EQ(code_of(store, folder / "in/absolute"), "");
  EXPECT_EQ(code_of(store, folder / "in/../in/a"), "");
  for (const char* path : {"out/secret", "inner/a", "in/bad", "in/folder/secret", "in/../out/secret",
                           "in/dangling", "out/none"}) {
    EXPECT_EQ(code_of(store, folder / path), "outside-sandbox") << path;
    EXPECT_FALSE(store.exists(folder / path)) << path;
  }
  EXPECT_THROW(store.digest_of(folder / "in/bad"), Failure);
  EXPECT_TRUE(store.list(folder / "in/folder").empty());
  EXPECT_FALSE(store.list(folder / "in").empty());
  EXPECT_EQ(code_of(store, folder / "in/none"), "missing-file");
}

TEST_F(FileStoreTest, FilesNamedOnTheCommandLineAreAllowed) {
  toys::write(folder / "in/a", "inside");
  toys::write(folder / "out/named", "outside");
  toys::write(folder / "out/other", "outside");
  FileStore store({folder / "in"}, {folder / "out/named"});
  EXPECT_EQ(code_of(store, folder / "out/named"), "");
  EXPECT_EQ(code_of(store, folder / "out/other"), "outside-sandbox");
  store.allow(folder / "out/other");
  EXPECT_EQ(code_of(store, folder / "out/other"), "");
}

TEST_F(FileStoreTest, AsksBetweenPiecesAndForMemoryBeforehand) {
  toys::write(folder / "a", std::string(5'000'000, 'k'));
  FileStore store;
  int asked = 0;
  std::size_t bytes = 0;
  store.read_hashed(folder / "a", {"a", [&] { ++asked; },
                                   [&](std::size_t wanted) {
                                     EXPECT_EQ(asked, 0);
                                     bytes = wanted;
                                     return std::shared_ptr<void>();
                                   }});
  EXPECT_GE(asked, 5);
  EXPECT_EQ(bytes, 5'000'000u);
  EXPECT_THROW(store.digest_of(folder / "a", {"a", [] { throw Cancelled(); }, {}}), Cancelled);
}

}  // namespace
}  // namespace kinegraph
