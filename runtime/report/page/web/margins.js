// A ruler of decades: how far each maximum is from its tolerance, one scale for all rows, so that
// the room that is left is seen before any number is read. Quantities have different units; what
// they share is the distance from tolerance, so the tolerances are aligned.

/** @typedef {{max: number | null, tolerance: number | null, pass: boolean | null}} Metric */

/** Decades below and above the tolerance that all rows need. @param {Metric[]} metrics */
function rulerScale(metrics) {
  const decades = metrics.filter((m) => m.tolerance && m.max)
    .map((m) => Math.log10(/** @type {number} */ (m.max) / /** @type {number} */ (m.tolerance)));
  const low = Math.min(-2, ...decades.map((d) => Math.floor(d)));
  const high = Math.max(1, ...decades.map((d) => Math.ceil(d)));
  return { low: Math.max(low, -16), high: Math.min(high, 16) };
}

/** @param {Metric | undefined} metric @param {{low: number, high: number}} scale
 *  @param {boolean} stands whether it is judged: otherwise the dot has no colour
 *  @param {string} limit what `tolerance` is */
function ruler(metric, scale, stands = true, limit = "the tolerance") {
  if (!metric?.tolerance || metric.max === null) return html("span");
  const width = 240;
  /** @param {number} decade */
  const x = (decade) => 6 + (width - 12) * (Math.min(Math.max(decade, scale.low), scale.high) - scale.low) / (scale.high - scale.low);
  const decade = metric.max === 0 ? scale.low : Math.log10(metric.max / metric.tolerance);
  const said = metric.max === 0 ? "no difference at all"
    : `${written(metric.max / metric.tolerance)} of ${limit}`;
  const ticks = [];
  for (let d = scale.low; d <= scale.high; d += 1)
    ticks.push(svg("line", { class: "axis", x1: x(d), x2: x(d), y1: 8, y2: 14 }));
  const dot = svg("circle", { cx: x(decade), cy: 11, r: 4.2 });
  dot.style.setProperty("fill", !stands ? "var(--unjudged)" : metric.pass ? "var(--agree)" : "var(--disagree)");
  return svg("svg", { viewBox: `0 0 ${width} 22`, role: "img", "aria-label": said },
    svg("title", {}, said),
    svg("line", { class: "axis", x1: 6, x2: width - 6, y1: 11, y2: 11 }), ...ticks,
    svg("line", { class: "span", x1: x(decade), x2: x(0), y1: 11, y2: 11 }),
    svg("line", { class: "limit", x1: x(0), x2: x(0), y1: 3, y2: 19 }), dot);
}
