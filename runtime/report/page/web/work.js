// Work and precision: what an error costs, by engine and by integrator.

/** @param {any} configuration @param {string} cost */
const costOf = (configuration, cost) => cost === "median_s" ? configuration.median_s : configuration.evaluations;

/** What makes configurations one curve: all but what its points differ in. @param {any} settings */
const wayOf = (settings) => settingWords(Object.fromEntries(Object.entries(settings)
  .filter(([path]) => !/^simulation\.(step|tolerance)/.test(path))));

/** One cloud for each engine and integrator. @param {"attitude_deg" | "position_m"} error
 *  @param {string} cost @param {string} unit @returns {Cloud[]} */
function workClouds(error, cost, unit) {
  const work = page.report.studies.work_precision;
  return engines.filter((e) => work[e.key]).flatMap((e) => {
    const ended = work[e.key].configurations.filter((/** @type {any} */ c) => !c.diverged);
    return grouped(ended, (c) => wayOf(c.settings)).map((group) => {
      const way = wayOf(group[0].settings);
      return {
        name: [e.label, way].filter(Boolean).join(", "), ...trendLook({ engine: e.key, settings: way ? { "simulation.integrator": way } : undefined }),
        line: way !== "",
        dots: group.map((c) => ({ x: costOf(c, cost), y: c[error], hollow: !c.frontier, out: leftOutFor(c.member) !== undefined,
          said: `${e.label}, ${settingWords(c.settings)}, member ${c.member}: ${written(c[error], 3)} ${unit}` })) };
    });
  });
}

/** @param {"attitude_deg" | "position_m"} error @param {string} cost */
function workFigure(error, cost) {
  const work = page.report.studies.work_precision;
  const unit = error === "attitude_deg" ? "deg" : "m";
  const present = engines.filter((e) => work[e.key]);
  return logFigure({
    title: error === "attitude_deg" ? "Attitude" : "Hub position",
    x: cost === "median_s" ? "time of the run [s]" : "evaluations", y: `error at the end [${unit}]`,
    floors: present.map((e) => ({ y: work[e.key].floor[error], name: `floor of ${e.label}`, colour: `var(--${e.key})` })),
    clouds: workClouds(error, cost, unit),
  }, unfold("Data", () => html("div", {}, ...present.map((e) => workTable(work[e.key], e.label)))));
}

/** @param {any} work of one engine @param {string} label */
function workTable(work, label) {
  return table(`Work and precision of ${label}`,
    [textCell(`${label} configuration`), textCell("member", "number"), textCell("attitude error", "number"), textCell("position error", "number"),
      textCell("evaluations", "number"), textCell("time", "number"), textCell("frontier")],
    work.configurations.map((/** @type {any} */ c) => ({ label: settingWords(c.settings), cells: [textCell(String(c.member), "number"), ...(c.diverged
      ? [textCell("diverged", "fail"), textCell(""), textCell(""), textCell(""), textCell("")]
      : [numberCell(c.attitude_deg, "deg"), numberCell(c.position_m, "m"),
        { value: c.evaluations, text: String(c.evaluations), kind: "number" },
        c.median_s === undefined ? textCell("–", "number") : { value: c.median_s, text: duration(c.median_s), kind: "number" },
        textCell(c.frontier ? "yes" : "")])] })));
}

function workSection() {
  const work = page.report.studies.work_precision;
  if (!work || Object.keys(work).length === 0) return null;
  const timed = engines.some((e) => work[e.key]?.configurations.some((/** @type {any} */ c) => c.median_s !== undefined));
  const cost = timed ? "median_s" : "evaluations";
  const faster = work.bsm_faster ? html("p", {}, `BSM is faster in ${work.bsm_faster.in} of ${work.bsm_faster.of} configurations.`) : null;
  const remarks = (work.remarks ?? []).map((/** @type {string} */ remark) => html("p", {}, `${remark}.`));
  return section("Work and precision", faster, ...remarks,
    note("The end of every configuration against a tight run of the same engine. A circle is BSM, a square MuJoCo; the colour is the integrator's. Full marks are on the engine's frontier: nothing cheaper has a smaller attitude error. Below the floor, where two tight runs differ, an error means nothing."),
    html("div", { class: "plots" }, workFigure("attitude_deg", cost), workFigure("position_m", cost)));
}
