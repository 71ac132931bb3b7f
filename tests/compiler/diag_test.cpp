// Diagnostics: what is collected, how it is sorted, and how it looks on a terminal and in JSON.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "compiler/diag/print.h"
#include "compiler/diag/terminal.h"
#include "compiler/diag/utf8.h"

namespace twincraft {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

std::string text_of(const Diagnostics& diagnostics) { return to_text(diagnostics, {}); }

/// The excerpt (source line and caret line) of an error at `span`.
std::string excerpt_of(const Span& span) {
  Diagnostics diagnostics;
  diagnostics.error(Code::kYamlSyntax, span, "x");
  const std::string text = text_of(diagnostics);
  const std::size_t begin = text.find('\n') + 1;
  return text.substr(begin, text.find("1 error") - begin);
}

TEST(Source, CountsLinesFromOneAndDropsLineEnds) {
  const Source source("a.yaml", "first\r\nsecond\n\nlast");
  EXPECT_EQ(source.line(1), "first");
  EXPECT_EQ(source.line(2), "second");
  EXPECT_EQ(source.line(3), "");
  EXPECT_EQ(source.line(4), "last");
  EXPECT_EQ(source.line(0), "");
  EXPECT_EQ(source.line(5), "");
}

TEST(Source, FindsThePlaceOfAByte) {
  const Source source("a.yaml", "ab\ncd\n");
  EXPECT_EQ(source.span(0, 2), (Span{&source, 1, 1, 2}));
  EXPECT_EQ(source.span(4, 1), (Span{&source, 2, 2, 1}));
  EXPECT_EQ(source.span(6, 0), (Span{&source, 3, 1, 0}));
}

TEST(Source, DropsAByteOrderMark) {
  const Source source("a.yaml", "\xEF\xBB\xBFname: x");
  EXPECT_EQ(source.line(1), "name: x");
}

TEST(Sources, KeepTheirAddressesWhenMoreAreAdded) {
  Sources sources;
  const Source& first = sources.add("first", "1");
  for (int i = 0; i < 1000; ++i) sources.add("other", "2");
  EXPECT_EQ(first.name(), "first");
}

TEST(Utf8, RefusesOverlongFormsSurrogatesAndCutCharacters) {
  for (const std::string_view text :
       {"\xC0\x80", "\xE0\x80\x80", "\xF0\x80\x80\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80",
        "\xE2\x82", "\x80", "\xFF"}) {
    EXPECT_EQ(decode_utf8(text, 0).length, 0u) << printable(text);
  }
  EXPECT_EQ(decode_utf8("\xE2\x82\xAC", 0).code, U'\u20AC');
  EXPECT_EQ(decode_utf8("\xF0\x9F\x9B\xB0", 0).code, U'\U0001F6F0');
}

TEST(Codes, AreUniqueOrderedAndExplained) {
  std::string last;
  for (const Code code : all_codes()) {
    const std::string name(code_name(code));
    EXPECT_THAT(name, testing::MatchesRegex("SC[1-4][0-9][0-9][0-9]"));
    EXPECT_LT(last, name);
    EXPECT_FALSE(code_title(code).empty()) << name;
    EXPECT_GT(code_explanation(code).size(), 60u) << name;
    last = name;
  }
}

TEST(Diagnostics, AreSortedBySourceOfFirstMentionThenLineThenColumn) {
  Sources sources;
  const Source& late = sources.add("late", "1\n2\n");
  const Source& early = sources.add("early", "1\n");
  Diagnostics diagnostics;
  diagnostics.error(Code::kYamlSyntax, {&late, 2, 1, 1}, "late line 2");
  diagnostics.error(Code::kYamlSyntax, {&early, 1, 1, 1}, "early");
  diagnostics.error(Code::kYamlSyntax, {&late, 1, 5, 1}, "late line 1 column 5");
  diagnostics.warning(Code::kYamlSyntax, {&late, 1, 2, 1}, "late line 1 column 2");
  std::vector<std::string> order;
  for (const Diagnostic& diagnostic : diagnostics.sorted()) order.push_back(diagnostic.message);
  EXPECT_THAT(order, testing::ElementsAre("late line 1 column 2", "late line 1 column 5",
                                          "late line 2", "early"));
}

TEST(Diagnostics, DropExactRepeatsOnly) {
  const Source source("a", "abc");
  Diagnostics diagnostics;
  diagnostics.error(Code::kYamlSyntax, source.span(0, 1), "same");
  diagnostics.error(Code::kYamlSyntax, source.span(0, 1), "other");
  diagnostics.error(Code::kYamlSyntax, source.span(0, 1), "same");
  diagnostics.error(Code::kYamlSyntax, source.span(1, 1), "same");
  EXPECT_EQ(diagnostics.sorted().size(), 3u);
  EXPECT_EQ(diagnostics.error_count(), 4u);
}

TEST(Diagnostics, WarningsAreNoErrors) {
  Diagnostics diagnostics;
  diagnostics.warning(Code::kYamlSyntax, {}, "careful");
  diagnostics.note(Code::kYamlSyntax, {}, "by the way");
  EXPECT_FALSE(diagnostics.has_errors());
}

TEST(ToText, ShowsPlaceLineCaretHintAndNotes) {
  const Source source("models/rw.yaml", "spin: 1\nspin_inertai: 0.08\n");
  Diagnostics diagnostics;
  diagnostics.error(Code::kDuplicateKey, source.span(8, 12), "key `spin_inertai` is odd")
      .with_hint("did you mean `spin_inertia`?")
      .with_note(source.span(0, 4), "first written here");
  diagnostics.warning(Code::kYamlSyntax, {}, "without a place");
  EXPECT_EQ(text_of(diagnostics),
            "models/rw.yaml:2:1: error[SC1012]: key `spin_inertai` is odd\n"
            "    2 | spin_inertai: 0.08\n"
            "      | ^~~~~~~~~~~~\n"
            "  hint: did you mean `spin_inertia`?\n"
            "  note: models/rw.yaml:1:1: first written here\n"
            "warning[SC1001]: without a place\n"
            "1 error, 1 warning\n");
}

TEST(ToText, IsEmptyWithoutDiagnostics) { EXPECT_EQ(text_of(Diagnostics()), ""); }

TEST(ToText, AlignsTheCaretBehindTabsAndWideCharacters) {
  const Source source("a", "\tk\xC3\xA9y: [1]");
  EXPECT_EQ(excerpt_of(source.span(7, 3)),
            "    1 |     k\xC3\xA9y: [1]\n"
            "      |          ^~~\n");
}

TEST(ToText, PutsTheCaretBehindTheLineWhenTheFaultIsThere) {
  const Source source("a", "key:\n");
  EXPECT_EQ(excerpt_of(source.span(4, 0)),
            "    1 | key:\n"
            "      |     ^\n");
}

TEST(ToText, CutsALongLineAroundTheCaret) {
  const std::string text = std::string(5'000'000, 'a') + "X" + std::string(5'000'000, 'b');
  const Source source("a", text);
  const std::string excerpt = excerpt_of(source.span(5'000'000, 1));
  const std::size_t newline = excerpt.find('\n');
  ASSERT_LT(newline, 120u);
  EXPECT_EQ(excerpt.find('X'), excerpt.find('^') - newline - 1);
  EXPECT_THAT(excerpt.substr(0, newline), HasSubstr("| ...aaa"));
  EXPECT_THAT(excerpt.substr(0, newline), EndsWith("bbb..."));
}

TEST(ToText, NeverSendsControlCharactersToTheTerminal) {
  const Source source("ev\x1bil", "na\x1b[31mme\n");
  Diagnostics diagnostics;
  diagnostics.error(Code::kYamlSyntax, source.span(2, 1), "bad \x1b \xFF \xE2\x80\xAE text")
      .with_hint("say \x07");
  const std::string text = text_of(diagnostics);
  for (const char c : text) EXPECT_TRUE(c == '\n' || static_cast<unsigned char>(c) >= 0x20);
  EXPECT_THAT(text, HasSubstr("bad \\x1b \\xff \\u202e text"));
  EXPECT_THAT(text, HasSubstr("na\\x1b[31mme\n      |   ^~~~\n"));
}

TEST(ToText, ColoursOnlyWhenAsked) {
  Diagnostics diagnostics;
  diagnostics.error(Code::kYamlSyntax, {}, "x");
  EXPECT_THAT(text_of(diagnostics), Not(HasSubstr("\x1b[")));
  EXPECT_THAT(to_text(diagnostics, {.colour = true}), HasSubstr("\x1b[1;31merror[SC1001]\x1b[0m"));
}

TEST(ToText, CountsWhatItDoesNotShow) {
  const Source source("a", std::string(60, 'x'));
  Diagnostics diagnostics;
  for (std::size_t i = 0; i < 60; ++i) diagnostics.error(Code::kYamlSyntax, source.span(i, 1), "x");
  const std::string text = text_of(diagnostics);
  EXPECT_THAT(text, HasSubstr("a:1:50:"));
  EXPECT_THAT(text, Not(HasSubstr("a:1:51:")));
  EXPECT_THAT(text, EndsWith("10 further errors not shown\n60 errors\n"));
}

TEST(ToJson, HasTheFieldsOfTheInterface) {
  const Source source("a.yaml", "key: \xFF\n");
  Diagnostics diagnostics;
  diagnostics.error(Code::kDuplicateKey, source.span(0, 3), "broken \xFF byte")
      .with_hint("fix it")
      .with_note(source.span(5, 1), "here");
  diagnostics.note(Code::kYamlSyntax, {}, "nowhere");
  const auto list = nlohmann::json::parse(to_json(diagnostics)).at("diagnostics");
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].at("severity"), "error");
  EXPECT_EQ(list[0].at("code"), "SC1012");
  EXPECT_EQ(list[0].at("file"), "a.yaml");
  EXPECT_EQ(list[0].at("line"), 1);
  EXPECT_EQ(list[0].at("column"), 1);
  EXPECT_EQ(list[0].at("end_column"), 4);
  EXPECT_EQ(list[0].at("message"), "broken \xEF\xBF\xBD byte");
  EXPECT_EQ(list[0].at("hint"), "fix it");
  EXPECT_EQ(list[0].at("notes")[0].at("column"), 6);
  EXPECT_EQ(list[0].at("notes")[0].at("message"), "here");
  EXPECT_EQ(list[1].at("severity"), "note");
  EXPECT_TRUE(list[1].at("line").is_null());
}

TEST(ToJson, IsAnEmptyListWithoutDiagnostics) {
  EXPECT_EQ(nlohmann::json::parse(to_json(Diagnostics())).at("diagnostics"),
            nlohmann::json::array());
}

TEST(ToSarif, DescribesEachRuleOnceAndCountsCharactersNotBytes) {
  const Source source("my specs/a.yaml", "\xC3\xA9: 1, 2\n");
  Diagnostics diagnostics;
  diagnostics.error(Code::kDuplicateKey, source.span(4, 1), "one");
  diagnostics.warning(Code::kDuplicateKey, source.span(7, 1), "two");
  const auto log = nlohmann::json::parse(to_sarif(diagnostics));
  EXPECT_EQ(log.at("version"), "2.1.0");
  const auto& run = log.at("runs")[0];
  EXPECT_EQ(run.at("tool").at("driver").at("rules").size(), 1u);
  ASSERT_EQ(run.at("results").size(), 2u);
  const auto& place = run["results"][0].at("locations")[0].at("physicalLocation");
  EXPECT_EQ(place.at("artifactLocation").at("uri"), "my%20specs/a.yaml");
  EXPECT_EQ(place.at("region").at("startColumn"), 4);
  EXPECT_EQ(run["results"][1].at("level"), "warning");
}

TEST(Nearest, FindsSlipsOfTheFinger) {
  const std::vector<std::string> keys{"spin_inertia", "transverse_inertia", "mass", "mount"};
  EXPECT_EQ(nearest("spin_inertai", keys), "spin_inertia");
  EXPECT_EQ(nearest("mss", keys), "mass");
  EXPECT_EQ(nearest("MASS", keys), "mass");
  EXPECT_EQ(nearest("mounts", keys), "mount");
}

TEST(Nearest, FindsNothingWhenNothingIsNear) {
  EXPECT_EQ(nearest("colour", {"mass", "mount"}), "");
  EXPECT_EQ(nearest("x", {"y"}), "");
  EXPECT_EQ(nearest("mass", {}), "");
  EXPECT_EQ(nearest(std::string(1'000'000, 'x'), {"mass"}), "");
}

TEST(Nearest, PrefersTheNearerAndThenTheFirst) {
  EXPECT_EQ(nearest("rw_z", {"rw_x", "rw_y"}), "rw_x");
  EXPECT_EQ(nearest("wing_m", {"wing_pp", "wing_n", "wing_mm"}), "wing_n");
}

TEST(InBackticks, CutsLongTextBetweenCharacters) {
  EXPECT_EQ(in_backticks("short"), "`short`");
  std::string text;
  for (int i = 0; i < 100; ++i) text += "\xE2\x82\xAC";
  const std::string shown = in_backticks(text);
  EXPECT_LT(shown.size(), 70u);
  EXPECT_EQ(printable(shown), shown);
}

TEST(InBackticks, ShowsWhatWouldDriveATerminal) {
  EXPECT_EQ(in_backticks("a\x1b[31mb\xc2\x9b\x9b"), "`a\\x1b[31mb\\u009b\\x9b`");
}

TEST(ForTerminal, LeavesLinesAndEscapesTheRest) {
  EXPECT_EQ(for_terminal("one\n\ttwo \xE2\x82\xAC\n", false), "one\n\ttwo \xE2\x82\xAC\n");
  EXPECT_EQ(for_terminal("a\r\x1b[31mb\x7f\xc2\x9b\xe2\x80\xae\x9b", false),
            "a\\r\\x1b[31mb\\x7f\\u009b\\u202e\\x9b");
  EXPECT_EQ(for_terminal(std::string("a\0b", 3), true), "a\\x00b");
}

TEST(ForTerminal, LetsColoursPassAndNoOtherSequence) {
  EXPECT_EQ(for_terminal("\x1b[1;31merror\x1b[0m", true), "\x1b[1;31merror\x1b[0m");
  EXPECT_EQ(for_terminal("\x1b[38;2;255;255;255mx", true), "\x1b[38;2;255;255;255mx");
  for (const std::string text : {"\x1b[2J", "\x1b[", "\x1b[31", "\x1b]0;x\x07", "\x1bm", "\x1b"})
    EXPECT_EQ(for_terminal(text, true), printable(text)) << printable(text);
  EXPECT_EQ(for_terminal("\x1b[" + std::string(100, '1') + "m", true).substr(0, 4), "\\x1b");
}

TEST(JsonForTerminal, KeepsTheMeaningOfTheDocument) {
  const nlohmann::json document = {{"a\x1b\xc2\x9b", "\x7f\xe2\x80\xae \xE2\x82\xAC\n\r"}};
  const std::string safe = json_for_terminal(document.dump(2));
  EXPECT_EQ(for_terminal(safe, false), safe);
  EXPECT_EQ(nlohmann::json::parse(safe), document);
}

}  // namespace
}  // namespace twincraft
