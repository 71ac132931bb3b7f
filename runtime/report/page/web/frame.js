// What surrounds the sections of every page. A part that cannot be made says so in its place; the
// others still come.

/** @param {string} name @param {() => (Node | null)[]} make */
function part(name, make) {
  try {
    return make();
  } catch (error) {
    console.error(error);
    return [html("p", { class: "problem" }, `${name} could not be shown: ${error}`)];
  }
}

function provenance() {
  const { provenance: p, spec } = page.report;
  const rows = { spec: spec.file, "SHA-256": spec.sha256, program: p.git ? `${p.program}, ${p.git}` : p.program,
    compiler: `${p.compiler}, ${p.flags}`, MuJoCo: p.mujoco, Eigen: p.eigen,
    "instruction set": `${p.instructions} of ${p.instructions_available.join(", ")}: ${p.instructions_reason}`, machine: [p.cpu, `${p.cores} cores`, p.load_average === null ? "" : `load ${p.load_average.toFixed(2)}`].filter(Boolean).join(", ") };
  return [html("h2", {}, "Provenance"),
    html("dl", {}, ...Object.entries(rows).flatMap(([key, value]) => [html("dt", {}, key), html("dd", {}, String(value))])),
    page.report.complete ? null : html("p", { class: "problem" }, "The run was not completed; this is what was computed.")];
}

/** System, light, dark, and round again. */
function themeButton() {
  const button = /** @type {HTMLButtonElement} */ (document.getElementById("theme"));
  const themes = ["system", "light", "dark"];
  let theme = 0;
  button.hidden = false;
  button.addEventListener("click", () => {
    theme = (theme + 1) % themes.length;
    button.textContent = `Theme: ${themes[theme]}`;
    if (theme === 0) delete document.documentElement.dataset.theme;
    else document.documentElement.dataset.theme = themes[theme];
    repaint();
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", repaint);
  fitPrint();
}

/** What is drawn in pixels does not follow the theme by itself. */
function repaint() {
  document.dispatchEvent(new Event("repaint"));
}

function contents() {
  const titles = [...document.querySelectorAll("main > section")].map((s) => ({ id: s.id, title: s.querySelector("h2")?.firstChild?.textContent || "" }));
  document.getElementById("contents")?.append(html("ul", {}, ...titles.map(({ id, title }) => html("li", {}, html("a", { href: "#" + id }, title)))));
}
