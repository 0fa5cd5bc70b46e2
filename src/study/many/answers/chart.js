// What the pages of studies and of measured series share: scales, frames, overlays.

function short(value) {
  if (value === null || value === undefined) return "–";
  if (typeof value === "string") return value;
  if (value === 0) return "0";
  const size = Math.abs(value);
  return size >= 1e6 || size < 1e-4 ? value.toExponential(3) : String(+value.toPrecision(4));
}
const unitText = (unit) => (unit && unit !== "1" ? ` ${unit}` : "");
const label = (quantity) => quantity.name + (quantity.unit && quantity.unit !== "1" ? ` [${quantity.unit}]` : "");
const isNumber = (value) => typeof value === "number";

function ticks(low, high, n) {
  const raw = (high - low) / n || 1;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= raw * 0.999);
  const made = [];
  for (let k = Math.ceil(low / step - 1e-9); k <= Math.floor(high / step + 1e-9); ++k) made.push(k * step);
  return made;
}

// Smallest and largest of any number of numbers.
function endsOf(numbers) {
  let low = Infinity, high = -Infinity;
  for (const v of numbers) { if (v < low) low = v; if (v > high) high = v; }
  return [low, high];
}

// Where the median lies between the ends, 0 in the middle and 1/2 at either.
function offCentre(numbers, f) {
  const sorted = numbers.map(f).sort((a, b) => a - b), low = sorted[0], high = sorted[sorted.length - 1];
  return Math.abs(sorted[sorted.length >> 1] - (low + high) / 2) / (high - low);
}

// Positions of a quantity on an axis: numbers as they are, evenly in the logarithm if they span decades and lie more evenly there; texts one after the other.
function scaleOf(quantity, from, to, extra = []) {
  const numbers = quantity.values.filter(isNumber).concat(extra);
  if (quantity.values.some((v) => typeof v === "string")) {
    const names = [...new Set(quantity.values.filter((v) => v !== null))];
    const at = (v) => from + ((names.indexOf(v) + 0.5) / names.length) * (to - from);
    return { at, ticks: names.map((name) => ({ value: name, text: name })) };
  }
  let [low, high] = endsOf(numbers);
  if (!(low < high)) { low -= Math.abs(low) * 0.1 || 1; high += Math.abs(high) * 0.1 || 1; }
  const isLog = low > 0 && high / low > 50 && offCentre(numbers, Math.log10) < offCentre(numbers, (v) => v);
  const f = isLog ? Math.log10 : (v) => v;
  const room = 0.04 * (f(high) - f(low)), a = f(low) - room, b = f(high) + room;
  const at = (v) => from + ((f(v) - a) / (b - a)) * (to - from);
  const marks = isLog ? ticks(Math.ceil(a), Math.floor(b), 6).filter((p) => Number.isInteger(p)).map((p) => 10 ** p) : ticks(low, high, 5);
  const text = (value) => (isLog || marks.length < 2 ? short(value) : tickText(value, marks[1] - marks[0]));
  return { at, ticks: (isLog && marks.length < 2 ? [low, high] : marks).map((value) => ({ value, text: text(value) })) };
}

function showTip(event, lines) {
  tip.hidden = false;
  tip.replaceChildren(...lines.map((line) => element("div", {}, line)));
  tip.style.left = Math.min(event.clientX + 14, innerWidth - tip.offsetWidth - 8) + "px";
  tip.style.top = Math.max(4, Math.min(event.clientY + 12, innerHeight - tip.offsetHeight - 4)) + "px";
}
const hideTip = () => { tip.hidden = true; };

function frame(width, height, x, y, xLabel, yLabel, margin) {
  const made = [];
  const bottom = height - margin.bottom, right = width - margin.right;
  for (const { value, text } of x.ticks) made.push(element("line", { class: "grid", x1: x.at(value), x2: x.at(value), y1: margin.top, y2: bottom }), element("text", { x: x.at(value), y: bottom + 15, "text-anchor": "middle" }, text));
  for (const { value, text } of y.ticks) made.push(element("line", { class: "grid", x1: margin.left, x2: right, y1: y.at(value), y2: y.at(value) }), element("text", { x: margin.left - 5, y: y.at(value) + 4, "text-anchor": "end" }, text));
  made.push(element("path", { class: "axis", d: `M${margin.left} ${margin.top}V${bottom}H${right}` }), element("text", { x: (margin.left + right) / 2, y: height - 6, "text-anchor": "middle" }, xLabel),
    element("text", { "text-anchor": "middle", transform: `translate(12 ${(margin.top + bottom) / 2}) rotate(-90)` }, yLabel));
  return made;
}

// Measured samples as dots, computed curves as lines.
function overlay(figure) {
  const width = 760, height = 300, margin = { left: 78, right: 10, top: 22, bottom: 40 };
  const all = [figure.measured, ...figure.curves];
  const x = scaleOf({ values: all.flatMap((c) => c.times) }, margin.left, width - margin.right), y = scaleOf({ values: all.flatMap((c) => c.values) }, height - margin.bottom, margin.top);
  const parts = frame(width, height, x, y, "time [s]", label(figure), margin);
  figure.measured.times.forEach((t, i) => parts.push(element("circle", { class: "measured", cx: x.at(t).toFixed(1), cy: y.at(figure.measured.values[i]).toFixed(1), r: 1.8 })));
  figure.curves.forEach((curve, c) => parts.push(element("path", { class: `curve curve-${figure.curves.length - c}`, d: curve.times.map((t, i) => `${i ? "L" : "M"}${x.at(t).toFixed(1)} ${y.at(curve.values[i]).toFixed(1)}`).join("") })));
  all.forEach((curve, c) => parts.push(element("text", { class: c ? `name curve-${figure.curves.length - c + 1}` : "name measured", x: margin.left + 8 + 110 * c, y: 14 }, curve.name)));
  return element("figure", {}, element("svg", { viewBox: `0 0 ${width} ${height}`, style: `max-width:${width}px`, role: "img", "aria-label": `measured and computed ${figure.name}` }, parts));
}

const differenceTable = (list) => table(["series", "file", "values", "rms", ...(list.some((d) => isNumber(d.rms_start)) ? ["rms at the start"] : []), "mean", "largest", "at", "variance explained"],
  list.map((d) => [d.series, d.file, `${d.n}${d.after_end ? `, ${d.after_end} after the end of the drop left out` : ""}`, short(d.rms) + unitText(d.unit), ...(list.some((o) => isNumber(o.rms_start)) ? [short(d.rms_start)] : []), short(d.mean) + unitText(d.unit), short(d.largest) + unitText(d.unit), `${short(d.largest_time)} s`, isNumber(d.share) ? `${short(100 * d.share)} %` : "–"]));
