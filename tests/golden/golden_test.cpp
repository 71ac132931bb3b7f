// What the compiler writes, byte for byte, for the shipped models and the specs of this folder, so
// that a change of output is seen by its reviewers. The files change by tools/update-goldens only.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/compiled.h"

namespace twincraft {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCure =
    "if the change is meant, run tools/update-goldens and review its diff";

fs::path expected_folder() { return fs::path(TWINCRAFT_ROOT) / "tests/golden/expected"; }

std::vector<fs::path> specs(const std::vector<std::string>& folders = {"models", "tests/golden"}) {
  std::vector<fs::path> found;
  for (const std::string& folder : folders) {
    for (const auto& entry : fs::directory_iterator(fs::path(TWINCRAFT_ROOT) / folder)) {
      if (entry.path().extension() == ".yaml") found.push_back(entry.path());
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::string read(const fs::path& path) {
  std::ifstream in(path);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

Bundle compiled(const fs::path& spec) {
  return test::compiled({spec.string(), {}}, {kMjcf, kAssemblyJson, kResolved, kBasilisk});
}

/// The first line that differs says more than two whole files.
std::string first_difference(const std::string& expected, const std::string& actual) {
  std::istringstream a(expected);
  std::istringstream b(actual);
  std::string line_a;
  std::string line_b;
  for (int number = 1;; ++number) {
    const bool more_a = static_cast<bool>(std::getline(a, line_a));
    const bool more_b = static_cast<bool>(std::getline(b, line_b));
    if (!more_a && !more_b) return "only the line ends differ";
    if (more_a == more_b && line_a == line_b) continue;
    return "line " + std::to_string(number) + "\n  expected: " + (more_a ? line_a : "(end)") +
           "\n  now:      " + (more_b ? line_b : "(end)");
  }
}

void expect_same(const std::string& file, const std::string& actual) {
  const std::string expected = read(expected_folder() / file);
  EXPECT_TRUE(expected == actual) << file << ": " << first_difference(expected, actual) << "\n"
                                  << kCure;
}

TEST(Golden, EverySpecCompilesToItsExpectedBytes) {
  ASSERT_FALSE(specs().empty());
  for (const fs::path& spec : specs()) {
    const Bundle bundle = compiled(spec);
    expect_same(bundle.model.name + ".xml", bundle.text(kMjcf));
    expect_same(bundle.model.name + ".bsm.json", bundle.text(kAssemblyJson));
    expect_same(bundle.model.name + ".basilisk.py", bundle.text(kBasilisk));
  }
}

TEST(Golden, TheSchemaAndTheReferenceAreFresh) {
  const fs::path folder = fs::path(TWINCRAFT_ROOT) / "schemas";
  EXPECT_TRUE(read(folder / "spacecraft.schema.json") == json_schema()) << kCure;
  EXPECT_TRUE(read(folder / "REFERENCE.md") == reference_markdown()) << kCure;
}

/// The model's description survives a trip through the resolved spec, and so do all its numbers.
TEST(Golden, EveryResolvedSpecCompilesToTheSameBytes) {
  for (const fs::path& spec :
       specs({"models", "models/gallery", "models/paper", "models/paper/flex_bodies",
              "models/paper/studies", "tests/golden"})) {
    const Bundle bundle = compiled(spec);
    const fs::path resolved = fs::path(testing::TempDir()) / "golden_resolved.yaml";
    std::ofstream(resolved) << bundle.text(kResolved);
    const Bundle again = compiled(resolved);
    EXPECT_EQ(again.text(kMjcf), bundle.text(kMjcf)) << spec;
    EXPECT_EQ(again.text(kAssemblyJson), bundle.text(kAssemblyJson)) << spec;
    EXPECT_EQ(again.text(kResolved), bundle.text(kResolved)) << spec;
    fs::remove(resolved);
  }
}

TEST(Golden, EveryExpectedFileHasItsSpec) {
  std::set<std::string> wanted;
  for (const fs::path& spec : specs()) {
    const std::string name = compiled(spec).model.name;
    wanted.insert(name + ".xml");
    wanted.insert(name + ".bsm.json");
    wanted.insert(name + ".basilisk.py");
  }
  for (const auto& entry : fs::directory_iterator(expected_folder())) {
    EXPECT_TRUE(wanted.contains(entry.path().filename().string()))
        << entry.path().filename() << " is left over; delete it";
  }
}

}  // namespace
}  // namespace twincraft
