// Puts the page of a campaign together: what the members show together, and which to look at.

/** @typedef {{description: string, drawn_drivers: number, report: any,
 *             distributions: {values: string, shares: string}[], scatter: any}} CampaignPage */

const shown = /** @type {CampaignPage} */ (/** @type {unknown} */ (page));
const { campaign } = shown.report;

/** `99.5 %`; near all and near nothing with the digits that matter. @param {number} share */
function shareWords(share) {
  const near = Math.min(share, 1 - share);
  return `${Number((100 * share).toFixed(near > 0 && near < 0.001 ? 3 : 1))} %`;
}

/** @param {number[]} interval of shares */
const between = ([low, high]) => `${shareWords(low).replace(" %", "")} to ${shareWords(high)}`;

/** @param {number} n @param {string} one @param {string} [several] */
const counted = (n, one, several = one + "s") => `${n} ${n === 1 ? one : several}`;

/** `below 0.1 rad` @param {any} output */
function requirementWords({ requirement, unit }) {
  const bound = (/** @type {string} */ word, /** @type {number | null} */ value) =>
    typeof value === "number" ? [word, written(value, 6), unit === "1" ? "" : unit].filter(Boolean).join(" ") : "";
  return [bound("above", requirement.above), bound("below", requirement.below)].filter(Boolean).join(" and ");
}

/** A number and, below it, how well it is known. @param {string} first @param {string} second */
const twoLines = (first, second) => html("span", {}, `${first} `, html("br"), html("small", {}, second));

/** `1019 of 1024`, `99.5 % (98.9 to 99.8 %)` @param {any} pass @returns {Cell} */
const rateCell = (pass) => (pass.rate === null ? textCell("–", "number")
  : { node: twoLines(`${pass.passed} of ${pass.of}`, `${shareWords(pass.rate)} (${between(pass.interval)})`), kind: `number ${pass.passed < pass.of ? "fail" : "pass"}` });

/** Ranges of members: `3, 17–20`. @param {{count: number, ranges: number[][]}} missing */
function rangeWords(missing) {
  const most = 10;
  const named = missing.ranges.slice(0, most).map(([first, last]) => (first === last ? String(first) : `${first}–${last}`));
  const more = missing.count - missing.ranges.slice(0, most).reduce((sum, [first, last]) => sum + last - first + 1, 0);
  return named.join(", ") + (more > 0 ? ` and ${more} more` : "");
}

/** Numbers one after another, at most so many. @param {number[]} members @param {number} [count] of all */
function listed(members, count = members.length) {
  const most = 30;
  const more = count - Math.min(most, members.length);
  return members.slice(0, most).join(", ") + (more > 0 ? ` and ${more} more` : "");
}

/** What the requirements come to, in a sentence. */
function requirementSentence() {
  const required = campaign.outputs.filter((/** @type {any} */ o) => o.requirement);
  if (required.length === 0) return "The spec requires nothing of the outputs.";
  const broken = required.filter((/** @type {any} */ o) => o.pass.flown.passed < o.pass.flown.of);
  if (broken.length === 0) {
    const flown = counted(campaign.flown, "member");
    return required.length === 1 ? `The requirement held in all of ${flown} flown.` : `All ${required.length} requirements held in all of ${flown} flown.`;
  }
  const said = broken.map((/** @type {any} */ o) => `${o.name} is not ${requirementWords(o)} in ${counted(o.pass.flown.of - o.pass.flown.passed, "member")}`);
  return `${broken.length} of ${counted(required.length, "requirement")} broken: ${said.join("; ")}.`;
}

function campaignDetail() {
  const { members, flown, missing } = campaign;
  const without = members - flown - missing.count;
  return [requirementSentence(),
    without > 0 ? `${counted(without, "member")} could not be flown.` : "",
    missing.count > 0 ? `${counted(missing.count, "member")} ${missing.count === 1 ? "is" : "are"} missing: ${rangeWords(missing)}.` : "",
    ...campaign.remarks.map((/** @type {string} */ remark) => `${remark}.`)].filter(Boolean).join(" ");
}

function campaignSetting() {
  const { members, flown, sampling, seed, drawn } = campaign;
  return [`${flown} of ${counted(members, "member")} flown`, `${counted(drawn.length, "number")} drawn`,
    `${sampling.replace("_", " ")} sampling`, `seed ${seed}`].join(" · ");
}

/** A number of an output, without the unit that its row has. @param {number | null} value @returns {Cell} */
const plainCell = (value) => ({ value, kind: "number", digits: 4 });

/** @param {any} output @returns {Cell} */
function percentileCell({ p95, p95_bounds: [low, high] }) {
  if (p95 === null) return textCell("–", "number");
  const bounds = low === null && high === null ? "" : high === null ? `${written(low, 4)} or more`
    : low === null ? `${written(high, 4)} or less` : `${written(low, 4)} to ${written(high, 4)}`;
  return { value: p95, node: twoLines(written(p95, 4), bounds), kind: "number" };
}

/** @param {any} output @returns {Cell} */
function toleranceCell({ requirement, tolerance_95_95: upper, tolerance_95_95_lower: lower }) {
  const isAbove = typeof requirement?.above === "number", isBelow = typeof requirement?.below === "number";
  const said = [isAbove && lower !== null ? `> ${written(lower, 4)}` : "", (isBelow || !isAbove) && upper !== null ? `< ${written(upper, 4)}` : ""].filter(Boolean);
  return textCell(said.join(", ") || "–", "number");
}

function outputsSection() {
  const { outputs } = campaign;
  if (outputs.length === 0) return null;
  const required = outputs.some((/** @type {any} */ o) => o.requirement);
  const judged = (/** @type {any} */ o) => {
    if (!o.requirement) return [textCell("–"), textCell("–", "number"), textCell("–", "number")];
    return [textCell(requirementWords(o)), rateCell(o.pass.flown), rateCell(o.pass.all)];
  };
  return section("Outputs",
    required ? note("Rates and percentiles stand with their 95 % confidence bounds (Clopper-Pearson, order statistics). Held by all counts members that were not flown as broken.") : null,
    note("95/95: with 95 % confidence, 95 % of all vehicles that could be drawn are on this side (Wilks; it takes 59 members)."),
    table("Outputs", [textCell("output"), ...(required ? [textCell("requirement"), textCell("held by flown", "number"), textCell("held by all", "number")] : []),
      ...["min", "median", "95th percentile", "max", "95/95", "members"].map((h) => textCell(h, "number"))],
    outputs.map((/** @type {any} */ o) => ({ label: withUnit(o.name, o.unit), cells: [...(required ? judged(o) : []),
      plainCell(o.min), plainCell(o.median), percentileCell(o), plainCell(o.max), toleranceCell(o), { value: o.count, text: String(o.count), kind: "number" }] }))),
    html("ul", { class: "reasons note" }, ...outputs.filter((/** @type {any} */ o) => o.meaning).map((/** @type {any} */ o) =>
      html("li", {}, `${o.name}: ${o.meaning}${o.count < campaign.flown ? `, which ${counted(campaign.flown - o.count, "flown member")} never reached` : ""}`))));
}

function drawnSection() {
  const { drawn } = campaign;
  if (drawn.length === 0) return null;
  return section("What was drawn",
    table("Drawn numbers", [textCell("number"), textCell("distribution"), textCell("nominal", "number"), textCell("unit")],
      drawn.map((/** @type {any} */ d) => ({ label: d.name, cells: [{ text: d.distribution, kind: "text" }, { ...plainCell(d.nominal), digits: 6 }, textCell(d.unit === "1" ? "–" : d.unit)] }))));
}

function distributionSection() {
  const figures = campaign.outputs.flatMap((/** @type {any} */ output, /** @type {number} */ i) =>
    output.count === 0 ? [] : [distributionFigure(output, doubles(shown.distributions[i].values), doubles(shown.distributions[i].shares))]);
  return figures.length === 0 ? null : section("Distributions", note("Of the members that were flown and have a value."), html("div", { class: "plots" }, ...figures));
}

/** @param {any} driver @returns {Cell} */
function sobolCell({ sobol_first: index }) {
  if (index === null) return textCell("–", "number");
  return { value: index.value, text: `${index.value.toFixed(2)} (${index.interval[0].toFixed(2)} to ${index.interval[1].toFixed(2)})`.replaceAll("-", "−"), kind: "number" };
}

/** `< 0.001` @param {number} p */
const chanceWords = (p) => (p < 0.001 ? "< 0.001" : p.toFixed(3));

/** @param {any[]} drivers @param {string} name of the output */
function driverTable(drivers, name) {
  const correlation = (/** @type {number} */ r) => r.toFixed(2).replace("-", "−");
  return table(`Drivers of ${name}`, [textCell("drawn number"), textCell("rank correlation", "number"), textCell("p", "number"), textCell("Sobol’ index", "number")],
    drivers.map((d) => ({ label: d.name, cells: [
      d.rank_correlation === null ? textCell("–", "number") : { value: d.rank_correlation, text: correlation(d.rank_correlation), kind: "number" },
      d.p_value === null ? textCell("–", "number") : { value: d.p_value, text: chanceWords(d.p_value), kind: "number" }, sobolCell(d)] })));
}

/** @param {any} output @param {number} place @param {Scatter} scatter */
function driversOf(output, place, scatter) {
  const most = 10;
  const all = output.drivers;
  const figures = all.slice(0, shown.drawn_drivers).filter((/** @type {any} */ d) => scatter.has(d.name))
    .map((/** @type {any} */ d) => scatter.figure(output, place, campaign.drawn.find((/** @type {any} */ one) => one.name === d.name)));
  return html("div", { class: "drivers" }, html("h3", {}, `What ${output.name} follows`),
    driverTable(all.slice(0, most), output.name),
    output.no_sobol ? note(`Sobol’ indices are not computed: ${output.no_sobol}.`) : null,
    all.length > most ? unfold(`The other ${all.length - most}`, () => driverTable(all.slice(most), output.name)) : null,
    html("div", { class: "plots" }, ...figures));
}

function driversSection() {
  const outputs = campaign.outputs.map((/** @type {any} */ output, /** @type {number} */ place) => ({ output, place }))
    .filter((/** @type {any} */ one) => one.output.count > 0 && one.output.drivers.length > 0);
  if (outputs.length === 0) return null;
  const scatter = new Scatter(shown.scatter);
  const parts = outputs.map(() => html("div"));
  parts.forEach((/** @type {HTMLElement} */ place, /** @type {number} */ i) =>
    whenNear(place, () => place.replaceChildren(driversOf(outputs[i].output, outputs[i].place, scatter))));
  const thinnedOut = scatter.members.length < scatter.of ? ` Each picture shows ${scatter.members.length} of ${scatter.of} members; broken and unflown ones are preferred.` : "";
  return section("Drivers",
    note("Rank correlation (Spearman) says how well a number alone orders the output, from −1 to 1; p is the chance that a number without any influence shows as much, looked at by itself. " +
      "The Sobol’ index is the share of the output’s variance that the number explains alone, with its 95 % interval." + thinnedOut), ...parts);
}

/** Which number tells members that disagree from those that agree, said with care. @param {any} driver */
function twinDriverWords(driver) {
  const share = driver.larger_where_they_disagree;
  const chance = driver.p_value < 0.05 ? `Chance alone would let any of the numbers differ as much with a probability of ${chanceWords(driver.p_value).replace("< ", "less than ")}. That does not make it the cause.`
    : "That is no more than chance alone may give.";
  return `Of the drawn numbers, ${driver.name} differs most between members that disagree and members that agree: in ${shareWords(Math.max(share, 1 - share))} of such pairs it is ${share >= 0.5 ? "larger" : "smaller"} in the one that disagrees. ${chance}`;
}

function twinsSection() {
  const { twins } = campaign;
  if (twins.flown === 0) return null;
  const judged = twins.agree + twins.disagree;
  return section("Engines",
    html("p", {}, `Both engines flew ${counted(twins.flown, "member")}${judged < twins.flown ? `; ${counted(judged, "is", "are")} judged` : ""}. ` +
      (judged === 0 ? "" : `They disagree in ${twins.disagree} of ${judged}: ${shareWords(twins.disagree / judged)} (${between(twins.interval)} with 95 % confidence).`)),
    twins.disagree > 0 ? html("p", { class: "problem" }, `They disagree in ${twins.disagree === 1 ? "member" : "members"} ${listed(twins.members, twins.disagree)}.`) : null,
    twins.driver ? html("p", {}, twinDriverWords(twins.driver)) : null);
}

function failuresSection() {
  const { failures } = campaign;
  if (failures.length === 0) return null;
  return section("Not flown", note("Members by the reason, without the numbers in it."),
    table("Why members were not flown", [textCell("reason"), textCell("members", "number"), textCell("first", "number")],
      failures.map((/** @type {any} */ f) => ({ label: f.reason || "no reason given", cells: [{ value: f.count, text: String(f.count), kind: "number" }, { value: f.first, text: String(f.first), kind: "number" }] }))));
}

function unresolvedSection() {
  const { unresolved } = campaign;
  if (unresolved.count === 0) return null;
  return section("Not resolved", note("What these members show says nothing of the vehicle: their step is too long for it."),
    html("p", { class: "problem" }, `The step does not resolve ${unresolved.count === 1 ? "member" : "members"} ${listed(unresolved.members, unresolved.count)}.`),
    html("p", {}, `Member ${unresolved.members[0]}: ${unresolved.reason}.`));
}

/** @param {string | null} command @returns {Cell} */
const commandCell = (command) => (command === null ? textCell("–") : { node: html("code", {}, command), kind: "text" });

/** @param {string} name @param {Cell[]} head @param {{label: string, cells: Cell[]}[]} rows */
const commandTable = (name, head, rows) => table(name, [textCell("member", "number"), ...head, textCell("command that flies it alone")],
  rows.map((row) => ({ ...row, kind: "number" })));

function worstSection() {
  const { worst, kept, outputs } = campaign;
  if (worst.length + kept.length === 0) return null;
  const folders = new Map(kept.map((/** @type {any} */ k) => [k.member, `${k.folder}/`]));
  const unit = (/** @type {string} */ name) => outputs.find((/** @type {any} */ o) => o.name === name)?.unit;
  const verdict = (/** @type {boolean | null} */ pass) => (pass === null ? textCell("–") : pass ? textCell("held", "pass") : textCell("BROKEN", "fail"));
  const others = kept.filter((/** @type {any} */ k) => !worst.some((/** @type {any} */ w) => w.member === k.member));
  return section("Members to look at",
    worst.length === 0 ? null : note("Of each output, the flown members that are nearest to breaking what is required of it, or furthest beyond it."),
    worst.length === 0 ? null : commandTable("Worst members", [textCell("output"), textCell("value", "number"), textCell("requirement"), textCell("trajectories")],
      worst.map((/** @type {any} */ w) => ({ label: String(w.member), cells: [textCell(w.output),
        w.value === null ? textCell("never reached", "number") : { value: w.value, unit: unit(w.output), kind: "number", digits: 4 }, verdict(w.pass),
        textCell(folders.get(w.member) || "–"), commandCell(w.command)] }))),
    others.length === 0 ? null : note(worst.length === 0 ? "Trajectories were kept of these members." : "Trajectories were also kept of these members."),
    others.length === 0 ? null : commandTable("Kept members", [textCell("trajectories")],
      others.map((/** @type {any} */ k) => ({ label: String(k.member), cells: [textCell(`${k.folder}/`), commandCell(k.command)] }))));
}

function composeCampaign() {
  const put = (/** @type {string} */ id, /** @type {string} */ text) => { /** @type {HTMLElement} */ (document.getElementById(id)).textContent = text; };
  put("verdict-detail", campaignDetail());
  put("setting", campaignSetting());
  document.getElementById("main")?.append(.../** @type {Node[]} */ ([
    ...part("Outputs", () => [outputsSection()]),
    ...part("What was drawn", () => [drawnSection()]),
    ...part("Distributions", () => [distributionSection()]),
    ...part("Drivers", () => [driversSection()]),
    ...part("Engines", () => [twinsSection()]),
    ...part("Not flown", () => [failuresSection()]),
    ...part("Not resolved", () => [unresolvedSection()]),
    ...part("Members to look at", () => [worstSection()]),
    html("p", { class: "note" }, "Every member is a row of campaign.csv and of campaign.nc."),
  ].filter((node) => node !== null)));
  document.getElementById("provenance")?.append(.../** @type {Node[]} */ (provenance().filter(Boolean)));
  contents();
  themeButton();
}

composeCampaign();
