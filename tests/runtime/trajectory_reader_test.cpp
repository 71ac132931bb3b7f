// Claims about the reader of trajectories: what it takes, and what it says of everything else.
#include "runtime/delivery/trajectory_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

namespace twincraft {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

/// A text read to its end: the time and the one column `x` of each sample, and the first fault.
struct Read {
  explicit Read(const std::string& text) : in(text), reader("a.csv", in) {
    std::vector<FileFault> faults;
    if (!reader.read_header(faults)) {
      for (const FileFault& each : faults) fault += to_text(each);
      return;
    }
    double x = 0.0;
    for (std::size_t i = 0; i < reader.columns().size(); ++i)
      if (reader.columns()[i].name == "x") reader.bind(i, 1.0, x);
    while (reader.next()) samples.emplace_back(reader.time(), x);
    if (reader.fault()) fault = to_text(*reader.fault());
  }

  std::istringstream in;
  TrajectoryReader reader;
  std::vector<std::pair<double, double>> samples;
  std::string fault;
};

void expect_samples(const std::string& text) {
  const Read read(text);
  EXPECT_EQ(read.fault, "") << text;
  EXPECT_THAT(read.samples, ElementsAre(Pair(0.0, 1.5), Pair(0.5, -2.0))) << text;
}

TEST(TrajectoryReader, ReadsWhatSpreadsheetsAndPandasWrite) {
  expect_samples("t [s],x [m]\n0,1.5\n0.5,-2\n");
  expect_samples("t [s],x [m]\n0,1.5\n0.5,-2");                       // no last line end
  expect_samples("t [s],x [m]\r\n0,1.5\r\n0.5,-2\r\n");               // of Windows
  expect_samples("\xEF\xBB\xBFt [s],x [m]\n0,1.5\n0.5,-2\n");         // of Excel
  expect_samples("\"t [s]\",\"x [m]\"\n\"0\",\"1.5\"\n0.5,-2\n");     // quoted
  expect_samples("\n t [s] , x [m] \n\n 0 , +1.5 \n0.5,-2e0\n\n\n");  // blanks and blank lines
  expect_samples("x [m],t [s]\n1.5,0\n-2,0.5\n");                     // any order
  expect_samples(",t [s],x [m]\n0,0,1.5\n1,0.5,-2\n");                // an index without a name
  expect_samples("t [ms],x [m]\n0,1.5\n500,-2\n");                    // of another unit
  expect_samples("t [s],mode,x [m]\n0,\"a,\"\"b\",1.5\n0.5,,-2\n");   // text that nobody asks for
}

TEST(TrajectoryReader, KeepsColumnsWithTheirUnitsAndPlaces) {
  const Read read("t [s],wing.1.position [deg],note,\"a, b [m]\"\n");
  ASSERT_EQ(read.reader.columns().size(), 4u);
  EXPECT_EQ(read.reader.columns()[1].name, "wing.1.position");
  EXPECT_EQ(read.reader.columns()[1].unit, "deg");
  EXPECT_EQ(read.reader.columns()[1].place, 7u);
  EXPECT_EQ(read.reader.columns()[2].unit, std::nullopt);
  EXPECT_EQ(read.reader.columns()[3].name, "a, b");
  EXPECT_THAT(read.samples, IsEmpty());
  EXPECT_EQ(read.fault, "");
}

TEST(TrajectoryReader, TellsNumbersThatAreNotFiniteFromThoseThatAreNone) {
  const Read read("t [s],x [m]\n0,nan\n1,-Inf\n2,1e999\n3,1e-999\n4,5e-324\n");
  EXPECT_EQ(read.fault, "");
  ASSERT_EQ(read.samples.size(), 5u);
  EXPECT_TRUE(std::isnan(read.samples[0].second));
  EXPECT_TRUE(std::isinf(read.samples[2].second));
  EXPECT_EQ(read.samples[3].second, 0.0);
  EXPECT_EQ(read.samples[4].second, 5e-324);
  EXPECT_EQ(read.reader.not_finite().count, 3u);
  EXPECT_EQ(read.reader.not_finite().line, 2u);
  EXPECT_EQ(read.reader.not_finite().column, "x");
}

TEST(TrajectoryReader, SaysWhereAHeaderIsWrongAndWhatToWrite) {
  EXPECT_EQ(Read("").fault,
            "a.csv: error: the file is empty\n"
            "  hint: a trajectory is a CSV file with a header, such as `t [s],q_BN.w [1]`\n");
  EXPECT_EQ(Read("time [s],x [m]\n").fault,
            "a.csv:1:1: error: there is no column `t`\n"
            "  hint: name the column of times `t [s]`\n");
  EXPECT_EQ(Read("t [s];x [m]\n").fault,
            "a.csv:1:1: error: there is no column `t`\n"
            "  hint: the first line is the header, and commas separate its columns\n");
  EXPECT_EQ(Read("x [m],t\n").fault, "a.csv:1:7: error: `t` has no unit\n  hint: write `t [s]`\n");
  EXPECT_EQ(Read("t [kg]\n").fault, "a.csv:1:1: error: `kg` is a mass, a time [s] is expected\n");
  EXPECT_EQ(Read("t [s],x [m],y [m],x [km]\n").fault,
            "a.csv:1:19: error: a second column `x`\n"
            "  hint: columns 2 and 4 have one name: rename one\n");
  EXPECT_EQ(Read("t [s],\"x [m]\n").fault, "a.csv:1:7: error: a quote is not closed\n");
  EXPECT_EQ(Read(std::string("PK\x03\x04", 4)).fault,
            "a.csv:1:3: error: the header is no text: byte 0x03\n"
            "  hint: a CSV file is expected, not packed and in UTF-8\n");
}

TEST(TrajectoryReader, SaysWhereASampleIsWrongAndWhy) {
  const std::string head = "t [s],x [m]\n0,1\n";
  EXPECT_EQ(Read(head + "1,2,3\n").fault,
            "a.csv:3:1: error: the line has 3 cells, the header has 2\n");
  EXPECT_EQ(Read(head + "1\n").fault, "a.csv:3:1: error: the line has 1 cell, the header has 2\n");
  EXPECT_EQ(Read(head + "1").fault,
            "a.csv:3:1: error: the line has 1 cell, the header has 2\n"
            "  hint: the file ends within this line: is it cut off?\n");
  EXPECT_EQ(Read(head + "1,12 m\n").fault,
            "a.csv:3:3: error: `12 m` is no number, in the column `x`\n");
  EXPECT_EQ(Read(head + "1,0x10\n").fault,
            "a.csv:3:3: error: `0x10` is no number, in the column `x`\n");
  EXPECT_EQ(Read(head + "1,\x1b[31m\n").fault,
            "a.csv:3:3: error: `\\x1b[31m` is no number, in the column `x`\n");
  EXPECT_EQ(Read(head + "1,\n").fault,
            "a.csv:3:3: error: the cell of `x` is empty\n"
            "  hint: write `nan` for a value that is missing\n");
  EXPECT_EQ(Read(head + "1,\"2\" 3\n").fault, "a.csv:3:3: error: a quote is not closed\n");
  EXPECT_EQ(Read(head + "inf,2\n").fault, "a.csv:3:1: error: the time is not finite\n");
  EXPECT_EQ(Read("x [m],t [s]\n1,3\n1,2\n").fault,
            "a.csv:3:3: error: the time 2 s does not come after 3 s, that of the sample before\n"
            "  hint: sort the samples by time, each time once\n");
  EXPECT_EQ(Read(head + "0,1\n").fault,
            "a.csv:3:1: error: the time 0 s does not come after 0 s, that of the sample before\n"
            "  hint: sort the samples by time, each time once\n");
}

TEST(TrajectoryReader, ReadsLinesThatCrossTheBoundariesOfItsBuffer) {
  std::string text = "t [s],x [m],filler\n";
  const std::string filler(997, 'f');
  constexpr int kSamples = 5000;  // 5 MB, eighty times the buffer
  for (int i = 0; i < kSamples; ++i)
    text += std::to_string(i) + "," + std::to_string(i) + ".25," + filler + "\n";
  const Read read(text);
  EXPECT_EQ(read.fault, "");
  ASSERT_EQ(read.samples.size(), static_cast<std::size_t>(kSamples));
  for (int i = 0; i < kSamples; ++i)
    ASSERT_EQ(read.samples[static_cast<std::size_t>(i)], std::pair(i + 0.0, i + 0.25));
}

TEST(TrajectoryReader, RefusesALineWithoutEnd) {
  EXPECT_EQ(Read("t [s],x [m]\n" + std::string(40u << 20, '1')).fault,
            "a.csv:2:1: error: a line is longer than 16 MiB\n");
}

}  // namespace
}  // namespace twincraft
