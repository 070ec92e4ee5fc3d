#include "welkin/core/files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "welkin/core/progress.h"
#include "welkin/core/units.h"

namespace welkin {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;

struct Files : testing::Test {
  fs::path folder = fs::temp_directory_path() / ("welkin_files_test_" + std::to_string(::getpid()));
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }
  std::size_t count() const { return std::size_t(std::distance(fs::directory_iterator(folder), fs::directory_iterator())); }
};

TEST_F(Files, writtenBytesComeBack) {
  const std::string bytes("a\0b\xff\n", 5);
  ASSERT_TRUE(writeFile(folder / "x", bytes).ok());
  EXPECT_EQ(*readFile(folder / "x"), bytes);
  ASSERT_TRUE(writeFile(folder / "x", "new").ok());
  EXPECT_EQ(*readFile(folder / "x"), "new");
  EXPECT_EQ(count(), 1u);  // no temporaries stay
}

TEST_F(Files, whatIsNotCommittedLeavesNothing) {
  ASSERT_TRUE(writeFile(folder / "x.png", "old").ok());
  {
    PendingFile pending(folder / "x.png");
    std::ofstream(pending.temporary()) << "half";
    EXPECT_EQ(pending.temporary().extension(), ".png");
    EXPECT_EQ(count(), 2u);
  }
  EXPECT_EQ(*readFile(folder / "x.png"), "old");
  EXPECT_EQ(count(), 1u);
}

TEST_F(Files, limitsAndPlacesThatCannotBe) {
  ASSERT_TRUE(writeFile(folder / "x", "12345").ok());
  EXPECT_THAT(readFile(folder / "x", 4).error().message, HasSubstr("at most 4 bytes"));
  EXPECT_FALSE(readFile(folder).ok());
  EXPECT_FALSE(readFile(folder / "none").ok());
  EXPECT_FALSE(writeFile(folder / "none" / "x", "1").ok());
  EXPECT_FALSE(makeWritableFolder(folder / "x").ok());        // a file is in the way
  EXPECT_FALSE(makeWritableFolder(folder / "x" / "y").ok());  // below a file
  EXPECT_FALSE(makeWritableFolder("/proc/welkin").ok());
  EXPECT_FALSE(checkWritableFile(folder).ok());
  EXPECT_TRUE(checkWritableFile(folder / "new" / "folder" / "file").ok());
  EXPECT_TRUE(fs::is_directory(folder / "new" / "folder"));
}

TEST(Units, bytes) {
  EXPECT_EQ(*parseBytes("512MiB"), 512ull << 20);
  EXPECT_EQ(*parseBytes("4 GiB"), 4ull << 30);
  EXPECT_EQ(*parseBytes("1.5KiB"), 1536u);
  EXPECT_EQ(*parseBytes("77"), 77u);
  for (const char* wrong : {"", "MiB", "-1MiB", "nan", "inf", "1e400", "512MB", "512 mib", "9999999GiB", "1MiB "})
    EXPECT_FALSE(parseBytes(wrong).ok()) << wrong;
  EXPECT_EQ(bytesText(512ull << 20), "512 MiB");
  EXPECT_EQ(bytesText(1536ull << 20), "1.5 GiB");
  EXPECT_EQ(bytesText(3), "3 B");
  for (const std::uint64_t n : {0ull, 1ull, 512ull << 20, (512ull << 20) + 1, 3ull << 30}) EXPECT_EQ(*parseBytes(bytesExact(n)), n);
}

TEST(Text, oneLine) {
  EXPECT_EQ(oneLine("a\nb\tc\x01\xff"), "a b c??");
  EXPECT_EQ(oneLine(std::string(300, 'x'), 10), "xxxxxxxxxx...");
}

TEST(Progress, linesWhenNotATerminal) {
  std::FILE* out = std::tmpfile();
  {
    Progress progress("fly", false, out);
    for (int i = 0; i <= 1000; ++i) progress.update(i / 1000.0);
  }
  std::rewind(out);
  int lines = 0;
  for (int c; (c = std::fgetc(out)) != EOF;) lines += c == '\n';
  std::fclose(out);
  EXPECT_EQ(lines, 11);  // one a tenth, 0 and 100 % included
  EXPECT_EQ(clockText(65), "1:05");
  EXPECT_EQ(clockText(3723), "1:02:03");
  EXPECT_EQ(clockText(-1), "-:--");
}

}  // namespace
}  // namespace welkin
