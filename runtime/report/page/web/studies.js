// Laws that the members of a study show together. Orders and exponents are those of report.json,
// between neighbours; a figure's dashed line has the median of those between members that count.

/** @param {(number | null)[]} values */
function medianOf(values) {
  const finite = /** @type {number[]} */ (values.filter((v) => v !== null && Number.isFinite(v))).sort((a, b) => a - b);
  if (finite.length === 0) return null;
  const middle = finite.length >> 1;
  return finite.length % 2 ? finite[middle] : (finite[middle - 1] + finite[middle]) / 2;
}

/** @param {string} path */
const lastStep = (path) => path.slice(path.lastIndexOf(".") + 1);

/** `step 0.1 s`; an integrator by its name alone. @param {any} settings */
const settingWords = (settings) => Object.entries(settings || {}).map(([path, value]) => {
  const text = typeof value === "object" ? JSON.stringify(value) : String(value);
  return path === "simulation.integrator" ? text : `${lastStep(path)} ${text}`;
}).join(", ");

/** What an engine's marks look like wherever a colour says something else. */
const engineMarks = { bsm: /** @type {const} */ ("circle"), mujoco: /** @type {const} */ ("square") };

/** How a trend is called beside others of its figure. @param {any} trend */
function trendName(trend) {
  const engine = engines.find((e) => e.key === trend.engine)?.label || "difference of the engines";
  const others = settingWords(trend.settings);
  return others ? `${engine}, ${others}` : engine;
}

/** Engines have their own colours where nothing else is told apart; where it is, each variant has
 *  its colour on the whole page and the mark tells the engine. @param {any} trend */
function trendLook(trend) {
  const mark = engineMarks[/** @type {"bsm"} */ (trend.engine)] || /** @type {const} */ ("diamond");
  const variant = settingWords(trend.settings);
  if (variant !== "") {
    const place = variants.placeOf(variant);
    return { mark, colour: `var(${paletteProperty(place)})`, dashed: isDashed(place) };
  }
  return { mark, colour: trend.engine ? `var(--${trend.engine})` : "var(--gap)" };
}

/** The swept paths of which no trend says where they stood: they step together.
 *  @param {any} trend */
function steppingAlong(trend) {
  if (trend.settings) return [];
  const varied = [...new Set(page.report.members.flatMap((/** @type {any} */ m) => Object.keys(m.settings)))].map(String)
    .filter((path) => new Set(page.report.members.map((/** @type {any} */ m) => JSON.stringify(m.settings[path]))).size > 1);
  return varied.length > 1 ? varied.filter((path) => path !== trend.set) : [];
}

/** Keys of the language that count; tests/node holds them against the schema. */
const countKeys = ["segments"];

/** An axis over a swept number: a count has no unit, a quantity is in SI. @param {string} path */
const sweptAxis = (path) => (countKeys.includes(lastStep(path)) ? path : `${path} [SI]`);

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
    axis: (t) => sweptAxis(t.set), value: (t) => `difference of the engines [${words(t.metric).unit}]`,
    title: (t) => `${metricName(t)} over ${t.set}` },
};

/** Whether the i-th dot of a trend is of a member that counts. @param {any} trend @param {number} i */
const dotCounts = (trend, i) => leftOutFor(trend.members?.[i]) === undefined;

/** Whether the i-th value of a trend is rounding. @param {any} trend @param {number} i */
const isRounding = (trend, i) => Boolean(trend.rounding?.[i]);

/** Median of the exponents between dots that count. @param {any} trend @param {TrendKind} kind */
const fittedExponent = (trend, kind) => medianOf(trend[kind.exponents].map((/** @type {number | null} */ e, /** @type {number} */ i) =>
  (dotCounts(trend, i) && dotCounts(trend, i + 1) ? e : null)));

/** The member of a dot, and what is wrong with it. @param {any} trend @param {number} i */
function dotMember(trend, i) {
  const index = trend.members?.[i];
  if (index === undefined) return "";
  const verdict = leftOutFor(index);
  return `member ${index}` + (verdict ? `, ${verdictLooks[verdict].word}` : "") + (isRounding(trend, i) ? ", rounding" : "");
}

/** Between dots i and i + 1. @param {any} trend @param {TrendKind} kind @param {number} i */
const exponentText = (trend, kind, i) =>
  isRounding(trend, i) || isRounding(trend, i + 1) ? "rounding" : trend[kind.exponents][i]?.toFixed(2) ?? "–";

/** @param {any[]} trends @param {TrendKind} kind */
function trendTable(trends, kind) {
  return html("div", {}, ...trends.map((trend) => table(`${kind.title(trend)}, ${trendName(trend)}`,
    [textCell(trendName(trend)), textCell(kind.axis(trend), "number"), textCell(kind.value(trend), "number"),
      textCell(kind.word, "number")],
    trend[kind.x].map((/** @type {number} */ x, /** @type {number} */ i) => ({ label: dotMember(trend, i) || String(i), kind: dotCounts(trend, i) ? "" : "unresolved", cells: [
      numberCell(x), numberCell(trend[kind.y][i]),
      i === 0 ? textCell("", "number")
        : { value: trend[kind.exponents][i - 1], text: exponentText(trend, kind, i - 1), kind: "number" }] })))));
}

/** @param {any[]} trends @param {TrendKind} kind */
function trendFigure(trends, kind) {
  const unit = words(trends[0].metric).unit;
  return logFigure({
    title: kind.title(trends[0]), x: kind.axis(trends[0]), y: kind.value(trends[0]), orderWord: kind.word,
    clouds: trends.map((trend) => ({
      name: trendName(trend) + (trend.rounding?.every(Boolean) ? ", rounding" : ""), ...trendLook(trend), order: fittedExponent(trend, kind),
      dots: trend[kind.x].map((/** @type {number} */ x, /** @type {number} */ k) => ({
        x, y: trend[kind.y][k], hollow: trend.engine === "mujoco", out: !dotCounts(trend, k),
        said: [`${trendName(trend)}: ${written(trend[kind.y][k], 3)} ${kind === trendKinds.scaling ? "µs" : unit} at ${written(x, 3)}`, dotMember(trend, k)].filter(Boolean).join(", ") })),
    })),
  }, unfold("Data", () => trendTable(trends, kind)));
}

/** @param {string} name @param {string} title @param {string} words */
function trendSection(name, title, words) {
  const trends = page.report.studies[name] || [];
  if (trends.length === 0) return null;
  const kind = trendKinds[name];
  const groups = grouped(trends, (trend) => [trend.set, trend.reference, trend.metric].join("|"));
  const along = name === "slopes" ? steppingAlong(trends[0]) : [];
  const together = along.length > 0 ? ` The swept paths step together, so each law is that of all of them at once: ${[trends[0].set, ...along].join(", ")}.` : "";
  return section(title, note(words + together), html("div", { class: "plots" }, ...groups.map((group) => trendFigure(group, kind))));
}

function studySections() {
  return [
    trendSection("convergence", "Convergence", "How the error follows the step."),
    trendSection("scaling", "Scaling", "How the time of a step follows the number of coordinates."),
    trendSection("slopes", "What the difference follows", "The largest difference of the engines over the number that was varied."),
    workSection(), membersSection(),
  ];
}
