// Claims about the members of a campaign: each is flown by itself, as its printed command says, by
// the program and step by step through the library, and is what its row says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "runtime/api/include/twincraft.h"
#include "tests/support/run_program.h"

namespace twincraft {
namespace {

using nlohmann::json;

const std::string kReduced = R"(extends: quickstart.yaml
simulation: {duration: 20 s, record: 0.1 s}
campaign:
  members: 600
  seed: 11
  dispersions:
    - {set: hub.mass, normal: {sigma: 2 %}}
    - {set: hub.inertia, inertia: {sigma: 5 %, tilt: 1 deg}}
    - {set: panels.*.stiffness, lognormal: {sigma: 20 %}}
    - {set: wheels.*.axis, cone: {sigma: 0.5 deg}}
    - {set: initial.attitude, rotation: {sigma: 2 deg}}
    - {set: initial.rate, normal: {sigma: 0.1 deg/s}}
  outputs:
    - {name: most, of: wing_p.1.position, reduce: max}
    - {name: least, of: wing_p.1.position, reduce: min}
    - {name: peak, of: wing_m.1.position, reduce: max_abs}
    - {name: turning, of: omega_BN_B, reduce: max_norm}
    - {name: last, of: omega_BN_B.z, reduce: final}
    - {name: average, of: wing_p.1.position, reduce: mean}
    - {name: swing, of: wing_p.1.position, reduce: rms}
    - {name: calm, of: wing_p.1.position, reduce: settling_time, within: 5 deg}
    - {name: level, of: wing_p.1.position, reduce: first_crossing, level: 1 deg}
  keep: {members: [0, 1, 7, 8, 64, 300, 517, 599]}
)";

template <class Handle, void (*Free)(Handle*)>
struct Freed {
  void operator()(Handle* handle) const { Free(handle); }
};
using ModelHandle = std::unique_ptr<tc_model, Freed<tc_model, tc_model_free>>;
using SimulationHandle = std::unique_ptr<tc_simulation, Freed<tc_simulation, tc_simulation_free>>;

ModelHandle load(const std::string& file, const std::vector<std::string>& settings) {
  std::vector<const char*> set;
  for (const std::string& setting : settings) set.push_back(setting.c_str());
  const tc_load_options options{sizeof(tc_load_options), set.data(), set.size(), nullptr};
  tc_model* model = nullptr;
  const tc_status status = tc_model_load(file.c_str(), &options, &model);
  ModelHandle handle(model);
  if (status != TC_OK) throw std::runtime_error(tc_model_error(model));
  return handle;
}

/// What a member is reduced to, from its samples.
struct Samples {
  std::vector<double> t, wing_p, wing_m, turning, rate_z;

  /// By the names of the columns.
  std::map<std::string, double> reduced() const {
    double area = 0.0, square = 0.0;
    for (std::size_t i = 1; i < t.size(); ++i) {
      area += 0.5 * (t[i] - t[i - 1]) * (wing_p[i] + wing_p[i - 1]);
      square += 0.5 * (t[i] - t[i - 1]) * (std::pow(wing_p[i], 2) + std::pow(wing_p[i - 1], 2));
    }
    double peak = 0.0;
    for (const double angle : wing_m) peak = std::max(peak, std::abs(angle));
    return {{"most [rad]", std::ranges::max(wing_p)},
            {"least [rad]", std::ranges::min(wing_p)},
            {"peak [rad]", peak},
            {"turning [rad/s]", std::ranges::max(turning)},
            {"last [rad/s]", rate_z.back()},
            {"average [rad]", area / t.back()},
            {"swing [rad]", std::sqrt(square / t.back())},
            {"calm [s]", settled(5.0 * M_PI / 180.0)},
            {"level [s]", crossed(M_PI / 180.0)}};
  }

 private:
  /// Where the straight line from sample i to the next has this value.
  double passes(std::size_t i, double value) const {
    return t[i] + (value - wing_p[i]) / (wing_p[i + 1] - wing_p[i]) * (t[i + 1] - t[i]);
  }
  double settled(double within) const {
    for (std::size_t i = t.size() - 1; i-- > 0;)
      if (const double off = wing_p[i] - wing_p.back(); std::abs(off) > within)
        return passes(i, wing_p.back() + std::copysign(within, off));
    return 0.0;
  }
  double crossed(double level) const {
    for (std::size_t i = 0; i + 1 < t.size(); ++i)
      if ((wing_p[i] - level) * (wing_p[i + 1] - level) <= 0.0) return passes(i, level);
    return NAN;
  }
};

Samples flown_alone(const std::string& file, const std::vector<std::string>& settings) {
  const ModelHandle model = load(file, settings);
  tc_simulation* made = nullptr;
  EXPECT_EQ(tc_simulation_new(model.get(), TC_BSM, &made), TC_OK);
  const SimulationHandle simulation(made);
  std::vector<double> outputs(tc_model_count(model.get(), TC_OUTPUTS));
  const auto place = [&](const char* name) {
    std::size_t index = 0;
    EXPECT_EQ(tc_model_find(model.get(), TC_OUTPUTS, name, &index, nullptr), TC_OK) << name;
    return index;
  };
  const std::size_t wing_p = place("wing_p.1.position"), wing_m = place("wing_m.1.position"),
                    rate = place("omega_BN_B");
  Samples samples;
  for (int i = 0; i <= 200; ++i) {
    EXPECT_EQ(tc_simulation_run_until(simulation.get(), 0.1 * i, nullptr, nullptr), TC_OK);
    EXPECT_EQ(tc_simulation_observe(simulation.get(), outputs.data(), outputs.size()), TC_OK);
    samples.t.push_back(tc_simulation_time(simulation.get()));
    samples.wing_p.push_back(outputs[wing_p]);
    samples.wing_m.push_back(outputs[wing_m]);
    samples.turning.push_back(std::hypot(outputs[rate], outputs[rate + 1], outputs[rate + 2]));
    samples.rate_z.push_back(outputs[rate + 2]);
  }
  return samples;
}

/// Every number of a column of CSV.
std::vector<double> column(const std::string& csv, const std::string& name) {
  std::istringstream lines(csv);
  std::vector<std::vector<std::string>> cells;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream in(line);
    cells.emplace_back();
    for (std::string cell; std::getline(in, cell, ',');) cells.back().push_back(cell);
  }
  const auto place = std::ranges::find(cells.at(0), name) - cells.at(0).begin();
  std::vector<double> numbers;
  for (std::size_t i = 1; i < cells.size(); ++i)
    numbers.push_back(std::stod(cells[i].at(static_cast<std::size_t>(place))));
  return numbers;
}

/// A campaign that was flown, and the commands that it prints.
class CampaignMembers : public testing::Test {
 protected:
  CampaignMembers() {
    folder.write("quickstart.yaml", test::read_file(TWINCRAFT_ROOT "/models/quickstart.yaml"));
    folder.write("reduced.yaml", kReduced);
    const test::ProgramResult flown = shell(TWINCRAFT_SCSIM " reduced.yaml -o out --no-timing");
    EXPECT_EQ(flown.exit_code, 0) << flown.err;
    table = folder.read("out/campaign.csv");
    const json report = json::parse(folder.read("out/report.json"));
    for (const json& kept : report["campaign"]["kept"]) commands[kept["member"]] = kept["command"];
  }

  test::ProgramResult shell(const std::string& command) const {
    return test::run_program("/bin/sh", {"-c", command}, {.folder = folder.path()});
  }
  /// Of a command, what stands behind each `--set`.
  std::vector<std::string> settings_in(const std::string& command) const {
    std::istringstream words(shell("printf '%s\\n' " + command).out);
    std::vector<std::string> settings;
    bool is_setting = false;
    for (std::string word; std::getline(words, word); is_setting = word == "--set")
      if (is_setting) settings.push_back(word);
    return settings;
  }
  void expect_row(std::size_t member, const std::map<std::string, double>& outputs) const {
    for (const auto& [name, value] : outputs)
      EXPECT_NEAR(column(table, name).at(member), value, 1e-12) << member << " " << name;
  }

  test::TemporaryFolder folder;
  std::string table;
  std::map<std::size_t, std::string> commands;  // by member
};

TEST_F(CampaignMembers, FlyThroughTheLibraryToTheirRows) {
  ASSERT_EQ(commands.size(), 8U);
  for (const auto& [member, command] : commands)
    expect_row(member,
               flown_alone(folder.path() + "/reduced.yaml", settings_in(command)).reduced());
}

TEST_F(CampaignMembers, FlyByTheirPrintedCommandsToTheirRows) {
  const std::string command = commands.at(517);
  ASSERT_THAT(command, testing::StartsWith("scsim "));
  const test::ProgramResult alone =
      shell(TWINCRAFT_SCSIM + command.substr(5) + " -o alone --no-timing --engine bsm");
  ASSERT_EQ(alone.exit_code, 0) << alone.err;
  const std::string csv = folder.read("alone/bsm.csv");
  Samples samples{column(csv, "t [s]"),
                  column(csv, "wing_p.1.position [rad]"),
                  column(csv, "wing_m.1.position [rad]"),
                  {},
                  column(csv, "omega_BN_B.z [rad/s]")};
  const std::vector<double> x = column(csv, "omega_BN_B.x [rad/s]"),
                            y = column(csv, "omega_BN_B.y [rad/s]");
  for (std::size_t i = 0; i < x.size(); ++i)
    samples.turning.push_back(std::hypot(x[i], y[i], samples.rate_z[i]));
  expect_row(517, samples.reduced());
}

}  // namespace
}  // namespace twincraft
