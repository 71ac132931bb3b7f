// Claims about netCDF files: what was written is read back, to the bit, with names, units and where
// it came from.
#include "runtime/report/netcdf.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netcdf.h>
#include <netcdf_mem.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "tests/runtime/handmade.h"

namespace twincraft {
namespace {

using testing::ElementsAre;

class Reader {
 public:
  explicit Reader(std::string bytes) : bytes_(std::move(bytes)) {
    EXPECT_EQ(nc_open_mem("read.nc", NC_NOWRITE, bytes_.size(), bytes_.data(), &file_), NC_NOERR);
  }
  ~Reader() { nc_close(file_); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  int variable(const std::string& name) const {
    int id = -1;
    EXPECT_EQ(nc_inq_varid(file_, name.c_str(), &id), NC_NOERR) << name;
    return id;
  }

  std::vector<double> values(const std::string& name) const {
    const int id = variable(name);
    int count = 0;
    nc_inq_varndims(file_, id, &count);
    std::vector<int> dimensions(static_cast<std::size_t>(count));
    nc_inq_vardimid(file_, id, dimensions.data());
    std::size_t size = 1;
    for (const int dimension : dimensions) {
      std::size_t length = 0;
      nc_inq_dimlen(file_, dimension, &length);
      size *= length;
    }
    std::vector<double> read(size);
    EXPECT_EQ(nc_get_var_double(file_, id, read.data()), NC_NOERR) << name;
    return read;
  }

  std::string attribute(int id, const char* name) const {
    std::size_t length = 0;
    EXPECT_EQ(nc_inq_attlen(file_, id, name, &length), NC_NOERR) << name;
    std::string text(length, ' ');
    nc_get_att_text(file_, id, name, text.data());
    return text;
  }

  std::string unit(const std::string& name) const { return attribute(variable(name), "units"); }

 private:
  std::string bytes_;
  int file_ = -1;
};

struct Written {
  Bundle bundle;
  EngineRun run;

  Written() {
    bundle.model = test::model_of_every_kind();
    bundle.model.description = "what it is";
    bundle.spec_file = "spec.yaml";
    bundle.spec_sha256 = "abc";
    bundle.settings = {{"simulation.step", "0.1"}};
    run.name = "bsm";
    run.trajectory = test::standstill(bundle.model);
  }
  std::string bytes() const {
    // The tests of this file may run at once.
    const std::string path = fmt::format("{}written-{}.nc", testing::TempDir(), getpid());
    NetcdfFile file(path, bundle, run.name, provenance());
    for (const Observation& sample : run.trajectory.samples) file.take(sample);
    file.close();
    std::ifstream stream(path, std::ios::binary);
    std::string read{std::istreambuf_iterator<char>(stream), {}};
    std::filesystem::remove(path);
    return read;
  }
};

TEST(Netcdf, ReadsBackToTheBit) {
  Written written;
  Observation& last = written.run.trajectory.samples[2];
  last.r_BN_N = Vector3d(1.0 / 3.0, -7.0e6, 5e-324);
  last.q_BN = Quaterniond(0.5, -0.5, 0.5, -0.5);
  last.joint_position[4] = 0.1;
  last.wheel_rate[1] = std::numeric_limits<double>::quiet_NaN();
  const Reader read(written.bytes());
  EXPECT_THAT(read.values("time"), ElementsAre(0.0, 0.5, 1.0));
  EXPECT_THAT(read.values("r_BN_N"), ElementsAre(0, 0, 0, 0, 0, 0, 1.0 / 3.0, -7.0e6, 5e-324));
  EXPECT_THAT(read.values("q_BN"), ElementsAre(1, 0, 0, 0, 1, 0, 0, 0, 0.5, -0.5, 0.5, -0.5));
  EXPECT_THAT(read.values("slosh.position"), ElementsAre(0.0, 0.0, 0.1));
  EXPECT_THAT(read.values("rw_y.rate"), ElementsAre(0.0, 0.0, testing::IsNan()));
  EXPECT_THAT(read.values("mass"), ElementsAre(100.0, 100.0, 100.0));
}

TEST(Netcdf, KeepsEverySampleOfALongRunInItsPlace) {
  Written written;
  std::vector<Observation>& samples = written.run.trajectory.samples;
  samples.assign(2500, samples[0]);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].time = static_cast<double>(i);
    samples[i].v_BN_N.y() = -static_cast<double>(i);
  }
  const Reader read(written.bytes());
  const std::vector<double> time = read.values("time"), v = read.values("v_BN_N");
  ASSERT_EQ(time.size(), samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    ASSERT_EQ(time[i], static_cast<double>(i));
    ASSERT_EQ(v[3 * i + 1], -static_cast<double>(i));
  }
}

TEST(Netcdf, SaysTheUnitOfEveryVariable) {
  const Reader read(Written().bytes());
  EXPECT_EQ(read.unit("time"), "s");
  EXPECT_EQ(read.unit("v_BN_N"), "m s-1");
  EXPECT_EQ(read.unit("q_BN"), "1");
  EXPECT_EQ(read.unit("wing.1.position"), "rad");
  EXPECT_EQ(read.unit("rail.position"), "m");
  EXPECT_EQ(read.unit("rail.rate"), "m s-1");
  EXPECT_EQ(read.unit("bob.phi.rate"), "rad s-1");
  EXPECT_EQ(read.unit("rw_x.rate"), "rad s-1");
}

TEST(Netcdf, SaysWhereItComesFrom) {
  const Reader read(Written().bytes());
  EXPECT_EQ(read.attribute(NC_GLOBAL, "title"), "every_kind");
  EXPECT_EQ(read.attribute(NC_GLOBAL, "summary"), "what it is");
  EXPECT_EQ(read.attribute(NC_GLOBAL, "engine"), "bsm");
  EXPECT_EQ(read.attribute(NC_GLOBAL, "spec_sha256"), "abc");
  EXPECT_EQ(read.attribute(NC_GLOBAL, "settings"), "simulation.step=0.1\n");
  EXPECT_EQ(read.attribute(NC_GLOBAL, "source"), "scsim " TWINCRAFT_VERSION);
}

TEST(Netcdf, IsTheSameBytesForTheSameRun) { EXPECT_EQ(Written().bytes(), Written().bytes()); }

}  // namespace
}  // namespace twincraft
