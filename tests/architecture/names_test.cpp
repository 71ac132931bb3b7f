// The names of engines and targets are written down once, in their tables. Whoever needs one takes
// it from there; a word that only happens to be spelt the same is listed here.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace twincraft {
namespace {

namespace fs = std::filesystem;
using testing::UnorderedElementsAre;

/// The files of the product, one entry for each line that matches outside of a comment.
std::vector<std::string> lines_with(const std::string& pattern) {
  const std::regex form(pattern);
  const fs::path root(TWINCRAFT_ROOT);
  std::vector<std::string> files;
  for (const char* folder : {"compiler", "runtime", "tools/programs"})
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".h" && extension != ".cpp" && extension != ".def") continue;
      std::ifstream in(entry.path());
      for (std::string line; std::getline(in, line);)
        if (std::regex_search(line.substr(0, line.find("//")), form))
          files.push_back(fs::relative(entry.path(), root).string());
    }
  return files;
}

TEST(Names, OfEnginesStandInTheirTable) {
  EXPECT_THAT(
      lines_with(R"re("(bsm|mujoco|BSM|MuJoCo)(\.csv|\.nc)?")re"),
      UnorderedElementsAre("compiler/ir/engine_kind.h", "compiler/ir/engine_kind.h",
                           "compiler/ir/bundle.h",    // of a target
                           "compiler/emit/mjcf.cpp",  // the root of MJCF
                           // halves of a script for Basilisk, and a module of it
                           "compiler/emit/basilisk_code.cpp", "compiler/emit/basilisk_half.h",
                           "compiler/emit/basilisk_mjscene_code.cpp",
                           "runtime/report/json.cpp",         // the version of a library,
                           "runtime/report/netcdf_file.cpp",  // the same
                           // words of the spec language
                           "compiler/schema/synonyms.def", "compiler/schema/synonyms.def",
                           "compiler/schema/synonyms.def", "compiler/schema/synonyms.def"));
}

TEST(Names, OfTargetsStandInTheirTable) {
  EXPECT_THAT(lines_with(R"re("(mjcf|resolved|dot)")re"),
              UnorderedElementsAre("compiler/emit/target.cpp", "compiler/ir/bundle.h",
                                   "compiler/ir/bundle.h",
                                   // properties of a model in Python
                                   "runtime/api/python/model.cpp", "runtime/api/python/model.cpp",
                                   // keys of report.json
                                   "runtime/report/json.cpp", "runtime/report/page/page_data.cpp",
                                   "runtime/report/resolution_json.cpp"));
}

}  // namespace
}  // namespace twincraft
