/* Twincraft's vehicles for programs: load a spec, fly it with either engine or both, drive it from
 * outside. C99, and the whole stable interface of libtwincraft; twincraft/simulation.h says the
 * same in C++.
 *
 * Handles. Every function that makes something gives a handle, which its `_free` takes back; NULL
 * is freed without effect. A handle owns all that it needs: a simulation outlives the model it was
 * made of. Texts that a handle returns are UTF-8 and stay until the next call that asks the same
 * handle for a text of that kind, or until it is freed.
 *
 * Faults. A function that can fail returns a tc_status. On a fault the handle is as it was before,
 * and tc_*_error() of the handle says what happened, with the near miss where a name is unknown.
 * A function that makes a handle gives one also when it fails, unless memory ran out, so that it
 * can be asked; such a handle can only be asked and freed: everything else returns TC_USAGE.
 *
 * Threads. A model may be used by any number of threads at once, but for the texts of its faults.
 * Another handle that is in use by one thread refuses another's call with TC_BUSY. The library has
 * no global state, sets no signal handler and prints nothing.
 *
 * Numbers are SI and radians. Names of inputs, outputs and states are those of Twincraft's CSV
 * files: `rw_x.torque`, `omega_BN_B.x`, `wing_p.1.position`.
 */
#ifndef TWINCRAFT_H
#define TWINCRAFT_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define TC_API __attribute__((visibility("default")))
#else
#define TC_API
#endif

/* The interface that this header describes; tc_abi_version() is that of the library. A library of
 * the same major number (the thousands) and no lower a version serves this header. */
#define TC_ABI_VERSION 1000

TC_API int tc_abi_version(void);
/* Of the product: `0.1.0`. */
TC_API const char* tc_version(void);

/* The first five are the exit codes of the programs. */
typedef enum tc_status {
  TC_OK = 0,
  TC_SPEC = 1,      /* the spec has errors: tc_model_diagnostics() */
  TC_USAGE = 2,     /* an unknown name, a value that is not finite or of another size or unit */
  TC_FILE = 3,      /* cannot be read or written */
  TC_NUMERICAL = 4, /* the motion is no longer finite: tc_simulation_failure() */
  TC_SNAPSHOT = 5,  /* bytes of another vehicle, engine or version, or damaged */
  TC_BUSY = 6,      /* in use by another thread */
  TC_MEMORY = 7,
  TC_INTERNAL = 8,   /* a bug of the library */
  TC_INTERRUPTED = 9 /* by tc_poll */
} tc_status;

/* Asked now and then, at the end of a step, from the thread that called the library; not 0: end
 * with TC_INTERRUPTED, with everything usable. */
typedef int (*tc_poll)(void* context);

typedef enum tc_engine { TC_BSM = 0, TC_MUJOCO = 1 } tc_engine;
/* Its word in specs, flags, files and reports: `bsm`, `mujoco`. */
TC_API const char* tc_engine_name(tc_engine engine);

/* ---- Model: a compiled spec ---- */

typedef struct tc_model tc_model;

typedef struct tc_load_options {
  size_t size;            /* sizeof(tc_load_options) */
  const char* const* set; /* `PATH=VALUE`, as the programs' --set */
  size_t set_count;
  const char* name; /* what diagnostics call a text; NULL: `<string>` */
} tc_load_options;

/* Compile a file. `options` may be NULL. TC_SPEC, TC_USAGE (a `set` that is no PATH=VALUE),
 * TC_FILE. */
TC_API tc_status tc_model_load(const char* path, const tc_load_options* options, tc_model** model);
/* Compile a text of `length` bytes; `extends` is looked for from the current folder. */
TC_API tc_status tc_model_loads(const char* text, size_t length, const tc_load_options* options,
                                tc_model** model);
TC_API void tc_model_free(tc_model* model);
/* The last fault of this handle as the programs print it; empty: none. */
TC_API const char* tc_model_error(const tc_model* model);
/* What the compiler said, warnings too, as the document of `--diagnostics json`. */
TC_API const char* tc_model_diagnostics(const tc_model* model);

typedef enum tc_text {
  TC_NAME = 0,     /* the spec's name */
  TC_DIGEST = 1,   /* SHA-256 of TC_RESOLVED, hexadecimal */
  TC_MJCF = 2,     /* NAME.xml; empty where MuJoCo cannot load it */
  TC_ASSEMBLY = 3, /* NAME.bsm.json */
  TC_RESOLVED = 4  /* NAME.resolved.yaml: it compiles to the same model, without other files */
} tc_text;
/* `length` may be NULL. */
TC_API const char* tc_model_text(const tc_model* model, tc_text which, size_t* length);

typedef enum tc_signals {
  TC_INPUTS = 0,
  TC_OUTPUTS = 1, /* the CSV's columns without time */
  TC_STATES = 2   /* positions, then rates: the same for both engines */
} tc_signals;
TC_API size_t tc_model_count(const tc_model* model, tc_signals which);
/* NULL beyond the last. */
TC_API const char* tc_model_signal_name(const tc_model* model, tc_signals which, size_t index);
TC_API const char* tc_model_signal_unit(const tc_model* model, tc_signals which, size_t index);
/* In words, of the signal that the number is of: `hub rate relative to inertial axes, hub axes`. */
TC_API const char* tc_model_signal_meaning(const tc_model* model, tc_signals which, size_t index);
/* The index of a name, or of the first number of a vector's name, and how many numbers it has;
 * `count` may be NULL. TC_USAGE. */
TC_API tc_status tc_model_find(tc_model* model, tc_signals which, const char* name, size_t* index,
                               size_t* count);
/* What a number with a unit, `10 mN m`, is in the unit of an input. TC_USAGE. */
TC_API tc_status tc_model_read_input(tc_model* model, size_t input, const char* text,
                                     double* value);
TC_API int tc_model_degrees_of_freedom(const tc_model* model);
TC_API double tc_model_step(const tc_model* model);     /* simulation.step [s] */
TC_API double tc_model_duration(const tc_model* model); /* simulation.duration [s] */
/* At t = 0: mass [kg], centre of mass from B [m] and inertia about it [kg m2], B axes, by rows. */
TC_API tc_status tc_model_mass_properties(tc_model* model, double* mass, double center_of_mass[3],
                                          double inertia[9]);

/* ---- Simulation: one engine on its way ---- */

typedef struct tc_simulation tc_simulation;

/* At t = 0. TC_USAGE: the engine cannot fly this model. */
TC_API tc_status tc_simulation_new(const tc_model* model, tc_engine engine,
                                   tc_simulation** simulation);
/* Another one that goes on from the same instant to the same bytes. */
TC_API tc_status tc_simulation_copy(tc_simulation* simulation, tc_simulation** copy);
TC_API void tc_simulation_free(tc_simulation* simulation);
TC_API const char* tc_simulation_error(const tc_simulation* simulation);
/* After TC_NUMERICAL: where it stands, the last good step end [s], and the coordinate that failed,
 * empty where none did. */
TC_API tc_status tc_simulation_failure(const tc_simulation* simulation, double* time,
                                       const char** coordinate);
/* `poll` may be NULL: no more. */
TC_API tc_status tc_simulation_set_poll(tc_simulation* simulation, tc_poll poll, void* context);

TC_API double tc_simulation_time(const tc_simulation* simulation);
/* `count` numbers, which must be tc_model_count() of the kind. What is read does not move it. */
TC_API tc_status tc_simulation_state(tc_simulation* simulation, double* state, size_t count);
TC_API tc_status tc_simulation_observe(tc_simulation* simulation, double* outputs, size_t count);
/* What acts now, driven or by schedule. */
TC_API tc_status tc_simulation_inputs(tc_simulation* simulation, double* inputs, size_t count);
/* Go on from another state; what rounding left over of earlier steps is dropped. */
TC_API tc_status tc_simulation_set_state(tc_simulation* simulation, const double* state,
                                         size_t count);

/* Hold an input at a value from now on, in place of its schedule. A thruster whose tank has run
 * empty stays at 0. */
TC_API tc_status tc_simulation_drive(tc_simulation* simulation, size_t input, double value);
/* The same for inputs `first` to `first + count - 1`; all or none. */
TC_API tc_status tc_simulation_drive_many(tc_simulation* simulation, size_t first,
                                          const double* values, size_t count);
/* A number with a unit: `10 mN m`. */
TC_API tc_status tc_simulation_drive_text(tc_simulation* simulation, size_t input,
                                          const char* value);
/* Give an input back to its schedule. */
TC_API tc_status tc_simulation_release(tc_simulation* simulation, size_t input);
TC_API int tc_simulation_is_driven(const tc_simulation* simulation, size_t input);

/* To the `count`-th next point of the grid k * simulation.step; inputs that change on the way are
 * met. TC_NUMERICAL leaves it at the last good step end. @pre count > 0 */
TC_API tc_status tc_simulation_step(tc_simulation* simulation, size_t count);

/* At every tick start + k * every, the end left out, `stop` is asked and then `controller`; at the
 * end `stop` alone. Both may call functions of the same handle that do not move it. */
typedef struct tc_control {
  size_t size;  /* sizeof(tc_control) */
  double every; /* [s]; 0: every step end */
  void* context;
  /* `inputs`: all of them as they act; the entries named by `driven` are driven with what it leaves
   * there. Not 0: end here with TC_INTERRUPTED. */
  int (*controller)(void* context, double time, const double* outputs, double* inputs);
  const size_t* driven;
  size_t driven_count;
  int (*stop)(void* context, double time, const double* outputs); /* not 0: enough */
} tc_control;

/* To exactly `time` [s], or to where `stop` said so: TC_OK, and `*reached` says where. Now: nothing
 * is flown. TC_USAGE: in the past or not finite. `control` and `reached` may be NULL. */
TC_API tc_status tc_simulation_run_until(tc_simulation* simulation, double time,
                                         const tc_control* control, double* reached);

/* All that the motion from here on depends on, held inputs too, as bytes for any process that runs
 * the same version. `*size` becomes their number; they are written where `capacity` holds them. */
TC_API tc_status tc_simulation_snapshot(tc_simulation* simulation, void* bytes, size_t capacity,
                                        size_t* size);
TC_API tc_status tc_simulation_restore(tc_simulation* simulation, const void* bytes, size_t size);
/* As just made. */
TC_API tc_status tc_simulation_reset(tc_simulation* simulation);

/* ---- Twin: both engines in lock step ---- */

typedef struct tc_twin tc_twin;

/* `lead`: the engine whose outputs controllers see and whose inputs both get. */
TC_API tc_status tc_twin_new(const tc_model* model, tc_engine lead, tc_twin** twin);
TC_API tc_status tc_twin_copy(tc_twin* twin, tc_twin** copy);
TC_API void tc_twin_free(tc_twin* twin);
TC_API const char* tc_twin_error(const tc_twin* twin);
TC_API tc_status tc_twin_failure(const tc_twin* twin, double* time, const char** coordinate);
TC_API tc_status tc_twin_set_poll(tc_twin* twin, tc_poll poll, void* context);
/* One of the two, to be asked and driven: the twin's own, which moves it and frees it. A call that
 * would move it returns TC_USAGE. */
TC_API tc_simulation* tc_twin_simulation(tc_twin* twin, tc_engine engine);
TC_API double tc_twin_time(const tc_twin* twin);
/* As the functions of a simulation; inputs are driven and released in both. */
TC_API tc_status tc_twin_drive_many(tc_twin* twin, size_t first, const double* values,
                                    size_t count);
TC_API tc_status tc_twin_drive_text(tc_twin* twin, size_t input, const char* value);
TC_API tc_status tc_twin_release(tc_twin* twin, size_t input);
TC_API tc_status tc_twin_step(tc_twin* twin, size_t count);
TC_API tc_status tc_twin_run_until(tc_twin* twin, double time, const tc_control* control,
                                   double* reached);
/* The same with a controller for each engine, that sees its outputs and drives it alone. */
TC_API tc_status tc_twin_run_each_until(tc_twin* twin, double time, const tc_control* bsm,
                                        const tc_control* mujoco, double* reached);
TC_API tc_status tc_twin_snapshot(tc_twin* twin, void* bytes, size_t capacity, size_t* size);
TC_API tc_status tc_twin_restore(tc_twin* twin, const void* bytes, size_t size);
TC_API tc_status tc_twin_reset(tc_twin* twin);
/* How far the engines are apart, over all step ends so far: `agreement` of report.json, with `now`
 * beside `max`, as JSON. It begins anew with what a snapshot brings. */
TC_API const char* tc_twin_disagreement(tc_twin* twin);

/* ---- Batch: many of one vehicle, by the analytic engine ---- */

typedef struct tc_batch tc_batch;

/* `count` members, all at t = 0. `threads` 0: as many as there are cores; the same bytes for any
 * number. */
TC_API tc_status tc_batch_new(const tc_model* model, size_t count, size_t threads,
                              tc_batch** batch);
TC_API void tc_batch_free(tc_batch* batch);
TC_API const char* tc_batch_error(const tc_batch* batch);
TC_API tc_status tc_batch_set_poll(tc_batch* batch, tc_poll poll, void* context);
TC_API size_t tc_batch_count(const tc_batch* batch);
TC_API double tc_batch_time(const tc_batch* batch);
/* A row per member, in the order of the model's states, outputs or inputs; `size` is the number of
 * all entries. A member that has failed has NaN in its state and outputs. */
TC_API tc_status tc_batch_states(tc_batch* batch, double* rows, size_t size);
TC_API tc_status tc_batch_outputs(tc_batch* batch, double* rows, size_t size);
TC_API tc_status tc_batch_inputs(tc_batch* batch, double* rows, size_t size);
/* Start from these states at the batch's time; one row serves all members. A member that had failed
 * flies again. */
TC_API tc_status tc_batch_set_states(tc_batch* batch, const double* rows, size_t size);
/* Drive every input from now on; one row serves all members. */
TC_API tc_status tc_batch_drive(tc_batch* batch, const double* rows, size_t size);
/* Give all inputs of all members back to their schedules. */
TC_API tc_status tc_batch_release(tc_batch* batch);
/* `count` points of the grid on. A member that fails ends alone. @pre count > 0 */
TC_API tc_status tc_batch_step(tc_batch* batch, size_t count);
/* 0, or TC_NUMERICAL of a member that has failed. */
TC_API tc_status tc_batch_status(tc_batch* batch, int32_t* status, size_t count);
/* Why a member has failed; empty: it has not. */
TC_API const char* tc_batch_reason(const tc_batch* batch, size_t member);

/* ---- Runs: what scsim and sccompile --check say ---- */

typedef struct tc_run tc_run;

typedef enum tc_engines { TC_BOTH = 0, TC_BSM_ALONE = 1, TC_MUJOCO_ALONE = 2 } tc_engines;

typedef struct tc_run_options {
  size_t size; /* sizeof(tc_run_options) */
  tc_engines engines;
  int trials;   /* timed trials per engine; 0: no timing */
  int jobs;     /* members of a study at a time; 0: all cores */
  tc_poll poll; /* may be NULL */
  void* context;
} tc_run_options;

/* What `scsim SPEC` does: a verdict that is not `agree` is no fault. `options` may be NULL: both
 * engines, no timing. A poll may end it: the verdict is `interrupted` and the run says what was
 * computed, or TC_INTERRUPTED where nothing was. */
TC_API tc_status tc_model_run(const tc_model* model, const tc_run_options* options, tc_run** run);
/* What `sccompile SPEC --check` does: are the two targets one machine? Of the options the poll
 * alone has a meaning; TC_INTERRUPTED. */
TC_API tc_status tc_model_prove(const tc_model* model, const tc_run_options* options,
                                tc_run** proof);
/* What `scsim attribute SPEC` does: why do the engines differ? Of the options `jobs`, variants at a
 * time, and the poll have a meaning; TC_INTERRUPTED. */
TC_API tc_status tc_model_attribute(const tc_model* model, const tc_run_options* options,
                                    tc_run** attribution);
TC_API void tc_run_free(tc_run* run);
TC_API const char* tc_run_error(const tc_run* run);
/* `agree`, `disagree`, `unresolved`, `not_judged`, `failed`, `interrupted`; of a proof `proved` or
 * `refuted`; of an attribution `explained` or `unexplained`. */
TC_API const char* tc_run_verdict(const tc_run* run);
/* Whether the program would end with 0. */
TC_API int tc_run_passes(const tc_run* run);
/* report.json, and what the program prints. */
TC_API const char* tc_run_json(const tc_run* run);
TC_API const char* tc_run_text(const tc_run* run);
/* Samples of an engine, of a study the first member's; 0: it did not fly. */
TC_API size_t tc_run_samples(const tc_run* run, tc_engine engine);
/* `rows` by 1 + outputs numbers: time [s], then the outputs. */
TC_API tc_status tc_run_read(tc_run* run, tc_engine engine, double* rows, size_t size);
/* Write what `scsim -o FOLDER` writes. TC_FILE. */
TC_API tc_status tc_run_save(tc_run* run, const char* folder);

/* ---- Campaigns: what scsim says of a spec with a `campaign` ---- */

/* Members that both engines fly, as `--engine` has it. */
typedef enum tc_twins {
  TC_TWINS_PLANNED = 0, /* those of `campaign.twin` and `campaign.keep` */
  TC_TWINS_ALL = 1,     /* `--engine both` */
  TC_TWINS_NONE = 2     /* `--engine bsm` */
} tc_twins;

typedef struct tc_campaign_options {
  size_t size; /* sizeof(tc_campaign_options) */
  tc_twins twins;
  int jobs;           /* members at a time; 0: all cores */
  const char* isa;    /* as `--isa`; NULL: `auto` */
  const char* folder; /* files are written here while it is flown; NULL: into a temporary one */
  size_t shard;       /* 1 to `shards`: fly this part alone */
  size_t shards;      /* 0: fly all members */
  int resume;         /* not 0: keep the members that `folder` has */
  /* Shards that were flown elsewhere, TC_CAMPAIGN_RECORDS of each: their members are taken from
   * there, the others are flown. */
  const char* const* records;
  const size_t* record_sizes;
  size_t record_count;
  tc_poll poll; /* may be NULL */
  void* context;
} tc_campaign_options;

/* What `scsim SPEC [-o FOLDER]` does of a spec with a campaign; tc_run_save() writes its files,
 * tc_run_json() is its report, and a verdict is no fault. A shard has records and no table, no
 * report and no files. `options` may be NULL. A poll may end it: the verdict is `interrupted`, or
 * TC_INTERRUPTED where there is no table; what was flown is in `folder` for `resume`.
 * TC_SPEC: the spec has no campaign. TC_FILE: `folder` cannot be written, or it or `records` are of
 * another spec. */
TC_API tc_status tc_model_campaign(const tc_model* model, const tc_campaign_options* options,
                                   tc_run** campaign);
/* `campaign.members`; 0: there is no campaign. */
TC_API size_t tc_model_campaign_members(const tc_model* model);
/* A member of the model's campaign as a model of its own, without a campaign: the spec with what is
 * drawn for it. TC_SPEC: there is no campaign, or what is drawn is no vehicle. */
TC_API tc_status tc_model_member(const tc_model* model, size_t member, tc_model** drawn);
/* What the program would end with, TC_INTERRUPTED aside. */
TC_API int tc_campaign_exit_code(const tc_run* campaign);
/* The table: a row per member, rising; columns are the drawn numbers, the outputs, `seconds`. */
TC_API size_t tc_campaign_rows(const tc_run* campaign);
TC_API size_t tc_campaign_columns(const tc_run* campaign);
/* NULL beyond the last. */
TC_API const char* tc_campaign_column_name(const tc_run* campaign, size_t column);
TC_API const char* tc_campaign_column_unit(const tc_run* campaign, size_t column);
/* A number per row, SI; NaN where there is none. */
TC_API tc_status tc_campaign_read(tc_run* campaign, size_t column, double* values, size_t size);
/* Of a row: its member, its verdict and why it is broken, stopped or failed; any may be NULL. */
TC_API tc_status tc_campaign_row(tc_run* campaign, size_t row, size_t* member, const char** verdict,
                                 const char** reason);
/* The flown members, at most `capacity`, that break the requirement on an output by most or come
 * nearest to it, worst first; of an output without one the largest. `by` NULL: the output of
 * `campaign.keep`, else the first with a requirement, else the first. TC_USAGE: an unknown one. */
TC_API tc_status tc_campaign_worst(tc_run* campaign, const char* by, size_t* members,
                                   size_t capacity, size_t* count);

typedef enum tc_campaign_texts {
  TC_CAMPAIGN_HEADER = 0, /* what all rows have in common, JSON: the columns with their meaning */
  TC_CAMPAIGN_CSV = 1,    /* campaign.csv */
  TC_CAMPAIGN_RECORDS = 2 /* of a shard, or of all: what `records` of the options takes */
} tc_campaign_texts;
/* Empty where it has none. `length` may be NULL. */
TC_API const char* tc_campaign_text(tc_run* campaign, tc_campaign_texts which, size_t* length);

#ifdef __cplusplus
}
#endif

#endif
