// Making elements. Text becomes text nodes, attributes go through setAttribute; there is no other
// way from data into the document.

/** @typedef {Record<string, string | number | boolean | undefined>} Attributes */
/** @typedef {Node | string | null | undefined} Child */

/**
 * @template {Element} T
 * @param {T} made
 * @param {Attributes} attributes
 * @param {Child[]} children
 * @returns {T}
 */
function furnish(made, attributes, children) {
  for (const [key, value] of Object.entries(attributes))
    if (value !== undefined && value !== false) made.setAttribute(key, value === true ? "" : String(value));
  for (const child of children) if (child !== null && child !== undefined) made.append(child);
  return made;
}

/**
 * @template {keyof HTMLElementTagNameMap} K
 * @param {K} tag
 * @param {Attributes} [attributes]
 * @param {...Child} children
 */
function html(tag, attributes = {}, ...children) {
  return furnish(document.createElement(tag), attributes, children);
}

/**
 * @template {keyof SVGElementTagNameMap} K
 * @param {K} tag
 * @param {Attributes} [attributes]
 * @param {...Child} children
 */
function svg(tag, attributes = {}, ...children) {
  return furnish(document.createElementNS("http://www.w3.org/2000/svg", tag), attributes, children);
}

/**
 * @param {string} title
 * @param {...Child} children
 */
function section(title, ...children) {
  const id = title.toLowerCase().replace(/[^a-z]+/g, "-");
  return html("section", { id, "aria-labelledby": id + "-title" },
    html("h2", { id: id + "-title" }, title), ...children);
}

/** @param {string} text @param {...Child} more */
const note = (text, ...more) => html("p", { class: "note" }, text, ...more);

/** A sentence, in which a flag with its value (`--step '2 ms'`) stays on one line to be copied.
 *  @param {string} text */
const withCommands = (text) => text.split(/(--[a-z-]+ '[^']*')/).map((piece, i) => (i % 2 === 1 ? html("code", {}, piece) : piece));

/**
 * A button that saves text as a file.
 * @param {string} label
 * @param {string} file
 * @param {() => string} text
 */
function download(label, file, text) {
  const button = html("button", { type: "button" }, label);
  button.addEventListener("click", () => {
    const url = URL.createObjectURL(new Blob([text()], { type: "text/plain" }));
    html("a", { href: url, download: file }).click();
    setTimeout(() => URL.revokeObjectURL(url), 10_000);
  });
  return button;
}

/**
 * Something to unfold that is made when it first is.
 * @param {string} label
 * @param {() => Node} make
 */
function unfold(label, make) {
  const details = html("details", {}, html("summary", {}, label));
  details.addEventListener("toggle", () => details.append(make()), { once: true });
  return details;
}

/** Runs `act` when the element comes near the window, or is about to be printed: what costs time
 *  must not hold up the first sight of the page. @param {Element} node @param {() => void} act */
function whenNear(node, act) {
  let done = false;
  const once = () => { if (!done) { done = true; watcher.disconnect(); act(); } };
  const watcher = new IntersectionObserver((entries) => { if (entries.some((e) => e.isIntersecting)) once(); }, { rootMargin: "300px" });
  watcher.observe(node);
  document.addEventListener("paper", once);
}

/** @param {string} name of a custom property @returns {string} its value in the theme that is on */
const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

/** Colours of what is neither an engine nor a verdict; the second time around they are dashed. */
const paletteSize = 8;

/** What has a name (a coordinate, an axis, an integrator) keeps its colour on the whole page. */
class Palette {
  /** @type {Map<string, number>} */ places = new Map();

  /** @param {string[]} names whose colours come first */
  constructor(names) {
    names.forEach((name) => this.placeOf(name));
  }

  /** @param {string} name */
  placeOf(name) {
    const place = this.places.get(name) ?? this.places.size;
    this.places.set(name, place);
    return place;
  }
}

const components = new Palette(["x", "y", "z", "w"]);
const variants = new Palette([]);

/** The custom property of a place in a palette. @param {number} place */
const paletteProperty = (place) => (place < 0 ? "--gap" : "--s" + (place % paletteSize));

/** The colour of a place in a palette. @param {number} place */
const seriesColour = (place) => colour(paletteProperty(place));

/** @param {number} place */
const isDashed = (place) => place >= 0 && Math.floor(place / paletteSize) % 2 === 1;
