// Whether the step resolves the vehicle's own motion: what is fastest, what is lost, and which step
// would do.

/** @type {Record<string, string>} */
const ruleWords = {
  stability: "the method is unstable at this step", modal_error: "a mode's motion is lost",
  attitude: "the attitude is lost", probes: "steps are too coarse where they were tried",
  translation: "the path of the centre of mass is lost", rotation: "more than half a turn in a step",
  energy: "the motion's own energy is not kept", adaptive: "the error estimates of the steps add up to too much",
};

/** @param {number} part */
const percent = (part) => `${written(100 * part)} %`;

/** @param {any} fastest */
function fastestWords({ coordinate, rate_rad_s: rate, damping_ratio: damping, kind }) {
  const period = rate > 0 && kind !== "damped" ? `, a period of ${duration(2 * Math.PI / rate)}` : "";
  const damped = kind === "damped" && typeof damping === "number" ? `, damping ratio ${written(damping)}` : kind === "undamped" ? ", undamped" : "";
  return `${coordinate || kind}: ${written(rate, 4)} rad/s${period}${damped}`;
}

/** Rows of what is known; what is null has no row. @param {any} resolution */
function resolutionRows(resolution) {
  const { fastest, worst, attitude_error_deg: attitude, step_s: step, largest_stable_step_s: stable, advised_step_s: advised } = resolution;
  const known = (/** @type {unknown} */ value) => typeof value === "number";
  /** @type {[string, string][]} */
  const rows = [];
  if (resolution.rule) rows.push(["what failed first", ruleWords[resolution.rule] || resolution.rule]);
  if (fastest && known(fastest.rate_rad_s)) rows.push(["fastest motion", fastestWords(fastest)]);
  if (worst && known(worst.error_relative)) rows.push(["largest loss", `${worst.coordinate || "the vehicle"}: ${percent(worst.error_relative)} of its motion`]);
  if (known(attitude)) rows.push(["attitude error, estimated", `${written(attitude)} deg`]);
  if (known(step)) rows.push(["step", duration(step)]);
  if (known(stable)) rows.push(["largest stable step", duration(stable)]);
  if (known(advised)) rows.push(["advised step", duration(advised)]);
  if (known(resolution.advised_rk4_step_s)) rows.push(["advised step of rk4", duration(resolution.advised_rk4_step_s)]);
  if (known(resolution.advised_tolerance)) rows.push(["advised tolerance, relative", written(resolution.advised_tolerance)]);
  return rows;
}

/** Energy of the vehicle's own motion, its orbit's left aside. @param {any} energy */
function ownEnergyTable(energy) {
  const present = engines.filter((e) => typeof energy?.[e.key]?.relative === "number");
  if (present.length === 0) return null;
  return table("Energy of the vehicle's own motion",
    [textCell("energy of its own motion"), textCell("exchanged", "number"), textCell("drift", "number"), textCell("drift of what was exchanged", "number")],
    present.map(({ key, label }) => ({ label, kind: "engine-" + key, cells: [
      numberCell(energy[key].exchanged_J, "J"), numberCell(energy[key].drift_J, "J"), numberCell(energy[key].relative)] })));
}

/** @param {any} member @param {string[]} reasons */
function resolutionWords(member, reasons) {
  if (member.resolution.resolved) return html("p", {}, "The run resolves the vehicle's own motion.");
  return html("p", { class: "unresolved" }, memberVerdict(member) === "failed" && reasons.length === 0
    ? "The run stopped, and no mode of the vehicle explains it."
    : "The run does not resolve the vehicle's own motion: whether the engines agree says nothing.");
}

/** @param {any} member */
function resolutionSection(member) {
  const { resolution } = member;
  if (!resolution) return null;
  const reasons = (resolution.reasons || []).map(String);
  const rows = resolutionRows(resolution);
  return section("Resolution", resolutionWords(member, reasons),
    reasons.length > 0 ? html("ul", { class: "reasons" }, ...reasons.map((/** @type {string} */ text) => html("li", {}, ...withCommands(text)))) : null,
    rows.length > 0 ? html("dl", { class: "facts" }, ...rows.flatMap(([key, value]) => [html("dt", {}, key), html("dd", {}, value)])) : null,
    ...(resolution.remarks || []).map((/** @type {unknown} */ text) => note(`${String(text)}.`)),
    ownEnergyTable(resolution.energy));
}
