// Claims about `scsim compare` as its user meets it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/run_program.h"

namespace twincraft {
namespace {

using nlohmann::json;
using test::ProgramResult;
using test::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string kQuickstart = TWINCRAFT_ROOT "/models/quickstart.yaml";

class Compare : public testing::Test {
 protected:
  Compare() { std::filesystem::create_directory(folder.path() + "/deg"); }

  ProgramResult run(std::vector<std::string> arguments) const {
    test::ProgramInput input;
    input.folder = folder.path();
    return test::run_program(TWINCRAFT_SCSIM, arguments, input);
  }
  ProgramResult compare(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "compare");
    return run(std::move(arguments));
  }
  void fly(const std::string& name, const std::string& integrator = "rk4") const {
    const ProgramResult result = run(
        {kQuickstart, "-o", name, "--no-timing", "--duration", "10 s", "--integrator", integrator});
    ASSERT_NE(result.exit_code, 3) << result.err;
  }
  json report(const std::string& name) const {
    return json::parse(folder.read(name + "/report.json"))["members"][0];
  }

  TemporaryFolder folder;
};

/// The lines of the table of a text: what stands below `agreement` until the first that is no row.
std::string table_in(const std::string& text) {
  const std::size_t begin = text.find("agreement ");
  std::size_t end = text.find('\n', begin);
  while (text.compare(end + 1, 2, "  ") == 0) end = text.find('\n', end + 1);
  return begin == std::string::npos ? "" : text.substr(begin, end + 1 - begin);
}

TEST_F(Compare, GivesTheTableOfARunFromItsFiles) {
  const ProgramResult flown = run({kQuickstart, "-o", "out", "--no-timing"});
  ASSERT_EQ(flown.exit_code, 0) << flown.err;
  const ProgramResult result =
      compare({"out/bsm.csv", "out/mujoco.csv", "--tolerances", kQuickstart});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  std::string without_mass = table_in(result.out);
  without_mass.erase(without_mass.find("  mass "));
  EXPECT_EQ(without_mass, table_in(flown.out));
  EXPECT_THAT(result.out, HasSubstr("241 common times, 0 s to 120 s\n"));
  EXPECT_THAT(result.out, HasSubstr("\n`out/bsm.csv` and `out/mujoco.csv` agree\n"));
  EXPECT_EQ(result.err, "");
}

TEST_F(Compare, ExitsWithOneWhereAnIntegratorLeavesTheTolerances) {
  fly("a");
  fly("b", "rk2");
  const ProgramResult judged = compare({"a", "b", "--tolerances", kQuickstart});
  EXPECT_EQ(judged.exit_code, 1) << judged.err;
  EXPECT_THAT(judged.out, AllOf(HasSubstr("`a/bsm.csv` and `b/bsm.csv`"),
                                HasSubstr("`a/mujoco.csv` and `b/mujoco.csv`"),
                                HasSubstr("EXCEEDED\n"), HasSubstr("\n`a` and `b` disagree\n")));
  const ProgramResult reported = compare({"a", "b"});
  EXPECT_EQ(reported.exit_code, 0);
  EXPECT_THAT(reported.out, AllOf(Not(HasSubstr("EXCEEDED")),
                                  HasSubstr("\nnot judged; no tolerance given: `--tolerances SPEC` "
                                            "names a spec\n")));
  EXPECT_EQ(compare({"a", "a", "--tolerances", kQuickstart}).exit_code, 0);
  // Wide enough for rk2, and changed as any spec is.
  EXPECT_EQ(compare({"a", "b", "--tolerances", kQuickstart, "--set",
                     "agreement={attitude: 1 rad, joint: 1 rad}"})
                .exit_code,
            0);
}

/// The text with one column in degrees, its columns turned about, and each quaternion negated.
std::string in_other_words(const std::string& csv) {
  std::istringstream lines(csv);
  std::string text;
  std::vector<std::string> names;
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    if (names.empty()) names = cells;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const bool is_header = text.find('\n') == std::string::npos;
      std::ostringstream number;
      number.precision(17);
      if (names[i].ends_with(" [rad]")) {
        if (is_header)
          cells[i] = names[i].substr(0, names[i].size() - 5) + "[deg]";
        else
          cells[i] = (number << std::stod(cells[i]) * (180.0 / M_PI), number.str());
      }
      if (names[i].starts_with("q_BN") && !is_header)
        cells[i] = (number << -std::stod(cells[i]), number.str());
    }
    for (auto cell = cells.rbegin(); cell != cells.rend(); ++cell)
      text += *cell + (cell + 1 == cells.rend() ? "\n" : ",");
  }
  return text;
}

TEST_F(Compare, FindsTheSameTrajectoryInOtherUnitsOrderAndSigns) {
  fly("a");
  folder.write("deg/bsm.csv", in_other_words(folder.read("a/bsm.csv")));
  const ProgramResult result =
      compare({"a", "deg", "--tolerances", kQuickstart, "--set",  // rounding of degrees alone
               "agreement={attitude: 0 deg, rate: 0, position: 0, joint: 1.0e-14 deg, wheel: 0}"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("note: 1 file is in `a` alone: `mujoco.csv`\n"));
}

TEST_F(Compare, ExitsWithThreeForFilesThatItCanNotRead) {
  folder.write("a.csv", "t [s],mass [kg]\n0,1\n");
  folder.write("\x1b[31m.csv", "t [s],mass [kg]\n0,one\n");
  ASSERT_EQ(::mkfifo((folder.path() + "/pipe").c_str(), 0600), 0);
  const auto expect = [this](const std::string& file, const std::string& error) {
    const ProgramResult result = compare({"a.csv", file});
    EXPECT_EQ(result.exit_code, 3) << file;
    EXPECT_EQ(result.err, error) << file;
    EXPECT_EQ(result.out, "") << file;
  };
  expect("missing", "missing: error: it can not be read: no such file or directory\n");
  expect("b.csv",
         "b.csv: error: it can not be read: no such file or directory; did you mean `a.csv`?\n");
  expect("deg",
         "deg: error: it is a folder, `a.csv` is none\n  hint: compare two files or two folders\n");
  expect("pipe", "pipe: error: it can not be read: it is not a regular file\n");
  expect("\x1b[31m.csv", "\\x1b[31m.csv:2:3: error: `one` is no number, in the column `mass`\n");
  const ProgramResult folders = compare({"deg", "."});
  EXPECT_EQ(folders.exit_code, 3);
  EXPECT_THAT(folders.err, HasSubstr("deg: error: no CSV file in common with `.`\n"));
}

TEST_F(Compare, ExplainsItsUsage) {
  const ProgramResult help = compare({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out, AllOf(HasSubstr("--tolerances SPEC"), HasSubstr("Example: scsim compare")));
  EXPECT_EQ(compare({}).exit_code, 2);
  EXPECT_EQ(compare({"a.csv"}).err,
            "scsim compare: B is missing: two files or folders are compared\n"
            "  hint: for example `scsim compare out/bsm.csv other/bsm.csv`\n");
  EXPECT_THAT(run({"compar", "a", "b"}).err, HasSubstr("did you mean `compare`?"));
}

TEST_F(Compare, PrintsNoTableWhenItIsToBeQuiet) {
  folder.write("a.csv", "t [s],mass [kg]\n0,1\n");
  folder.write("b.csv", "t [s],mass [kg]\n0,2\n");
  const ProgramResult quiet = compare({"a.csv", "b.csv", "--quiet"});
  EXPECT_EQ(quiet.exit_code, 0);
  EXPECT_EQ(quiet.out + quiet.err, "");
  EXPECT_EQ(compare({"a.csv", "b.csv", "--quiet", "--tolerances", kQuickstart, "--set",
                     "agreement={mass: 1 g}"})
                .exit_code,
            1);
  EXPECT_TRUE(json::accept(compare({"a.csv", "b.csv", "--diagnostics", "json"}).out));
}

}  // namespace
}  // namespace twincraft
