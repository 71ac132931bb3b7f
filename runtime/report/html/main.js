// Puts the page together. A part that cannot be made says so in its place; the others still come.

/** @param {string} name @param {() => (Node | null)[]} make */
function part(name, make) {
  try {
    return make();
  } catch (error) {
    console.error(error);
    return [html("p", { class: "problem" }, `${name} could not be shown: ${error}`)];
  }
}

/** The metric that uses most of its tolerance, of all members. */
function closestMetric() {
  let closest = { part: -1, key: "", member: 0 };
  page.report.members.forEach((/** @type {any} */ member, /** @type {number} */ i) => {
    for (const [key, metric] of Object.entries(member.agreement)) {
      if (!metric.tolerance) continue;
      const part = metric.max === null ? Infinity : metric.max / metric.tolerance;
      if (part > closest.part) closest = { part, key, member: i };
    }
  });
  return closest;
}

/** Why the first engine that has no whole run has none, in words. */
function engineTrouble() {
  for (const [i, member] of page.report.members.entries())
    for (const { key, label } of engines)
      if (member.engines[key]?.reason)
        return `${page.is_study ? `Member ${i + 1}, ` : ""}${label}: ${member.engines[key].reason}.`;
  return "";
}

/** Why the verdict is what it is. */
function verdictDetail() {
  if (page.is_work_precision) return "A work-precision study has no verdict.";
  const trouble = engineTrouble();
  if (page.report.verdict === "not_judged" && trouble !== "") return trouble;
  const { part, key, member } = closestMetric();
  if (part < 0) return "The spec gives no tolerance that could be judged.";
  if (part === 0) return "No quantity that is judged differs at all.";
  const metric = page.report.members[member].agreement[key];
  const { label, unit } = words(key);
  const where = page.is_study ? `, in member ${member + 1}` : "";
  const reached = `${label}, ${metric.max === null ? "which is not a number" : `at most ${written(metric.max)} ${unit}`}`;
  return `${metric.pass ? "Closest to its limit" : "Furthest beyond its limit"}: ${reached}, with ${written(metric.tolerance)} ${unit} allowed${where}.`;
}

function sourceSection() {
  const name = page.report.spec.name;
  const source = (/** @type {string} */ label, /** @type {string} */ file, /** @type {string} */ text) => text === "" ? null
    : html("details", {}, html("summary", {}, label), download(`Download ${file}`, file, () => text), html("pre", { tabindex: 0 }, text));
  return section("Sources",
    note(page.is_study ? "Of the first member." : "What was run, to read and to take along."),
    source("The spec with every default filled in", `${name}.resolved.yaml`, page.resolved),
    source("The MJCF that MuJoCo loaded", `${name}.xml`, page.mjcf));
}

function provenance() {
  const { provenance: p, spec } = page.report;
  const rows = { spec: spec.file, "SHA-256": spec.sha256, program: p.git ? `${p.program}, ${p.git}` : p.program,
    compiler: `${p.compiler}, ${p.flags}`, MuJoCo: p.mujoco, Eigen: p.eigen,
    machine: [p.cpu, `${p.cores} cores`, p.load_average === null ? "" : `load ${p.load_average.toFixed(2)}`].filter(Boolean).join(", ") };
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
  sharedTime.charts.forEach((chart) => chart.redraw());
  document.dispatchEvent(new Event("repaint"));
}

/** In light, at the width of a sheet. */
function fitPrint() {
  /** @type {string | undefined} */
  let before;
  window.addEventListener("beforeprint", () => {
    before = document.documentElement.dataset.theme;
    document.documentElement.dataset.theme = "light";
    document.documentElement.classList.add("for-print");
    repaint();
  });
  window.addEventListener("afterprint", () => {
    if (before) document.documentElement.dataset.theme = before;
    else delete document.documentElement.dataset.theme;
    document.documentElement.classList.remove("for-print");
    repaint();
  });
}

function contents() {
  const titles = [...document.querySelectorAll("main > section")].map((s) => ({ id: s.id, title: s.querySelector("h2")?.firstChild?.textContent || "" }));
  document.getElementById("contents")?.append(html("ul", {}, ...titles.map(({ id, title }) => html("li", {}, html("a", { href: "#" + id }, title)))));
}

function compose() {
  const first = page.report.members[0];
  const main = /** @type {HTMLElement} */ (document.getElementById("main"));
  const put = (/** @type {string} */ id, /** @type {string} */ text) => { /** @type {HTMLElement} */ (document.getElementById(id)).textContent = text; };
  put("verdict-detail", verdictDetail());
  put("setting", [page.vehicle, page.plan].join(" · "));
  main.append(...[
    ...part("The study", () => page.is_study ? studySections() : []),
    ...part("Why they differ", () => [attributionSection()]),
    ...part("Agreement", () => [...engineRemarks(first), agreementSection(first)]),
    ...part("References", () => [referenceSection(first)]),
    ...part("Conservation", () => [conservationSection(first)]),
    ...part("Cost", () => [costSection(first)]),
    ...part("The replay", () => [replaySection()]),
    ...part("Time histories", () => [historiesSection()]),
    ...part("Sources", () => [sourceSection()]),
  ].filter((node) => node !== null));
  if (page.is_study)
    for (const title of main.querySelectorAll("section#agreement h2, section#conservation h2, section#cost h2, section#references h2, section#replay h2, section#time-histories h2"))
      title.append(html("span", { class: "of" }, " of the first member"));
  document.getElementById("provenance")?.append(.../** @type {Node[]} */ (provenance().filter(Boolean)));
  contents();
  themeButton();
}

compose();
