// Numbers for reading. Tables keep the exact value in `data-value`.

const superscripts = "⁰¹²³⁴⁵⁶⁷⁸⁹";

/** @param {number} n an integer */
function superscript(n) {
  return (n < 0 ? "⁻" : "") + String(Math.abs(n)).replace(/\d/g, (d) => superscripts[Number(d)]);
}

/** `10⁻¹²` @param {number} n */
const powerOfTen = (n) => "10" + superscript(n);

/**
 * `3.1 × 10⁻¹³`, `0.0125`, `6000`
 * @param {number | null | undefined} value
 * @param {number} [digits] significant ones
 */
function written(value, digits = 2) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "not a number";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e-3 && size < 1e5) return String(Number(value.toPrecision(Math.max(digits, 3)))).replace("-", "−");
  const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
  return `${mantissa.replace("-", "−")} × ${powerOfTen(Number(exponent))}`;
}

/** @param {number} seconds */
function duration(seconds) {
  for (const [unit, name] of /** @type {[number, string][]} */ ([[1e-9, "ns"], [1e-6, "µs"], [1e-3, "ms"]]))
    if (seconds < 999.5 * unit) return `${Number((seconds / unit).toPrecision(3))} ${name}`;
  return `${Number(seconds.toPrecision(seconds < 999.5 ? 3 : 4))} s`;
}

const day = 86400;          // [s]
const year = 31556925.9747; // [s] the tropical year, which is that of the spec's units

/** A time in a run: from two days on in days, from two years on in years. @param {number} t [s] */
function instant(t) {
  if (Math.abs(t) >= 2 * year) return `${(t / year).toFixed(3)} years`;
  return Math.abs(t) >= 2 * day ? `${(t / day).toFixed(3)} days` : `${t.toFixed(2)} s`;
}

/** How long a span of a run is. @param {number} t [s] */
function span(t) {
  if (t >= 2 * year) return `${written(t / year, 3)} years`;
  return t >= 2 * day ? `${written(t / day, 3)} days` : `${written(t, 2)} s`;
}

/** For a tick of an axis. @param {number} value */
function tick(value) {
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e-3 && size < 1e5) return String(Number(value.toPrecision(6))).replace("-", "−");
  const [mantissa, exponent] = value.toExponential(3).split("e");
  const short = String(Number(mantissa)).replace("-", "−");
  return short === "1" ? powerOfTen(Number(exponent)) : `${short}·${powerOfTen(Number(exponent))}`;
}
