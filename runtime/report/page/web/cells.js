// Tables: rows of cells, each of which shows a number or a text.

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
