// Hand-made report.json documents: what the page must show of results that are rare, or that take
// long to compute. The numbers are invented; the shapes are those of the format.
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { scratch } from "./support.mjs";

/** @param {number} max @param {number | null} tolerance */
export const metric = (max, tolerance = null, at_s = 1) =>
  ({ max, at_s, tolerance, pass: tolerance === null ? null : max <= tolerance });

/** A resolved run. */
export const resolved = () => ({
  resolved: true, rule: null,
  fastest: { coordinate: "wing_p.1", rate_rad_s: 2.1, damping_ratio: 0.05, kind: "damped" },
  worst: { coordinate: "wing_p.1", error_relative: 2e-7 }, attitude_error_deg: 1e-6,
  step_s: 0.02, largest_stable_step_s: 1.3, advised_step_s: null,
  energy: { bsm: { exchanged_J: 3.2, drift_J: 1e-9, relative: 3e-10 }, mujoco: { exchanged_J: 3.2, drift_J: 1e-9, relative: 3e-10 } },
  reasons: [],
});

/** A spring that the step does not follow. */
export const unresolved = () => ({
  resolved: false, rule: "modal_error",
  fastest: { coordinate: "w.1", rate_rad_s: 26.64, damping_ratio: 0, kind: "undamped" },
  worst: { coordinate: "w.1", error_relative: 0.33 }, attitude_error_deg: 0.012,
  step_s: 0.02, largest_stable_step_s: 0.106, advised_step_s: 0.005,
  energy: { bsm: { exchanged_J: 1.5, drift_J: 1.5, relative: 1 }, mujoco: { exchanged_J: 1.5, drift_J: 1.49, relative: 0.993 } },
  reasons: ["w.1 swings at 26.6 rad/s, undamped: rk4 at 0.02 s gives a period 12 steps and loses 33 % of its motion in 85 periods (limit 5 %)"],
  remarks: ["the orbit is not looked at"],
});

/** Makes the engines of a member stop. @param {any} member @param {number} t [s] */
export function fail(member, t) {
  member.verdict = "failed";
  for (const engine of Object.values(member.engines))
    Object.assign(engine, { status: "failed", reason: `the rate of w.1 is not finite at t = ${t} s`, t_end_s: t });
  return member;
}

/** The judged balances. @param {any} member @param {Record<string, number | null>} tolerances */
export function judgeConservation(member, tolerances) {
  member.conservation = Object.fromEntries(Object.entries(tolerances).map(([key, tolerance]) => {
    const engine = ["bsm", "mujoco"].reduce((a, b) => (member.engines[b].conservation[key] > member.engines[a].conservation[key] ? b : a));
    const { at_s, ...figure } = metric(member.engines[engine].conservation[key], tolerance);
    return [key, { ...figure, engine }];
  }));
  return member;
}

/** A report's page with other data in it, as if scsim had found them. @returns {string} its file */
export function altered(made, name, change) {
  const text = readFileSync(made.file, "utf8");
  const [, data] = text.match(/<script type="application\/json" id="data">([^]*?)<\/script>/);
  const shown = JSON.parse(data);
  change(shown);
  const file = join(scratch, `${name}.html`);
  writeFileSync(file, text.replace(data, () => JSON.stringify(shown).replaceAll("<", "\\u003c")));
  return file;
}

/** Turns a run's data into those of a study: every integrator at every step, the error of order
 *  `order`, the largest step unresolved. @param {any} shown */
export function makeStudy(shown, integrators = { rk4: 4, euler: 1 }, steps = [0.01, 0.02, 0.04, 0.08]) {
  const [first] = shown.report.members;
  const members = [], convergence = [];
  for (const [integrator, order] of Object.entries(integrators)) {
    const numbers = steps.map((_, i) => members.length + i);
    for (const step of steps) {
      const member = structuredClone(first);
      member.settings = { "simulation.integrator": integrator, "simulation.step": `${step} s` };
      Object.assign(member, step === steps.at(-1) ? { verdict: "unresolved", resolution: unresolved() } : { verdict: "agree", resolution: resolved() });
      members.push(member);
    }
    // What is unresolved lies far off the law of the others.
    const errors = steps.map((step, i) => (i === steps.length - 1 ? 30 : 1e-3 * step ** order));
    for (const engine of ["bsm", "mujoco"])
      convergence.push({ metric: "attitude_deg", reference: "torque_free", engine, set: "simulation.step",
        settings: { "simulation.integrator": integrator }, steps_s: steps, errors, members: numbers,
        orders: errors.slice(1).map((e, i) => Math.log(e / errors[i]) / Math.log(steps[i + 1] / steps[i])) });
  }
  Object.assign(shown, { is_study: true, members_run: members.length, members_planned: members.length });
  Object.assign(shown.report, { members, studies: { convergence, scaling: [], slopes: [] } });
}
