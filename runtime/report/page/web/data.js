// What the program put into the page, and its types. Nothing here is trusted to be markup: it
// reaches the document as text alone.

/** @typedef {{name: string, bsm?: string, mujoco?: string, values?: string}} Series */
/** @typedef {{unit: string, tolerance: number | null, metric?: string, series: Series[]}} Difference */
/** @typedef {{title: string, unit: string, logarithmic?: boolean, series: Series[],
 *             difference?: Difference | null}} Figure */
/** @typedef {{samples: number, points: number, thinned: boolean,
 *             times: {bsm?: string, mujoco?: string, difference?: string},
 *             figures: Figure[]}} Histories */
/** @typedef {{site: string, is_thruster: boolean, force: number[][]}} Force */
/** @typedef {{joints: string[], wheels: string[], forces: Force[], gravity: boolean,
 *             point_mass: boolean,
 *             frames: {bsm?: string, mujoco?: string}}} Replay */
/** @typedef {{description: string, vehicle: string, plan: string, depletion: string,
 *             words: Record<string, {label: string, unit: string}>, is_study: boolean,
 *             is_work_precision: boolean, members_run: number, members_planned: number,
 *             left_out?: Record<string, string>, report: any, histories: Histories, replay: Replay | null, mjcf: string,
 *             resolved: string}} Page */

/** @type {Page} */
const page = JSON.parse(/** @type {HTMLElement} */ (document.getElementById("data")).textContent || "{}");

/** The engines, in the order in which they are drawn and named. */
const engines = /** @type {const} */ ([
  { key: "bsm", label: "BSM" },
  { key: "mujoco", label: "MuJoCo" },
]);

/**
 * A column of little-endian doubles.
 * @param {string | undefined} text base64
 */
function doubles(text) {
  const bytes = Uint8Array.from(atob(text || ""), (c) => c.charCodeAt(0));
  return new Float64Array(bytes.buffer);
}

/** @param {string} key of a metric */
function words(key) {
  return page.words[key] || { label: key, unit: "" };
}
