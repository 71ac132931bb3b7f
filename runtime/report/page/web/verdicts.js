// The six verdicts: how each is called, and what it leaves of the judgements in a table. A report
// without `verdict` in its members, or with an older run verdict, is read as far as it tells.

/** @typedef {"agree" | "disagree" | "unresolved" | "not_judged" | "failed" | "interrupted"} Verdict */

/** @type {Record<Verdict, {word: string, kind: string}>} */
const verdictLooks = {
  agree: { word: "agree", kind: "pass" },
  disagree: { word: "DISAGREE", kind: "fail" },
  unresolved: { word: "unresolved", kind: "unresolved" },
  not_judged: { word: "not judged", kind: "unjudged" },
  failed: { word: "failed", kind: "fail" },
  interrupted: { word: "interrupted", kind: "unjudged" },
};

/** @param {unknown} text */
const isVerdict = (text) => typeof text === "string" && Object.hasOwn(verdictLooks, text);

/** The engines of a member that stopped. @param {any} member */
const failedEngines = (member) => engines.filter((e) => member.engines?.[e.key]?.status === "failed");

/** @param {any} member @returns {any[]} every figure that may be judged */
function judgedFigures(member) {
  const references = Object.values(member.references || {}).flatMap((runs) => Object.values(runs)).flatMap((metrics) => Object.values(metrics));
  return [...Object.values(member.agreement || {}), ...Object.values(member.conservation || {}), ...references];
}

/** @param {any} member @returns {Verdict} */
function memberVerdict(member) {
  if (isVerdict(member.verdict)) return member.verdict;
  if (failedEngines(member).length > 0) return "failed";
  if (engines.some((e) => String(member.engines?.[e.key]?.reason || "").startsWith("interrupted"))) return "interrupted";
  if (member.resolution?.resolved === false) return "unresolved";
  const passes = judgedFigures(member).map((figure) => figure.pass);
  if (passes.includes(false)) return "disagree";
  return passes.includes(true) ? "agree" : "not_judged";
}

/** @returns {Verdict} */
function runVerdict() {
  const { verdict, members, complete } = page.report;
  if (verdict !== "not_judged" || page.is_work_precision) return isVerdict(verdict) ? verdict : "not_judged";
  const found = members.map(memberVerdict);
  if (!complete || found.includes("interrupted")) return "interrupted";
  return found.includes("failed") ? "failed" : "not_judged";
}

/** Why a member is in no fit: `failed`, `unresolved`, `interrupted`; nothing of one that counts.
 *  Only the first members are on the page whole. @param {number | undefined} index
 *  @returns {Verdict | undefined} */
function leftOutFor(index) {
  if (index === undefined) return undefined;
  const member = page.report.members[index];
  const verdict = member ? memberVerdict(member) : /** @type {Verdict | undefined} */ (page.left_out?.[index]);
  return verdict === "failed" || verdict === "unresolved" || verdict === "interrupted" ? verdict : undefined;
}

/** How many members are left out for a reason. @param {Verdict} verdict */
function countLeftOut(verdict) {
  let count = 0;
  for (let i = 0; i < page.members_run; i += 1) if (leftOutFor(i) === verdict) count += 1;
  return count;
}

/** The heading of a verdict that is no judgement; of others the program's own words stand. */
function verdictTitle() {
  const verdict = runVerdict();
  if (verdict === "agree" || verdict === "disagree") return null;
  const count = countLeftOut(verdict);
  const members = page.is_study && count > 0 ? `${count} of ${page.members_run} members` : "";
  switch (verdict) {
    case "unresolved": return members ? `${members} ${count === 1 ? "is" : "are"} not resolved` : "The run does not resolve the vehicle's motion";
    case "failed": return members ? `${members} failed` : "The run failed";
    case "interrupted": return "Interrupted";
    default: return "Not judged";
  }
}

/** `2 members failed, 3 are unresolved: they are marked, and left out of every fit.` */
function leftOutWords() {
  if (!page.is_study) return "";
  const failed = countLeftOut("failed"), unresolved = countLeftOut("unresolved");
  const members = (/** @type {number} */ n) => `${n} ${n === 1 ? "member" : "members"}`;
  const said = [failed > 0 ? `${members(failed)} failed` : "",
    unresolved > 0 ? `${members(unresolved)} ${unresolved === 1 ? "is" : "are"} unresolved` : ""].filter(Boolean);
  if (said.length === 0) return "";
  return `${said.join(" and ")}: ${failed + unresolved === 1 ? "it is" : "they are"} marked and left out of every fit.`;
}

/** Until when both engines ran. @param {any} member */
function comparedUntil(member) {
  const ends = engines.map((e) => member.engines[e.key]?.t_end_s).filter((t) => t !== undefined);
  return ends.length === 0 ? "" : ` at t = ${instant(Math.min(...ends))}`;
}

/** What to say above judged tables of a member that cannot be judged. @param {any} member */
function unjudgedNote(member) {
  switch (memberVerdict(member)) {
    case "failed": return note(`The run stopped${comparedUntil(member)}. What was compared until then is shown and not judged.`);
    case "unresolved": return note("The run does not resolve the vehicle's motion, so nothing here is judged.");
    case "interrupted": return note(`The run was interrupted${comparedUntil(member)}. What was compared until then is shown; only an exceeded tolerance is certain.`);
    default: return null;
  }
}

/** Whether a figure's judgement stands. @param {any} figure @param {Verdict} verdict of its member */
const stands = (figure, verdict) => typeof figure?.pass === "boolean" &&
  verdict !== "failed" && verdict !== "unresolved" && (verdict !== "interrupted" || !figure.pass);

/** @param {any} figure with `pass` @param {Verdict} verdict of its member @returns {Cell} */
function passCell(figure, verdict) {
  if (stands(figure, verdict)) return figure.pass ? textCell("ok", "pass") : textCell("EXCEEDED", "fail");
  if (typeof figure?.pass !== "boolean") return textCell("not judged", "unjudged");
  return textCell({ failed: "stopped", unresolved: "unresolved", interrupted: "so far" }[/** @type {"failed"} */ (verdict)], "unjudged");
}
