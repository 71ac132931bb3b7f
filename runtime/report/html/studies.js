// What the members of a study show together. Orders and exponents are those of report.json, between
// neighbours; a figure's dashed line has their median.

/** @param {(number | null)[]} values */
function medianOf(values) {
  const finite = /** @type {number[]} */ (values.filter((v) => v !== null && Number.isFinite(v))).sort((a, b) => a - b);
  if (finite.length === 0) return null;
  const middle = finite.length >> 1;
  return finite.length % 2 ? finite[middle] : (finite[middle - 1] + finite[middle]) / 2;
}

/** @param {string} path */
const lastStep = (path) => path.slice(path.lastIndexOf(".") + 1);

/** @param {any} settings */
const settingWords = (settings) => Object.entries(settings || {}).map(([path, value]) =>
  `${lastStep(path)} ${typeof value === "object" ? JSON.stringify(value) : value}`).join(", ");

/** How a trend is called beside others of its figure. @param {any} trend */
function trendName(trend) {
  const engine = engines.find((e) => e.key === trend.engine)?.label || "difference of the engines";
  const others = settingWords(trend.settings);
  return others ? `${engine}, ${others}` : engine;
}

/** @param {any} trend @param {number} i */
function trendLook(trend, i) {
  const plain = !trend.settings;
  if (trend.engine === "bsm" && plain) return { mark: /** @type {const} */ ("circle"), colour: "var(--bsm)" };
  if (trend.engine === "mujoco" && plain) return { mark: /** @type {const} */ ("square"), colour: "var(--mujoco)" };
  return { mark: /** @type {const} */ (["circle", "square", "diamond"])[i % 3], colour: `var(--s${i % 6})` };
}

/** @template T @param {T[]} list @param {(item: T) => string} key */
function grouped(list, key) {
  /** @type {Map<string, T[]>} */
  const groups = new Map();
  for (const item of list) groups.set(key(item), [...(groups.get(key(item)) || []), item]);
  return [...groups.values()];
}

/** @typedef {{x: string, y: string, exponents: string, word: string, axis: (trend: any) => string,
 *             value: (trend: any) => string, title: (trend: any) => string}} TrendKind */

/** @param {any} trend */
const metricName = (trend) => {
  const label = words(trend.metric).label;
  return trend.reference ? `${trend.reference}, ${label.replace(/^hub /, "")}` : label;
};

/** @type {Record<string, TrendKind>} */
const trendKinds = {
  convergence: { x: "steps_s", y: "errors", exponents: "orders", word: "order",
    axis: () => "step [s]", value: (t) => `error [${words(t.metric).unit}]`,
    title: (t) => metricName(t) },
  scaling: { x: "degrees_of_freedom", y: "us_per_step", exponents: "exponents", word: "exponent",
    axis: () => "coordinates", value: () => "time of a step [µs]", title: () => "Time of a step" },
  slopes: { x: "values", y: "maxima", exponents: "slopes", word: "exponent",
    axis: (t) => `${t.set} [SI]`, value: (t) => `difference of the engines [${words(t.metric).unit}]`,
    title: (t) => metricName(t) },
};

/** @param {any[]} trends @param {TrendKind} kind */
function trendTable(trends, kind) {
  return html("div", {}, ...trends.map((trend) => table(`${kind.title(trend)}, ${trendName(trend)}`,
    [textCell(trendName(trend)), textCell(kind.axis(trend), "number"), textCell(kind.value(trend), "number"),
      textCell(kind.word, "number")],
    trend[kind.x].map((/** @type {number} */ x, /** @type {number} */ i) => ({ label: String(i + 1), cells: [
      numberCell(x), numberCell(trend[kind.y][i]),
      i === 0 ? textCell("", "number")
        : { value: trend[kind.exponents][i - 1], text: trend[kind.exponents][i - 1]?.toFixed(2) ?? "–", kind: "number" }] })))));
}

/** @param {any[]} trends @param {TrendKind} kind */
function trendFigure(trends, kind) {
  const unit = words(trends[0].metric).unit;
  return logFigure({
    title: kind.title(trends[0]), x: kind.axis(trends[0]), y: kind.value(trends[0]), orderWord: kind.word,
    clouds: trends.map((trend, i) => ({
      name: trendName(trend), ...trendLook(trend, i), order: medianOf(trend[kind.exponents]),
      dots: trend[kind.x].map((/** @type {number} */ x, /** @type {number} */ k) => ({
        x, y: trend[kind.y][k], hollow: trend.engine === "mujoco",
        said: `${trendName(trend)}: ${written(trend[kind.y][k], 3)} ${kind === trendKinds.scaling ? "µs" : unit} at ${written(x, 3)}` })),
    })),
  }, unfold("Data", () => trendTable(trends, kind)));
}

/** @param {string} name @param {string} title @param {string} words */
function trendSection(name, title, words) {
  const trends = page.report.studies[name] || [];
  if (trends.length === 0) return null;
  const kind = trendKinds[name];
  const groups = grouped(trends, (trend) => [trend.set, trend.reference, trend.metric].join("|"));
  return section(title, note(words), html("div", { class: "plots" }, ...groups.map((group) => trendFigure(group, kind))));
}

/** @param {any} configuration @param {string} cost */
const costOf = (configuration, cost) => cost === "median_s" ? configuration.median_s : configuration.evaluations;

/** @param {"attitude_deg" | "position_m"} error @param {string} cost */
function workFigure(error, cost) {
  const work = page.report.studies.work_precision;
  const unit = error === "attitude_deg" ? "deg" : "m";
  const present = engines.filter((e) => work[e.key]);
  const look = { bsm: { mark: /** @type {const} */ ("circle"), colour: "var(--bsm)" },
    mujoco: { mark: /** @type {const} */ ("square"), colour: "var(--mujoco)" } };
  return logFigure({
    title: error === "attitude_deg" ? "Attitude" : "Hub position",
    x: cost === "median_s" ? "time of the run [s]" : "evaluations", y: `error at the end [${unit}]`,
    floors: present.map((e) => ({ y: work[e.key].floor[error], name: `floor of ${e.label}`, colour: look[e.key].colour })),
    clouds: present.map((e) => ({ name: e.label, ...look[e.key], line: false,
      dots: work[e.key].configurations.filter((/** @type {any} */ c) => !c.diverged).map((/** @type {any} */ c) => ({
        x: costOf(c, cost), y: c[error], hollow: !c.frontier,
        said: `${e.label}, ${settingWords(c.settings)}: ${written(c[error], 3)} ${unit}` })) })),
  }, unfold("Data", () => html("div", {}, ...present.map((e) => workTable(work[e.key], e.label)))));
}

/** @param {any} work of one engine @param {string} label */
function workTable(work, label) {
  return table(`Work and precision of ${label}`,
    [textCell(`${label} configuration`), textCell("attitude error", "number"), textCell("position error", "number"),
      textCell("evaluations", "number"), textCell("time", "number"), textCell("frontier")],
    work.configurations.map((/** @type {any} */ c) => ({ label: settingWords(c.settings), cells: c.diverged
      ? [textCell("diverged"), textCell(""), textCell(""), textCell(""), textCell("")]
      : [numberCell(c.attitude_deg, "deg"), numberCell(c.position_m, "m"),
        { value: c.evaluations, text: String(c.evaluations), kind: "number" },
        c.median_s === undefined ? textCell("–", "number") : { value: c.median_s, text: duration(c.median_s), kind: "number" },
        textCell(c.frontier ? "yes" : "")] })));
}

function workSection() {
  const work = page.report.studies.work_precision;
  if (!work || Object.keys(work).length === 0) return null;
  const timed = engines.some((e) => work[e.key]?.configurations.some((/** @type {any} */ c) => c.median_s !== undefined));
  const cost = timed ? "median_s" : "evaluations";
  const faster = work.bsm_faster ? html("p", {}, `BSM is faster in ${work.bsm_faster.in} of ${work.bsm_faster.of} configurations.`) : null;
  return section("Work and precision", faster,
    note("Every configuration's end against a tight run of the same engine. Full marks are on the engine's frontier: nothing cheaper has a smaller attitude error. Below the floor, where two tight runs differ, an error means nothing."),
    html("div", { class: "plots" }, workFigure("attitude_deg", cost), workFigure("position_m", cost)));
}

/** @param {any} member */
function memberVerdict(member) {
  const failed = engines.find((e) => member.engines[e.key]?.status === "failed");
  if (failed) return textCell(`${failed.label} failed`, "fail");
  const passes = Object.values(member.agreement).map((/** @type {any} */ m) => m.pass);
  if (passes.includes(false)) return textCell("disagree", "fail");
  return passes.includes(true) ? textCell("agree", "pass") : textCell("not judged");
}

function membersSection() {
  const members = page.report.members;
  const paths = [...new Set(members.flatMap((/** @type {any} */ m) => Object.keys(m.settings)))].map(String);
  const metrics = [...new Set(members.flatMap((/** @type {any} */ m) => Object.keys(m.agreement)))].map(String).filter((k) => k !== "mass_kg");
  const timed = members.some((/** @type {any} */ m) => m.timing?.ratio_bsm_over_mujoco);
  const compared = members.some((/** @type {any} */ m) => m.against);
  const left = page.members_run - members.length;
  return section("Members",
    note(`${page.members_run} of ${page.members_planned} members were run.` + (left > 0 ? ` The first ${members.length} are shown; all are in report.json.` : "")),
    table("Members of the study",
      [textCell("member", "number"), ...paths.map((p) => textCell(lastStep(p))), ...metrics.map((k) => textCell(words(k).label, "number")),
        ...(compared ? engines.map((e) => textCell(`${e.label} by itself`, `number engine-${e.key}`)) : []),
        ...(timed ? [...engines.map((e) => textCell(`${e.label} step`, `number engine-${e.key}`)), textCell("ratio", "number")] : []), textCell("verdict")],
      members.map((/** @type {any} */ m, /** @type {number} */ i) => ({ label: String(i + 1), kind: "number", cells: [
        ...paths.map((p) => textCell(settingText(m.settings[p]))),
        ...metrics.map((k) => m.agreement[k] ? numberCell(m.agreement[k].max, words(k).unit) : textCell("–", "number")),
        ...(compared ? engines.map((e) => againstCell(m.against?.[e.key])) : []),
        ...(timed ? [...engines.map((e) => m.timing?.[e.key]?.us_per_step === undefined ? textCell("–", "number")
          : { value: m.timing[e.key].us_per_step, text: duration(1e-6 * m.timing[e.key].us_per_step), kind: "number" }),
        m.timing?.ratio_bsm_over_mujoco ? { value: m.timing.ratio_bsm_over_mujoco, text: `${written(1 / m.timing.ratio_bsm_over_mujoco, 3)}×`, kind: "number" } : textCell("–", "number")] : []),
        memberVerdict(m)] }))));
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

function studySections() {
  return [
    trendSection("convergence", "Convergence", "How the error follows the step."),
    trendSection("scaling", "Scaling", "How the time of a step follows the number of coordinates."),
    trendSection("slopes", "What the difference follows", "The largest difference of the engines over the number that was varied."),
    workSection(), membersSection(),
  ];
}
