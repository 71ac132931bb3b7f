// Campaigns: Model::campaign() flies the members of a spec that has one, and gives a Campaign.
#ifndef TWINCRAFT_CAMPAIGN_H
#define TWINCRAFT_CAMPAIGN_H

#include <cstddef>
#include <string>
#include <vector>

#include "../twincraft.h"
#include "model.h"

namespace twincraft {

enum class Twins { planned = TC_TWINS_PLANNED, all = TC_TWINS_ALL, none = TC_TWINS_NONE };

struct CampaignOptions {
  Twins twins = Twins::planned;       // members that both engines fly
  int jobs = 0;                       // members at a time; 0: all cores
  std::string isa = "auto";           // as --isa
  std::string folder;                 // files are written here; empty: nowhere
  std::size_t shard = 0, shards = 0;  // fly part 1 to `shards` alone; 0: all
  bool resume = false;                // keep the members that `folder` has
  std::vector<std::string> records;   // of shards that were flown elsewhere
  tc_poll poll = nullptr;
  void* context = nullptr;
};

/// A campaign as scsim flies it, or a shard of one, which has records alone.
class Campaign : public Run {
 public:
  std::size_t rows() const { return tc_campaign_rows(handle()); }
  /// Names and units of the drawn numbers, the outputs and `seconds`.
  std::vector<Signal> columns() const {
    std::vector<Signal> all;
    for (std::size_t i = 0; i < tc_campaign_columns(handle()); ++i)
      all.push_back(
          {tc_campaign_column_name(handle(), i), tc_campaign_column_unit(handle(), i), ""});
    return all;
  }
  /// @pre values has room for rows() numbers
  void read(std::size_t column, double* values, std::size_t size) const {
    check(tc_campaign_read(handle(), column, values, size));
  }
  struct Row {
    std::size_t member = 0;
    std::string verdict, reason;
  };
  Row row(std::size_t index) const {
    std::size_t member = 0;
    const char *verdict = "", *reason = "";
    check(tc_campaign_row(handle(), index, &member, &verdict, &reason));
    return {member, verdict, reason};
  }
  /// Members, worst first. @param by  an output; empty: as the campaign keeps members
  std::vector<std::size_t> worst(std::size_t most, const std::string& by = "") const {
    std::vector<std::size_t> members(most);
    std::size_t count = 0;
    check(tc_campaign_worst(handle(), by.empty() ? nullptr : by.c_str(), members.data(), most,
                            &count));
    members.resize(count);
    return members;
  }
  std::string text(tc_campaign_texts which) const {
    std::size_t length = 0;
    const char* text = tc_campaign_text(handle(), which, &length);
    return {text, length};
  }
  using Run::text;
  int exit_code() const { return tc_campaign_exit_code(handle()); }

 private:
  friend class Model;
  using Run::Run;
};

inline Campaign Model::campaign(const CampaignOptions& how) const {
  std::vector<const char*> records;
  std::vector<std::size_t> sizes;
  for (const std::string& one : how.records) {
    records.push_back(one.data());
    sizes.push_back(one.size());
  }
  const tc_campaign_options options{sizeof options,
                                    static_cast<tc_twins>(how.twins),
                                    how.jobs,
                                    how.isa.c_str(),
                                    how.folder.empty() ? nullptr : how.folder.c_str(),
                                    how.shard,
                                    how.shards,
                                    how.resume ? 1 : 0,
                                    records.data(),
                                    sizes.data(),
                                    records.size(),
                                    how.poll,
                                    how.context};
  tc_run* handle = nullptr;
  const tc_status status = tc_model_campaign(this->handle(), &options, &handle);
  Campaign campaign(handle);
  if (status == TC_SPEC) throw SpecError(tc_run_error(handle), "");
  detail::check(status, tc_run_error(handle));
  return campaign;
}

inline Campaign Model::campaign() const { return campaign(CampaignOptions{}); }

}  // namespace twincraft

#endif
