// Time histories: a row per quantity, what it does on the left, where the engines part on the right.

/** Curves that are shown to begin with; more are a tick away. */
const firstCurves = paletteSize;

/** @type {Record<string, Float64Array>} */
const timeColumns = {};
/** @param {"bsm" | "mujoco" | "difference"} which */
const timesOf = (which) => (timeColumns[which] ??= doubles(page.histories.times[which]));

/** MuJoCo first: the band lies under the line. @param {Series[]} series @returns {Curve[]} */
function valueCurves(series) {
  /** @type {Curve[]} */
  const curves = [];
  for (const engine of /** @type {const} */ (["mujoco", "bsm"]))
    series.forEach((one) => {
      if (one[engine])
        curves.push({ name: one.name, engine, colour: components.placeOf(one.name), values: doubles(one[engine]), times: timesOf(engine) });
    });
  return curves;
}

/** @param {Series[]} series @returns {Curve[]} */
function differenceCurves(series) {
  return series.map((one) => ({
    name: one.name, engine: "", colour: series.length === 1 ? -1 : components.placeOf(one.name), values: doubles(one.values), times: timesOf("difference"),
  }));
}

/** `rad/s`; of pure numbers nothing. @param {string} unit */
const unitLabel = (unit) => (unit === "1" ? "pure number" : unit);

/** `t = 120 s`, and in words where that is long. @param {number} t [s] */
function cursorWords(t) {
  const seconds = `t = ${Number(t.toPrecision(8))} s`;
  return t >= 2 * day ? `${seconds} (${instant(t)})` : seconds;
}

/** A chart with its axes named and the values under the cursor. */
class ChartPanel {
  /**
   * @param {string} heading
   * @param {Series[]} series
   * @param {(series: Series[]) => Curve[]} curvesOf
   * @param {{unit: string, logarithmic: boolean, tolerance: number | null, label: string}} options
   */
  constructor(heading, series, curvesOf, options) {
    this.series = series;
    this.curvesOf = curvesOf;
    this.options = options;
    this.place = html("div", { class: "chart", tabindex: 0, role: "group",
      "aria-label": `${options.label}: chart over time. Arrows move the cursor, plus and minus zoom, 0 shows all.` });
    this.readout = html("div", { class: "readout", tabindex: 0, role: "group", "aria-label": `${options.label}: curves and values` });
    this.node = html("div", { class: "panel" },
      html("h4", {}, html("span", {}, `${heading} [${unitLabel(options.unit)}]`)),
      this.place, html("p", { class: "time-axis" }, "time [s]"), this.readout);
    /** @type {TimeChart | null} */
    this.chart = null;
  }

  draw() {
    if (this.chart) return;
    const curves = this.curvesOf(this.series);
    this.chart = new TimeChart(this.place, curves, this.options, (row) => this.tell(row));
    this.listCurves(curves);
  }

  /** @param {Curve[]} curves */
  listCurves(curves) {
    /** @type {Map<HTMLTableCellElement, number>} */
    this.cells = new Map();
    this.when = html("th", { scope: "col" });
    const present = [...new Set(curves.map((c) => c.engine))].reverse();
    const rows = this.series.map((one, i) => {
      const own = curves.map((c, k) => ({ c, k })).filter(({ c }) => c.name === one.name);
      const box = html("input", { type: "checkbox" });
      const shown = i < firstCurves;
      box.checked = shown;
      const entry = html("tr");
      const show = () => {
        own.forEach(({ k }) => this.chart?.setVisible(k, box.checked));
        entry.classList.toggle("hidden-curve", !box.checked);
      };
      box.addEventListener("change", show);
      if (!shown) show();
      const place = own[0]?.c.colour ?? components.placeOf(one.name);
      const swatch = html("span", { class: isDashed(place) ? "swatch dashed" : "swatch" });
      for (const node of [swatch, box]) node.style.setProperty("--swatch", `var(${paletteProperty(place)})`);
      const cells = present.map((engine) => {
        const td = html("td");
        const mine = own.find(({ c }) => c.engine === engine);
        if (mine) this.cells?.set(td, mine.k);
        return td;
      });
      const name = this.series.length > 1 ? html("label", {}, box, swatch, one.name) : html("label", {}, swatch, one.name);
      return furnish(entry, {}, [html("th", { scope: "row" }, name), ...cells]);
    });
    const labels = { bsm: "BSM", mujoco: "MuJoCo", "": "" };
    const hidden = this.series.length - firstCurves;
    this.readout.replaceChildren(hidden > 0 ? html("p", { class: "more" }, `${this.series.length} curves; the last ${hidden} appear when ticked.`) : "", html("table", {},
      html("thead", {}, html("tr", {}, this.when,
        ...present.map((engine) => html("th", { scope: "col" }, labels[/** @type {"bsm"} */ (engine)])))),
      html("tbody", {}, ...rows)));
    this.tell(null);
  }

  /** @param {(number | null)[] | null} row */
  tell(row) {
    if (this.when) this.when.textContent = row ? cursorWords(Number(row[0])) : "value at the cursor";
    for (const [cell, k] of this.cells || []) {
      const value = row ? row[k + 1] : null;
      cell.textContent = value === null || value === undefined ? "" : (this.options.logarithmic ? value.toExponential(3) : value.toPrecision(9)).replace("-", "−").replace("e-", "e−");
    }
  }

  /** The numbers behind the picture. */
  dataTable() {
    const curves = this.curvesOf(this.series);
    const rows = rowsOf(curves);
    const names = curves.map((c) => [c.name, { bsm: "BSM", mujoco: "MuJoCo" }[c.engine] || ""].filter(Boolean).join(" "));
    return html("div", { class: "table-scroll", tabindex: 0, role: "region", "aria-label": `${this.options.label}, data` },
      html("table", {},
        html("thead", {}, html("tr", {}, ...["t [s]", ...names.map((n) => `${n} [${this.options.unit}]`)].map((h) => html("th", { scope: "col" }, h)))),
        html("tbody", {}, ...rows.map((row) => html("tr", {}, ...row.map((v) => html("td", { class: "number" }, v === null ? "" : String(v))))))));
  }
}

/** @param {Figure} figure */
function historyFigure(figure) {
  const panels = [new ChartPanel("value", figure.series, valueCurves,
    { unit: figure.unit, logarithmic: Boolean(figure.logarithmic), tolerance: null, label: figure.title })];
  if (figure.difference)
    panels.push(new ChartPanel(figure.difference.metric ? "difference of the engines, as judged" : "difference of the engines, |BSM − MuJoCo|",
      figure.difference.series, differenceCurves,
      { unit: figure.difference.unit, logarithmic: true, tolerance: figure.difference.tolerance, label: figure.title + ", difference" }));
  const node = html("figure", { class: "history" }, html("figcaption", {}, html("h3", {}, figure.title)),
    html("div", { class: "pair" }, ...panels.map((panel) => panel.node)),
    unfold("Data", () => html("div", {}, ...panels.map((panel) => panel.dataTable()))));
  return { node, draw: () => panels.forEach((panel) => panel.draw()) };
}

function historiesSection() {
  const { histories } = page;
  if (!histories.times.bsm && !histories.times.mujoco) return null;
  const figures = histories.figures.map(historyFigure);
  const thinned = histories.thinned
    ? `Of ${histories.samples.toLocaleString("en")} samples each curve shows at most ${histories.points.toLocaleString("en")} points: the least and the greatest value of every stretch of time, so that no extreme is lost. All samples are in the CSV files.`
    : `All ${histories.samples} recorded samples are shown.`;
  const node = section("Time histories", note(thinned + " Gaps on a logarithmic axis are exact zeros."), zoomTools(), engineKey(),
    ...figures.map((figure) => figure.node));
  node.classList.add("long");
  figures.forEach((figure) => whenNear(figure.node, figure.draw));
  return node;
}

function engineKey() {
  return html("div", { class: "key" },
    html("span", {}, html("i", { class: "thin" }), "BSM, the thin line"),
    html("span", {}, html("i", { class: "band" }), "MuJoCo, the pale band below it"),
    html("span", {}, "- - -  tolerance"));
}

function zoomTools() {
  const said = html("output", {}, "all of the run");
  const reset = html("button", { type: "button", id: "reset-zoom", disabled: true }, "Show all");
  reset.addEventListener("click", () => sharedTime.show(null));
  sharedTime.listeners.push((window) => {
    reset.disabled = window === null;
    const end = (/** @type {number} */ t) => (Math.abs(t) >= 2 * day ? instant(t) : `${t.toPrecision(6)} s`);
    said.textContent = window ? `${end(window[0])} to ${end(window[1])}` : "all of the run";
  });
  return html("div", { class: "tools" }, reset, said,
    html("span", { class: "note" }, "Drag across a chart to zoom in, shift-drag to move; all charts follow."));
}
