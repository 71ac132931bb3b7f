/* Fly a spec for a minute and print where it ended: first_flight models/quickstart.yaml */
#include <stdio.h>
#include <stdlib.h>
#include <twincraft.h>

int main(int argc, char** argv) {
  tc_model* model = NULL;
  tc_simulation* simulation = NULL;
  size_t i, count;
  double* y;
  if (argc != 2) return 2;
  if (tc_model_load(argv[1], NULL, &model) != TC_OK) {
    fprintf(stderr, "%s\n", tc_model_error(model));
    return 1;
  }
  count = tc_model_count(model, TC_OUTPUTS);
  y = malloc(count * sizeof *y);
  if (tc_simulation_new(model, TC_BSM, &simulation) != TC_OK ||
      tc_simulation_run_until(simulation, 60.0, NULL, NULL) != TC_OK ||
      tc_simulation_observe(simulation, y, count) != TC_OK) {
    fprintf(stderr, "%s\n", tc_simulation_error(simulation));
    return 1;
  }
  for (i = 0; i < count; ++i)
    printf("%s %.17g\n", tc_model_signal_name(model, TC_OUTPUTS, i), y[i]);
  free(y);
  tc_simulation_free(simulation);
  tc_model_free(model);
  return 0;
}
