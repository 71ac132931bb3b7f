// What a stranger wrote must not drive a terminal: every flag of both programs, as `--help` lists
// them, is given bytes that would, and so are the names of files and the text of a spec.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <regex>
#include <set>

#include "compiler/diag/diagnostics.h"
#include "compiler/diag/utf8.h"
#include "tests/support/run_program.h"

namespace twincraft {
namespace {

namespace fs = std::filesystem;
using test::ProgramResult;
using test::TemporaryFolder;
using testing::HasSubstr;
using testing::Not;

/// Bytes that recolour, move, ring, reorder or are no text at all.
const std::vector<std::string> kHostile{
    "a\x1b[31mb",  // ESC: the title, the colour, the cursor
    "a\x1b]0;owned\x07"
    "b",  // an operating system command, ended by BEL
    "a\xc2\x9b"
    "31mb",  // CSI as one character of C1
    "a\x9b"
    "31mb",  // the same as one byte, no UTF-8
    "a\x7f\r\xe2\x80\xae"
    "b",  // DEL, carriage return, right-to-left override
};

/// The first place at which `text` would drive a terminal; empty when it only shows.
std::string danger_in(const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const Utf8Character character = decode_utf8(text, at);
    const std::size_t length = std::max<std::size_t>(1, character.length);
    const std::string piece = text.substr(at, length);
    if (piece != "\n" && piece != "\t" && printable(piece) != piece)
      return printable(text.substr(at < 40 ? 0 : at - 40, 80));
    at += length;
  }
  return {};
}

struct Program {
  const char* name;
  const char* path;
  std::vector<std::string> first;  // arguments before all others
};

const std::vector<Program> kPrograms{{"sccompile", TWINCRAFT_SCCOMPILE, {}},
                                     {"scsim", TWINCRAFT_SCSIM, {}},
                                     {"attribute", TWINCRAFT_SCSIM, {"attribute"}}};

class Terminal : public testing::TestWithParam<Program> {
 protected:
  Terminal() { fs::current_path(folder.path()); }  // where sccompile writes without `-o`
  ~Terminal() override { fs::current_path("/"); }

  ProgramResult run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), GetParam().first.begin(), GetParam().first.end());
    return test::run_program(GetParam().path, arguments);
  }

  void expect_harmless(const std::vector<std::string>& arguments) const {
    const ProgramResult result = run(arguments);
    std::string shown;
    for (const std::string& argument : arguments) shown += " " + printable(argument);
    EXPECT_EQ(danger_in(result.out), "") << "standard output of" << shown;
    EXPECT_EQ(danger_in(result.err), "") << "standard error of" << shown;
    EXPECT_LT(result.exit_code, 128) << shown;
  }

  /// Every flag that `--help` lists, long and short.
  std::set<std::string> flags() const {
    const std::string help = run({"--help"}).out;
    static const std::regex flag("(^|[ ,])(--?[A-Za-z][a-z-]*)");
    std::set<std::string> found;
    for (std::sregex_iterator it(help.begin(), help.end(), flag), end; it != end; ++it)
      found.insert((*it)[2]);
    return found;
  }

  TemporaryFolder folder;
  std::string brick = folder.write("brick.yaml",
                                   "format: spacecraft/1\nname: brick\n"
                                   "hub: {mass: 600, inertia: [400, 380, 360]}\n"
                                   "simulation: {integrator: rk4, step: 0.1, duration: 0.2}\n");
};

TEST_P(Terminal, IsSafeFromTheValueOfEveryFlag) {
  const std::set<std::string> all = flags();
  for (const char* known : {"-o", "--set", "--diagnostics", "--explain", "-W"})
    ASSERT_TRUE(all.contains(known)) << known;
  for (const std::string& flag : all)
    for (const std::string& hostile : kHostile) {
      expect_harmless({brick, flag, folder.path() + "/" + hostile});
      expect_harmless({flag + (flag.starts_with("--") ? "=" : "") + hostile, brick});
    }
}

TEST_P(Terminal, IsSafeFromFlagsAndArgumentsThatDoNotExist) {
  for (const std::string& hostile : kHostile) {
    expect_harmless({hostile});
    expect_harmless({brick, hostile});
    expect_harmless({brick, "--" + hostile});
    expect_harmless({brick, "-" + hostile});
    expect_harmless({brick, "-o", "/proc/" + hostile});
    expect_harmless({"/proc/self/" + hostile});
  }
}

TEST_P(Terminal, IsSafeFromTheNameOfASpec) {
  for (const std::string& hostile : kHostile) {
    const std::string faulty = folder.write(hostile + "_faulty.yaml", "format: spacecraft/1\n");
    const std::string good = folder.write(hostile + ".yaml", folder.read("brick.yaml"));
    for (const char* format : {"text", "json"}) {
      expect_harmless({faulty, "--diagnostics", format});
      expect_harmless({good, "--diagnostics", format, "-o", folder.path() + "/out"});
    }
    expect_harmless({folder.path() + "/" + hostile + "_no.yaml"});  // the near miss is named too
  }
}

TEST_P(Terminal, IsSafeFromTheTextOfASpec) {
  for (const std::string& hostile : kHostile) {
    expect_harmless({brick, "--set", "description=" + hostile});
    expect_harmless({brick, "--set", "name=" + hostile});
    expect_harmless({brick, "--set", hostile + "=1"});
    expect_harmless({brick, "--set", "hub.mass=" + hostile});
    expect_harmless({brick, "--set", "hub.mass='1 " + hostile + "'"});
    expect_harmless({brick, "--set", "extends=" + hostile});
    const std::string spec =
        folder.write("spec.yaml", folder.read("brick.yaml") + hostile + ": 1\n");
    expect_harmless({spec});
    expect_harmless({folder.write("spec.yaml", "extends: " + hostile + "\n")});
  }
}

TEST(TerminalOfCompare, IsSafeFromTheTextAndNameOfATrajectory) {
  const TemporaryFolder folder;
  const std::string good = folder.write("good.csv", "t [s],mass [kg],x [m]\n0,1,2\n");
  const auto expect_harmless = [&good](const std::string& file) {
    for (const std::vector<std::string>& arguments :
         {std::vector{file, good}, std::vector{good, file}, std::vector{file, file}}) {
      const ProgramResult result =
          test::run_program(TWINCRAFT_SCSIM, {"compare", arguments[0], arguments[1]});
      EXPECT_EQ(danger_in(result.out), "");
      EXPECT_EQ(danger_in(result.err), "");
      EXPECT_LT(result.exit_code, 128);
    }
  };
  for (const std::string& hostile : kHostile) {
    expect_harmless(folder.write(hostile + ".csv", "t [s],mass [kg]\n0,1\n"));
    expect_harmless(folder.path() + "/" + hostile + "_no.csv");
    for (const std::string& text :
         {"t [s]," + hostile + " [m]\n0,1\n", "t [s]," + hostile + ".rate\n0,1\n",
          "t [s],mass [" + hostile + "]\n0,1\n", "t [" + hostile + "]\n0\n",
          "t [s],mass [kg]\n0," + hostile + "\n", "t [s],x [m]," + hostile + "\n0,1,2\n"})
      expect_harmless(folder.write("bad.csv", text));
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Terminal, testing::ValuesIn(kPrograms),
                         [](const auto& instance) { return instance.param.name; });

/// What a program says on a terminal of its own, both streams as they come.
std::string said_on_terminal(const char* program, const std::vector<std::string>& arguments) {
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
  if (child == 0) {
    setenv("TERM", "xterm", 1);
    unsetenv("NO_COLOR");
    std::vector<char*> argv{const_cast<char*>(program)};
    for (const std::string& argument : arguments)
      argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    execv(program, argv.data());
    _exit(127);
  }
  std::string text;
  std::array<char, 4096> buffer{};
  for (ssize_t count = 1; count > 0;) {
    count = read(terminal, buffer.data(), buffer.size());
    if (count > 0) text.append(buffer.data(), static_cast<std::size_t>(count));
  }
  close(terminal);
  waitpid(child, nullptr, 0);
  return text;
}

// With colour the programs write escapes of their own, among which a stranger's must not pass.
TEST(TerminalWithColour, ShowsTheEscapesOfANameAndKeepsItsOwn) {
  const TemporaryFolder folder;
  const std::string spec = folder.write("a\x1b[35mb.yaml", "format: spacecraft/1\nname: x\n");
  for (const char* program : {TWINCRAFT_SCCOMPILE, TWINCRAFT_SCSIM}) {
    const std::string said = said_on_terminal(program, {spec});
    EXPECT_THAT(said, HasSubstr("a\\x1b[35mb.yaml"));
    EXPECT_THAT(said, Not(HasSubstr("\x1b[35m")));
    EXPECT_THAT(said, HasSubstr("\x1b[1;31merror"));
    const std::string missing = said_on_terminal(program, {folder.path() + "/c\x1b[35md"});
    EXPECT_THAT(missing, HasSubstr("c\\x1b[35md"));
    EXPECT_THAT(missing, Not(HasSubstr("\x1b[35m")));
  }
}

// Results for programs are bytes, but not when a terminal is what reads them.
TEST(TerminalWithColour, GetsNoControlCharacterOutOfAResult) {
  const TemporaryFolder folder;
  const std::string spec = folder.write("brick.yaml",
                                        "format: spacecraft/1\nname: brick\n"
                                        "description: a\xc2\x85"
                                        "b\n"
                                        "hub: {mass: 600, inertia: [400, 380, 360]}\n");
  for (const char* target : {"resolved", "mjcf", "bsm", "dot"}) {
    const std::string said =
        said_on_terminal(TWINCRAFT_SCCOMPILE, {spec, "--emit", target, "-o", "-"});
    EXPECT_THAT(said, Not(HasSubstr("\xc2\x85"))) << target;
  }
}

}  // namespace
}  // namespace twincraft
