// A campaign as netCDF: names with dots, units, distributions, texts, to the bit.
#include "runtime/report/campaign_netcdf.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netcdf.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>

#include "runtime/report/netcdf_file.h"
#include "tests/campaign/handmade.h"

namespace twincraft {
namespace {

using test::campaign_header;
using test::failed_member;
using test::member_record;
using testing::ElementsAre;
using testing::IsNan;

class CampaignNetcdf : public testing::Test {
 protected:
  CampaignNetcdf()
      : path_(fmt::format("{}campaign-{}.nc", testing::TempDir(), getpid())),
        table_(campaign_header()) {}
  ~CampaignNetcdf() override {
    if (file_ >= 0) nc_close(file_);
    std::filesystem::remove(path_);
  }

  void write() {
    ASSERT_EQ(table_.settle(1U << 20U), "");
    write_campaign_netcdf(path_, table_, provenance());
    ASSERT_EQ(nc_open(path_.c_str(), NC_NOWRITE, &file_), NC_NOERR);
  }
  int variable(const char* name) const {
    int id = -1;
    EXPECT_EQ(nc_inq_varid(file_, name, &id), NC_NOERR) << name;
    return id;
  }
  std::vector<double> numbers(const char* name) const {
    std::vector<double> values(table_.rows());
    EXPECT_EQ(nc_get_var_double(file_, variable(name), values.data()), NC_NOERR) << name;
    return values;
  }
  std::vector<std::string> texts(const char* name) const {
    std::vector<char*> pointers(table_.rows());
    EXPECT_EQ(nc_get_var_string(file_, variable(name), pointers.data()), NC_NOERR) << name;
    std::vector<std::string> values(pointers.begin(), pointers.end());
    nc_free_string(pointers.size(), pointers.data());
    return values;
  }
  std::string text_attribute(int id, const char* name) const {
    std::size_t length = 0;
    EXPECT_EQ(nc_inq_attlen(file_, id, name, &length), NC_NOERR) << name;
    std::string text(length, ' ');
    nc_get_att_text(file_, id, name, text.data());
    return text;
  }
  double number_attribute(const char* variable_name, const char* name) const {
    double value = 0.0;
    EXPECT_EQ(nc_get_att_double(file_, variable(variable_name), name, &value), NC_NOERR);
    return value;
  }

  std::string path_;
  CampaignTable table_;
  int file_ = -1;
};

TEST_F(CampaignNetcdf, ReadsBackToTheBit) {
  MemberRecord odd = member_record(5);
  odd.drawn = {1.0 / 3.0, 5e-324};
  odd.verdict = Verdict::kAgree;
  table_.add(odd);
  table_.add(failed_member(2, "`x` is absurd"));
  write();
  EXPECT_THAT(numbers("member"), ElementsAre(2.0, 5.0));
  EXPECT_THAT(numbers("wheels.w.speed"), ElementsAre(-0.1, 5e-324));
  EXPECT_THAT(numbers("hub.mass"), ElementsAre(600.0 + 2.0 / 3.0, 1.0 / 3.0));
  EXPECT_THAT(numbers("peak"), ElementsAre(IsNan(), 5e-3));
  EXPECT_THAT(numbers("seconds"), ElementsAre(0.25, 0.25));
  EXPECT_THAT(texts("verdict"), ElementsAre("failed", "agree"));
  EXPECT_THAT(texts("reason"), ElementsAre("`x` is absurd", ""));
}

TEST_F(CampaignNetcdf, SaysWhatEveryColumnIs) {
  table_.add(member_record(0));
  write();
  EXPECT_EQ(text_attribute(variable("wheels.w.speed"), "units"), "rad s-1");
  EXPECT_EQ(text_attribute(variable("hub.mass"), "distribution"), "normal, sigma 2 %");
  EXPECT_EQ(number_attribute("hub.mass", "nominal"), 600.0);
  EXPECT_EQ(text_attribute(variable("peak"), "long_name"),
            "largest magnitude of wing_p.1.position");
  EXPECT_EQ(number_attribute("peak", "below"), 0.1);
  EXPECT_EQ(text_attribute(NC_GLOBAL, "Conventions"), "CF-1.8");
  EXPECT_EQ(text_attribute(NC_GLOBAL, "title"), "quickstart");
  EXPECT_EQ(text_attribute(NC_GLOBAL, "spec_sha256"), "abc");
  EXPECT_EQ(text_attribute(NC_GLOBAL, "instructions"), "AVX2");
  EXPECT_EQ(text_attribute(NC_GLOBAL, "source"), "scsim " TWINCRAFT_VERSION);
}

TEST_F(CampaignNetcdf, HoldsMoreRowsThanAChunk) {
  for (std::size_t member = 0; member < 10000; ++member) table_.add(member_record(member));
  table_.add(failed_member(10000, "last"));
  write();
  const std::vector<double> members = numbers("member"), peaks = numbers("peak");
  for (std::size_t i = 0; i < 10000; ++i) {
    ASSERT_EQ(members[i], static_cast<double>(i));
    ASSERT_EQ(peaks[i], 1e-3 * static_cast<double>(i));
  }
  EXPECT_EQ(texts("reason").back(), "last");
}

TEST_F(CampaignNetcdf, OfNoMembersHasItsColumns) {
  write();
  EXPECT_EQ(text_attribute(variable("peak"), "units"), "rad");
}

TEST_F(CampaignNetcdf, RefusesTwoColumnsOfOneName) {
  RecordsHeader header = campaign_header();
  header.outputs[0].name = "seconds";
  EXPECT_THROW(write_campaign_netcdf(path_, CampaignTable(header), provenance()),
               std::runtime_error);
}

TEST(NetcdfUnits, ArePrintedAsProducts) {
  EXPECT_EQ(netcdf::as_product("rad/s"), "rad s-1");
  EXPECT_EQ(netcdf::as_product("m3/s2"), "m3 s-2");
  EXPECT_EQ(netcdf::as_product("N m/rad"), "N m rad-1");
  EXPECT_EQ(netcdf::as_product("N m s/rad"), "N m s rad-1");
  EXPECT_EQ(netcdf::as_product("m/s/s"), "m s-1 s-1");
  EXPECT_EQ(netcdf::as_product("kg m2"), "kg m2");
  EXPECT_EQ(netcdf::as_product("1"), "1");
}

}  // namespace
}  // namespace twincraft
