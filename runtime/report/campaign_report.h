// What a campaign has to say, before anyone decides how to print it: report.json and report.html
// are made of this.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "compiler/ir/campaign.h"
#include "runtime/campaign/findings.h"
#include "runtime/study/provenance.h"

namespace twincraft {

struct CampaignReport {
  MergedCampaign campaign;
  CampaignPlan plan;
  CampaignFindings findings;  // find_all() of these two
  Verdict verdict = Verdict::kNotJudged;
  bool complete = false;  // no member is missing, none was interrupted
  Provenance provenance = {};

  std::string description = {};        // of the vehicle; may be empty
  std::string spec_file = {};          // as given
  std::string spec_sha256 = {};        // of the bytes of the spec and of all it extends
  int degrees_of_freedom = 0;          // of the vehicle as it is drawn around
  std::vector<std::size_t> kept = {};  // members whose trajectories were kept, rising
  // `hub.mass=601.2`: the settings that make this member of the spec. Empty: nobody knows them.
  std::function<std::vector<std::string>(std::size_t member)> settings = {};
};

/// `0017`: where the trajectories of a member are, from the report's own folder.
std::string member_folder(std::size_t member);

/// `scsim models/x.yaml --set hub.mass=601.2`, to be typed in a shell: what flies this member
/// alone. Empty where its settings are not known.
std::string reproducing_command(const CampaignReport& report, std::size_t member);

/// `random`, `latin_hypercube`, `sobol`
std::string_view sampling_name(Sampling sampling);

/// The verdict in words: `The engines agree in all 11 members that both flew`.
std::string verdict_words(const CampaignReport& report);

}  // namespace twincraft
