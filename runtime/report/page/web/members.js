// The members of a study, one row each. They are counted from 0, as in report.json and as their
// folders are.

/** The last steps of a path, as many as tell it from the others. @param {string} path
 *  @param {string[]} paths */
function shortPath(path, paths) {
  const steps = path.split(".");
  for (let n = 1; n < steps.length; n += 1) {
    const short = steps.slice(-n).join(".");
    if (paths.every((other) => other === path || !(`.${other}`).endsWith(`.${short}`))) return short;
  }
  return path;
}

/** `0006`; the first member's files lie beside the report. @param {number} index */
const folderOf = (index) => (index === 0 ? "." : String(index).padStart(4, "0"));

/** @param {any} member */
function memberVerdictCell(member) {
  const verdict = memberVerdict(member);
  const failed = failedEngines(member);
  const { word, kind } = verdictLooks[verdict];
  return textCell(verdict === "failed" && failed.length > 0 ? `${failed.map((e) => e.label).join(", ")} failed` : word, kind);
}

/** One engine's run against another run of its own: the first metric there is. @param {any} against */
function againstCell(against) {
  const [key] = Object.keys(against || {});
  return key === undefined ? textCell("–", "number") : numberCell(against[key].max, words(key).unit);
}

/** @param {any} value */
function settingText(value) {
  if (value === undefined) return "–";
  const text = typeof value === "object" ? JSON.stringify(value) : String(value);
  return text.length > 40 ? text.slice(0, 37) + "…" : text;
}

/** @param {any} timing of a member */
function timingCells(timing) {
  const ratio = timing?.ratio_bsm_over_mujoco;
  return [...engines.map((e) => timing?.[e.key]?.us_per_step === undefined ? textCell("–", "number")
    : { value: timing[e.key].us_per_step, text: duration(1e-6 * timing[e.key].us_per_step), kind: "number" }),
  ratio ? { value: ratio, text: `${written(1 / ratio, 3)}×`, kind: "number" } : textCell("–", "number")];
}

function membersTable() {
  const members = page.report.members;
  const keys = (/** @type {(m: any) => object} */ of) => [...new Set(members.flatMap((/** @type {any} */ m) => Object.keys(of(m))))].map(String);
  const paths = keys((m) => m.settings), metrics = keys((m) => m.agreement).filter((k) => k !== "mass_kg");
  const timed = members.some((/** @type {any} */ m) => m.timing?.ratio_bsm_over_mujoco);
  const compared = members.some((/** @type {any} */ m) => m.against);
  const perEngine = (/** @type {string} */ what) => engines.map((e) => textCell(`${e.label} ${what}`, `number engine-${e.key}`));
  return table("Members of the study",
    [textCell("member", "number"), textCell("folder"), textCell("verdict"), ...paths.map((p) => textCell(shortPath(p, paths))),
      ...metrics.map((k) => textCell(words(k).label, "number")), ...(compared ? perEngine("by itself") : []),
      ...(timed ? [...perEngine("step"), textCell("ratio", "number")] : [])],
    members.map((/** @type {any} */ m, /** @type {number} */ i) => ({ label: String(i), kind: "number", cells: [
      textCell(folderOf(i)), memberVerdictCell(m), ...paths.map((p) => textCell(settingText(m.settings[p]))),
      ...metrics.map((k) => m.agreement[k] ? numberCell(m.agreement[k].max, words(k).unit) : textCell("–", "number")),
      ...(compared ? engines.map((e) => againstCell(m.against?.[e.key])) : []),
      ...(timed ? timingCells(m.timing) : [])] })));
}

function membersSection() {
  const left = page.members_run - page.report.members.length;
  const box = membersTable();
  box.classList.add("boxed");
  const leftOut = leftOutWords();
  return section("Members",
    note(`${page.members_run} of ${page.members_planned} members were run, counted from 0. The files of the first lie beside the report, those of any other in its folder.`
      + (left > 0 ? ` The first ${page.report.members.length} are shown; all are in report.json.` : "")),
    leftOut ? html("p", { class: "unresolved" }, leftOut) : null, box);
}
