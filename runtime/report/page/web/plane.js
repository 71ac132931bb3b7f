// What figures with two axes have in common, as SVG: crisp in print, and every point can be asked.

const plot = { width: 560, height: 350, left: 66, right: 34, top: 16, bottom: 46 };

/** @param {"circle" | "square" | "diamond"} mark @param {number} x @param {number} y @param {string} shade @param {boolean} hollow */
function marker(mark, x, y, shade, hollow) {
  const r = mark === "square" ? 5.2 : 4; // a square is seen around a circle that lies on it
  const node = mark === "circle" ? svg("circle", { cx: x, cy: y, r })
    : svg("rect", { x: x - r * 0.9, y: y - r * 0.9, width: 1.8 * r, height: 1.8 * r,
      transform: mark === "diamond" ? `rotate(45 ${x} ${y})` : undefined });
  node.style.stroke = shade;
  node.style.strokeWidth = "1.6";
  node.style.fill = hollow ? "var(--paper)" : shade;
  return node;
}

/** At most seven of many. @param {number[]} ticks */
const thinned = (ticks) => ticks.filter((_, i) => i % Math.ceil(ticks.length / 8) === 0);

/** @param {number[]} xs @param {number[]} ys @param {(v: number) => number} X @param {(v: number) => number} Y
 *  @param {{x: string}} figure */
function axes(xs, ys, X, Y, figure) {
  const { width, height, left, right, top, bottom } = plot;
  return [
    ...ys.map((y) => svg("line", { class: "grid", x1: left, x2: width - right, y1: Y(y), y2: Y(y) })),
    ...xs.map((x) => svg("line", { class: "grid", x1: X(x), x2: X(x), y1: top, y2: height - bottom })),
    svg("line", { class: "axis", x1: left, x2: width - right, y1: height - bottom, y2: height - bottom }),
    svg("line", { class: "axis", x1: left, x2: left, y1: top, y2: height - bottom }),
    ...thinned(ys).map((y) => svg("text", { x: left - 8, y: Y(y) + 4, "text-anchor": "end" }, tick(y))),
    ...thinned(xs).map((x) => svg("text", { x: X(x), y: height - bottom + 18, "text-anchor": "middle" }, tick(x))),
    svg("text", { x: width - right, y: height - 8, "text-anchor": "end" }, figure.x),
  ];
}

/** Over a dot that does not count. @param {number} x @param {number} y */
function cross(x, y) {
  return svg("path", { class: "out", d: `M${x - 6},${y - 6}L${x + 6},${y + 6}M${x - 6},${y + 6}L${x + 6},${y - 6}` });
}
