// The flown campaign behind twincraft.Campaign.
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cstdint>

#include "runtime/api/python/arrays.h"
#include "runtime/api/python/faults.h"
#include "runtime/api/python/model.h"
#include "runtime/api/python/watched.h"

using namespace nanobind::literals;

namespace twincraft::python {
namespace {

/// As `--engine`; empty: as the campaign plans. @throws ValueError
twincraft::Twins twins_named(const std::string& engine) {
  if (engine.empty()) return twincraft::Twins::planned;
  if (engine == "both") return twincraft::Twins::all;
  if (engine_named(engine) == twincraft::Engine::bsm) return twincraft::Twins::none;
  refuse_value("members of a campaign fly in the analytic engine; 'both' adds the other to all");
}

twincraft::Campaign fly(const CompiledModel& model, const std::string& engine, int jobs,
                        const std::string& isa, const std::string& folder, std::size_t shard,
                        std::size_t shards, bool resume, const std::vector<nb::bytes>& records) {
  twincraft::CampaignOptions options;
  options.twins = twins_named(engine);
  options.jobs = jobs;
  options.isa = isa;
  options.folder = folder;
  options.shard = shard;
  options.shards = shards;
  options.resume = resume;
  for (const nb::bytes& one : records) options.records.emplace_back(one.c_str(), one.size());
  return watched(std::move(options),
                 [&](const twincraft::CampaignOptions& how) { return model.model.campaign(how); });
}

nb::object members(const twincraft::Campaign& campaign) {
  return new_array<std::int64_t, const std::int64_t>(
      {campaign.rows()}, [&](std::int64_t* to, std::size_t rows) {
        for (std::size_t i = 0; i < rows; ++i)
          to[i] = static_cast<std::int64_t>(campaign.row(i).member);
      });
}

template <std::string twincraft::Campaign::Row::*text>
std::vector<std::string> texts(const twincraft::Campaign& campaign) {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < campaign.rows(); ++i) all.push_back(campaign.row(i).*text);
  return all;
}

nb::object column(const twincraft::Campaign& campaign, std::size_t index) {
  return read_only_array({campaign.rows()}, [&](double* values, std::size_t size) {
    campaign.read(index, values, size);
  });
}

nb::list columns(const twincraft::Campaign& campaign) {
  nb::list all;
  for (const twincraft::Signal& one : campaign.columns())
    all.append(nb::make_tuple(one.name, one.unit));
  return all;
}

nb::bytes records(const twincraft::Campaign& campaign) {
  const std::string bytes = campaign.text(TC_CAMPAIGN_RECORDS);
  return nb::bytes(bytes.data(), bytes.size());
}

}  // namespace

void bind_campaign(nb::module_& module) {
  using twincraft::Campaign;
  module.def("fly_campaign", fly, "model"_a, "engine"_a, "jobs"_a, "isa"_a, "folder"_a, "shard"_a,
             "shards"_a, "resume"_a, "records"_a, "Fly a campaign, or a shard of one.");
  nb::class_<Campaign, twincraft::Run>(module, "FlownCampaign", "The campaign behind a Campaign.")
      .def_prop_ro("exit_code", &Campaign::exit_code)
      .def_prop_ro("columns", columns, nb::sig("def columns(self) -> list[tuple[str, str]]"))
      .def("column", column, "index"_a,
           nb::sig("def column(self, index: int) -> numpy.typing.NDArray[numpy.float64]"))
      .def("members", members, nb::sig("def members(self) -> numpy.typing.NDArray[numpy.int64]"))
      .def("verdicts", texts<&Campaign::Row::verdict>)
      .def("reasons", texts<&Campaign::Row::reason>)
      .def("worst", &Campaign::worst, "most"_a, "by"_a)
      .def("header", [](const Campaign& self) { return self.text(TC_CAMPAIGN_HEADER); })
      .def("csv", [](const Campaign& self) { return self.text(TC_CAMPAIGN_CSV); })
      .def("records", records);
}

}  // namespace twincraft::python
