/* Goes through the library, faults included, and fails if that set a signal handler. What it may
 * have printed, or written into the working folder, the caller sees. */
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <twincraft.h>

enum { SIGNALS = 32 };

static void read_handlers(struct sigaction* all) {
  int i;
  memset(all, 0, SIGNALS * sizeof *all);
  for (i = 1; i < SIGNALS; ++i) sigaction(i, NULL, &all[i]);
}

static int fly(const tc_model* model, tc_engine engine, double torque, double until) {
  tc_simulation* simulation = NULL;
  int status = tc_simulation_new(model, engine, &simulation);
  if (status == TC_OK) status = tc_simulation_drive(simulation, 0, torque);
  if (status == TC_OK) status = tc_simulation_run_until(simulation, until, NULL, NULL);
  tc_simulation_free(simulation);
  return status;
}

int main(int argc, char** argv) {
  struct sigaction before[SIGNALS], after[SIGNALS];
  const char broken[] = "format: spacecraft/1\nname: broken\nhub: {mass: -1}\n";
  tc_model *model = NULL, *none = NULL;
  tc_run* run = NULL;
  int i, engine;
  if (argc != 2) return 10;
  read_handlers(before);
  if (tc_model_loads(broken, strlen(broken), NULL, &none) != TC_SPEC) return 11;
  tc_model_free(none);
  if (tc_model_load("no such file", NULL, &none) != TC_FILE) return 12;
  tc_model_free(none);
  if (tc_model_load(argv[1], NULL, &model) != TC_OK) return 13;
  for (engine = TC_BSM; engine <= TC_MUJOCO; ++engine) {
    if (fly(model, (tc_engine)engine, 0.01, 5.0) != TC_OK) return 14;
    if (fly(model, (tc_engine)engine, 1e300, 5.0) != TC_NUMERICAL) return 15;
  }
  if (tc_model_prove(model, NULL, &run) != TC_OK || !tc_run_passes(run)) return 16;
  tc_run_free(run);
  if (tc_model_run(model, NULL, &run) != TC_OK) return 17;
  tc_run_free(run);
  tc_model_free(model);
  read_handlers(after);
  for (i = 1; i < SIGNALS; ++i)
    if (before[i].sa_handler != after[i].sa_handler) return 100 + i;
  return 0;
}
