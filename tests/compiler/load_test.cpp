// The loader: what it accepts, where it puts things, and that every trap of YAML and of yaml-cpp
// ends in a diagnostic at the right place, in bounded time and memory.
#include "compiler/syntax/load.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>

#include "compiler/diag/print.h"

namespace twincraft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct Loaded {
  Sources sources;
  Diagnostics diagnostics;
  std::optional<Node> root;

  /// `SC1012 3:5` for each fault.
  std::vector<std::string> faults() const {
    std::vector<std::string> result;
    for (const Diagnostic& d : diagnostics.sorted()) {
      result.push_back(fmt::format("{} {}:{}", code_name(d.code), d.span.line, d.span.column));
    }
    return result;
  }
};

std::unique_ptr<Loaded> load(std::string text) {
  auto loaded = std::make_unique<Loaded>();
  loaded->root = parse(loaded->sources.add("t.yaml", std::move(text)), loaded->diagnostics);
  EXPECT_EQ(loaded->root.has_value(), !loaded->diagnostics.has_errors());
  return loaded;
}

std::vector<std::string> faults_of(std::string text) { return load(std::move(text))->faults(); }

std::string repeated(std::string_view part, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += part;
  return text;
}

#ifdef TWINCRAFT_SANITIZED
constexpr int kAllowance = 10;  // a sanitizer's own time and memory
#else
constexpr int kAllowance = 1;
#endif

double processor_seconds(const rusage& usage) {
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// Of processor time [s]. Loading takes some tenths of one, or all of one where other programs use
// the caches; what grows much faster than its text takes longer than this.
constexpr double kHang = 10.0;

/// Fails when loading takes as long as what hangs, or the process grows by 100 MB.
std::unique_ptr<Loaded> load_bounded(std::string text) {
  rusage before{};
  getrusage(RUSAGE_SELF, &before);
  auto loaded = load(std::move(text));
  rusage after{};
  getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(processor_seconds(after) - processor_seconds(before), kHang * kAllowance);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 100 * 1024 * kAllowance);  // KiB
  return loaded;
}

std::string place(const Span& span) {
  return fmt::format("{}:{}+{}", span.line, span.column, span.length);
}

TEST(Parse, KeepsKeysInOrderWithTheirPlaces) {
  const auto loaded = load("name: brick\nhub:\n  mass: 600 kg\n  \"inertia\": [1, 2]\n");
  ASSERT_TRUE(loaded->root);
  const Node& root = *loaded->root;
  ASSERT_EQ(root.keys.size(), 2u);
  EXPECT_EQ(place(root.keys[1].span), "2:1+3");
  const Node* hub = root.find("hub");
  ASSERT_TRUE(hub != nullptr && hub->is_map());
  EXPECT_EQ(place(hub->span), "3:3+1");
  EXPECT_EQ(hub->find("mass")->scalar, "600 kg");
  EXPECT_EQ(place(hub->find("mass")->span), "3:9+6");
  EXPECT_EQ(place(hub->keys[1].span), "4:3+9");
  EXPECT_EQ(place(hub->find("inertia")->items[1].span), "4:18+1");
  EXPECT_EQ(root.find("wheels"), nullptr);
}

TEST(Parse, KeepsScalarsAsTextAndKnowsWhichWereQuoted) {
  const auto loaded = load("a: 010\nb: \"5\"\nc: yes\nd: 'it''s'\ne: .nan\n");
  ASSERT_TRUE(loaded->root);
  const Node& root = *loaded->root;
  EXPECT_EQ(root.find("a")->scalar, "010");
  EXPECT_FALSE(root.find("a")->quoted);
  EXPECT_EQ(root.find("b")->scalar, "5");
  EXPECT_TRUE(root.find("b")->quoted);
  EXPECT_EQ(place(root.find("b")->span), "2:4+3");
  EXPECT_EQ(root.find("c")->scalar, "yes");
  EXPECT_EQ(root.find("d")->scalar, "it's");
  EXPECT_EQ(place(root.find("d")->span), "4:4+7");
  EXPECT_EQ(root.find("e")->scalar, ".nan");
}

TEST(Parse, PutsAnEmptyValueAtItsColon) {
  const auto loaded = load("a:\n\n# nothing\nb: ~\nc: null\nd: [~, 1]\n");
  ASSERT_TRUE(loaded->root);
  EXPECT_TRUE(loaded->root->find("a")->is_null());
  EXPECT_EQ(place(loaded->root->find("a")->span), "1:2+1");
  EXPECT_EQ(place(loaded->root->find("b")->span), "4:4+1");
  EXPECT_EQ(place(loaded->root->find("c")->span), "5:4+4");
  EXPECT_EQ(place(loaded->root->find("d")->items[0].span), "6:5+1");
}

TEST(Parse, ReadsTextOverSeveralLines) {
  const auto loaded = load("a: |\n  one\n  two\nb: one\n  two\nc: \"one\n  two\"\nd: x\n");
  ASSERT_TRUE(loaded->root);
  EXPECT_EQ(loaded->root->find("a")->scalar, "one\ntwo\n");
  EXPECT_EQ(loaded->root->find("b")->scalar, "one two");
  EXPECT_EQ(loaded->root->find("c")->scalar, "one two");
  EXPECT_EQ(place(loaded->root->find("d")->span), "8:4+1");
}

TEST(Parse, AcceptsByteOrderMarkCrLfAndAMissingFinalNewline) {
  const auto loaded = load(
      "\xEF\xBB\xBF"
      "a: 1\r\nb:\r\n  c: 2");
  ASSERT_TRUE(loaded->root);
  EXPECT_EQ(loaded->root->find("a")->scalar, "1");
  EXPECT_EQ(place(loaded->root->keys[0].span), "1:1+1");
  EXPECT_EQ(place(loaded->root->find("b")->find("c")->span), "3:6+1");
}

TEST(Parse, AcceptsDocumentMarkersAroundOneDocument) {
  EXPECT_TRUE(load("# head\n---\na: 1\n...\n# tail\n")->root);
}

TEST(Parse, CountsColumnsInBytes) {
  const auto loaded = load("{\xC3\xA9: 1, b: 2}");
  ASSERT_TRUE(loaded->root);
  EXPECT_EQ(place(loaded->root->keys[1].span), "1:9+1");
}

TEST(Parse, RefusesAnEmptySpec) {
  for (const char* text : {"", "\n\n", "# only\n# comments\n", "---\n", "...\n", "~", "null\n"}) {
    EXPECT_THAT(faults_of(text), ElementsAre("SC1004 1:1")) << text;
  }
}

TEST(Parse, RefusesARootThatIsNoMap) {
  EXPECT_THAT(faults_of("- a\n- b\n"), ElementsAre("SC1006 1:1"));
  EXPECT_THAT(faults_of("\n42\n"), ElementsAre("SC1006 2:1"));
  const auto loaded = load("name:brick\n");
  ASSERT_THAT(loaded->faults(), ElementsAre("SC1006 1:1"));
  EXPECT_THAT(loaded->diagnostics.all()[0].hint, HasSubstr("blank after the colon"));
}

TEST(Parse, RefusesEveryDuplicateKeyAtTheSecondWithANoteAtTheFirst) {
  const auto loaded = load("a: 1\nhub: {m: 1, m: 2}\na: 3\n");
  ASSERT_THAT(loaded->faults(), ElementsAre("SC1012 2:13", "SC1012 3:1"));
  const Diagnostic fault = loaded->diagnostics.sorted()[1];
  ASSERT_EQ(fault.notes.size(), 1u);
  EXPECT_EQ(place(fault.notes[0].span), "1:1+1");
}

TEST(Parse, SeesDuplicateKeysThroughQuotes) {
  EXPECT_THAT(faults_of("a: 1\n\"a\": 2\n'a': 3\n"), ElementsAre("SC1012 2:1", "SC1012 3:1"));
}

TEST(Parse, RefusesAnchorsAndAliases) {
  EXPECT_THAT(faults_of("a: &x 5\nb: *x\n"), ElementsAre("SC1009 1:4", "SC1009 2:4"));
  EXPECT_THAT(faults_of("a: &x [*x]\n"), ElementsAre("SC1009 1:4", "SC1009 1:8"));
  EXPECT_THAT(faults_of("a: *nowhere\n"), ElementsAre("SC1009 1:4"));
  EXPECT_THAT(faults_of("&k a: 5\n"), ElementsAre("SC1009 1:1"));
  EXPECT_THAT(faults_of("a: & b\n"), ElementsAre("SC1009 1:5"));
}

TEST(Parse, RefusesTags) {
  for (const char* value : {"!!str 5", "!mine 5", "!<x> 5", "! 5", "!!map {b: 1}", "!!seq [1]"}) {
    EXPECT_THAT(faults_of(fmt::format("a: {}\n", value)), ElementsAre("SC1010 1:4")) << value;
  }
}

TEST(Parse, RefusesMergeKeys) {
  EXPECT_THAT(faults_of("a:\n  <<: {b: 1}\n"), ElementsAre("SC1011 2:3"));
  EXPECT_THAT(faults_of("\"<<\": {b: 1}\n"), ElementsAre("SC1011 1:1"));
}

TEST(Parse, RefusesKeysThatAreNoWords) {
  EXPECT_THAT(faults_of("{a: 1}: 2\n"), ElementsAre("SC1013 1:1"));
  EXPECT_THAT(faults_of("? [a]\n: b\n"), ElementsAre("SC1013 1:3"));
  EXPECT_THAT(faults_of("\"\": x\n"), ElementsAre("SC1013 1:1"));
  EXPECT_THAT(faults_of(": x\n"), ElementsAre("SC1013 1:1"));
  EXPECT_THAT(faults_of("~: x\n"), ElementsAre("SC1013 1:1"));
  EXPECT_THAT(faults_of("? a\n: b\n"), ElementsAre("SC1017 1:3"));
}

TEST(Parse, RefusesKeysWithoutAColonWhichYamlCppTakesForNull) {
  EXPECT_THAT(faults_of("a: 1\nb\n"), ElementsAre("SC1017 2:1"));
  EXPECT_THAT(faults_of("a:\n- 1\nb\n"), ElementsAre("SC1017 3:1"));
  EXPECT_THAT(faults_of("{a, b: 1}"), ElementsAre("SC1017 1:2"));
  const auto loaded = load("hub: {mass:600, inertia: 1}\n");
  ASSERT_THAT(loaded->faults(), ElementsAre("SC1017 1:7"));
  EXPECT_THAT(loaded->diagnostics.all()[0].hint, HasSubstr("`mass: 600`"));
}

TEST(Parse, RefusesEmptyPlacesBetweenCommas) {
  EXPECT_THAT(faults_of("a: [1,,2]\n"), ElementsAre("SC1019 1:7"));
  EXPECT_THAT(faults_of("a: [,1]\n"), ElementsAre("SC1019 1:5"));
  EXPECT_THAT(faults_of("a: {,}\n"), ElementsAre("SC1019 1:5"));
  EXPECT_TRUE(load("a: [1, 2,]\nb: {c: 1,}\n")->root);
}

TEST(Parse, RefusesASecondDocument) {
  EXPECT_THAT(faults_of("a: 1\n---\nb: 2\n"), ElementsAre("SC1005 2:1"));
  EXPECT_THAT(faults_of("a: 1\n---\n"), ElementsAre("SC1005 2:1"));
  EXPECT_THAT(faults_of("a: 1\n...\nb: 2\n"), ElementsAre("SC1005 3:1"));
}

TEST(Parse, RefusesTextAfterTheEndOfTheRoot) {
  EXPECT_THAT(faults_of("{a: 1} b\n"), ElementsAre("SC1001 1:8"));
  EXPECT_THAT(faults_of("- a\nb: 1\n"), ElementsAre("SC1001 2:1"));
}

TEST(Parse, SurvivesTheLoneCommaOnWhichYamlCppNeverEnds) {
  EXPECT_THAT(faults_of(","), ElementsAre("SC1001 1:1"));
  EXPECT_THAT(faults_of("---\n,\n"), ElementsAre("SC1001 2:1"));
  EXPECT_THAT(faults_of("- a\n,\n"), ElementsAre("SC1001 2:1"));
  EXPECT_THAT(faults_of("a: 1\n,\n"), ElementsAre("SC1001 2:1"));
  EXPECT_THAT(faults_of("[a]\n,\n"), ElementsAre("SC1001 2:1"));
}

TEST(Parse, RefusesDirectives) {
  EXPECT_THAT(faults_of("%YAML 1.2\n---\na: 1\n"), ElementsAre("SC1018 1:1"));
  EXPECT_THAT(faults_of("# x\n%FOO\n---\na: 1\n"), ElementsAre("SC1018 2:1"));
  EXPECT_THAT(faults_of("%YAML 3.0\n---\na: 1\n"), ElementsAre("SC1018 1:1"));
}

TEST(Parse, FindsTheQuoteThatIsNeverClosed) {
  EXPECT_THAT(faults_of("a: 1\nb: \"x\nc: 2\n"), ElementsAre("SC1014 2:4"));
  EXPECT_THAT(faults_of("a: 'b'  # don't\nb: 'x\nc: 2"), ElementsAre("SC1014 2:4"));
  EXPECT_THAT(faults_of("b: 'x\n\n\n"), ElementsAre("SC1014 1:4"));
  EXPECT_THAT(faults_of("a: [1, \"b]\n"), ElementsAre("SC1014 1:8"));
  EXPECT_THAT(faults_of("a: 1\n\"b\n"), ElementsAre("SC1014 2:1"));
  EXPECT_THAT(faults_of("a: \"x\\\""), ElementsAre("SC1014 1:4"));
  EXPECT_THAT(faults_of("a: \"x\n---\nb: 1\n"), ElementsAre("SC1014 1:4"));
  EXPECT_THAT(faults_of("a: |\n  it's \"\nb: 'x"), ElementsAre("SC1014 3:4"));
}

TEST(Parse, FindsTheBracketThatIsNotClosed) {
  EXPECT_THAT(faults_of("a: [1, 2\n"), ElementsAre("SC1015 1:4"));
  EXPECT_THAT(faults_of("a: [1, 2 # two\n"), ElementsAre("SC1015 1:4"));
  EXPECT_THAT(faults_of("a: {b: 1\nc: 2\n"), ElementsAre("SC1015 1:4"));
  EXPECT_THAT(faults_of("a: [[1, 2], [3\nb: 4\n"), ElementsAre("SC1015 1:13"));
  EXPECT_THAT(faults_of("a: {b: [1, 2}\n"), ElementsAre("SC1015 1:13"));
  EXPECT_THAT(faults_of("a: [1, 2]]\n"), ElementsAre("SC1001 1:10"));
  EXPECT_THAT(faults_of("a: 1\n}\n"), ElementsAre("SC1001 2:1"));
}

TEST(Parse, BlamesTabsInTheIndentation) {
  EXPECT_THAT(faults_of("a:\n\tb: 1\n"), ElementsAre("SC1016 2:1"));
  EXPECT_THAT(faults_of("a:\n  b: 1\n \tc: 2\n"), ElementsAre("SC1016 3:2"));
  EXPECT_THAT(faults_of("a:\n\t- b\n"), ElementsAre("SC1016 2:1"));
  EXPECT_THAT(faults_of("\tb: 1\n"), ElementsAre("SC1016 1:1"));
  EXPECT_TRUE(load("a: [\n\t1,\n\t2]\nb:\t3\n")->root) << "tabs are fine between tokens";
}

TEST(Parse, RewordsSyntaxFaultsWithTheirPlace) {
  EXPECT_THAT(faults_of("a: b: c\n"), ElementsAre("SC1001 1:5"));
  EXPECT_THAT(faults_of("a:\n  b: 1\n c: 2\n"), ElementsAre("SC1001 3:2"));
  EXPECT_THAT(faults_of("a: - b\n"), ElementsAre("SC1001 1:4"));
  EXPECT_THAT(faults_of("a: @x\n"), ElementsAre("SC1001 1:4"));
  EXPECT_THAT(faults_of("a: 'x' y\n"), ElementsAre("SC1001 1:8"));
  EXPECT_THAT(faults_of("a: |x\n  b\n"), ElementsAre("SC1001 1:5"));
  EXPECT_THAT(faults_of("a:\n - \"x\\q\"\n"), ElementsAre("SC1001 2:6"));
  EXPECT_THAT(faults_of("a: \"\\x\"\n"), ElementsAre("SC1001 1:5"));
  EXPECT_THAT(faults_of("a: \"\\uD800\"\n"), ElementsAre("SC1001 1:5"));
  for (const char* text : {"a: b: c\n", "a: @x\n", "a: \"\\q\"\n", "a: [1}\n"}) {
    const auto loaded = load(text);
    EXPECT_THAT(to_text(loaded->diagnostics, {}), testing::Not(HasSubstr("illegal"))) << text;
  }
}

TEST(Parse, CollectsFaultsThatDoNotStopTheParser) {
  EXPECT_THAT(faults_of("a: 1\na: 2\nb: !!int 3\nc: [1,,2]\n? d\n<<: 1\n"),
              ElementsAre("SC1012 2:1", "SC1010 3:4", "SC1019 4:7", "SC1017 5:3", "SC1011 6:1"));
}

TEST(Parse, RefusesNulAndOtherControlCharacters) {
  EXPECT_THAT(faults_of(std::string("a: 1\nb\0: 2\n", 11)), ElementsAre("SC1003 2:2"));
  EXPECT_THAT(faults_of("a: \x1b[31m\n"), ElementsAre("SC1003 1:4"));
  EXPECT_THAT(faults_of("a: \x04\nb: 1\n"), ElementsAre("SC1003 1:4"));
  EXPECT_THAT(faults_of("a: \xC2\x9B"
                        "31m\n"),
              ElementsAre("SC1003 1:4"));
  EXPECT_THAT(faults_of("a: 1\rb: 2\r"), ElementsAre("SC1003 1:5"));
  EXPECT_THAT(faults_of("a: \"x\\0y\"\n"), ElementsAre("SC1003 1:4"));
  EXPECT_THAT(faults_of("a: \"\\x1b[31m\"\n"), ElementsAre("SC1003 1:4"));
}

TEST(Parse, RefusesTextThatIsNotUtf8AtTheFirstBadByte) {
  EXPECT_THAT(faults_of("a: 1\nb: caf\xE9\n"), ElementsAre("SC1002 2:7"));
  EXPECT_THAT(faults_of("a: \xC0\x80\n"), ElementsAre("SC1002 1:4"));
  EXPECT_THAT(faults_of("a: \xED\xA0\x80\n"), ElementsAre("SC1002 1:4"));
}

TEST(Parse, NamesUtf16) {
  for (const std::string& text :
       {std::string("\xFF\xFE"
                    "a\0:\0",
                    6),
        std::string("a\0:\0 \0", 6), std::string("\0a\0:", 4), std::string("\xFE\xFF\0a", 4)}) {
    const auto loaded = load(text);
    ASSERT_THAT(loaded->faults(), ElementsAre("SC1002 1:1"));
    EXPECT_THAT(loaded->diagnostics.all()[0].message, HasSubstr("UTF-16"));
  }
}

TEST(Parse, AllowsExactlyTheMaximumDepth) {
  const auto nested = [](int depth) {
    return "a: " + std::string(static_cast<std::size_t>(depth - 1), '[') +
           std::string(static_cast<std::size_t>(depth - 1), ']');
  };
  EXPECT_TRUE(load(nested(kMaximumDepth))->root);
  EXPECT_THAT(faults_of(nested(kMaximumDepth + 1)), ElementsAre("SC1007 1:67"));
}

TEST(Parse, RefusesDeepNestingInBoundedTimeAndMemory) {
  for (const char* part :
       {"[", "{", "[1,", "{a: ", "- ", "[\n", "a: [\n", "{\"a\": [", "? ", ": "}) {
    for (const int times : {600, 9'000, 100'000}) {
      const auto loaded = load_bounded(repeated(part, times));
      EXPECT_FALSE(loaded->root) << part;
    }
  }
  EXPECT_THAT(load_bounded("a: " + repeated("[", 100'000))->diagnostics.all()[0].code,
              Code::kTooDeep);
}

TEST(Parse, RefusesAliasBombsInBoundedTimeAndMemory) {
  std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 20; ++i) {
    bomb += fmt::format("a{0}: &a{0} [{1}*a{2}]\n", i, repeated(fmt::format("*a{}, ", i - 1), 8),
                        i - 1);
  }
  const auto loaded = load_bounded(bomb);
  ASSERT_FALSE(loaded->root);
  EXPECT_EQ(loaded->diagnostics.all()[0].code, Code::kAnchor);
  EXPECT_LE(loaded->diagnostics.error_count(), 100u) << "faults are capped";
}

TEST(Parse, ReadsAHundredThousandKeysInBoundedTimeAndMemory) {
  std::string text;
  for (int i = 0; i < 100'000; ++i) text += fmt::format("key_{}: {}\n", i, i);
  const auto loaded = load_bounded(text);
  ASSERT_TRUE(loaded->root);
  EXPECT_EQ(loaded->root->keys.size(), 100'000u);
}

TEST(Parse, ReadsALongListOnOneLineInBoundedTimeAndMemory) {
  const auto loaded = load_bounded("a: [" + repeated("[1, 2],", 50'000) + "]");
  ASSERT_TRUE(loaded->root);
  EXPECT_EQ(loaded->root->find("a")->items.size(), 50'000u);
}

TEST(Parse, RefusesMoreStructureThanASpecCanHave) {
  EXPECT_EQ(load("a: [" + repeated("[],", 400'000))->diagnostics.all()[0].code, Code::kTooLarge);
  EXPECT_EQ(load(repeated("- x\n", 1'000'002))->diagnostics.all()[0].code, Code::kTooLarge);
  EXPECT_EQ(load("a: " + std::string(kMaximumFileBytes, 'x'))->diagnostics.all()[0].code,
            Code::kTooLarge);
}

TEST(ParseValue, TakesAnyNode) {
  Sources sources;
  Diagnostics diagnostics;
  const auto value = [&](std::string text) {
    const auto node = parse_value(sources.add("v", std::move(text)), diagnostics);
    EXPECT_TRUE(node);
    return node.value_or(Node{});
  };
  EXPECT_EQ(value("40 s").scalar, "40 s");
  EXPECT_EQ(value("[1,2,3]").items.size(), 3u);
  EXPECT_TRUE(value("{mrp: [0,0,0]}").find("mrp")->is_list());
  for (const char* text : {"", "  ", "~", "null"}) EXPECT_TRUE(value(text).is_null()) << text;
  EXPECT_FALSE(diagnostics.has_errors());
}

TEST(ParseValue, StartsWhereItIsTold) {
  Sources sources;
  Diagnostics diagnostics;
  const Source& source = sources.add("--set a.b", "a.b=[1, 2]");
  const auto node = parse_value(source, diagnostics, 4);
  ASSERT_TRUE(node);
  EXPECT_EQ(place(node->items[1].span), "1:9+1");
}

TEST(ParseValue, RefusesWhatIsOnlyAComment) {
  Sources sources;
  Diagnostics diagnostics;
  EXPECT_FALSE(parse_value(sources.add("v", "#1"), diagnostics));
  EXPECT_TRUE(diagnostics.has_errors());
}

class ReadFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              fmt::format("twincraft_read_{}", static_cast<long>(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const char* name) const { return (folder_ / name).string(); }

  std::filesystem::path folder_;
};

TEST_F(ReadFile, ReadsTheBytesAsTheyAre) {
  const std::string bytes("a\0\r\n\xFF", 5);
  std::ofstream(path("a.yaml"), std::ios::binary) << bytes;
  const FileText file = read_file(path("a.yaml"));
  EXPECT_EQ(file.error, "");
  EXPECT_EQ(file.text, bytes);
}

TEST_F(ReadFile, SaysWhyAFileCannotBeRead) {
  EXPECT_THAT(read_file(path("none.yaml")).error, HasSubstr("no such file"));
  EXPECT_THAT(read_file(folder_.string()).error, HasSubstr("directory"));
  EXPECT_THAT(read_file("").error, HasSubstr("no such file"));
}

TEST_F(ReadFile, NeverBlocksOnAFifo) {
  ASSERT_EQ(::mkfifo(path("fifo").c_str(), 0600), 0);
  EXPECT_THAT(read_file(path("fifo")).error, HasSubstr("not a regular file"));
}

TEST_F(ReadFile, NeverReadsADevice) {
  EXPECT_THAT(read_file("/dev/zero").error, HasSubstr("not a regular file"));
  EXPECT_THAT(read_file("/dev/null").error, HasSubstr("not a regular file"));
}

TEST_F(ReadFile, RefusesALargeFileWithoutReadingIt) {
  std::ofstream(path("large.yaml")) << "a: 1\n";
  std::filesystem::resize_file(path("large.yaml"), std::uintmax_t{1} << 40);  // sparse
  EXPECT_THAT(read_file(path("large.yaml")).error, HasSubstr("larger than 4 MiB"));
  std::filesystem::resize_file(path("large.yaml"), kMaximumFileBytes);
  EXPECT_EQ(read_file(path("large.yaml")).error, "");
}

TEST_F(ReadFile, StopsReadingEndlessStandardInput) {
  const int saved = ::dup(STDIN_FILENO);
  const int endless = ::open("/dev/zero", O_RDONLY);
  ASSERT_GE(endless, 0);
  ASSERT_GE(::dup2(endless, STDIN_FILENO), 0);
  EXPECT_THAT(read_file("-").error, HasSubstr("larger than 4 MiB"));
  ::dup2(saved, STDIN_FILENO);
  ::close(endless);
  ::close(saved);
}

}  // namespace
}  // namespace twincraft
