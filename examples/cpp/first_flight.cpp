// Fly a spec for a minute and print where it ended: first_flight models/quickstart.yaml
#include <twincraft/simulation.h>

#include <cstdio>

int main(int argc, char** argv) try {
  if (argc != 2) return 2;
  const auto model = twincraft::Model::load(argv[1]);
  twincraft::Simulation simulation(model);
  simulation.run_until(60.0);
  const std::vector<double> y = simulation.observe();
  for (std::size_t i = 0; i < y.size(); ++i)
    std::printf("%s %.17g\n", model.outputs()[i].name.c_str(), y[i]);
} catch (const twincraft::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
