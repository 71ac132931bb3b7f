// Results of a campaign, written by hand.
#pragma once

#include <string>

#include "runtime/campaign/records.h"

namespace twincraft::test {

/// Two numbers are drawn; `peak` must be below 0.1 rad, `touch` may never be reached.
inline RecordsHeader campaign_header() {
  RecordsHeader header;
  header.name = "quickstart";
  header.spec_sha256 = "abc";
  header.instructions = "AVX2";
  header.drawn = {{"hub.mass", "kg", "normal, sigma 2 %", 600.0},
                  {"wheels.w.speed", "rad/s", "uniform", 1.0 / 3.0}};
  header.outputs = {{"peak", "rad", "largest magnitude of wing_p.1.position", 0.1, {}},
                    {"touch", "s", "first crossing of wing_p.1.position", {}, {}}};
  return header;
}

/// Flown; its peak is a thousandth of its number.
inline MemberRecord member_record(std::size_t member) {
  MemberRecord record;
  record.member = member;
  record.drawn = {600.0 + static_cast<double>(member) / 3.0, -0.1};
  record.outputs = {1e-3 * static_cast<double>(member), std::nullopt};
  record.seconds = 0.25;
  return record;
}

inline MemberRecord failed_member(std::size_t member, std::string reason) {
  MemberRecord record = member_record(member);
  record.outputs = {std::nullopt, std::nullopt};
  record.verdict = Verdict::kFailed;
  record.reason = std::move(reason);
  return record;
}

}  // namespace twincraft::test
