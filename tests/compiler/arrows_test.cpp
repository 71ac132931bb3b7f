// Which room may include which: the architecture's arrows, read from the #include lines.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace twincraft {
namespace {

namespace fs = std::filesystem;
using testing::IsEmpty;

struct Include {
  std::string from;  // from the repository's root
  std::string to;    // as written
};

std::vector<Include> includes_below(const std::string& folder) {
  static const std::regex line_form("^\\s*#include [<\"]([^>\"]+)[>\"].*");
  std::vector<Include> includes;
  const fs::path root(TWINCRAFT_ROOT);
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".h" && extension != ".cpp") continue;
    std::ifstream in(entry.path());
    std::smatch match;
    for (std::string line; std::getline(in, line);) {
      if (!std::regex_match(line, match, line_form)) continue;
      includes.push_back({fs::relative(entry.path(), root).string(), match[1]});
    }
  }
  return includes;
}

std::vector<std::string> breaches(const std::string& folder,
                                  const std::function<bool(const Include&)>& allowed) {
  std::vector<std::string> found;
  for (const Include& include : includes_below(folder)) {
    if (!allowed(include)) found.push_back(include.from + " includes " + include.to);
  }
  return found;
}

bool is_mujoco(const std::string& header) { return header.starts_with("mujoco/"); }

TEST(Arrows, AreReadFromRealFiles) {
  EXPECT_GT(includes_below("compiler").size(), 100u);
  EXPECT_GT(includes_below("runtime").size(), 50u);
}

TEST(Arrows, TheCompilerKnowsNoRuntimeAndNoMujoco) {
  const auto allowed = [](const Include& include) {
    // What `sccompile --check` says.
    if (include.to == "runtime/study/proof.h" || include.to == "runtime/linear/resolution.h" ||
        include.to == "runtime/report/progress.h")
      return include.from == "compiler/main.cpp";
    return !include.to.starts_with("runtime/") && !is_mujoco(include.to);
  };
  EXPECT_THAT(breaches("compiler", allowed), IsEmpty());
}

TEST(Arrows, TheRuntimeSeesOfTheCompilerOnlyTheModel) {
  const auto allowed = [](const Include& include) {
    if (!include.to.starts_with("compiler/") || include.to.starts_with("compiler/ir/")) return true;
    // Writing safely, to files and to terminals, is no knowledge of the compiler.
    if (include.to == "compiler/output.h" || include.to == "compiler/diag/terminal.h") return true;
    // The files of the program itself: its two commands and what they share.
    const std::set<std::string> program = {"runtime/main.cpp",        "runtime/attribute.cpp",
                                           "runtime/command.h",       "runtime/command.cpp",
                                           "runtime/estimate.cpp",    "runtime/member_files.cpp",
                                           "runtime/report_files.cpp"};
    if (!program.contains(include.from)) return false;
    return include.to == "compiler/pipeline.h" || include.to == "compiler/cli.h" ||
           include.to.starts_with("compiler/diag/") || include.to.starts_with("compiler/syntax/");
  };
  EXPECT_THAT(breaches("runtime", allowed), IsEmpty());
}

TEST(Arrows, OnlyTheMujocoRoomIncludesMujoco) {
  const auto allowed = [](const Include& include) {
    return !is_mujoco(include.to) || include.from.starts_with("runtime/mujoco/") ||
           include.from == "runtime/report/provenance.cpp";  // asks for its version
  };
  EXPECT_THAT(breaches("runtime", allowed), IsEmpty());
}

TEST(Arrows, TheModelDependsOnNothingOfOurs) {
  const auto allowed = [](const Include& include) {
    const bool ours = include.to.starts_with("compiler/") || include.to.starts_with("runtime/");
    return !ours || include.to.starts_with("compiler/ir/");
  };
  EXPECT_THAT(breaches("compiler/ir", allowed), IsEmpty());
}

TEST(Arrows, DiagnosticsAndSyntaxKnowNoMeaning) {
  const auto allowed = [](const Include& include) {
    return !include.to.starts_with("compiler/") || include.to.starts_with("compiler/diag/") ||
           include.to.starts_with("compiler/syntax/");
  };
  EXPECT_THAT(breaches("compiler/diag", allowed), IsEmpty());
  EXPECT_THAT(breaches("compiler/syntax", allowed), IsEmpty());
}

TEST(Arrows, PrintersAndVerificationKnowNoComponent) {
  const auto allowed = [](const Include& include) {
    const bool component_free = include.from.find("/emit_") != std::string::npos ||
                                include.from.find("/verify.") != std::string::npos;
    return !component_free || !include.to.starts_with("compiler/components/");
  };
  EXPECT_THAT(breaches("compiler", allowed), IsEmpty());
}

}  // namespace
}  // namespace twincraft
