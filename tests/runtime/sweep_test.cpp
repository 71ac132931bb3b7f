// Claims about what a study makes of its members: their order, exponents, and the cost of accuracy.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <future>
#include <stdexcept>

#include "runtime/report/study_table.h"
#include "runtime/study/in_order.h"
#include "tests/runtime/handmade.h"

namespace twincraft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

TEST(InOrder, DeliversByIndexWhateverTheNumberOfThreads) {
  for (const int jobs : {1, 4}) {
    std::vector<std::size_t> delivered;
    std::vector<std::promise<void>> done(40);
    const auto work = [&done, jobs](std::size_t index) {
      // The first of every four ends after the second, so that results come out of order.
      if (jobs > 1 && index % 4 == 0) done[index + 1].get_future().wait();
      done[index].set_value();
      return index * index;
    };
    in_order<std::size_t>(
        {40, work, [&](std::size_t square) { delivered.push_back(square); }, [] { return true; }},
        jobs);
    ASSERT_THAT(delivered, SizeIs(40));
    for (std::size_t i = 0; i < 40; ++i) EXPECT_EQ(delivered[i], i * i) << jobs;
  }
}

TEST(InOrder, KeepsEverythingThatWasBegunBeforeAStop) {
  std::atomic<int> begun = 0;
  int delivered = 0;
  in_order<int>({1000, [&](std::size_t) { return ++begun; }, [&](int) { ++delivered; },
                 [&] { return begun < 10; }},
                3);
  EXPECT_GE(delivered, 10);
  EXPECT_LE(delivered, 13);
  EXPECT_EQ(delivered, begun);
}

TEST(InOrder, LetsAnExceptionThrough) {
  const auto work = [](std::size_t index) -> int {
    if (index == 7) throw std::runtime_error("seven");
    return 0;
  };
  EXPECT_THROW(in_order<int>({50, work, [](int) {}, [] { return true; }}, 3), std::runtime_error);
}

/// A member that differs from the others in what it sets and in one metric.
ReportedMember member_with(std::vector<Setting> settings, double attitude_deg) {
  ReportedMember member;
  member.bundle.model = test::model_of_every_kind();
  member.settings = std::move(settings);
  member.result.comparison = Comparison{{{"attitude_deg", attitude_deg, 0.0, {}}}, true};
  return member;
}

TEST(Trends, FindTheOrderOfAMethodInTheDifferenceOfTheEngines) {
  std::vector<ReportedMember> members;
  for (const double step : {0.4, 0.1, 0.05}) {
    members.push_back(member_with({{"simulation.step", "?", step}}, 3.0 * std::pow(step, 4)));
    members.back().bundle.model.simulation.step = step;
  }
  const StudyPlan plan{3, {"simulation.step"}};
  const std::vector<Trend> trends = convergence_of(plan, study_points(members));
  ASSERT_THAT(trends, SizeIs(1));
  EXPECT_THAT(trends[0].exponents,
              ElementsAre(testing::DoubleNear(4, 1e-12), testing::DoubleNear(4, 1e-12)));
  EXPECT_THAT(trends[0].members, ElementsAre(0U, 1U, 2U));
  EXPECT_THAT(slopes_of(plan, study_points(members)), IsEmpty());
}

TEST(Trends, NameRoundingInsteadOfFittingIt) {
  std::vector<ReportedMember> members;
  const auto add = [&members](double step, double attitude_deg) {
    members.push_back(member_with({{"simulation.step", "?", step}}, attitude_deg));
    members.back().bundle.model.simulation.step = step;
    members.back().result.comparison->metrics[0].size = 57.3;
    members.back().result.engines.resize(1);
    members.back().result.engines[0].trajectory.counts.accepted = 10'000;
  };
  // 4 eps sqrt(10 000) 57.3 deg = 5.1e-12 deg.
  add(0.4, 1e-6);
  add(0.2, 6e-12);
  add(0.1, 5e-12);
  add(0.05, 3e-16);
  const std::vector<Trend> trends = convergence_of({4, {"simulation.step"}}, study_points(members));
  ASSERT_THAT(trends, SizeIs(1));
  EXPECT_THAT(trends[0].is_rounding, ElementsAre(false, false, true, true));
  EXPECT_NEAR(trends[0].exponents[0], 17.3, 0.1);
  EXPECT_THAT(trends[0].exponents, ElementsAre(testing::Gt(0), testing::IsNan(), testing::IsNan()));
}

TEST(Trends, PreferReferencesToTheDifferenceOfTheEngines) {
  std::vector<ReportedMember> members;
  for (const double step : {2.0, 1.0}) {
    members.push_back(member_with({{"simulation.step", "?", step}}, 1.0));
    members.back().bundle.model.simulation.step = step;
    members.back().result.references = {{"kepler", "bsm", {{"position_m", step * step, 0.0}}}};
  }
  const std::vector<Trend> trends = convergence_of({2, {"simulation.step"}}, study_points(members));
  ASSERT_THAT(trends, SizeIs(1));
  EXPECT_EQ(trends[0].reference, "kepler");
  EXPECT_EQ(trends[0].engine, "bsm");
  EXPECT_THAT(trends[0].exponents, ElementsAre(testing::DoubleNear(2, 1e-12)));
}

TEST(Trends, SeparateTheOtherPathsOfAGrid) {
  std::vector<ReportedMember> members;
  for (const char* frame : {"comoving", "inertial"})
    for (const double mass : {1.0, 2.0})
      members.push_back(member_with({{"frame", frame}, {"hub.mass", std::to_string(mass), mass}},
                                    frame[0] == 'c' ? mass : mass * mass));
  const std::vector<Trend> trends = slopes_of({4, {"frame", "hub.mass"}}, study_points(members));
  ASSERT_THAT(trends, SizeIs(2));
  EXPECT_THAT(trends[0].exponents, ElementsAre(testing::DoubleNear(1, 1e-12)));
  EXPECT_THAT(trends[1].exponents, ElementsAre(testing::DoubleNear(2, 1e-12)));
  EXPECT_EQ(trends[1].others[0].text, "inertial");
  EXPECT_THAT(trends[1].members, ElementsAre(2U, 3U));
}

TEST(Trends, LeaveOutWhatHasNoLogarithm) {
  std::vector<ReportedMember> members;
  for (const double value : {0.0, 1.0, 2.0})
    members.push_back(member_with({{"initial.velocity", "?", value}}, value));
  const std::vector<Trend> trends = slopes_of({3, {"initial.velocity"}}, study_points(members));
  ASSERT_THAT(trends, SizeIs(1));
  EXPECT_TRUE(std::isnan(trends[0].exponents[0]));
  EXPECT_NEAR(trends[0].exponents[1], 1.0, 1e-12);
}

TEST(Trends, ReadScalingOffTheTimeOfAStep) {
  std::vector<ReportedMember> members;
  for (const int links : {11, 21}) {
    members.push_back(member_with({{"panels.*.segments", "?", links}}, 1.0));
    Model& model = members.back().bundle.model;
    model.assembly.links.resize(static_cast<std::size_t>(links));
    const double size = model.degrees_of_freedom();
    members.back().result.timing = Timing{1, {{"bsm", {size}, 10}, {"mujoco", {size * size}, 10}}};
  }
  const std::vector<Trend> trends = scaling_of({2, {"panels.*.segments"}}, study_points(members));
  ASSERT_THAT(trends, SizeIs(2));
  EXPECT_THAT(trends[0].x, ElementsAre(18.0, 28.0));
  EXPECT_NEAR(trends[0].exponents[0], 1.0, 1e-12);
  EXPECT_NEAR(trends[1].exponents[0], 2.0, 1e-12);
}

TEST(Trends, TakeThePathsOfAZipForOneGroup) {
  std::vector<ReportedMember> members;
  for (const double value : {1.0, 2.0}) {
    members.push_back(member_with(
        {{"hub.mass", std::to_string(value), value}, {"simulation.step", "?", value}}, value));
    members.back().bundle.model.simulation.step = value;
  }
  const StudyPlan plan{2, {"hub.mass", "simulation.step"}, false};
  EXPECT_THAT(convergence_of(plan, study_points(members)), SizeIs(1));
  EXPECT_THAT(slopes_of(plan, study_points(members)), SizeIs(1));
  EXPECT_THAT(convergence_of({2, plan.paths}, study_points(members)), IsEmpty());
}

/// A configuration of one engine that ends `angle` [rad] about x away from the truth.
ReportedMember run_with(double angle, long evaluations) {
  ReportedMember member = member_with({{"simulation.step", "?", 1.0}}, 0.0);
  EngineRun run;
  run.name = "bsm";
  run.trajectory = test::standstill(member.bundle.model);
  run.trajectory.counts.evaluations = evaluations;
  run.trajectory.samples.back().q_BN =
      Quaterniond(std::cos(0.5 * angle), std::sin(0.5 * angle), 0.0, 0.0);
  run.trajectory.samples.back().r_BN_N.x() = angle;
  member.result.engines.push_back(std::move(run));
  member.result.complete = true;
  return member;
}

std::vector<ReportedMember> configurations() {
  std::vector<ReportedMember> members;
  members.push_back(run_with(1.0e-2, 100));
  members.push_back(run_with(1.0e-4, 200));
  members.push_back(run_with(1.0e-3, 300));  // dearer and worse than the one before
  members.push_back(run_with(1.0e-6, 400));
  members.back().result.engines[0].status = EngineRun::Status::kFailed;
  members.push_back(run_with(0.0, 5000));
  members.push_back(run_with(1.0e-13, 4000));
  return members;
}

TEST(WorkPrecision, HoldsConfigurationsAgainstTheReferenceOfTheirOwnEngine) {
  const std::vector<ReportedMember> members = configurations();
  const std::vector<EngineWork> engines = work_precision_of(study_points(members));
  ASSERT_THAT(engines, SizeIs(1));
  const EngineWork& work = engines[0];
  ASSERT_THAT(work.points, SizeIs(4));
  EXPECT_NEAR(work.points[1].error.attitude, 1.0e-4 * 180.0 / M_PI, 1e-15);
  EXPECT_EQ(work.points[1].error.position, 1.0e-4);
  EXPECT_NEAR(work.floor.attitude, 1.0e-13 * 180.0 / M_PI, 1e-20);
}

TEST(WorkPrecision, KeepsOnTheFrontierWhatNothingCheaperBeats) {
  const std::vector<ReportedMember> members = configurations();
  const EngineWork work = work_precision_of(study_points(members)).at(0);
  std::vector<bool> frontier;
  for (const WorkPoint& point : work.points) frontier.push_back(point.on_frontier);
  EXPECT_THAT(frontier, ElementsAre(true, true, false, false));
  EXPECT_TRUE(work.points[3].diverged);
}

TEST(WorkPrecision, SaysWhichTolerancesChangeNothing) {
  std::vector<ReportedMember> members = configurations();
  const std::array<const char*, 4> methods{"rkf45", "rkf45", "rkf45", "rkf78"};
  const std::array<long, 4> evaluations{600, 600, 900, 600};
  for (std::size_t i = 0; i < methods.size(); ++i) {
    members[i].settings = {{"simulation.integrator", methods[i], {}},
                           {"simulation.tolerance", "?", 1.0}};
    members[i].result.engines[0].status = EngineRun::Status::kOk;
    members[i].result.engines[0].trajectory.counts.evaluations = evaluations[i];
  }
  const StudyPoints points = study_points(members);
  EXPECT_THAT(idle_tolerances(work_precision_of(points).at(0), points),
              ElementsAre(HasSubstr("2 of 3 tolerances of rkf45 take the same steps")));
}

TEST(WorkPrecision, SaysNothingWithoutAReference) {
  std::vector<ReportedMember> members = configurations();
  members[4].result.engines[0].status = EngineRun::Status::kFailed;
  EXPECT_THAT(work_precision_of(study_points(members)), IsEmpty());
}

TEST(StudyTable, ShowsARowPerMemberAndWhatTheyShowTogether) {
  Report report{provenance(), {}};
  for (const double mass : {1.0, 2.0})
    report.members.push_back(
        member_with({{"hub.mass", mass == 1.0 ? "1 kg" : "2 kg", mass}}, 1.0e-3 * mass * mass));
  for (ReportedMember& member : report.members) member.result.complete = true;
  report.study = StudyPlan{2, {"hub.mass"}};
  const std::string table = study_table(report, false);
  EXPECT_THAT(table, HasSubstr("2 of 2 members"));
  EXPECT_THAT(table, HasSubstr("2 kg  4.0e-03 deg"));
  EXPECT_THAT(table, HasSubstr("attitude  2.00"));
}

TEST(StudyTable, MarksWhatDiverged) {
  Report report{provenance(), configurations()};
  report.study = StudyPlan{6, {}, true, true};
  const std::string table = study_table(report, false);
  EXPECT_THAT(table, HasSubstr("diverged"));
  EXPECT_THAT(table, HasSubstr("floor"));
}

TEST(Report, OfAStudyIsCompleteWhenEveryMemberIs) {
  Report report{provenance(), configurations()};
  report.study = StudyPlan{7, {}, true, true};
  EXPECT_FALSE(report.complete());
  report.study->members = 6;
  EXPECT_TRUE(report.complete());
}

}  // namespace
}  // namespace twincraft
