// Tables of what report.json says of a member and of a study.

/** @typedef {{text?: string, value?: number | null, unit?: string, node?: Node, kind?: string,
 *             digits?: number}} Cell */

/** A number as a cell. @param {number | null | undefined} value @param {string} [unit]
 *  @returns {Cell} */
const numberCell = (value, unit = "") => ({ value: value ?? null, unit, kind: "number" });

/** @param {Cell} cell */
function cellNode(cell) {
  const td = html("td", { class: cell.kind, "data-value": cell.value === null ? undefined : cell.value });
  if (cell.node) td.append(cell.node);
  else if (cell.text !== undefined) td.append(cell.text);
  else if (cell.value === null) td.append("–");
  else td.append(written(cell.value, cell.digits) + (cell.unit && cell.unit !== "1" ? " " + cell.unit : ""));
  return td;
}

/**
 * @param {string} name for those who hear it
 * @param {Cell[]} head
 * @param {{label: string, kind?: string, cells: Cell[]}[]} rows
 */
function table(name, head, rows) {
  return html("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": name },
    html("table", { "aria-label": name },
      html("thead", {}, html("tr", {}, ...head.map((h) => html("th", { scope: "col", class: h.kind }, h.text)))),
      html("tbody", {}, ...rows.map((row) => html("tr", {},
        html("th", { scope: "row", class: row.kind }, row.label), ...row.cells.map(cellNode))))));
}

/** @param {string} text @param {string} [kind] @returns {Cell} */
const textCell = (text, kind) => ({ text, kind });

/** @param {boolean | null} pass @returns {Cell} */
function passCell(pass) {
  if (pass === null) return textCell("not judged", "");
  return pass ? textCell("held", "pass") : textCell("exceeded", "fail");
}

/** @param {any} member */
function agreementSection(member) {
  const keys = Object.keys(member.agreement);
  if (keys.length === 0) return null;
  const rulers = rulerScale(keys.map((key) => member.agreement[key]));
  return section("Agreement",
    note("The largest difference of the two engines over the recorded samples, and when it occurred."),
    table("Agreement of the engines",
      [textCell("quantity"), textCell("maximum", "number"), textCell("at", "number"),
        textCell("tolerance", "number"), textCell("verdict"), { text: "maximum ● and tolerance ┃, by decades" }],
      keys.map((key) => {
        const metric = member.agreement[key];
        const { label, unit } = words(key);
        return {
          label, cells: [
            numberCell(metric.max, unit),
            { value: metric.at_s, text: instant(metric.at_s), kind: "number" },
            metric.tolerance === null ? textCell("–", "number") : numberCell(metric.tolerance, unit),
            passCell(metric.pass),
            { node: ruler(metric, rulers), kind: "ruler" },
          ],
        };
      })));
}

/** @param {any} member */
function referenceSection(member) {
  const rows = [];
  for (const [name, runs] of Object.entries(member.references))
    for (const { key: engine, label } of engines)
      for (const [metric, result] of Object.entries(runs[engine] || {})) {
        const { label: quantity, unit } = words(metric);
        // A reference speaks of the system's centre of mass where a metric speaks of the hub.
        rows.push({ label: `${name}, ${quantity.replace(/^hub /, "")}`, cells: [
          textCell(label, "engine-" + engine), numberCell(result.max, unit),
          { value: result.at_s, text: instant(result.at_s), kind: "number" }] });
      }
  if (rows.length === 0) return null;
  return section("References",
    note("Each engine against a solution that neither of them uses."),
    table("Differences from references", [textCell("reference"), textCell("engine"),
      textCell("maximum", "number"), textCell("at", "number")], rows));
}

/** @param {any} member */
function conservationSection(member) {
  /** @type {[string, string][]} */
  const books = [["energy balance", "energy_relative"], ["momentum", "momentum_relative"],
    ["angular momentum", "angular_momentum_relative"]];
  return section("Conservation",
    note("The largest imbalance of each engine's books, external work and impulses counted, relative to the size of what is balanced."),
    table("Conservation", [textCell("books"), ...engines.map((e) => textCell(e.label, "number engine-" + e.key))],
      books.map(([label, key]) => ({
        label, cells: engines.map((e) => numberCell(member.engines[e.key]?.conservation?.[key])),
      }))));
}

/** @param {any} member */
function costSection(member) {
  const timing = member.timing;
  const timed = engines.filter((e) => timing?.[e.key]?.median_s !== undefined);
  if (timed.length === 0) return null;
  const rows = timed.map(({ key, label }) => {
    const { median_s, us_per_step, trials_s } = timing[key];
    return { label, kind: "engine-" + key, cells: [
      { value: us_per_step, text: duration(1e-6 * us_per_step), kind: "number" },
      { value: median_s, text: duration(median_s), kind: "number" },
      { text: `${duration(Math.min(...trials_s))} to ${duration(Math.max(...trials_s))}`, kind: "number" },
      { value: member.engines[key].steps, text: String(member.engines[key].steps), kind: "number" },
      { value: member.engines[key].evaluations, text: String(member.engines[key].evaluations), kind: "number" }] };
  });
  const ratio = timing.ratio_bsm_over_mujoco;
  return section("Cost",
    ratio ? html("p", {}, `MuJoCo takes ${written(1 / ratio, 3)} times as long as BSM.`)
      : timed.length === 2 ? note("The trials are too scattered for a ratio: the machine had other work.") : null,
    table("Cost", [textCell("engine"), textCell("per step", "number"), textCell("whole run, median", "number"),
      textCell("trials", "number"), textCell("steps", "number"), textCell("evaluations", "number")], rows),
    note(`Protocol: ${timing.protocol}.`));
}

/** Why an engine has no result. @param {any} member */
function engineRemarks(member) {
  return engines
    .filter(({ key }) => member.engines[key] && member.engines[key].reason)
    .map(({ key, label }) => html("p", { class: member.engines[key].status === "failed" ? "problem" : "note" },
      `${label}: ${member.engines[key].status}, ${member.engines[key].reason}`));
}
