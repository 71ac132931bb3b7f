// Tables of what report.json says of a member and of a study.

/** A limit, or none. @param {any} figure @param {string} unit */
const limitCell = (figure, unit) => typeof figure?.tolerance === "number" ? numberCell(figure.tolerance, unit) : textCell("–", "number");

const rulerHead = { text: "maximum ● and tolerance ┃, by decades" };

/** @param {any} member */
function agreementSection(member) {
  const keys = Object.keys(member.agreement);
  if (keys.length === 0) return null;
  const verdict = memberVerdict(member);
  const rulers = rulerScale(keys.map((key) => member.agreement[key]));
  return section("Agreement",
    note("The largest difference of the two engines over the recorded samples, and when it occurred."),
    unjudgedNote(member),
    table("Agreement of the engines",
      [textCell("quantity"), textCell("verdict"), textCell("maximum", "number"), textCell("at", "number"),
        textCell("tolerance", "number"), rulerHead],
      keys.map((key) => {
        const metric = member.agreement[key];
        const { label, unit } = words(key);
        return {
          label, cells: [
            passCell(metric, verdict),
            numberCell(metric.max, unit),
            { value: metric.at_s, text: instant(metric.at_s), kind: "number" },
            limitCell(metric, unit),
            { node: ruler(metric, rulers, stands(metric, verdict)), kind: "ruler" },
          ],
        };
      })));
}

/** Every figure of a member's references. @param {any} member */
function referenceFigures(member) {
  return Object.entries(member.references || {}).flatMap(([name, runs]) => engines.flatMap(({ key: engine, label }) =>
    Object.entries(runs[engine] || {}).map(([key, figure]) => ({ name, engine, label, key, figure }))));
}

/** @param {any} member */
function referenceSection(member) {
  const figures = referenceFigures(member);
  if (figures.length === 0) return null;
  const verdict = memberVerdict(member);
  const judged = figures.some(({ figure }) => typeof figure.tolerance === "number");
  const rulers = rulerScale(figures.map(({ figure }) => figure));
  return section("References",
    note("Each engine against a solution that neither of them uses."),
    judged ? unjudgedNote(member) : null,
    table("Differences from references", [textCell("reference"), textCell("engine"), ...(judged ? [textCell("verdict")] : []),
      textCell("maximum", "number"), textCell("at", "number"), ...(judged ? [textCell("tolerance", "number"), rulerHead] : [])],
    figures.map(({ name, engine, label, key, figure }) => {
      const { label: quantity, unit } = words(key);
      // A reference speaks of the system's centre of mass where a metric speaks of the hub.
      return { label: `${name}, ${quantity.replace(/^hub /, "")}`, cells: [
        textCell(label, "engine-" + engine), ...(judged ? [passCell(figure, verdict)] : []), numberCell(figure.max, unit),
        { value: figure.at_s, text: instant(figure.at_s), kind: "number" },
        ...(judged ? [limitCell(figure, unit), { node: ruler(figure, rulers, stands(figure, verdict)), kind: "ruler" }] : [])] };
    })));
}

/** What is balanced, by its key in report.json. */
const balances = { energy_relative: "energy balance", momentum_relative: "momentum", angular_momentum_relative: "angular momentum" };

/** @param {any} member */
function conservationSection(member) {
  const verdict = memberVerdict(member);
  const figures = member.conservation || {};
  const judged = Object.values(figures).some((figure) => typeof figure.tolerance === "number");
  const rulers = rulerScale(Object.values(figures));
  return section("Conservation",
    note("The largest imbalance of each engine's books, external work and impulses counted, relative to the size of what is balanced."),
    judged ? unjudgedNote(member) : null,
    table("Conservation", [textCell("books"), ...(judged ? [textCell("verdict")] : []),
      ...engines.map((e) => textCell(e.label, "number engine-" + e.key)), ...(judged ? [textCell("tolerance", "number"), rulerHead] : [])],
      Object.entries(balances).map(([key, label]) => ({
        label, cells: [...(judged ? [passCell(figures[key], verdict)] : []),
          ...engines.map((e) => numberCell(member.engines[e.key]?.conservation?.[key])),
          ...(judged ? [limitCell(figures[key], ""), { node: ruler(figures[key], rulers, stands(figures[key], verdict)), kind: "ruler" }] : [])],
      }))));
}

/** @param {any} member */
function costSection(member) {
  const timing = member.timing;
  const timed = engines.filter((e) => timing?.[e.key]?.median_s !== undefined);
  if (timed.length === 0) return null;
  const rows = timed.map(({ key, label }) => {
    const { median_s, us_per_step, trials_s } = timing[key];
    return { label, kind: "engine-" + key, cells: [
      { value: us_per_step, text: duration(1e-6 * us_per_step), kind: "number" },
      { value: median_s, text: duration(median_s), kind: "number" },
      { text: `${duration(Math.min(...trials_s))} to ${duration(Math.max(...trials_s))}`, kind: "number" },
      { value: member.engines[key].steps, text: String(member.engines[key].steps), kind: "number" },
      { value: member.engines[key].evaluations, text: String(member.engines[key].evaluations), kind: "number" }] };
  });
  const ratio = timing.ratio_bsm_over_mujoco;
  return section("Cost",
    ratio ? html("p", {}, `MuJoCo takes ${written(1 / ratio, 3)} times as long as BSM.`)
      : timed.length === 2 ? note("The trials are too scattered for a ratio: the machine had other work.") : null,
    table("Cost", [textCell("engine"), textCell("per step", "number"), textCell("whole run, median", "number"),
      textCell("trials", "number"), textCell("steps", "number"), textCell("evaluations", "number")], rows),
    note(`Protocol: ${timing.protocol}.`));
}

/** Why an engine has no result. @param {any} member */
function engineRemarks(member) {
  return engines
    .filter(({ key }) => member.engines[key] && member.engines[key].reason)
    .map(({ key, label }) => {
      const { status, reason } = member.engines[key];
      return html("p", { class: status === "failed" ? "problem" : "note" }, `${label}: ${status === "ok" ? "" : `${status}, `}${reason}`);
    });
}
