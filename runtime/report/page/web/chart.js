// A chart of values over time, by dygraphs. All charts share one window of time and one cursor.
//
// Both engines lie on one another almost always. So MuJoCo is drawn as a wide pale band and BSM as
// a thin line inside it: where the line leaves the band, they part.

/** `colour` is a place in a palette, -1 that of a difference.
 *  @typedef {{name: string, engine: string, colour: number, values: Float64Array,
 *             times: Float64Array}} Curve */

class SharedTime {
  /** @type {TimeChart[]} */ charts = [];
  /** @type {[number, number] | null} */ window = null;
  /** @type {((window: [number, number] | null) => void)[]} */ listeners = [];
  busy = false;

  /** @param {[number, number] | null} window */
  show(window) {
    // A chart says its window whenever it has drawn: what is shown already costs the others nothing.
    if (this.busy || (window === null ? this.window === null
      : this.window !== null && window[0] === this.window[0] && window[1] === this.window[1])) return;
    this.busy = true;
    this.window = window;
    for (const chart of this.charts) chart.showWindow(window);
    for (const listener of this.listeners) listener(window);
    this.busy = false;
  }

  /** @param {number | null} time */
  point(time) {
    for (const chart of this.charts) chart.showCursor(time);
  }
}

const sharedTime = new SharedTime();
document.addEventListener("repaint", () => sharedTime.charts.forEach((chart) => chart.redraw()));

// The page names curves itself; dygraphs' own legend writes styles that the page's policy forbids.
Dygraph.PLUGINS = Dygraph.PLUGINS.filter((/** @type {any} */ plugin) => plugin !== Dygraph.Plugins.Legend);

/** Decades only, at most seven of them named. @param {number} low @param {number} high */
function decadeTicks(low, high) {
  const first = Math.ceil(Math.log10(low) - 1e-9), last = Math.floor(Math.log10(high) + 1e-9);
  const every = Math.max(1, Math.ceil((last - first) / 6));
  return Array.from({ length: Math.max(last - first + 1, 0) }, (_, i) => ({ v: 10 ** (first + i), label: (last - first - i) % every === 0 ? powerOfTen(first + i) : "" }))
    .filter((t) => t.label !== "");
}

/**
 * Rows of dygraphs: time, then every curve, `null` where it has no sample.
 * @param {Curve[]} curves
 */
function rowsOf(curves) {
  const same = curves.every((c) => c.times === curves[0].times ||
    (c.times.length === curves[0].times.length && c.times.every((t, i) => t === curves[0].times[i])));
  if (same)
    return Array.from(curves[0].times, (t, i) => [t, ...curves.map((c) => c.values[i])]);
  /** @type {Map<number, (number | null)[]>} */
  const rows = new Map();
  curves.forEach((curve, k) => curve.times.forEach((t, i) => {
    const row = rows.get(t) || [t, ...curves.map(() => null)];
    row[k + 1] = curve.values[i];
    rows.set(t, row);
  }));
  return [...rows.values()].sort((a, b) => Number(a[0]) - Number(b[0]));
}

class TimeChart {
  /**
   * @param {HTMLElement} place
   * @param {Curve[]} curves
   * @param {{unit: string, logarithmic: boolean, tolerance: number | null, label: string}} options
   * @param {(row: (number | null)[] | null) => void} onCursor
   */
  constructor(place, curves, options, onCursor) {
    this.curves = curves;
    this.options = options;
    this.onCursor = onCursor;
    this.rows = rowsOf(curves);
    this.place = place;
    this.inner = html("div");
    place.replaceChildren(this.inner);
    this.graph = new Dygraph(this.inner, this.rows, this.look());
    sharedTime.charts.push(this);
    this.takeKeys();
  }

  look() {
    // Zeros alone have no logarithm: then they are a line at zero.
    const nothing = this.options.logarithmic && !this.hasPositive();
    const logarithmic = this.options.logarithmic && !nothing;
    /** @type {Record<string, object>} */
    const series = {};
    /** @type {string[]} */
    const names = this.curves.map((_, i) => `${i}`);
    this.curves.forEach((curve, i) => {
      const band = curve.engine === "mujoco" && this.curves.some((c) => c.engine === "bsm");
      const shade = seriesColour(curve.colour);
      series[names[i]] = { strokeWidth: band ? 6 : 1.4, color: band ? withAlpha(shade, 0.32) : shade,
        strokePattern: isDashed(curve.colour) && !band ? [7, 3] : null, highlightCircleSize: band ? 0 : 3 };
    });
    return {
      labels: ["t", ...names], legend: "never", series, logscale: logarithmic,
      pixelRatio: paper.ready ? paperScale : null,
      valueRange: logarithmic ? this.logRange() : nothing ? [0, 1] : undefined,
      dateWindow: sharedTime.window, xRangePad: 0, yRangePad: logarithmic ? 0 : 8,
      connectSeparatedPoints: !logarithmic, labelsUTC: true,
      gridLineColor: colour("--rule"), axisLineColor: colour("--rule"), gridLineWidth: 0.6,
      axisLabelFontSize: 12, highlightSeriesOpts: undefined, animatedZooms: false,
      axes: {
        x: { valueFormatter: String, axisLabelFormatter: tick, drawGrid: false },
        y: { axisLabelWidth: 66, axisLabelFormatter: tick, pixelsPerLabel: 34, ...(logarithmic ? { ticker: decadeTicks } : {}) },
      },
      highlightCallback: (/** @type {Event} */ _event, /** @type {number} */ x) => sharedTime.point(x),
      unhighlightCallback: () => sharedTime.point(null),
      drawCallback: (/** @type {any} */ graph, /** @type {boolean} */ initial) => {
        if (!initial) sharedTime.show(graph.isZoomed("x") ? graph.xAxisRange() : null);
      },
      underlayCallback: (/** @type {CanvasRenderingContext2D} */ context, /** @type {any} */ area, /** @type {any} */ graph) =>
        this.drawTolerance(context, area, graph),
    };
  }

  hasPositive() {
    return this.curves.some((curve) => curve.values.some((value) => value > 0 && Number.isFinite(value)));
  }

  /** Whole decades that hold the data and the tolerance; a long tail towards zero is cut. */
  logRange() {
    let least = Infinity, greatest = 0;
    for (const row of this.rows)
      for (const value of row.slice(1))
        if (value !== null && value > 0 && Number.isFinite(value)) {
          least = Math.min(least, value);
          greatest = Math.max(greatest, value);
        }
    greatest = Math.max(greatest, this.options.tolerance || 0);
    least = Math.max(least, greatest * 1e-12);
    return [10 ** Math.floor(Math.log10(least)), 10 ** (Math.floor(Math.log10(greatest)) + 1)];
  }

  /** @param {CanvasRenderingContext2D} context @param {any} area @param {any} graph */
  drawTolerance(context, area, graph) {
    context.lineJoin = "round"; // a wide line would have spikes
    if (this.options.tolerance === null || !this.hasPositive()) return;
    const y = graph.toDomYCoord(this.options.tolerance);
    context.save();
    context.strokeStyle = colour("--ink");
    context.setLineDash([5, 4]);
    context.beginPath();
    context.moveTo(area.x, y);
    context.lineTo(area.x + area.w, y);
    context.stroke();
    context.restore();
  }

  /** @param {[number, number] | null} window */
  showWindow(window) {
    this.graph.updateOptions({ dateWindow: window });
  }

  /** @param {number | null} time */
  showCursor(time) {
    if (time === null) {
      this.graph.clearSelection();
      return this.onCursor(null);
    }
    const row = this.rowAt(time);
    this.graph.setSelection(row);
    this.onCursor(this.rows[row]);
  }

  /** The row whose time is nearest. @param {number} time */
  rowAt(time) {
    let low = 0, high = this.rows.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (Number(this.rows[middle][0]) <= time) low = middle;
      else high = middle;
    }
    return time - Number(this.rows[low][0]) <= Number(this.rows[high][0]) - time ? low : high;
  }

  /** @param {number} curve @param {boolean} visible */
  setVisible(curve, visible) {
    this.graph.setVisibility(curve, visible);
  }

  /** In the theme and at the size that it has now, drawn once. */
  redraw() {
    const { width, height } = this.graph.size();
    const resized = width !== this.inner.clientWidth || height !== this.inner.clientHeight;
    this.graph.updateOptions(this.look(), resized);
    if (resized) this.graph.resize();
  }

  /** Arrows move the cursor, + and - zoom about it, 0 shows everything. */
  takeKeys() {
    let row = 0;
    this.place.addEventListener("keydown", (event) => {
      const [begin, end] = this.graph.xAxisRange();
      const step = Math.max(1, Math.round((this.rowAt(end) - this.rowAt(begin)) / (event.shiftKey ? 10 : 100)));
      const zoom = (/** @type {number} */ factor) => {
        const at = Number(this.rows[row][0]);
        sharedTime.show(this.clipped([at - factor * (at - begin), at + factor * (end - at)]));
      };
      switch (event.key) {
        case "ArrowLeft": row = Math.max(0, row - step); break;
        case "ArrowRight": row = Math.min(this.rows.length - 1, row + step); break;
        case "Home": row = 0; break;
        case "End": row = this.rows.length - 1; break;
        case "+": case "=": return zoom(0.5);
        case "-": return zoom(2);
        case "0": case "Escape": return sharedTime.show(null);
        default: return;
      }
      event.preventDefault();
      sharedTime.point(Number(this.rows[row][0]));
    });
    this.place.addEventListener("blur", () => sharedTime.point(null));
  }

  /** @param {[number, number]} window @returns {[number, number] | null} */
  clipped([begin, end]) {
    const first = Number(this.rows[0][0]), last = Number(this.rows[this.rows.length - 1][0]);
    return begin <= first && end >= last ? null : [Math.max(begin, first), Math.min(end, last)];
  }
}

/** @param {string} shade `#rrggbb` @param {number} alpha */
function withAlpha(shade, alpha) {
  const parts = [1, 3, 5].map((i) => parseInt(shade.slice(i, i + 2), 16));
  return `rgba(${parts.join(",")},${alpha})`;
}
