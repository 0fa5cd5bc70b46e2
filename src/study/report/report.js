// Draws the page: texts, tables, the drop at an instant, fields; after figures.js.

function showOrbits(animation) {
  const figures = element("div", { class: "figures" });
  section("Orbits", figures);
  // Every sample where the figures of displacement have them, else the frames of the drop.
  const line = (name, id) => data.charts.find((c) => c.id === "displacement-" + id)?.lines.find((l) => l.name === name && l.rises && l.complete);
  const frames = (b) => ({ x: b.z, y: b.y, said: `one sample every ${short((b.time[b.time.length - 1] - b.time[0]) / (b.time.length - 1))} ms; results.h5 has every one` });
  const samples = (b) => {
    const y = line(b.name, "y"), z = line(b.name, "z");
    return y && z ? { x: z.y, y: y.y, said: "every recorded sample" } : frames(b);
  };
  const farthest = ({ x, y }) => x.reduce((most, v, i) => Math.max(most, Math.abs(v), Math.abs(y[i])), 0);
  // One scale for all bearings: equal air gaps are equal circles.
  const reach = 1.08 * Math.max(...animation.bearings.map((b) => Math.max(farthest(samples(b)), b.gap + Math.abs(Drop.rest(b).y))));
  animation.bearings.forEach((b, i) => new Figure({
    id: "orbit-" + b.name, title: `${b.name}: orbit of the rotor's centre`, square: true, circle: b.gap, centre: { x: Drop.rest(b).z, y: Drop.rest(b).y }, reach,
    x: { label: data.directions.z, unit: "um" }, y: { label: data.directions.y, unit: "um" },
    note: `From the axis of the unloaded outer ring. Dashed: radial air gap of ${short(b.gap)} µm (0-peak), at ambient temperature, about the inner ring's centre before the drop, which hangs in its clearance.`,
    lines: [{ name: "rotor centre", colour: i, dash: 0, ...samples(b) }] }, figures));
  (animation.probes || []).forEach((p, i) => new Figure({
    id: "orbit-probe-" + p.name, title: `${p.name}: orbit of the rotor's centre at the probe`, square: true, circle: p.gap,
    x: { label: data.directions.z, unit: "um" }, y: { label: data.directions.y, unit: "um" },
    note: `Dashed: radial clearance of ${short(p.gap)} µm about the stationary part's axis.`,
    lines: [{ name: "rotor centre", colour: i + animation.bearings.length, dash: 0, ...frames(p) }] }, figures));
}

// Load of every ball over time: a row of the picture for each ball.
function showBallLoads(bearing, into) {
  const n = bearing.loads.length, columns = bearing.loads[0].length;
  const canvas = element("canvas", { width: columns, height: n });
  const pixels = canvas.getContext("2d").createImageData(columns, n);
  bearing.loads.forEach((row, ball) => row.forEach((load, k) => {
    pixels.data.set([...shade(load / bearing.largest), 255], 4 * (ball * columns + k));
  }));
  canvas.getContext("2d").putImageData(pixels, 0, 0);
  const total = isNarrow() ? 380 : 620, left = isNarrow() ? 62 : 76, top = 10, width = total - left - 74, height = isNarrow() ? 188 : 228, right = left + width + 14;
  const picture = element("image", { href: canvas.toDataURL(), x: left, y: top, width, height, preserveAspectRatio: "none", style: "image-rendering: pixelated" });
  const bar = Array.from({ length: 40 }, (_, i) => element("rect", { x: right, y: top + height * (1 - (i + 1) / 40), width: 12, height: height / 40 + 0.5, fill: `rgb(${shade((i + 0.5) / 40)})` }));
  const svg = element("svg", { viewBox: `0 0 ${total} ${height + 52}`, role: "img", "aria-label": `${bearing.name}: load of every ball` }, picture, ...bar,
    element("path", { class: "axis", d: `M${left} ${top}h${width}v${height}h${-width}z` }));
  const text = (x, y, anchor, content, more = {}) => svg.append(element("text", { x, y, "text-anchor": anchor, ...more }, content));
  for (const { value, text: label } of ticks(0, bearing.end, isNarrow() ? 4 : 6)) text(left + (width * value) / bearing.end, top + height + 15, "middle", label);
  for (const { value, text: label } of ticks(0, bearing.largest, 4)) text(right + 16, top + height * (1 - value / bearing.largest) + 4, "start", label);
  for (let first = 0; first < n; first += bearing.balls_per_row) {
    const y = top + (height * first) / n;
    text(left - 6, y + 10, "end", `row ${first / bearing.balls_per_row + 1}`);
    svg.append(element("line", { class: "axis", x1: left, x2: left + width, y1: y, y2: y }));
  }
  text(left + width / 2, height + 44, "middle", "time [ms]", { class: "x-label" });
  svg.append(element("text", { class: "y-label", "text-anchor": "middle", transform: `translate(13 ${top + height / 2}) rotate(-90)` }, "ball (colour: load [N])"));
  const caption = element("p", { class: "note" }, `Balls of each row from top to bottom, 1 to ${bearing.balls_per_row}; darker means a higher load. Each point is the largest recorded load in its time interval (0-peak)` + (bearing.is_held ? "; one without a recorded sample shows the load of the last sample before." : "."));
  const figure = element("figure", { class: "map", id: "figure-balls-" + bearing.name }, element("figcaption", {}, `${bearing.name}: load of every ball`), svg, caption);
  svg.onpointermove = (event) => {
    const box = svg.getBoundingClientRect();
    const k = Math.floor((((event.clientX - box.left) * total) / box.width - left) / width * columns), ball = Math.floor((((event.clientY - box.top) * total) / box.width - top) / height * n);
    tip.hidden = !(k >= 0 && k < columns && ball >= 0 && ball < n);
    if (tip.hidden) return;
    tip.textContent = `row ${Math.floor(ball / bearing.balls_per_row) + 1}, ball ${(ball % bearing.balls_per_row) + 1}, ${short((k / columns) * bearing.end)} ms: ${short(bearing.loads[ball][k])} N`;
    tip.style.left = Math.min(event.clientX + 16, innerWidth - tip.offsetWidth - 8) + "px";
    tip.style.top = event.clientY + 12 + "px";
  };
  svg.onpointerleave = () => { tip.hidden = true; };
  into.append(figure);
}

// The section of a bearing with its temperatures at one instant.
function showField(bearing, picture, into) {
  const { columns, rows } = bearing, n = columns * rows;
  const levels = Uint8Array.from(atob(picture.levels), (c) => c.charCodeAt(0));
  const canvas = element("canvas", { width: columns, height: rows });
  const pixels = canvas.getContext("2d").createImageData(columns, rows);
  for (let i = 0; i < n; ++i)
    if (levels[i]) pixels.data.set([...shade((levels[i] - 1) / 254, WARM), 255], 4 * i);
  canvas.getContext("2d").putImageData(pixels, 0, 0);
  const [x0, x1] = bearing.x, [r0, r1] = bearing.r;
  const left = 64, top = 12, scale = Math.min(420 / (x1 - x0), 380 / (r1 - r0)), width = scale * (x1 - x0), height = scale * (r1 - r0);
  const total = { width: left + width + 96, height: top + height + 46 };
  const toX = (x) => left + scale * (x - x0), toY = (r) => top + height - scale * (r - r0);
  let d = "";
  for (let i = 0; i < bearing.edges.length; i += 4) d += `M${toX(bearing.edges[i]).toFixed(1)} ${toY(bearing.edges[i + 1]).toFixed(1)}L${toX(bearing.edges[i + 2]).toFixed(1)} ${toY(bearing.edges[i + 3]).toFixed(1)}`;
  const right = left + width + 18, part = (k) => shade((k + 0.5) / 60, WARM);
  const bar = Array.from({ length: 60 }, (_, k) => element("rect", { x: right, y: top + height * (1 - (k + 1) / 60), width: 14, height: height / 60 + 0.5, fill: `rgb(${part(k)})` }));
  const svg = element("svg", { viewBox: `0 0 ${total.width} ${total.height}`, style: `max-width:${total.width}px`, role: "img", "aria-label": `${bearing.name}: temperature rise at ${short(picture.time)} ms` },
    element("image", { href: canvas.toDataURL(), x: left, y: top, width, height, preserveAspectRatio: "none" }), element("path", { class: "edges", d, fill: "none", stroke: "#444", "stroke-width": 0.7 }), ...bar,
    element("rect", { x: right, y: top, width: 14, height, class: "axis" }), element("path", { class: "axis", d: `M${left} ${top}V${top + height}H${left + width}` }));
  const text = (x, y, anchor, content, more = {}) => svg.append(element("text", { x, y, "text-anchor": anchor, ...more }, content));
  for (const { value, text: label } of ticks(x0, x1, Math.max(2, Math.round(width / 70)))) text(toX(value), top + height + 15, "middle", label);
  for (const { value, text: label } of ticks(r0, r1, Math.max(2, Math.round(height / 50)))) text(left - 6, toY(value) + 4, "end", label);
  const span = picture.high - picture.low;
  if (span > 0) for (const { value, text: label } of ticks(picture.low, picture.high, 4)) text(right + 18, top + height * (1 - Math.sqrt((value - picture.low) / span)) + 4, "start", label);
  const fixed = (value) => String(+value.toFixed(Math.max(0, Math.ceil(3 - Math.log10(span || 1)) - 1)) || 0);
  text(left + width / 2, total.height - 10, "middle", "x [mm]", { class: "x-label" });
  svg.append(element("text", { class: "y-label", "text-anchor": "middle", transform: `translate(13 ${top + height / 2}) rotate(-90)` }, "r [mm]"),
    element("text", { class: "bar-label", "text-anchor": "middle", transform: `translate(${total.width - 8} ${top + height / 2}) rotate(-90)` }, "temperature rise [K]"));
  const caption = element("p", { class: "note" }, `Recorded field nearest to: ${picture.next_to.join("; ")}. From ${fixed(picture.low)} to ${fixed(picture.high)} K above ambient (${fixed(bearing.ambient + picture.low)} to ${fixed(bearing.ambient + picture.high)} °C); circumferential means. The colour scale follows the square root of the rise, so that thin hot layers and warm bodies are both visible.`);
  svg.onpointermove = (event) => {
    const box = svg.getBoundingClientRect(), zoom = total.width / box.width;
    const x = x0 + ((event.clientX - box.left) * zoom - left) / scale, r = r0 + (top + height - (event.clientY - box.top) * zoom) / scale;
    const column = Math.floor(((x - x0) / (x1 - x0)) * columns), row = Math.floor(((r1 - r) / (r1 - r0)) * rows);
    const level = column >= 0 && column < columns && row >= 0 && row < rows ? levels[row * columns + column] : 0;
    tip.hidden = !level;
    if (!level) return;
    tip.textContent = `x ${x.toFixed(2)} mm, r ${r.toFixed(2)} mm: ${fixed(picture.low + span * ((level - 1) / 254) ** 2)} K`;
    tip.style.left = Math.min(event.clientX + 16, innerWidth - tip.offsetWidth - 8) + "px";
    tip.style.top = event.clientY + 12 + "px";
  };
  svg.onpointerleave = () => { tip.hidden = true; };
  into.append(element("figure", { class: "field" }, element("figcaption", {}, `${bearing.name}: temperature rise in the section at ${short(picture.time)} ms`), svg, caption));
}

function showFields() {
  const figures = element("div", { class: "figures" });
  section("Temperature fields", figures);
  for (const bearing of data.fields) for (const picture of bearing.pictures) showField(bearing, picture, figures);
}

function showHead() {
  const warnings = data.checks.filter((check) => check.state === "warning"), missing = data.checks.filter((check) => check.state === "unknown"), uncertain = data.checks.filter((check) => check.state === "uncertain");
  page.append(element("h1", {}, data.user_title || data.title), ...(data.user_title ? [element("div", { class: "case-name" }, data.title)] : []), element("div", { class: "subtitle" }, data.provenance.facts.filter((f) => f[0] === "run by").map((f) => f[1]).join("")), element("nav", {}));
  const { state, verdict, rows } = data.acceptance || { state: "ok" }, isMet = state === "ok";
  const failed = isMet ? [] : [element("p", {}, element("strong", {}, verdict + " "), rows.filter((r) => r.state === state).map((r) => r.key).join("; "))];
  page.append(element("div", { class: "alert" + (warnings.length || !isMet ? "" : " none") }, ...failed,
    ...(warnings.length ? warnings.map((w) => element("p", {}, element("strong", {}, `Warning, ${w.name}: `), w.text)) : [element("p", {}, isMet ? "No warnings." : "No other warnings.")]),
    ...uncertain.map((u) => element("p", {}, element("strong", {}, `Uncertain, ${u.name}: `), u.text)),
    ...(missing.length ? [element("p", {}, element("strong", {}, "Not assessed: "), missing.map((m) => m.name).join("; "))] : [])));
}

function showNumbers() {
  const { bearings, rows, whole } = data.numbers;
  const all = element("div", { class: "columns" });
  if (rows.length) all.append(element("div", { class: "wide", tabindex: "0", role: "region", "aria-label": "numbers of each bearing" },
    table(["", "unit", ...bearings], rows.map((r) => [r.name, unit(r.unit), ...r.values]), ["", "", ...bearings.map(() => "number")])));
  if (whole.length) all.append(table(null, whole.map(([name, text]) => [name, text]), ["", "number"]));
  section("Main numbers", all);
}

function showProvenance() {
  const { facts, given, n_defaults } = data.provenance;
  const parts = [table(null, facts, ["", "code"]),
    element("h3", {}, "Parameters that differ from their defaults"),
    element("p", { class: "note" }, `The other ${n_defaults} parameters have their default values; “rotordrop defaults” lists the sources of these. The origin of a value is its file, its line and the author's comment there.`),
    table(["parameter", "value", "default", "origin of the value", "meaning"], given, ["code name", "code", "code", "code", "note"])];
  section("Provenance", ...parts);
}

function limitTable(rows, met = "✓ accepted", exceeded = "! REJECTED") {
  const words = { ok: met, warning: exceeded, unknown: "? not assessed" };
  return table(["", "result", "value", "limit", "usage"], rows.map((r) => [element("span", { class: "state " + r.state }, words[r.state] + (r.why ? `: ${r.why}` : "")),
    r.meaning ? element("span", { title: r.key }, r.meaning) : r.key, unit(r.value), unit(r.limit), r.usage]), ["", "", "number", "number", "number"]);
}

function showDamage(rows) {
  const bases = rows.map((r) => r.basis).filter((basis) => basis);
  section("Damage per drop", limitTable(rows, "✓ within", "! beyond"),
    element("p", { class: "note" }, "The allowed number of drops is the least of what was assessed: drops until the fatigue life L10 or the permitted wear depth is used up; 0 if the static safety is too small. " + bases.join(". ") + ". Wear coefficients are known to a factor of ten at best."));
}

function showAcceptance({ verdict, state, rows }) {
  section("Acceptance", element("p", { class: "verdict " + state }, element("strong", {}, verdict)), limitTable(rows),
    element("p", { class: "note" }, "Limits are those of the case ([limits]). Usage: value over an upper limit, or lower limit over value. What could not be assessed is not accepted."));
}

unpackLines(data.charts);
showHead();
if (data.acceptance) showAcceptance(data.acceptance);
if (data.damage && data.damage.length) showDamage(data.damage);
if (data.second_opinion) section("Second opinion", element("p", {}, data.second_opinion[0]), list(data.second_opinion.slice(1)));
section("The case", ...(data.note ? [element("p", { class: "user-note" }, data.note)] : []), ...data.words.map((text) => element("p", {}, text)));
showNumbers();
section("Checks", table(["", "", ""], data.checks.map((c) => [element("span", { class: "state " + c.state }, { ok: "✓ good", warning: "! warning", unknown: "? not assessed", uncertain: "? uncertain" }[c.state]), c.name, c.text])));
showMachine(data.machine, data.modes);
if (data.animation.bearings.length) {
  showDrops(data.animation);
  showOrbits(data.animation);
}
const sections = new Map();
for (const chart of data.charts) {
  if (!sections.has(chart.section)) {
    if (sections.has("Temperatures") && data.fields.length && !document.getElementById("temperature-fields")) showFields();
    sections.set(chart.section, element("div", { class: "figures" }));
    section(chart.section, sections.get(chart.section));
  }
  new Figure(chart, sections.get(chart.section));
}
if (data.spectra_note) (sections.has("Spectra") ? sections.get("Spectra").parentNode : section("Spectra")).append(element("p", { class: "note" }, data.spectra_note));
for (const fall of data.waterfalls) showWaterfall(fall, sections.get("Spectra"));
for (const bearing of data.ball_loads) showBallLoads(bearing, sections.get("Balls"));
if (data.comparison)
  section("Lumped circuit against finite elements", list(data.comparison.in_short), element("h3", {}, "Verdict"), list(data.comparison.verdict));
section("Assumptions", list(data.assumptions));
showProvenance();
page.append(element("p", { class: "note screen" }, "Figures: hover for values, drag to zoom, double-click to reset, click a legend entry to hide its line. " +
  "Lines with more samples than a figure can show keep the smallest and largest of each interval; a zoomed figure says what it shows."));
page.dataset.ready = "yes";
