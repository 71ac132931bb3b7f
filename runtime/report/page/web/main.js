// Puts the page of a run or a study together.

/** The judged figures of a member with their names. @param {any} member
 *  @returns {{name: string, unit: string, figure: any}[]} */
function namedFigures(member) {
  const named = (/** @type {Record<string, any>} */ figures) => Object.entries(figures || {})
    .map(([key, figure]) => ({ name: balances[/** @type {"energy_relative"} */ (key)] || words(key).label, unit: words(key).unit, figure }));
  return [...named(member.agreement), ...named(member.conservation),
    ...referenceFigures(member).map(({ name, label, key, figure }) =>
      ({ name: `${label} against ${name}, ${words(key).label.replace(/^hub /, "")}`, unit: words(key).unit, figure }))];
}

/** The figure that uses most of its tolerance, of all members whose judgement stands. */
function closestFigure() {
  const judged = page.report.members.flatMap((/** @type {any} */ member, /** @type {number} */ i) =>
    namedFigures(member).filter(({ figure }) => figure.tolerance && stands(figure, memberVerdict(member)))
      .map((one) => ({ ...one, member: i, part: one.figure.max === null ? Infinity : one.figure.max / one.figure.tolerance })));
  return judged.reduce((/** @type {any} */ most, /** @type {any} */ one) => (most === null || one.part > most.part ? one : most), null);
}

/** Why the first engine that has no whole run has none, in words.
 *  @param {string[]} statuses of the engines that are asked about */
function engineTrouble(...statuses) {
  for (const [i, member] of page.report.members.entries())
    for (const { key, label } of engines)
      if (member.engines[key]?.reason && statuses.includes(member.engines[key].status))
        return `${page.is_study ? `Member ${i}, ` : ""}${label}: ${member.engines[key].reason}.`;
  return "";
}

/** Why the first unresolved member is that. */
function unresolvedReason() {
  const i = page.report.members.findIndex((/** @type {any} */ m) => memberVerdict(m) === "unresolved");
  const reason = page.report.members[i]?.resolution?.reasons?.[0];
  return reason ? `${page.is_study ? `Member ${i}: ` : ""}${reason}.` : "";
}

/** How near the judged figures are to their limits. */
function closestWords() {
  const closest = closestFigure();
  if (closest === null) return "The spec gives no tolerance that could be judged.";
  const { part, name, unit, figure, member } = closest;
  if (part === 0) return "No quantity that is judged differs at all.";
  const where = page.is_study ? `, in member ${member}` : "";
  const sized = (/** @type {number} */ value) => [written(value), unit].filter(Boolean).join(" ");
  const reached = `${name}, ${figure.max === null ? "which is not a number" : `at most ${sized(figure.max)}`}`;
  return `${figure.pass ? "Closest to its limit" : "Furthest beyond its limit"}: ${reached}, with ${sized(figure.tolerance)} allowed${where}.`;
}

/** Why the verdict is what it is. */
function verdictDetail() {
  const verdict = runVerdict();
  if (page.is_work_precision && verdict === "not_judged") return "A work-precision study has no verdict.";
  if (verdict === "failed") return engineTrouble("failed");
  if (verdict === "interrupted") return engineTrouble("ok") || "What was computed until then is shown.";
  if (verdict === "unresolved") return [unresolvedReason(), "Whether the engines agree says nothing."].filter(Boolean).join(" ");
  const skipped = engineTrouble("skipped");
  return verdict === "not_judged" && skipped ? skipped : [closestWords(), leftOutWords()].filter(Boolean).join(" ");
}

/** The verdict's look, and its words where the judgement is none. */
function showVerdict() {
  const title = verdictTitle();
  const heading = document.getElementById("verdict");
  if (!heading) return;
  heading.parentElement?.setAttribute("data-verdict", runVerdict());
  if (title === null) return;
  heading.textContent = title;
  document.title = `${page.report.spec.name} · ${title}`;
}

function sourceSection() {
  const name = page.report.spec.name;
  const source = (/** @type {string} */ label, /** @type {string} */ file, /** @type {string} */ text) => text === "" ? null
    : html("details", {}, html("summary", {}, label), download(`Download ${file}`, file, () => text), html("pre", { tabindex: 0 }, text));
  return section("Sources",
    note(page.is_study ? "Of member 0." : "What was run, to read and to take along."),
    source("The spec with every default filled in", `${name}.resolved.yaml`, page.resolved),
    source("The MJCF that MuJoCo loaded", `${name}.xml`, page.mjcf));
}

function compose() {
  const first = page.report.members[0];
  const main = /** @type {HTMLElement} */ (document.getElementById("main"));
  const put = (/** @type {string} */ id, /** @type {string} */ text) => { /** @type {HTMLElement} */ (document.getElementById(id)).textContent = text; };
  showVerdict();
  document.getElementById("verdict-detail")?.replaceChildren(...withCommands(verdictDetail()));
  put("setting", [page.vehicle, page.plan, page.depletion].filter(Boolean).join(" · "));
  main.append(...[
    ...part("The study", () => page.is_study ? studySections() : []),
    ...part("Why they differ", () => [attributionSection()]),
    ...part("Why an engine has no result", () => engineRemarks(first)),
    ...part("Resolution", () => [resolutionSection(first)]),
    ...part("Agreement", () => [agreementSection(first)]),
    ...part("References", () => [referenceSection(first)]),
    ...part("Conservation", () => [conservationSection(first)]),
    ...part("Cost", () => [costSection(first)]),
    ...part("The replay", () => [replaySection()]),
    ...part("Time histories", () => [historiesSection()]),
    ...part("Sources", () => [sourceSection()]),
  ].filter((node) => node !== null));
  if (page.is_study)
    for (const title of main.querySelectorAll("section#resolution h2, section#agreement h2, section#conservation h2, section#cost h2, section#references h2, section#replay h2, section#time-histories h2"))
      title.append(html("span", { class: "of" }, " of member 0"));
  document.getElementById("provenance")?.append(.../** @type {Node[]} */ (provenance().filter(Boolean)));
  contents();
  themeButton();
}

compose();
