// Why the engines differ: what `scsim attribute` found, cause by cause.

/** @param {string} label @param {number} maximum @param {number} rounding */
const leftOver = (label, maximum, rounding) =>
  ({ label, metric: { max: maximum, tolerance: rounding, pass: maximum <= rounding } });

/** How far down the difference comes as the causes go, one after another.
 *  @param {any[]} causes @param {any} explanation @param {string} unit */
function removalTable(causes, explanation, unit) {
  const steps = [leftOver("as it is", explanation.maximum, explanation.rounding),
    ...causes.map((cause) => leftOver(`without ${cause.name}`, cause.maximum_left, explanation.rounding))];
  const rulers = rulerScale(steps.map((step) => step.metric));
  return table("Causes removed one after another",
    [textCell("removed one after another"), textCell("maximum", "number"),
      { text: "maximum ● and rounding ┃, by decades" }],
    steps.map(({ label, metric }) => ({
      label, cells: [numberCell(metric.max, unit), { node: ruler(metric, rulers, true, "rounding"), kind: "ruler" }] })));
}

/** @param {number | null} part */
const share = (part) => part === null ? "–" : `${String(Number((100 * part).toFixed(1))).replace("-", "−")} %`;

/** @param {any[]} causes @param {string} unit */
function causesTable(causes, unit) {
  return table("What carries the difference",
    [textCell("cause"), textCell("carries", "number"), textCell("without it", "number"), textCell("law")],
    causes.map((cause) => ({
      label: cause.name, cells: [
        { value: cause.share, text: share(cause.share), kind: "number" },
        numberCell(cause.maximum_without, unit), textCell(cause.law ? cause.law.words : cause.no_law)] })));
}

function attributionSection() {
  const { explanation, attribution: causes } = page.report;
  if (!explanation) return null;
  const { unit } = words(explanation.metric);
  const tables = explanation.nothing_to_explain || causes.length === 0 ? []
    : [causesTable(causes, unit), removalTable(causes, explanation, unit)];
  const sentence = `${explanation.conclusion[0].toUpperCase()}${explanation.conclusion.slice(1)}.`;
  return section("Why they differ", html("p", {}, sentence), ...tables, note(explanation.method));
}
