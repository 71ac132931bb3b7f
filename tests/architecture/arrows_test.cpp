// Which room may include which: the architecture's arrows, read from the #include lines. No file is
// an exception.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace twincraft {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::IsEmpty;

using Rooms = std::set<std::string>;

// A room, and those that it sees beside itself. What `a/b` sees is asked of `a/b` before `a`.
const std::map<std::string, Rooms> kArrows = {
    // Text to model.
    {"compiler/ir", {}},
    {"compiler/analysis", {"compiler/ir"}},
    {"compiler/diag", {}},
    {"compiler/files", {"compiler/diag"}},
    {"compiler/units", {"compiler/diag"}},
    {"compiler/syntax", {"compiler/diag"}},
    {"compiler/schema", {"compiler/diag", "compiler/ir", "compiler/syntax", "compiler/units"}},
    {"compiler/components",
     {"compiler/analysis", "compiler/diag", "compiler/ir", "compiler/schema", "compiler/syntax"}},
    {"compiler/draws", {"compiler/ir"}},
    {"compiler/spec",
     {"compiler/analysis", "compiler/components", "compiler/diag", "compiler/draws", "compiler/ir",
      "compiler/schema", "compiler/syntax"}},
    {"compiler/emit", {"compiler/ir"}},
    {"compiler",
     {"compiler/analysis", "compiler/diag", "compiler/emit", "compiler/ir", "compiler/schema",
      "compiler/spec", "compiler/syntax"}},
    // Model to motion to findings.
    {"runtime/engine", {"compiler/ir"}},
    {"runtime/scalar", {"compiler/ir"}},
    {"runtime/forces", {"compiler/ir", "runtime/engine", "runtime/scalar"}},
    {"runtime/integrate", {"compiler/ir", "runtime/engine"}},
    {"runtime/bsm", {"compiler/ir", "runtime/engine", "runtime/forces", "runtime/scalar"}},
    {"runtime/mujoco", {"compiler/ir", "runtime/engine", "runtime/forces", "mujoco"}},
    {"runtime/reference", {"compiler/ir", "compiler/analysis", "runtime/engine"}},
    {"runtime/simulate",
     {"compiler/ir", "runtime/bsm", "runtime/engine", "runtime/integrate", "runtime/mujoco",
      "runtime/reference"}},
    {"runtime/linear",
     {"compiler/ir", "compiler/analysis", "runtime/bsm", "runtime/engine", "runtime/integrate",
      "runtime/reference", "runtime/simulate"}},
    {"runtime/compare", {"compiler/ir", "runtime/engine", "runtime/simulate"}},
    {"runtime/study",
     {"compiler/ir", "runtime/bsm", "runtime/compare", "runtime/engine", "runtime/integrate",
      "runtime/linear", "runtime/reference", "runtime/simulate", "mujoco"}},
    {"runtime/statistics", {}},
    {"runtime/campaign",
     {"compiler/ir", "runtime/bsm", "runtime/compare", "runtime/engine", "runtime/linear",
      "runtime/simulate", "runtime/statistics", "runtime/study"}},
    {"runtime/report",
     {"compiler/ir", "runtime/campaign", "runtime/compare", "runtime/engine", "runtime/integrate",
      "runtime/simulate", "runtime/study"}},
    {"runtime/report/page",
     {"compiler/ir", "runtime/compare", "runtime/engine", "runtime/report", "runtime/simulate",
      "runtime/statistics", "runtime/study"}},
    // Where both meet: a spec flown, in process.
    {"runtime/delivery",
     {"compiler", "compiler/diag", "compiler/files", "compiler/ir", "compiler/syntax",
      "compiler/units", "runtime/bsm", "runtime/campaign", "runtime/compare", "runtime/engine",
      "runtime/linear", "runtime/report", "runtime/report/page", "runtime/simulate",
      "runtime/study"}},
    // And what strangers see of it.
    {"runtime/api",
     {"compiler", "compiler/analysis", "compiler/diag", "compiler/ir", "compiler/units",
      "runtime/bsm", "runtime/campaign", "runtime/compare", "runtime/delivery", "runtime/engine",
      "runtime/report", "runtime/simulate", "runtime/api/include"}},
    {"runtime/api/python", {}},  // the library as any program has it
};

std::string folder_of(const std::string& file) {
  const std::size_t slash = file.rfind('/');
  return slash == std::string::npos ? "" : file.substr(0, slash);
}

/// An include of ours or of MuJoCo, from file to folder.
struct Arrow {
  std::string from;  // a file, from the repository's root
  std::string to;    // a folder
};

std::vector<Arrow> arrows_below(const std::string& folder) {
  static const std::regex line_form("^\\s*#include [<\"]([^>\"]+)[>\"].*");
  std::vector<Arrow> arrows;
  const fs::path root(TWINCRAFT_ROOT);
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".h" && extension != ".cpp") continue;
    std::ifstream in(entry.path());
    std::smatch match;
    for (std::string line; std::getline(in, line);) {
      if (!std::regex_match(line, match, line_form)) continue;
      const std::string header = match[1];
      for (const char* ours : {"compiler/", "runtime/", "tools/", "tests/", "mujoco/"})
        if (header.starts_with(ours))
          arrows.push_back({fs::relative(entry.path(), root).string(), folder_of(header)});
    }
  }
  return arrows;
}

TEST(Arrows, AreReadFromRealFiles) {
  EXPECT_GT(arrows_below("compiler").size(), 100u);
  EXPECT_GT(arrows_below("runtime").size(), 300u);
}

TEST(Arrows, OfEveryRoomLeadToTheRoomsBelowIt) {
  std::vector<std::string> breaches;
  for (const char* house : {"compiler", "runtime"})
    for (const Arrow& arrow : arrows_below(house)) {
      const std::string room = folder_of(arrow.from);
      ASSERT_THAT(kArrows, Contains(testing::Key(room))) << arrow.from << " is in no known room";
      if (arrow.to != room && !kArrows.at(room).contains(arrow.to))
        breaches.push_back(arrow.from + " sees " + arrow.to);
    }
  EXPECT_THAT(breaches, IsEmpty());
}

TEST(Arrows, DoNotLeadInCircles) {
  std::map<std::string, Rooms> left = kArrows;
  for (bool is_smaller = true; is_smaller;) {
    is_smaller = std::erase_if(left, [&left](const auto& room) {
                   return std::ranges::none_of(room.second, [&left](const std::string& seen) {
                     return left.contains(seen);
                   });
                 }) > 0;
  }
  EXPECT_TRUE(left.empty()) << left.begin()->first;
}

}  // namespace
}  // namespace twincraft
