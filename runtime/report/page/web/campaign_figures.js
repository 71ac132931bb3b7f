// Pictures of a campaign: how each output is distributed, and how it follows what was drawn.

/** @typedef {{below: number | null, above: number | null}} Requirement */

/** A quantity with its unit, as an axis is called. @param {string} name @param {string} unit */
const withUnit = (name, unit) => (unit === "1" ? name : `${name} [${unit}]`);

/** @param {Requirement | null} requirement */
const limitsOf = (requirement) => [requirement?.above, requirement?.below].filter((limit) => typeof limit === "number");

/** @param {Requirement | null} requirement @param {number} value NaN: never reached, infinitely late */
function holdsRequirement(requirement, value) {
  const reached = Number.isNaN(value) ? Infinity : value;
  return (typeof requirement?.below !== "number" || reached < requirement.below) &&
    (typeof requirement?.above !== "number" || reached > requirement.above);
}

/** Whether an axis shows a value. @param {number[]} ticks @param {number} value */
const isOnAxis = (ticks, value) => value >= ticks[0] && value <= ticks[ticks.length - 1];

/** What share of the members stays below each value, with the requirement as a line.
 *  @param {any} output of report.json @param {Float64Array} values @param {Float64Array} shares */
function distributionFigure(output, values, shares) {
  const limits = limitsOf(output.requirement);
  const xs = ticksWith([...values], limits), ys = [0, 0.2, 0.4, 0.6, 0.8, 1];
  const figure = { title: output.name, x: withUnit(output.name, output.unit), y: "share of members that are no larger",
    said: `Distribution of ${output.name}: median ${written(output.median, 4)}, 95 % are below ${written(output.p95, 4)}` };
  return linearFigure(figure, xs, ys, (X, Y) => {
    const steps = [...values].map((value, i) => `H${X(value).toFixed(2)}V${Y(shares[i]).toFixed(2)}`);
    return [svg("path", { class: "curve", d: `M${X(values[0]).toFixed(2)},${Y(0)}${steps.join("")}` }),
      ...limits.filter((limit) => isOnAxis(xs, limit)).map((limit) =>
        svg("line", { class: "limit", x1: X(limit), x2: X(limit), y1: Y(0), y2: Y(1) }, svg("title", {}, `required: ${requirementWords(output)}`)))];
  }, output.requirement ? note(`Required: ${requirementWords(output)}${limits.every((limit) => isOnAxis(xs, limit)) ? ", the upright line" : ", beyond the axis"}.`) : null);
}

/** Where the members of the page are in the space of what was drawn, and what became of them. */
class Scatter {
  /** @param {any} data as the program made it */
  constructor(data) {
    this.of = data.of;
    this.members = doubles(data.members);
    this.flown = doubles(data.flown);
    /** @type {Map<string, Float64Array>} */
    this.drawn = new Map(Object.entries(data.drawn).map(([name, text]) => [name, doubles(String(text))]));
    this.outputs = data.outputs.map((/** @type {string} */ text) => doubles(text));
  }

  /** Has the program sent this number? @param {string} name */
  has(name) {
    return this.drawn.has(name);
  }

  /** An output over a drawn number. @param {any} output of report.json @param {number} place of it
   *  @param {{name: string, unit: string}} drawn */
  figure(output, place, drawn) {
    const x = /** @type {Float64Array} */ (this.drawn.get(drawn.name)), y = this.outputs[place];
    const [held, broken, absent] = [0, 1, 2].map(() => /** @type {number[]} */ ([]));
    x.forEach((_, i) => {
      const kind = !this.flown[i] || Number.isNaN(y[i]) ? absent : holdsRequirement(output.requirement, y[i]) ? held : broken;
      kind.push(i);
    });
    const shown = [...held, ...broken];
    const limits = limitsOf(output.requirement);
    const xs = ticksWith([...x], []), ys = ticksWith(shown.length > 0 ? shown.map((i) => y[i]) : [0, 1], limits);
    const figure = { title: `${output.name} over ${drawn.name}`, x: withUnit(drawn.name, drawn.unit), y: withUnit(output.name, output.unit),
      said: `${output.name} over ${drawn.name}: ${shown.length} members` };
    return linearFigure(figure, xs, ys, (X, Y) => [
      ...limits.filter((limit) => isOnAxis(ys, limit)).map((limit) => svg("line", { class: "limit", x1: plot.left, x2: plot.width - plot.right, y1: Y(limit), y2: Y(limit) })),
      dots(held, (i) => X(x[i]), (i) => Y(y[i])),
      ...broken.map((i) => svg("circle", { class: "broken", cx: X(x[i]).toFixed(1), cy: Y(y[i]).toFixed(1), r: 3 }, svg("title", {}, `member ${this.members[i]}`))),
      ...absent.map((i) => svg("path", { class: "absent", d: `M${X(x[i]).toFixed(1)},${plot.height - plot.bottom}v-9` },
        svg("title", {}, `member ${this.members[i]}: ${this.flown[i] ? "never reached" : "not flown"}`)))],
    this.legend(broken.length, absent.length));
  }

  /** @param {number} broken @param {number} absent how many of each are drawn */
  legend(broken, absent) {
    const sign = (/** @type {Node} */ node) => svg("svg", { viewBox: "0 0 19 13", "aria-hidden": true }, node);
    if (broken + absent === 0) return null;
    return html("ul", { class: "legend" },
      broken > 0 ? html("li", {}, sign(svg("circle", { class: "broken", cx: 9, cy: 6.5, r: 3 })), "requirement broken") : null,
      absent > 0 ? html("li", {}, sign(svg("path", { class: "absent", d: "M9,11v-9" })), "no value: not flown, or never reached") : null);
  }
}

/** Many dots as one path: each is a line of no length with round ends. @param {number[]} places
 *  @param {(i: number) => number} X @param {(i: number) => number} Y */
const dots = (places, X, Y) => svg("path", { class: "dots", d: places.map((i) => `M${X(i).toFixed(1)},${Y(i).toFixed(1)}h0`).join("") });
