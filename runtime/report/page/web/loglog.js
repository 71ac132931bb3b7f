// A figure with two logarithmic axes.

/** `out`: no result that counts, so it is crossed out and in no fit.
 *  @typedef {{x: number, y: number, said: string, hollow?: boolean, out?: boolean}} Dot */
/** @typedef {{name: string, mark: "circle" | "square" | "diamond", colour: string, dots: Dot[],
 *             line?: boolean, dashed?: boolean, order?: number | null}} Cloud */
/** @typedef {{title: string, x: string, y: string, clouds: Cloud[], orderWord?: string,
 *             floors?: {y: number, name: string, colour: string}[]}} LogFigure */

/** Whole decades around the values, or 1-2-5 steps where they span less than one and a half.
 *  @param {number[]} values */
function logTicks(values) {
  const least = Math.min(...values), greatest = Math.max(...values);
  const few = Math.log10(greatest / least) < 1.5;
  const steps = few ? [1, 2, 5] : [1];
  const all = [];
  for (let decade = Math.floor(Math.log10(least)) - 1; decade <= Math.ceil(Math.log10(greatest)) + 1; decade += 1)
    for (const step of steps) all.push(step * 10 ** decade);
  const below = all.filter((t) => t <= least * 1.0001).pop() ?? all[0];
  const above = all.find((t) => t >= greatest * 0.9999) ?? all[all.length - 1];
  const ticks = all.filter((t) => t >= below && t <= above);
  return ticks.length > 1 ? ticks : [below, below * 10];
}

/** @param {number} from @param {number} to pixels @param {number[]} ticks */
function logScale(from, to, ticks) {
  const low = Math.log10(ticks[0]), high = Math.log10(ticks[ticks.length - 1]);
  return (/** @type {number} */ value) => from + (to - from) * (Math.log10(value) - low) / (high - low);
}

/** A line of the order through the middle of the dots that count. @param {Cloud} cloud
 *  @param {Dot[]} all @param {(v: number) => number} X @param {(v: number) => number} Y */
function guide(cloud, all, X, Y) {
  const dots = all.filter((d) => !d.out);
  if (cloud.order === null || cloud.order === undefined || dots.length < 2) return [];
  const mean = (/** @type {number[]} */ list) => list.reduce((a, b) => a + b, 0) / list.length;
  const x0 = mean(dots.map((d) => Math.log10(d.x))), y0 = mean(dots.map((d) => Math.log10(d.y)));
  const ends = [Math.min(...dots.map((d) => d.x)), Math.max(...dots.map((d) => d.x))];
  const at = (/** @type {number} */ x) => 10 ** (y0 + Number(cloud.order) * (Math.log10(x) - x0));
  return [svg("line", { class: "guide", x1: X(ends[0]), y1: Y(at(ends[0])), x2: X(ends[1]), y2: Y(at(ends[1])) })];
}

/** @param {Cloud} cloud @param {(v: number) => number} X @param {(v: number) => number} Y */
function drawnCloud(cloud, X, Y) {
  const dots = cloud.dots.filter((d) => d.x > 0 && d.y > 0 && Number.isFinite(d.x) && Number.isFinite(d.y));
  const path = svg("polyline", { points: dots.filter((d) => !d.out).map((d) => `${X(d.x)},${Y(d.y)}`).join(" "), fill: "none" });
  path.style.stroke = cloud.colour;
  path.style.strokeWidth = "1.4";
  if (cloud.dashed) path.style.strokeDasharray = "7 3";
  return svg("g", {}, ...guide(cloud, dots, X, Y), cloud.line === false ? null : path,
    ...dots.map((d) => {
      const node = marker(cloud.mark, X(d.x), Y(d.y), cloud.colour, Boolean(d.hollow));
      const whole = d.out ? svg("g", {}, node, cross(X(d.x), Y(d.y))) : node;
      whole.append(svg("title", {}, d.said));
      return whole;
    }));
}

/** @param {LogFigure} figure */
function legend(figure) {
  const anyOut = figure.clouds.some((cloud) => cloud.dots.some((d) => d.out));
  return html("ul", { class: "legend" }, ...figure.clouds.map((cloud) => html("li", {},
    svg("svg", { viewBox: "0 0 19 13", "aria-hidden": true }, marker(cloud.mark, 9, 6.5, cloud.colour, cloud.dots.every((d) => d.hollow))),
    cloud.name + (cloud.order === null || cloud.order === undefined ? "" : `, ${figure.orderWord ?? "order"} ${cloud.order.toFixed(2)}`))),
    anyOut ? html("li", {}, svg("svg", { viewBox: "0 0 19 13", "aria-hidden": true }, cross(9, 6.5)), "unresolved or failed, in no fit") : null);
}

/** @param {LogFigure} figure @param {Node | null} data the numbers behind it */
function logFigure(figure, data) {
  const good = (/** @type {number} */ v) => v > 0 && Number.isFinite(v);
  const all = figure.clouds.flatMap((c) => c.dots).filter((d) => good(d.x) && good(d.y));
  const counted = all.filter((d) => !d.out);
  const dots = counted.length > 0 ? counted : all;
  const caption = html("figcaption", {}, html("h3", {}, figure.title));
  if (dots.length === 0) return html("figure", {}, caption, note("No two numbers here have a logarithm."), data);
  const floors = (figure.floors || []).filter((f) => good(f.y));
  const xs = logTicks(all.map((d) => d.x));
  const ys = logTicks([...dots.map((d) => d.y), ...floors.map((f) => f.y)]);
  const X = logScale(plot.left, plot.width - plot.right, xs);
  const scale = logScale(plot.height - plot.bottom, plot.top, ys);
  // What does not count sets no axis: far away it lies on the edge.
  const Y = (/** @type {number} */ y) => scale(Math.min(Math.max(y, ys[0]), ys[ys.length - 1]));
  const picture = svg("svg", { viewBox: `0 0 ${plot.width} ${plot.height}`, role: "img",
    "aria-label": `${figure.title}: ${figure.y} over ${figure.x}; the numbers are in the table below` },
  ...axes(xs, ys, X, Y, figure),
  ...floors.map((f, i) => {
    const line = svg("line", { class: "guide", x1: plot.left, x2: plot.width - plot.right, y1: Y(f.y), y2: Y(f.y) });
    line.style.stroke = f.colour;
    return svg("g", {}, line, svg("text", i === 0 ? { x: plot.left + 6, y: Y(f.y) - 5 }
      : { x: plot.width - plot.right, y: Y(f.y) - 5, "text-anchor": "end" }, f.name));
  }),
  ...[...figure.clouds].reverse().map((cloud) => drawnCloud(cloud, X, Y)));
  return html("figure", {}, caption, html("div", { class: "note" }, figure.y), picture, legend(figure), data);
}
