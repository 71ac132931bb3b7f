// Claims about specs that extend specs: what is merged how, what is dropped, and which files are
// never read.
#include "compiler/syntax/extends.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "compiler/diag/print.h"
#include "compiler/syntax/load.h"

namespace twincraft {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

class Extends : public testing::Test {
 protected:
  Extends()
      : folder_(fs::canonical(testing::TempDir()) /
                (std::string("extends_") +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "specs");
  }
  ~Extends() override { fs::remove_all(folder_); }

  std::string file(const std::string& name) const { return (folder_ / "specs" / name).string(); }
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories(fs::path(file(name)).parent_path());
    std::ofstream(file(name)) << text;
  }

  /// Writes `text` as specs/root.yaml and resolves it.
  bool resolve(const std::string& text) {
    write("root.yaml", text);
    const Source& source = sources_.add(file("root.yaml"), text);
    std::optional<Node> root = parse(source, diagnostics_);
    if (!root) return false;
    root_ = std::move(*root);
    whole_ = resolve_extends(root_, source, file("root.yaml"), sources_, diagnostics_);
    return whole_.has_value();
  }

  std::string said() const { return to_text(diagnostics_, {}); }

  const Node& at(std::initializer_list<std::string_view> keys) const {
    const Node* node = &root_;
    for (const std::string_view key : keys) node = node->find(key);
    return *node;
  }

  static std::vector<std::string> names(const Node& list) {
    std::vector<std::string> found;
    for (const Node& member : list.items) found.push_back(member.find("name")->scalar);
    return found;
  }

  fs::path folder_;
  Sources sources_;
  Diagnostics diagnostics_;
  Node root_;
  std::optional<Extended> whole_;
};

constexpr const char* kBase = R"(format: spacecraft/1
name: base
hub: {mass: 600 kg, inertia: [1, 2, 3]}
wheels:
  - {name: rw_x, speed: 1, axis: [1, 0, 0]}
  - {name: rw_y, speed: 2}
panels: [{name: wing}]
initial: {orbit: {raan: 1}, rate: [0, 0, 1]}
)";

TEST_F(Extends, MergesMapsByKeyAndNamedMembersByName) {
  write("base.yaml", kBase);
  ASSERT_TRUE(resolve(R"(extends: base.yaml
name: own
hub: {mass: 500 kg}
wheels:
  - {name: rw_z, speed: 3}
  - {name: rw_x, speed: 7}
)")) << said();
  EXPECT_EQ(at({"name"}).scalar, "own");
  EXPECT_EQ(at({"hub", "mass"}).scalar, "500 kg");
  EXPECT_EQ(at({"hub", "inertia"}).items.size(), 3u);
  EXPECT_THAT(names(at({"wheels"})), ElementsAre("rw_x", "rw_y", "rw_z"));
  const Node& rw_x = at({"wheels"}).items[0];
  EXPECT_EQ(rw_x.find("speed")->scalar, "7");
  EXPECT_EQ(rw_x.find("axis")->items.size(), 3u);
  EXPECT_EQ(root_.find("extends"), nullptr);
}

TEST_F(Extends, ReplacesOtherListsAndOtherShapes) {
  write("base.yaml", kBase);
  ASSERT_TRUE(
      resolve("extends: base.yaml\nhub: {inertia: [9]}\npanels: []\ninitial: {orbit: far}\n"));
  EXPECT_EQ(at({"hub", "inertia"}).items.size(), 1u);
  EXPECT_TRUE(at({"panels"}).items.empty());
  EXPECT_TRUE(at({"initial", "orbit"}).is_scalar());
  EXPECT_TRUE(at({"initial", "rate"}).is_list());
}

TEST_F(Extends, TakesAKeyAwayByAWrittenNullButNotByAForgottenValue) {
  write("base.yaml", kBase);
  ASSERT_TRUE(resolve("extends: base.yaml\ninitial: {orbit: null, rate: ~}\nhub:\n"));
  EXPECT_TRUE(at({"initial"}).items.empty());
  EXPECT_TRUE(at({"hub"}).is_null());  // for the reader to complain about
}

TEST_F(Extends, KeepsEveryPlaceInItsOwnFile) {
  write("base.yaml", kBase);
  ASSERT_TRUE(resolve("extends: base.yaml\nhub: {mass: 500 kg}\n"));
  EXPECT_EQ(at({"hub", "mass"}).span.source->name(), file("root.yaml"));
  EXPECT_EQ(at({"hub", "mass"}).span.line, 2);
  EXPECT_EQ(at({"hub", "inertia"}).span.source->name(), file("base.yaml"));
  EXPECT_EQ(at({"hub", "inertia"}).span.line, 3);
}

TEST_F(Extends, DropsInheritedComponentsBeforeItPutsInItsOwn) {
  write("base.yaml", kBase);
  ASSERT_TRUE(
      resolve("extends: base.yaml\ndrop: [rw_x, wing]\nwheels: [{name: rw_x, speed: 5}]\n"));
  EXPECT_THAT(names(at({"wheels"})), ElementsAre("rw_y", "rw_x"));
  EXPECT_EQ(at({"wheels"}).items[1].find("axis"), nullptr);  // the new one, nothing of the old
  EXPECT_TRUE(at({"panels"}).items.empty());
  EXPECT_EQ(root_.find("drop"), nullptr);
}

TEST_F(Extends, SaysWhatWasProbablyToBeDropped) {
  write("base.yaml", kBase);
  EXPECT_FALSE(resolve("extends: base.yaml\ndrop: [rw_u, wing, wing]\n"));
  EXPECT_THAT(said(), HasSubstr("root.yaml:2:8: error[SC1605]"));
  EXPECT_THAT(said(), HasSubstr("did you mean `rw_x`?"));
  EXPECT_THAT(said(), HasSubstr("root.yaml:2:20: error[SC1605]"));
}

TEST_F(Extends, FollowsAChainFromTheFolderOfEachFile) {
  write("below/base.yaml", "extends: deeper/first.yaml\ndrop: [rw_y]\nhub: {mass: 2}\n");
  write("below/deeper/first.yaml", kBase);
  ASSERT_TRUE(resolve("extends: below/base.yaml\nname: own\n")) << said();
  EXPECT_EQ(at({"hub", "mass"}).scalar, "2");
  EXPECT_THAT(names(at({"wheels"})), ElementsAre("rw_x"));
  EXPECT_EQ(whole_->text,
            "extends: below/base.yaml\nname: own\n"
            "extends: deeper/first.yaml\ndrop: [rw_y]\nhub: {mass: 2}\n" +
                std::string(kBase));
}

TEST_F(Extends, ReportsFaultsOfAnExtendedFileThere) {
  write("base.yaml", "hub: [1, 2\n");
  EXPECT_FALSE(resolve("extends: base.yaml\n"));
  EXPECT_THAT(said(), HasSubstr("base.yaml:1:6: error[SC1015]"));
}

TEST_F(Extends, EndsEveryChain) {
  EXPECT_FALSE(resolve("extends: root.yaml\n"));
  EXPECT_THAT(said(), HasSubstr("root.yaml:1:10: error[SC1603]: `root.yaml` is this very file"));
  write("a.yaml", "extends: b.yaml\n");
  write("b.yaml", "extends: ./a.yaml\n");
  EXPECT_FALSE(resolve("extends: a.yaml\n"));
  EXPECT_THAT(said(),
              HasSubstr("b.yaml:1:10: error[SC1603]: `./a.yaml` extends this file in turn"));
}

TEST_F(Extends, AllowsSixteenFilesAndNotOneMore) {
  for (int i = 1; i < 17; ++i) {
    write(fmt::format("{}.yaml", i), fmt::format("extends: {}.yaml\n", i + 1));
  }
  write("17.yaml", "hub: {mass: 1}\n");
  EXPECT_FALSE(resolve("extends: 1.yaml\n"));
  EXPECT_THAT(said(), HasSubstr("16.yaml:1:10: error[SC1603]: a chain of more than 16"));
  EXPECT_TRUE(resolve("extends: 2.yaml\n"));
}

TEST_F(Extends, StaysInTheFolderOfTheCompiledSpec) {
  std::ofstream(folder_ / "outside.yaml") << "hub: {mass: 1}\n";
  fs::create_symlink(folder_ / "outside.yaml", file("link.yaml"));
  fs::create_directory_symlink(folder_, file("up"));
  write("inner/back.yaml", "extends: ../fine.yaml\n");
  write("fine.yaml", "hub: {mass: 1}\n");
  EXPECT_TRUE(resolve("extends: inner/back.yaml\n")) << said();
  for (const char* path : {"../outside.yaml", "../missing.yaml", "inner/../../outside.yaml",
                           "/etc/passwd", "link.yaml", "up/outside.yaml"}) {
    diagnostics_ = {};
    EXPECT_FALSE(resolve(fmt::format("extends: {}\n", path))) << path;
    EXPECT_THAT(said(), HasSubstr("root.yaml:1:10: error[SC1602]")) << path;
  }
}

TEST_F(Extends, MayUseTheTreeOfAMarkedFolder) {
  std::ofstream(folder_ / "outside.yaml") << "hub: {mass: 1}\n";
  std::ofstream(folder_ / kTreeMarker).flush();
  EXPECT_TRUE(resolve("extends: ../outside.yaml\n")) << said();
  EXPECT_FALSE(resolve("extends: ../../outside.yaml\n"));
  EXPECT_THAT(said(), HasSubstr("error[SC1602]"));
  std::ofstream(file(kTreeMarker)).flush();  // a nearer one closes the tree again
  EXPECT_FALSE(resolve("extends: ../outside.yaml\n"));
}

TEST_F(Extends, ReadsRegularFilesOnlyAndNeverWaits) {
  fs::create_directory(file("folder"));
  ASSERT_EQ(::mkfifo(file("pipe").c_str(), 0600), 0);
  fs::create_symlink("loop", file("loop"));
  for (const auto& [path, reason] :
       {std::pair{"folder", "it is a directory"}, std::pair{"pipe", "it is not a regular file"},
        std::pair{"missing.yaml", "no such file or directory"},
        std::pair{"loop", "too many levels of symbolic links"},
        std::pair{"-", "no such file or directory"}}) {
    diagnostics_ = {};
    EXPECT_FALSE(resolve(fmt::format("extends: \"{}\"\n", path))) << path;
    EXPECT_THAT(said(), HasSubstr(fmt::format("root.yaml:1:10: error[SC1601]: cannot read `{}`: {}",
                                              path, reason)));
  }
}

TEST_F(Extends, ReportsAFileItMayNotRead) {
  write("secret.yaml", "hub: {mass: 1}\n");
  fs::permissions(file("secret.yaml"), fs::perms::none);
  // Root may read everything, so root goes on as nobody here, who must get at the folder.
  fs::permissions(file("."), fs::perms::all);
  const uid_t user = ::geteuid();
  ASSERT_EQ(::seteuid(user == 0 ? 65534 : user), 0);
  EXPECT_FALSE(resolve("extends: secret.yaml\n"));
  ASSERT_EQ(::seteuid(user), 0);
  EXPECT_THAT(said(), HasSubstr("cannot read `secret.yaml`: permission denied"));
}

TEST_F(Extends, WantsAPathAndAListOfNames) {
  write("base.yaml", kBase);
  for (const char* text :
       {"extends:\n", "extends: [base.yaml]\n", "extends: ''\n", "drop: [a]\n",
        "extends: base.yaml\ndrop: rw_x\n", "extends: base.yaml\ndrop: [[a]]\n"}) {
    diagnostics_ = {};
    EXPECT_FALSE(resolve(text)) << text;
    EXPECT_EQ(diagnostics_.error_count(), 1u) << text << said();
  }
}

TEST_F(Extends, DoesNotHideAnotherFormat) {
  write("base.yaml", "format: spacecraft/2\n");
  EXPECT_FALSE(resolve("format: spacecraft/1\nextends: base.yaml\n"));
  EXPECT_THAT(said(), HasSubstr("base.yaml:1:9: error[SC3001]"));
}

TEST_F(Extends, IsNotForStandardInput) {
  const Source& source = sources_.add("<stdin>", "extends: base.yaml\n");
  Node root = *parse(source, diagnostics_);
  EXPECT_FALSE(resolve_extends(root, source, "-", sources_, diagnostics_));
  EXPECT_THAT(said(), HasSubstr("<stdin>:1:10: error[SC1604]"));
}

TEST_F(Extends, KeepsNamesThatOneFileRepeats) {
  write("base.yaml", "wheels: [{name: a, speed: 1}]\n");
  ASSERT_TRUE(resolve("extends: base.yaml\nwheels: [{name: a, speed: 2}, {name: a, speed: 3}]\n"));
  EXPECT_THAT(names(at({"wheels"})), ElementsAre("a", "a"));
}

}  // namespace
}  // namespace twincraft
