// The corpus of this folder: NAME.yaml holds one fault, NAME.expected what sccompile says about it
// on standard error and its exit code, NAME.args (where needed) further arguments, one a line.
// SC_UPDATE_EXPECTED=1 rewrites the expected files; read the diff as the user would.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

#include "compiler/diag/diagnostics.h"
#include "tests/support/run_program.h"

namespace twincraft {
namespace {

namespace fs = std::filesystem;

/// A file of the corpus by its name, without the ending.
struct Fault {
  std::string name;
  fs::path file(const char* ending) const { return folder() / (name + ending); }
  static fs::path folder() { return fs::path(TWINCRAFT_ROOT) / "tests/malformed"; }
  friend void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.name; }
};

/// The names of all files with an ending, sorted.
std::vector<Fault> faults_with(const std::string& ending) {
  std::vector<Fault> found;
  for (const auto& entry : fs::directory_iterator(Fault::folder()))
    if (entry.path().extension() == ending) found.push_back({entry.path().stem().string()});
  std::ranges::sort(found, {}, &Fault::name);
  return found;
}

/// A case that ends in a warning compiles, so its result has to go somewhere.
std::string said_about(const Fault& fault) {
  std::vector<std::string> arguments{fault.name + ".yaml", "-o", "-"};
  std::istringstream further(test::read_file(fault.file(".args")));
  for (std::string line; std::getline(further, line);) arguments.push_back(line);
  if (std::ranges::find(arguments, "--emit") == arguments.end())
    arguments.insert(arguments.end(), {"--emit", "bsm"});
  const test::ProgramResult run =
      test::run_program(TWINCRAFT_SCCOMPILE, arguments, {.folder = Fault::folder()});
  return run.err + "exit " + std::to_string(run.exit_code) + "\n";
}

class Malformed : public testing::TestWithParam<Fault> {};

TEST_P(Malformed, IsAnsweredWithItsExpectedText) {
  const fs::path expected = GetParam().file(".expected");
  const std::string said = said_about(GetParam());
  if (std::getenv("SC_UPDATE_EXPECTED") != nullptr)
    std::ofstream(expected, std::ios::binary) << said;
  EXPECT_EQ(test::read_file(expected), said) << "SC_UPDATE_EXPECTED=1 rewrites the expected text";
}

INSTANTIATE_TEST_SUITE_P(Corpus, Malformed, testing::ValuesIn(faults_with(".yaml")),
                         [](const auto& instance) { return instance.param.name; });

TEST(MalformedCorpus, HasNothingLeftOver) {
  for (const char* ending : {".expected", ".args"})
    for (const Fault& fault : faults_with(ending))
      EXPECT_TRUE(fs::exists(fault.file(".yaml"))) << fault.file(ending);
}

/// Codes that no file of the corpus can produce, and why.
const std::map<Code, std::string>& unreachable() {
  static const std::map<Code, std::string> reasons{
      {Code::kTooLarge, "needs 200 000 values or 4 MiB; load_test makes them"},
      {Code::kCampaignSobol, "needs 3668 drawn numbers; campaign_test makes them"},
      {Code::kUnresolvedStep, "is said by `--check` alone; sccompile_test asks for it"},
  };
  return reasons;
}

TEST(MalformedCorpus, HasAFileForEveryCode) {
  std::string all;
  for (const Fault& fault : faults_with(".yaml")) all += test::read_file(fault.file(".expected"));
  for (const Code code : all_codes()) {
    const std::string name(code_name(code));
    const bool produced = all.find("[" + name + "]") != std::string::npos;
    EXPECT_NE(produced, unreachable().contains(code)) << name << ": " << code_title(code);
  }
}

}  // namespace
}  // namespace twincraft
