// Claims about what is made of samples while they come: the same as of all of them at the end.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "runtime/compare/pairing.h"
#include "runtime/reference/running.h"
#include "runtime/report/json.h"
#include "tests/runtime/handmade.h"

namespace twincraft {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// What a pairing delivered, by time.
struct Pairs {
  std::vector<double> times;
  Pairing pairing{[this](const Observation& a, const Observation& b) {
    EXPECT_EQ(a.time, b.time);
    times.push_back(a.time);
  }};
  Model model = test::model_of_every_kind();

  void add(std::size_t engine, std::initializer_list<double> at) {
    for (const double time : at) pairing.add(engine, test::sample_at(time, model));
  }
};

TEST(Pairing, DeliversEachPairOnceWhoeverIsAhead) {
  Pairs both;
  both.add(0, {0.0, 1.0, 2.0});
  EXPECT_THAT(both.times, IsEmpty());
  both.add(1, {0.0, 1.0, 2.0, 3.0});
  EXPECT_THAT(both.times, ElementsAre(0.0, 1.0, 2.0));
  both.add(0, {3.0});
  EXPECT_THAT(both.times, ElementsAre(0.0, 1.0, 2.0, 3.0));
  EXPECT_TRUE(both.pairing.same_times());
}

TEST(Pairing, EndsWhereTimesDiffer) {
  Pairs both;
  both.add(0, {0.0, 1.0, 2.0});
  both.add(1, {0.0, 1.5, 2.0});
  EXPECT_THAT(both.times, ElementsAre(0.0));
  EXPECT_FALSE(both.pairing.same_times());
}

TEST(Pairing, KeepsNothingForAnEngineThatHasEnded) {
  Pairs both;
  both.add(0, {0.0, 1.0});
  both.add(1, {0.0});
  both.pairing.end(1);
  both.add(0, {2.0, 3.0});
  both.pairing.end(0);
  EXPECT_THAT(both.times, ElementsAre(0.0));
  EXPECT_FALSE(both.pairing.same_times());
}

TEST(Pairing, WaitsForAnEngineThatEndedAhead) {
  Pairs both;
  both.add(0, {0.0, 1.0});
  both.pairing.end(0);
  both.add(1, {0.0, 1.0});
  both.pairing.end(1);
  EXPECT_THAT(both.times, ElementsAre(0.0, 1.0));
  EXPECT_TRUE(both.pairing.same_times());
}

TEST(RunningDeviations, AreThoseOfAllSamplesAtOnce) {
  Model model = test::model_of_every_kind();
  model.gravity.mu = 3.986e14;
  std::vector<Observation> samples;
  for (int i = 0; i < 2000; ++i) {
    Observation sample = test::sample_at(i, model);
    sample.r_CN_N = Vector3d(7.0e6, 7.5e3 * i, 0.0);  // straight on, which is no orbit
    sample.v_CN_N = Vector3d(0.0, 7.5e3, std::sin(0.01 * i));
    samples.push_back(sample);
  }
  RunningDeviations running(ReferenceKind::kKepler, model);
  for (const Observation& sample : samples) running.take(sample);
  const std::vector<Deviation> at_once = deviations(ReferenceKind::kKepler, model, samples);
  const std::vector<Deviation> found = running.result();
  ASSERT_EQ(found.size(), at_once.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].metric, at_once[i].metric);
    EXPECT_EQ(found[i].max, at_once[i].max);
    EXPECT_EQ(found[i].at, at_once[i].at);
    EXPECT_GT(found[i].max, 0.0);
  }
}

TEST(RunningDeviations, OfASingleSampleAndOfNone) {
  Model model = test::model_of_every_kind();
  RunningDeviations none(ReferenceKind::kSpinUp, model);
  EXPECT_THAT(none.result(), IsEmpty());
  model.assembly.links[0].elements = {
      {.name = "hub", .mass = 1.0, .I_PntE_L = Matrix3d::Identity()}};
  RunningDeviations one(ReferenceKind::kSpinUp, model);
  one.take(test::sample_at(0.0, model));
  EXPECT_EQ(one.result().size(), 2U);
}

TEST(ReportMembers, StandInTheFileAsInTheDocument) {
  Report report{provenance(), {}};
  for (int i = 0; i < 3; ++i) {
    ReportedMember member;
    member.bundle.model = test::model_of_every_kind();
    member.bundle.model.name = "a\n  \"members\": []";  // as a hostile spec would
    member.bundle.resolved_json = R"({"text": "line\nbreak", "list": []})";
    member.result = refused_member("why\nnot");
    report.members.push_back(std::move(member));
  }
  const ReportFrame frame = report_frame(report);
  std::string text = frame.before;
  for (const ReportedMember& member : report.members)
    text += report_member(member, &member == &report.members.front());
  text += frame.after;
  EXPECT_EQ(text, report_value(report).dump(2) + "\n");
}

}  // namespace
}  // namespace twincraft
