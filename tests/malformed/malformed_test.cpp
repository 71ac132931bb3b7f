// The corpus of this folder: NAME.yaml holds one fault, NAME.expected what sccompile says about it
// on standard error and its exit code, NAME.args (where needed) further arguments, one a line.
// SC_UPDATE_EXPECTED=1 rewrites the expected files; read the diff as the user would.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "compiler/diag/diagnostics.h"
#include "tests/compiler/run_sccompile.h"

namespace twincraft {
namespace {

namespace fs = std::filesystem;

fs::path folder() { return fs::path(TWINCRAFT_ROOT) / "tests/malformed"; }

std::vector<fs::path> cases() {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder())) {
    if (entry.path().extension() == ".yaml") found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::string read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

std::string further_arguments(fs::path spec) {
  std::ifstream in(spec.replace_extension(".args"));
  std::string arguments;
  for (std::string line; std::getline(in, line);) arguments += " '" + line + "'";
  return arguments;
}

/// A case that ends in a warning compiles, so its result has to go somewhere.
std::string said_about(const fs::path& spec) {
  const test::Outcome run =
      test::run_sccompile("'" + spec.filename().string() + "' --emit bsm -o -" +
                              further_arguments(spec) + " 2>&1 >/dev/null",
                          folder().string());
  return run.output + "exit " + std::to_string(run.exit_code) + "\n";
}

TEST(Malformed, EveryFileIsAnsweredWithItsExpectedText) {
  const bool update = std::getenv("SC_UPDATE_EXPECTED") != nullptr;
  ASSERT_GE(cases().size(), 60u);
  for (const fs::path& spec : cases()) {
    const fs::path expected = fs::path(spec).replace_extension(".expected");
    const std::string said = said_about(spec);
    if (update) std::ofstream(expected, std::ios::binary) << said;
    EXPECT_EQ(read(expected), said)
        << spec.filename() << ": SC_UPDATE_EXPECTED=1 rewrites the expected text";
  }
}

TEST(Malformed, NothingIsLeftOver) {
  for (const auto& entry : fs::directory_iterator(folder())) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".expected" && extension != ".args") continue;
    EXPECT_TRUE(fs::exists(fs::path(entry.path()).replace_extension(".yaml"))) << entry.path();
  }
}

/// Codes that no file of the corpus can produce, and why.
const std::map<Code, std::string>& unreachable() {
  static const std::map<Code, std::string> reasons{
      {Code::kTooLarge, "needs 200 000 values or 4 MiB; load_test makes them"},
      {Code::kUnresolvedStep, "is said by `--check` alone; sccompile_test asks for it"},
  };
  return reasons;
}

TEST(Malformed, EveryCodeIsProducedBySomeFile) {
  std::string all;
  for (const fs::path& spec : cases()) all += read(fs::path(spec).replace_extension(".expected"));
  for (const Code code : all_codes()) {
    const std::string name(code_name(code));
    const bool produced = all.find("[" + name + "]") != std::string::npos;
    EXPECT_NE(produced, unreachable().contains(code)) << name << ": " << code_title(code);
  }
}

}  // namespace
}  // namespace twincraft
