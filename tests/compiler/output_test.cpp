// Files appear whole or not at all.
#include "compiler/files/output.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace twincraft {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Output : public testing::Test {
 protected:
  Output() : folder_(fs::path(testing::TempDir()) / name()) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~Output() override { fs::remove_all(folder_); }

  static std::string name() {
    return std::string("output_") + testing::UnitTest::GetInstance()->current_test_info()->name();
  }
  std::string path(const std::string& file) const { return (folder_ / file).string(); }
  std::string text_of(const std::string& file) const {
    std::ifstream in(path(file));
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
  }
  std::size_t entries() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

TEST_F(Output, WritesAllFilesAndMakesTheirFolders) {
  EXPECT_EQ(write_files({{path("a.xml"), "one\n"}, {path("deep/er/b.json"), "two\n"}}), "");
  EXPECT_EQ(text_of("a.xml"), "one\n");
  EXPECT_EQ(text_of("deep/er/b.json"), "two\n");
  EXPECT_EQ(entries(), 2u);  // no temporary file is left
}

TEST_F(Output, GrowsAFileFromWhereItIsWhole) {
  {
    GrowingFile file(path("deep/er/a.txt"), 0);
    file.append("one\n");
    EXPECT_EQ(text_of("deep/er/a.txt"), "one\n");  // no buffer keeps it
    file.append("tw");
    EXPECT_EQ(file.error(), "");
  }
  GrowingFile file(path("deep/er/a.txt"), 4);
  EXPECT_EQ(text_of("deep/er/a.txt"), "one\n");
  file.append("two\n");
  EXPECT_EQ(text_of("deep/er/a.txt"), "one\ntwo\n");
}

TEST_F(Output, GrowsAFileForOneWriterAtATime) {
  GrowingFile first(path("a.txt"), 0);
  first.append("one\n");
  GrowingFile second(path("a.txt"), 0);
  EXPECT_THAT(second.error(), HasSubstr("another program is writing it"));
  second.append("two\n");
  first.append("three\n");
  EXPECT_EQ(text_of("a.txt"), "one\nthree\n");
}

TEST_F(Output, SaysWhyAFileCannotGrow) {
  fs::create_directories(folder_ / "here");
  EXPECT_THAT(GrowingFile(path("here"), 0).error(), HasSubstr("is a directory"));
  ASSERT_EQ(write_files({{path("file"), "x"}}), "");
  EXPECT_THAT(GrowingFile(path("file/a.txt"), 0).error(), HasSubstr("not a directory"));
}

TEST_F(Output, ReplacesAnEarlierFile) {
  ASSERT_EQ(write_files({{path("a.xml"), "a long earlier text\n"}}), "");
  EXPECT_EQ(write_files({{path("a.xml"), "new\n"}}), "");
  EXPECT_EQ(text_of("a.xml"), "new\n");
}

TEST_F(Output, LeavesEarlierFilesAloneWhenALaterOneFails) {
  ASSERT_EQ(write_files({{path("a.xml"), "earlier\n"}}), "");
  fs::create_directory(path("b.json"));
  const std::string error = write_files({{path("a.xml"), "new\n"}, {path("b.json"), "new\n"}});
  EXPECT_THAT(error, HasSubstr("b.json`: is a directory"));
  EXPECT_EQ(text_of("a.xml"), "earlier\n");
  EXPECT_EQ(entries(), 2u);
}

TEST_F(Output, SaysWhyAFolderCannotBeMade) {
  ASSERT_EQ(write_files({{path("file"), ""}}), "");
  EXPECT_THAT(write_files({{path("file/a.xml"), "x"}}), HasSubstr("file`: not a directory"));
}

TEST_F(Output, ReportsAFullDiskAndKeepsTheEarlierFile) {
  ASSERT_EQ(write_files({{path("a.xml"), "earlier\n"}}), "");
  // A file size limit is the disk that is full for this process alone.
  const auto write_too_much = [this] {
    const rlimit limit{4096, 4096};
    setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, SIG_IGN);
    const std::string error = write_files({{path("a.xml"), std::string(100'000, 'x')}});
    std::exit(error.find("file too large") != std::string::npos ? 0 : 1);
  };
  EXPECT_EXIT(write_too_much(), testing::ExitedWithCode(0), "");
  EXPECT_EQ(text_of("a.xml"), "earlier\n");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(Output, ReportsAClosedPipe) {
  const auto write_to_nobody = [] {
    std::signal(SIGPIPE, SIG_IGN);
    std::array<int, 2> ends;
    if (pipe(ends.data()) != 0) std::exit(2);
    close(ends[0]);
    dup2(ends[1], STDOUT_FILENO);
    std::exit(write_standard_output("x") == "cannot write standard output: broken pipe" ? 0 : 1);
  };
  EXPECT_EXIT(write_to_nobody(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace twincraft
