// A changed spec reads again only what its changes touch. It must be the spec that one gets by
// reading all of it: the same bytes, or the same faults at the same places.
#include <gtest/gtest.h>

#include <filesystem>

#include "compiler/emit/target.h"
#include "compiler/pipeline.h"
#include "compiler/syntax/load.h"
#include "tests/compiler/schema_reading.h"

namespace twincraft {
namespace {

const Wanted kWanted{kMjcf, kAssemblyJson, kResolved};

struct Outcome {
  std::vector<std::string> faults;
  std::map<std::string, std::string> texts;  // by target
  std::vector<std::string> settings;         // with what they came to
};

Outcome outcome_of(const std::optional<Bundle>& bundle, const Diagnostics& diagnostics) {
  Outcome outcome;
  for (const std::string& line : lines_of(diagnostics)) outcome.faults.push_back(line);
  for (std::size_t i = 0; i < diagnostics.all().size(); ++i) {
    const Source* source = diagnostics.all()[i].span.source;
    outcome.faults[i] += fmt::format(" in {}", source == nullptr ? "" : source->name());
  }
  if (!bundle) return outcome;
  for (const auto& [name, emitted] : bundle->emitted) outcome.texts[name] = emitted.text;
  for (const Setting& setting : bundle->settings)
    outcome.settings.push_back(
        fmt::format("{} {} {}", setting.path, setting.text, setting.value ? *setting.value : -1.0));
  return outcome;
}

/// By reading all of it.
Outcome compiled_whole(const std::string& file, const std::vector<std::string>& changes) {
  Diagnostics diagnostics;
  const LoadResult loaded = load_spec({file, changes}, diagnostics);
  std::optional<Bundle> bundle;
  if (loaded.spec) bundle = loaded.spec->compile(kWanted, diagnostics);
  return outcome_of(bundle, diagnostics);
}

Outcome compiled_changed(const LoadedSpec& spec, const std::vector<std::string>& changes) {
  Diagnostics diagnostics;
  const std::optional<Bundle> bundle = spec.variant(changes, kWanted, diagnostics);
  return outcome_of(bundle, diagnostics);
}

LoadedSpec loaded(const std::string& file) {
  Diagnostics diagnostics;
  LoadResult result = load_spec({file, {}}, diagnostics);
  if (!result.spec) throw std::runtime_error(file + " has errors");
  return *std::move(result.spec);
}

void expect_same(const std::string& file, const LoadedSpec& spec,
                 const std::vector<std::string>& changes) {
  const Outcome whole = compiled_whole(file, changes);
  const Outcome changed = compiled_changed(spec, changes);
  const std::string what = fmt::format("{} with {}", file, changes.front());
  EXPECT_EQ(whole.faults, changed.faults) << what;
  EXPECT_EQ(whole.texts, changed.texts) << what;
  EXPECT_EQ(whole.settings, changed.settings) << what;
}

/// Spec paths of all values below `node`, the lists and maps among them.
void collect_paths(const Node& node, const std::string& path, std::vector<std::string>& paths) {
  const std::string prefix = path.empty() ? path : path + ".";
  if (!path.empty()) paths.push_back(path);
  for (std::size_t i = 0; node.is_map() && i < node.items.size(); ++i)
    collect_paths(node.items[i], prefix + node.keys[i].name, paths);
  for (std::size_t i = 0; node.is_list() && i < node.items.size(); ++i) {
    const Node* name = node.items[i].find("name");
    if (name != nullptr) collect_paths(node.items[i], prefix + name->scalar, paths);
  }
}

std::vector<std::string> paths_of(const std::string& file) {
  Diagnostics diagnostics;
  const Source source(file, read_file(file).text);
  std::vector<std::string> paths;
  collect_paths(parse(source, diagnostics).value(), {}, paths);
  return paths;
}

std::string model(const std::string& name) { return TWINCRAFT_ROOT "/models/" + name; }

class ChangedModel : public testing::TestWithParam<const char*> {};

TEST_P(ChangedModel, IsWhatReadingAllOfItGives) {
  const std::string file = model(GetParam());
  const LoadedSpec spec = loaded(file);
  const std::vector<std::string> paths = paths_of(file);
  ASSERT_GT(paths.size(), 10u);
  for (const std::string& path : paths) {
    // A number, one in the place of anything; a word; nothing; a map without keys.
    for (const char* value : {"1.25", "-2 deg", "wing_p", "null", "{}"})
      expect_same(file, spec, {fmt::format("{}={}", path, value)});
  }
}

INSTANTIATE_TEST_SUITE_P(Models, ChangedModel,
                         testing::Values("quickstart.yaml", "gallery/branched_arm.yaml",
                                         "gallery/rocket.yaml", "nesc/case_9a.yaml",
                                         "paper/flex_panels.yaml",
                                         "paper/variable_mass_orbit.yaml"));

TEST(ChangedSpec, MayHaveMoreOrFewerPartsThanItsBase) {
  const std::string file = model("quickstart.yaml");
  const LoadedSpec spec = loaded(file);
  const std::vector<std::vector<std::string>> all{
      {"initial.velocity=[1, 2, 3]"},                         // a key that the base leaves out
      {"engines.bsm.attitude=quaternion"},                    // in sections that it leaves out
      {"panels.wing_m=null"},                                 // a list gets shorter
      {"wheels.*.torque=null"},                               // back to the default
      {"wheels.rw_x.name=rw_a", "wheels.rw_y.name=rw_x"},     // names move
      {"wheels.rw_x.name=rw_y"},                              // one name twice
      {"panels.*.angle=45"},                                  // a warning that the base has not
      {"panels.wing_p.mass=40", "panels.wing_p.mass=50 kg"},  // the last one counts
      {"hub={mass: 5, inertia: [1, 1, 1]}", "hub.mass=6"},
      {"format=spacecraft/2"},
      {"drop=[rw_x]"},
      {"agreement=null", "simulation.step={per_period: 50, of: wing_p}"},
  };
  for (const std::vector<std::string>& changes : all) expect_same(file, spec, changes);
}

// The base says something while it is read, which every spec made of it has to say again.
TEST(ChangedSpec, RepeatsTheWarningsOfItsBase) {
  const std::string text =
      "format: spacecraft/1\nname: brick\nhub: {mass: 600 kg, inertia: [400, 380, 360]}\n"
      "panels: [{name: wing, hinge: {position: [1, 0, 0], axis: [0, 1, 0], outboard: [1, 0, 0]}, "
      "mass: 5, length: 2, inertia: {shape: bar}, stiffness: 10, angle: 45}]\n"
      "simulation: {integrator: rk4, step: 0.1 s, duration: 1 s, record: 0.5 s}\n";
  Diagnostics diagnostics;
  const LoadResult loaded = load_spec({"brick.yaml", {}, text}, diagnostics);
  ASSERT_TRUE(loaded.spec);
  Diagnostics of_variant;
  EXPECT_TRUE(loaded.spec->variant({"hub.mass=700"}, {}, of_variant));
  EXPECT_EQ(lines_of(of_variant), lines_of(diagnostics));
  EXPECT_FALSE(of_variant.all().empty());
}

}  // namespace
}  // namespace twincraft
