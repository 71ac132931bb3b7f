// A figure with two linear axes.

/** Round numbers around the values. @param {number} least @param {number} greatest
 *  @param {number} [most] how many steps */
function linearTicks(least, greatest, most = 6) {
  const size = Math.max(Math.abs(least), Math.abs(greatest), 1e-300);
  // Numbers that are all but the same still need an axis.
  const width = Math.max(greatest - least, 1e-9 * size);
  const power = 10 ** Math.floor(Math.log10(width / most));
  const step = power * /** @type {number} */ ([1, 2, 5, 10].find((s) => s * power * most >= width * 0.999999));
  const first = Math.floor(least / step + 1e-6), last = Math.max(first + 1, Math.ceil(greatest / step - 1e-6));
  return Array.from({ length: last - first + 1 }, (_, i) => (first + i) * step);
}

/** @param {number} from @param {number} to pixels @param {number[]} ticks */
function linearScale(from, to, ticks) {
  const low = ticks[0], high = ticks[ticks.length - 1];
  return (/** @type {number} */ value) => from + (to - from) * (value - low) / (high - low);
}

/** Ticks for values, and for those limits that leave the values room enough to be seen.
 *  @param {number[]} values @param {number[]} limits */
function ticksWith(values, limits) {
  let least = Infinity, greatest = -Infinity;
  for (const value of values) {
    least = Math.min(least, value);
    greatest = Math.max(greatest, value);
  }
  const width = greatest - least;
  for (const limit of limits) {
    const low = Math.min(least, limit), high = Math.max(greatest, limit);
    if (width === 0 || high - low <= 4 * width) [least, greatest] = [low, high];
  }
  return linearTicks(least, greatest);
}

/**
 * A figure, its axes, and what `draw` adds to them.
 * @param {{title: string, x: string, y: string, said: string}} figure
 * @param {number[]} xs @param {number[]} ys ticks
 * @param {(X: (v: number) => number, Y: (v: number) => number) => (Node | null)[]} draw
 * @param {...Child} below
 */
function linearFigure(figure, xs, ys, draw, ...below) {
  const X = linearScale(plot.left, plot.width - plot.right, xs);
  const Y = linearScale(plot.height - plot.bottom, plot.top, ys);
  return html("figure", {}, html("figcaption", {}, html("h3", {}, figure.title)), html("div", { class: "note" }, figure.y),
    svg("svg", { viewBox: `0 0 ${plot.width} ${plot.height}`, role: "img", "aria-label": figure.said },
      ...axes(xs, ys, X, Y, figure), ...draw(X, Y)), ...below);
}
