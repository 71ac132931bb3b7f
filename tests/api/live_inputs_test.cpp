// Every shipped model, both engines, every method: a run whose inputs are fed live, at the times at
// which its schedules change, has the bytes of the scheduled run.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "runtime/integrate/tableau.h"
#include "runtime/simulate/engines.h"
#include "runtime/simulate/flight.h"
#include "tests/support/compiled.h"

namespace twincraft {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> shipped_models() {
  std::vector<std::string> files;
  const fs::path root(TWINCRAFT_ROOT);
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / "models"))
    if (entry.path().extension() == ".yaml")
      files.push_back(fs::relative(entry.path(), root).string());
  std::ranges::sort(files);
  return files;
}

using State = std::vector<double>;

/// The times that matter here: a step after every change, of the first few.
std::vector<double> stops_of(const Model& model) {
  std::vector<double> stops = input_events(model);
  stops.resize(std::min<std::size_t>(stops.size(), 6));
  const double last = stops.empty() ? 0.0 : stops.back();
  stops.push_back(std::min(model.simulation.duration, last + 20.0 * model.simulation.step));
  return stops;
}

/// At most some hundred steps: bytes, not accuracy, are in question.
void shorten(Model& model) {
  const double span = stops_of(model).back();
  model.simulation.step = std::max(model.simulation.step, span / 400.0);
}

class LiveInputs : public testing::TestWithParam<std::string> {};

TEST_P(LiveInputs, HaveTheBytesOfTheSchedule) {
  Bundle bundle = test::compiled_file(GetParam());
  shorten(bundle.model);
  for (const EngineName& engine : kEngines) {
    if (!refusal_of(engine.kind, bundle.model).empty()) continue;
    for (const Method method :
         {Method::kEuler, Method::kRk2, Method::kRk4, Method::kRkf45, Method::kRkf78}) {
      bundle.model.simulation.method = method;
      const auto a = make_engine(engine.kind, bundle), b = make_engine(engine.kind, bundle);
      Flight scheduled(*a, bundle.model), live(*b, bundle.model);
      InputFeed schedule(bundle.model);
      const std::size_t ports = ports_of(bundle.model).size();
      const auto feed = [&](double time) {
        schedule.begin(time);
        for (std::size_t port = 0; port < ports; ++port) live.drive(port, schedule.value(port));
      };
      feed(0.0);
      try {
        for (const double stop : stops_of(bundle.model)) {
          scheduled.advance_to(stop);
          live.advance_to(stop);
          feed(stop);
        }
      } catch (const NumericalFailure&) {
        continue;  // Euler's method with so long a step
      }
      EXPECT_EQ(State(live.state().begin(), live.state().end()),
                State(scheduled.state().begin(), scheduled.state().end()))
          << engine.label << ", method " << static_cast<int>(method);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Of, LiveInputs, testing::ValuesIn(shipped_models()),
                         [](const auto& param_info) {
                           std::string name = param_info.param;
                           std::ranges::replace_if(
                               name, [](char c) { return std::isalnum(c) == 0; }, '_');
                           return name;
                         });

}  // namespace
}  // namespace twincraft
