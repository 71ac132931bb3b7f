// A whole campaign, made by hand: every kind of member occurs, and what drives what is known.
#pragma once

#include <cmath>
#include <random>

#include "runtime/campaign/findings.h"

namespace twincraft::test {

/// `peak` rises with the mass and, less, with the square of the speed; `touch` is never reached by
/// heavy vehicles; the third number drives nothing.
inline RecordsHeader driven_header() {
  RecordsHeader header;
  header.name = "tug";
  header.spec_sha256 = "abc";
  header.instructions = "AVX2";
  header.drawn = {{"hub.mass", "kg", "normal, sigma 2 %, truncate 3", 600.0},
                  {"wheels.w.speed", "rad/s", "uniform, low -100 rad/s, high 100 rad/s", 0.0},
                  {"panels.p.stiffness", "N m/rad", "lognormal, sigma 10 %", 5.0}};
  header.outputs = {{"peak", "rad", "largest magnitude of p.1.position", 0.08, {}},
                    {"touch", "s", "first crossing of p.1.position", {}, {}}};
  return header;
}

inline MemberRecord driven_member(std::size_t member, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const double heavy = normal(random), fast = uniform(random), stiff = normal(random);
  MemberRecord record;
  record.member = member;
  record.drawn = {600.0 + 12.0 * heavy, 100.0 * fast, 5.0 * std::exp(0.1 * stiff)};
  record.outputs = {0.05 + 0.01 * heavy + 0.02 * fast * fast, std::nullopt};
  if (heavy < 1.0) record.outputs[1] = 10.0 + heavy;
  if (!(*record.outputs[0] < 0.08)) record.reason = "peak is not below 0.08 rad";
  if (member % 10 == 0) record.twin = heavy > 0.8 ? Verdict::kDisagree : Verdict::kAgree;
  record.seconds = 0.25;
  return record;
}

/// Every 400th member, from the 399th on, failed; the last `missing` were not begun.
inline MergedCampaign driven_campaign(std::size_t members, std::size_t missing = 0,
                                      RecordsHeader header = driven_header()) {
  std::mt19937_64 random(7);
  CampaignTable table(std::move(header));
  for (std::size_t member = 0; member < members - missing; ++member) {
    MemberRecord record = driven_member(member, random);
    if (member % 400 == 399) {
      record.outputs = {std::nullopt, std::nullopt};
      record.verdict = Verdict::kFailed;
      record.twin.reset();
      record.reason = "`omega_BN_B` is absurd: 3e+08 rad/s";
    }
    table.add(record);
  }
  table.settle(members);
  std::vector<MemberRange> absent = table.missing(members);
  return {std::move(table), members, std::move(absent), {}};
}

inline CampaignPlan driven_plan(std::size_t members) {
  CampaignPlan plan;
  plan.members = members;
  plan.seed = 7;
  plan.sampling = Sampling::kLatinHypercube;
  plan.drawn = driven_header().drawn;
  plan.twin_every = 10;
  plan.keep_worst = 5;
  plan.keep_by = "peak";
  plan.keep_members = {0, 17};
  return plan;
}

}  // namespace twincraft::test
