/* Attitude feedback on three reaction wheels, through the C interface.
 *
 *   mrp_feedback models/quickstart.yaml
 *
 * A proportional-derivative law in modified Rodrigues parameters slows the rotation of the hub and
 * turns it back towards its initial attitude. It acts ten times a second for half a minute. Every
 * tick prints the time and the state, exactly, as hexadecimal numbers; examples/cpp and
 * examples/python hold the same law and print the same bytes. Compile with -ffp-contract=off to
 * get them on processors with fused multiply-add. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <twincraft.h>

enum { WHEELS = 3 };
static const char* const torque_names[WHEELS] = {"rw_x.torque", "rw_y.torque", "rw_z.torque"};
static const double axes[WHEELS][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}; /* as in the spec */
static const double K = 3.0;                                             /* [N m] */
static const double P = 12.0;                                            /* [N m s] */

typedef struct Controller {
  tc_simulation* simulation;
  size_t attitude, rate;  /* where q_BN and omega_BN_B begin in the outputs */
  size_t torques[WHEELS]; /* inputs */
  double* state;
  size_t states;
} Controller;

static void fail(const char* error) {
  fprintf(stderr, "%s\n", error);
  exit(EXIT_FAILURE);
}

static size_t find(tc_model* model, tc_signals which, const char* name) {
  size_t index = 0;
  if (tc_model_find(model, which, name, &index, NULL) != TC_OK) fail(tc_model_error(model));
  return index;
}

/* All digits of a double, as Python's float.hex() and, but for zero, C's "%.13a" print it. */
static void print_exactly(double x) {
  if (x == 0.0)
    fputs(signbit(x) ? "-0x0.0p+0" : "0x0.0p+0", stdout);
  else
    printf("%.13a", x);
}

static void print_line(const Controller* c, double time) {
  size_t i;
  if (tc_simulation_state(c->simulation, c->state, c->states) != TC_OK)
    fail(tc_simulation_error(c->simulation));
  print_exactly(time);
  for (i = 0; i < c->states; ++i) {
    putchar(' ');
    print_exactly(c->state[i]);
  }
  putchar('\n');
}

/* torque_B = K sigma_BN + P omega_BN_B is asked of the wheels, so the hub gets the opposite. */
static int control(void* context, double time, const double* outputs, double* inputs) {
  const Controller* c = context;
  const double* q_BN = outputs + c->attitude;
  const double* omega_BN_B = outputs + c->rate;
  double torque_B[3]; /* [N m] */
  int i;
  print_line(c, time);
  for (i = 0; i < 3; ++i) {
    const double sigma_BN = q_BN[1 + i] / (1.0 + q_BN[0]);
    torque_B[i] = K * sigma_BN + P * omega_BN_B[i];
  }
  for (i = 0; i < WHEELS; ++i)
    inputs[c->torques[i]] =
        axes[i][0] * torque_B[0] + axes[i][1] * torque_B[1] + axes[i][2] * torque_B[2];
  return 0;
}

int main(int argc, char** argv) {
  tc_model* model = NULL;
  tc_control law = {0};
  Controller c;
  double reached = 0.0;
  int i;
  if (argc != 2) fail("usage: mrp_feedback SPEC");
  if (tc_model_load(argv[1], NULL, &model) != TC_OK) fail(tc_model_error(model));
  if (tc_simulation_new(model, TC_BSM, &c.simulation) != TC_OK)
    fail(tc_simulation_error(c.simulation));
  c.attitude = find(model, TC_OUTPUTS, "q_BN");
  c.rate = find(model, TC_OUTPUTS, "omega_BN_B");
  for (i = 0; i < WHEELS; ++i) c.torques[i] = find(model, TC_INPUTS, torque_names[i]);
  c.states = tc_model_count(model, TC_STATES);
  c.state = malloc(c.states * sizeof *c.state);
  if (c.state == NULL) fail("out of memory");

  law.size = sizeof law;
  law.every = 0.1; /* [s] */
  law.controller = control;
  law.context = &c;
  law.driven = c.torques;
  law.driven_count = WHEELS;
  if (tc_simulation_run_until(c.simulation, 30.0, &law, &reached) != TC_OK)
    fail(tc_simulation_error(c.simulation));
  print_line(&c, reached);

  free(c.state);
  tc_simulation_free(c.simulation);
  tc_model_free(model);
  return 0;
}
