// Draws the page of a study from the JSON in #data: answers, response, parallel coordinates, indices, worst and failed points.

const limitsOf = (result) => data.limits.filter((limit) => limit.result === result.name);
// How far a value is beyond each limit of its result, negative within it.
const beyondLimits = (result, value) => limitsOf(result).flatMap((limit) => [...(isNumber(limit.max) ? [value - limit.max] : []), ...(isNumber(limit.min) ? [limit.min - value] : [])]);
const isBroken = (result, value) => value !== null && beyondLimits(result, value).some((distance) => distance > 0);
// How bad it is: by the limit that it is farthest beyond; without limits the value itself.
function beyond(result, value) {
  const distances = beyondLimits(result, value);
  return distances.length ? Math.max(...distances) : value;
}
function worstOf(result) {
  const found = result.values.map((_, k) => k).filter((k) => result.values[k] !== null);
  return found.sort((a, b) => beyond(result, result.values[b]) - beyond(result, result.values[a])).slice(0, 10);
}
function worstWords(result, n) {
  const limits = limitsOf(result), hasMin = limits.some((limit) => isNumber(limit.min)), hasMax = limits.some((limit) => isNumber(limit.max));
  const drops = n === 1 ? "The drop" : `The ${n} drops`;
  return hasMin && hasMax ? `${drops} farthest beyond the limits of ${result.name}, or nearest to them;` : `${drops} with the ${hasMin ? "smallest" : "largest"} ${result.name};`;
}

const rerunCommand = (point) => `${data.rerun} --point ${point}`;
const describe = (k) => [`point ${data.points[k]}`, ...data.parameters.map((p) => `${p.name}: ${short(p.values[k])}${unitText(p.unit)}`)];

const quantile = (sorted, p) => {
  const at = p * (sorted.length - 1), i = Math.floor(at);
  return i + 1 < sorted.length ? sorted[i] + (at - i) * (sorted[i + 1] - sorted[i]) : sorted[sorted.length - 1];
};

// One result over one parameter, with median and 5 to 95 % of bins with equally many points.
function scatter(parameter, result) {
  const width = 380, height = 270, margin = { left: 68, right: 10, top: 8, bottom: 40 };
  const shown = result.values.map((v, k) => k).filter((k) => result.values[k] !== null && parameter.values[k] !== null);
  const bounds = limitsOf(result).flatMap((limit) => [limit.max, limit.min]).filter(isNumber);
  const x = scaleOf(parameter, margin.left, width - margin.right), y = scaleOf(result, height - margin.bottom, margin.top, bounds);
  const parts = frame(width, height, x, y, label(parameter), label(result), margin);
  const sorted = [...shown].sort((a, b) => x.at(parameter.values[a]) - x.at(parameter.values[b]));
  const levels = new Set(sorted.map((k) => parameter.values[k]));
  let bins = [];
  if (levels.size <= 12) bins = [...levels].map((level) => sorted.filter((k) => parameter.values[k] === level));
  else {
    const n = Math.max(4, Math.min(12, Math.floor(sorted.length / 15)));
    if (sorted.length >= 40) bins = Array.from({ length: n }, (_, i) => sorted.slice(Math.floor((i * sorted.length) / n), Math.floor(((i + 1) * sorted.length) / n)));
  }
  const lines = bins.filter((bin) => bin.length > 4).map((bin) => {
    const values = bin.map((k) => result.values[k]).sort((a, b) => a - b);
    return { x: bin.reduce((sum, k) => sum + x.at(parameter.values[k]), 0) / bin.length, low: y.at(quantile(values, 0.05)), mid: y.at(quantile(values, 0.5)), high: y.at(quantile(values, 0.95)) };
  });
  if (lines.length > 1) {
    const path = (list, key) => list.map((p, i) => `${i ? "L" : "M"}${p.x.toFixed(1)} ${p[key].toFixed(1)}`).join("");
    parts.push(element("path", { class: "band", d: path(lines, "high") + path([...lines].reverse(), "low").replace("M", "L") + "Z" }));
    for (const k of shown) parts.push(dot(k));
    parts.push(element("path", { class: "middle", d: path(lines, "mid") }));
  } else for (const k of shown) parts.push(dot(k));
  for (const bound of bounds) parts.push(element("line", { class: "limit", x1: margin.left, x2: width - margin.right, y1: y.at(bound), y2: y.at(bound) }));
  function dot(k) {
    const made = element("circle", { class: "point" + (isBroken(result, result.values[k]) ? " broken" : ""), cx: x.at(parameter.values[k]).toFixed(1), cy: y.at(result.values[k]).toFixed(1), r: shown.length > 800 ? 1.6 : 2.6 });
    made.onpointermove = (event) => showTip(event, [...describe(k), `${result.name}: ${short(result.values[k])}${unitText(result.unit)}`]);
    made.onpointerleave = hideTip;
    return made;
  }
  return element("figure", {}, element("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": `${result.name} over ${parameter.name}` }, parts));
}

// Cumulative share of the points below a value.
function cumulative(result) {
  const width = 380, height = 270, margin = { left: 56, right: 10, top: 8, bottom: 40 };
  const values = result.values.filter(isNumber).sort((a, b) => a - b);
  const bounds = limitsOf(result).flatMap((limit) => [limit.max, limit.min]).filter(isNumber);
  const x = scaleOf(result, margin.left, width - margin.right, bounds);
  const at = (p) => height - margin.bottom - p * (height - margin.bottom - margin.top);
  const y = { at, ticks: [0, 0.25, 0.5, 0.75, 1].map((value) => ({ value, text: `${100 * value} %` })) };
  const d = values.map((v, i) => `${i ? "L" : "M"}${x.at(v).toFixed(1)} ${at((i + 0.5) / values.length).toFixed(1)}`).join("");
  return element("figure", {}, element("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": `share of drops below a value of ${result.name}` },
    ...frame(width, height, x, y, label(result), "share of drops below", margin), element("path", { class: "middle", d, style: "stroke:#0072B2" }),
    ...bounds.map((bound) => element("line", { class: "limit", x1: x.at(bound), x2: x.at(bound), y1: margin.top, y2: height - margin.bottom }))));
}

// Every drop as a line over the parameters and the result; a drag along an axis selects.
function parallel(result, into) {
  const width = 1180, height = 360, margin = { left: 60, right: 70, top: 40, bottom: 16 };
  const axes = [...data.parameters, result];
  const shown = result.values.map((_, k) => k).filter((k) => axes.every((axis) => axis.values[k] !== null)).slice(0, 3000);
  const xs = axes.map((_, i) => margin.left + (i / (axes.length - 1)) * (width - margin.left - margin.right));
  const scales = axes.map((axis) => scaleOf(axis, height - margin.bottom, margin.top));
  const values = shown.map((k) => result.values[k]), [low, high] = endsOf(values);
  const colour = (v) => { const t = high > low ? (v - low) / (high - low) : 0.5; return `hsl(${230 - 215 * t} 75% ${52 - 10 * t}%)`; };
  const lines = shown.map((k) => {
    const line = element("path", { d: axes.map((axis, i) => `${i ? "L" : "M"}${xs[i].toFixed(1)} ${scales[i].at(axis.values[k]).toFixed(1)}`).join(""), fill: "none", stroke: colour(result.values[k]), "stroke-opacity": shown.length > 500 ? 0.35 : 0.6 });
    line.onpointermove = (event) => showTip(event, [...describe(k), `${result.name}: ${short(result.values[k])}${unitText(result.unit)}`]);
    line.onpointerleave = hideTip;
    return line;
  });
  const count = element("p", { class: "note" });
  const svg = element("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": "parallel coordinates" }, ...lines);
  const brushes = axes.map(() => null);
  const select = () => {
    let n = 0;
    shown.forEach((k, i) => {
      const isIn = brushes.every((brush, a) => !brush || (scales[a].at(axes[a].values[k]) >= brush[0] && scales[a].at(axes[a].values[k]) <= brush[1]));
      lines[i].classList.toggle("dim", !isIn);
      n += isIn;
    });
    count.textContent = brushes.some(Boolean) ? `${n} of ${shown.length} drops selected. A click on an axis removes its selection.` : `${shown.length} drops; drag along an axis to select.`;
  };
  axes.forEach((axis, i) => {
    const mark = element("rect", { class: "brush", x: xs[i] - 7, width: 14, y: 0, height: 0 });
    const hit = element("rect", { class: "axis-hit", x: xs[i] - 14, y: margin.top, width: 28, height: height - margin.top - margin.bottom, fill: "transparent" });
    svg.append(element("line", { class: "axis", x1: xs[i], x2: xs[i], y1: margin.top, y2: height - margin.bottom }), mark);
    for (const { value, text } of scales[i].ticks) svg.append(element("text", { x: xs[i] - 5, y: scales[i].at(value) + 4, "text-anchor": "end" }, text));
    svg.append(element("text", { x: Math.max(4, Math.min(width - 4, xs[i])), y: i % 2 ? 14 : 28, "text-anchor": i === 0 ? "start" : i === axes.length - 1 ? "end" : "middle" }, label(axis)), hit);
    const place = (event) => { const box = svg.getBoundingClientRect(); return ((event.clientY - box.top) * height) / box.height; };
    let from = null;
    hit.onpointerdown = (event) => { from = place(event); hit.setPointerCapture(event.pointerId); };
    hit.onpointermove = (event) => {
      if (from === null) return;
      brushes[i] = [Math.min(from, place(event)), Math.max(from, place(event))];
      mark.setAttribute("y", brushes[i][0]);
      mark.setAttribute("height", brushes[i][1] - brushes[i][0]);
      select();
    };
    hit.onpointerup = () => {
      if (!brushes[i] || brushes[i][1] - brushes[i][0] < 3) { brushes[i] = null; mark.setAttribute("height", 0); }
      from = null;
      select();
    };
  });
  select();
  into.replaceChildren(element("figure", { class: "wide" }, svg), count);
}

// Bars with intervals: first and total indices, or mean magnitudes of elementary effects.
function bars(entries, unit) {
  const rows = entries.length, width = 760, height = 46 + 34 * rows, left = 300, right = 20;
  const all = entries.flatMap((e) => e.bars.flatMap((b) => [b.value, b.low, b.high])).filter(isNumber);
  const low = Math.min(0, ...all), high = Math.max(...all, unit ? 0 : 0.1) * 1.02;
  const at = (v) => left + ((v - low) / (high - low || 1)) * (width - left - right);
  const parts = [];
  for (const value of ticks(low, high, 6)) parts.push(element("line", { class: "grid", x1: at(value), x2: at(value), y1: 4, y2: height - 30 }), element("text", { x: at(value), y: height - 14, "text-anchor": "middle" }, short(value)));
  entries.forEach((entry, i) => {
    const y = 8 + 34 * i;
    parts.push(element("text", { x: left - 8, y: y + 17, "text-anchor": "end" }, entry.name));
    entry.bars.forEach((bar, b) => {
      const h = entry.bars.length > 1 ? 12 : 20, top = y + b * 13;
      if (!isNumber(bar.value)) return;
      parts.push(element("rect", { class: "bar" + (b ? " second" : ""), x: Math.min(at(0), at(bar.value)), y: top, width: Math.abs(at(bar.value) - at(0)), height: h }));
      if (isNumber(bar.low) && isNumber(bar.high)) parts.push(element("line", { class: "interval", x1: at(bar.low), x2: at(bar.high), y1: top + h / 2, y2: top + h / 2 }));
    });
  });
  return element("svg", { viewBox: `0 0 ${width} ${height}`, style: `max-width:${width}px`, role: "img", "aria-label": "what matters" }, ...parts);
}

function influences(result) {
  if (data.morris) {
    const effects = data.morris[result.name];
    if (!effects) return element("p", {}, "This result does not vary.");
    const entries = Object.entries(effects).map(([name, e]) => ({ name, bars: [e.mean_magnitude] })).sort((a, b) => b.bars[0].value - a.bars[0].value);
    const known = (v) => (isNumber(v) ? short(v) : "–");
    const rows = Object.entries(effects).map(([name, e]) => [name, known(e.mean_magnitude.value), known(e.mean), known(e.deviation), String(e.n)]);
    return element("div", {}, bars(entries, true), element("p", { class: "note" }, `Mean magnitude of the change of ${label(result)} over the whole range of each parameter, with 95 % intervals (bootstrap). A deviation as large as the mean magnitude tells of interaction or curvature.`),
      table(["parameter", "mean magnitude", "mean", "deviation", "effects"], rows, ["", "number", "number", "number", "number"]));
  }
  const indices = data.indices && data.indices[result.name];
  if (!indices) return element("p", {}, data.indices ? "This result does not vary, or too few drops have it." : `A ${data.design} design has no indices; latin-hypercube, sobol-sequence, monte-carlo, saltelli and morris have.`);
  const entries = Object.entries(indices).map(([name, e]) => ({ name, bars: [e.first, ...(e.total ? [e.total] : [])] })).sort((a, b) => b.bars[b.bars.length - 1].value - a.bars[a.bars.length - 1].value);
  const hasTotal = entries[0].bars.length > 1;
  return element("div", {}, bars(entries, false), element("p", { class: "note" }, (hasTotal ? "Blue: first index, the part of the variance that a parameter explains by itself. Orange: total index, with its interactions. " : "First index: the part of the variance that a parameter explains by itself. ") + `Lines: 95 % intervals. Method: ${data.indices_method}.`));
}

function showAnswers() {
  const parts = [element("p", {}, data.counts)];
  if (data.limits.length && !data.minimise)
    parts.push(element("h3", {}, "Limits"), table(["result", "allowed", "broken by", "not assessed", "probability", "95 % interval"], data.limits.map((l) => [l.result,
      [isNumber(l.min) ? `from ${short(l.min)}` : "", isNumber(l.max) ? `up to ${short(l.max)}` : ""].filter(Boolean).join(" ") + unitText(l.unit), `${l.broken} of ${l.n} drops`,
      Object.entries(l.undefined_because || {}).map(([why, n]) => `${n}: ${why}`).join("; ") || "–",
      l.probability === null ? "–" : `${short(100 * l.probability)} %`, isNumber(l.low) ? `${short(100 * l.low)} to ${short(100 * l.high)} % (${l.interval})` : l.interval || "–"])));
  if (data.choose) {
    const c = data.choose;
    parts.push(element("h3", {}, `${100 * c.quantile} % quantile of ${c.result} by ${c.parameter}`),
      table([label({ name: c.parameter, unit: c.unit }), `quantile [${c.result_unit}]`, "95 % interval", "mean", "smallest", "largest", "drops", "without the result"], c.levels.map((l) => {
        const isBest = c.best && l.value === c.best.value;
        return [element("span", {}, short(l.value) + (isBest ? c.all_drawn === false ? "  ← smallest of those drawn" : "  ← smallest" : "")), short(l.quantile), isNumber(l.low) || isNumber(l.high) ? `${isNumber(l.low) ? short(l.low) : "?"} to ${isNumber(l.high) ? short(l.high) : "?"}` : "–", short(l.mean), short(l.smallest), short(l.largest), l.not_drawn ? "0, not drawn" : String(l.n), String(l.without_result) + (l.not_run ? ` (and ${l.not_run} not run)` : "")];
      }), ["", "number", "", "number", "number", "number", "number", "number"]));
    if (!c.best) parts.push(element("p", {}, "No level is called smallest: each has drops without this result or not run."));
  }
  section("Answers", ...parts);
}

// Value of every evaluation, and the smallest one so far that keeps the limits.
function course(m) {
  const width = 760, height = 300, margin = { left: 78, right: 10, top: 8, bottom: 40 };
  const shown = m.course.map((e, k) => ({ ...e, k })).filter((e) => isNumber(e.value));
  const order = { name: "evaluation", unit: "", values: shown.map((e) => e.k) }, values = { name: m.result, unit: m.unit, values: shown.map((e) => e.value) };
  const x = scaleOf({ ...order, values: [0, Math.max(1, m.course.length - 1)] }, margin.left, width - margin.right), y = scaleOf(values, height - margin.bottom, margin.top);
  const at = (k) => x.ticks.length ? margin.left + ((k + 0.5) / m.course.length) * (width - margin.left - margin.right) : 0;
  x.at = at;
  x.ticks = ticks(0, Math.max(1, m.course.length - 1), 8).filter(Number.isInteger).map((value) => ({ value, text: String(value) }));
  const parts = frame(width, height, x, y, "evaluation, searches one after the other", label(values), margin);
  let best = Infinity, d = "";
  for (const e of shown) {
    if (e.within_limits && e.value < best) { d += `${d ? `H${at(e.k).toFixed(1)}V` : `M${at(e.k).toFixed(1)} `}${y.at(e.value).toFixed(1)}`; best = e.value; }
    const dot = element("circle", { class: "point" + (e.within_limits ? "" : " broken"), cx: at(e.k).toFixed(1), cy: y.at(e.value).toFixed(1), r: shown.length > 400 ? 1.6 : 3 });
    dot.onpointermove = (event) => showTip(event, [`search ${e.search}, evaluation ${e.evaluation}, points ${e.points.join(" to ")}`, ...Object.entries(e.parameters).map(([name, v]) => `${name}: ${short(v)}${unitText(m.units[name])}`), `${m.result}: ${short(e.value)}${unitText(m.unit)}`]);
    dot.onpointerleave = hideTip;
    parts.push(dot);
  }
  if (d) parts.push(element("path", { class: "middle", d: d + `H${width - margin.right}` }));
  return element("figure", {}, element("svg", { viewBox: `0 0 ${width} ${height}`, style: `max-width:${width}px`, role: "img", "aria-label": "course of the search" }, parts));
}

function showSearch() {
  const m = data.minimise, what = m.of === "quantile" ? `${short(100 * m.quantile)} % quantile of ${m.result}` : m.drops_of_evaluation > 1 ? `mean of ${m.result}` : m.result;
  const row = (name, e) => [name, e ? short(e.value) : "–", e && isNumber(e.low) ? `${short(e.low)} to ${short(e.high)}` : "–", e ? (e.within_limits ? "yes" : "no") : "–", e ? e.points.join(" to ") : "–", ...Object.keys(m.units).map((p) => e ? short(e.parameters[p]) + ((e.at_end_of_range || []).includes(p) ? ", end of its range" : "") : "–")];
  section("Search", element("p", {}, `Smallest ${what}${data.limits.length ? " within the limits" : ""}, by ${m.method}: ${m.evaluations} evaluations of ${m.drops_of_evaluation} drop${m.drops_of_evaluation > 1 ? "s" : ""} in ${m.searches.length} search${m.searches.length > 1 ? "es" : ""}.`),
    table(["", label({ name: what, unit: m.unit }), "95 % interval", "within limits", "points", ...Object.keys(m.units).map((p) => label({ name: p, unit: m.units[p] }))], [row("best", m.best), row(m.method === "direct" ? "middle of the ranges" : "start", m.start), ...(m.searches.length > 1 ? m.searches.map((s, k) => row(`best of search ${k}${s.all_used ? ", which used all its evaluations" : ""}`, s.best)) : [])], ["", "number", "", "", "", ...Object.keys(m.units).map(() => "number")]),
    course(m), element("p", { class: "note" }, "Each point is an evaluation; orange ones break a limit. Line: smallest so far. The best of many uncertain values looks better than it is: compute it again with other starts before it is relied upon."));
}

// Predicted over computed: points on the diagonal are predicted well.
function showSurrogates() {
  const s = data.surrogate, entries = Object.entries(s.results);
  const figures = entries.filter(([, r]) => r.predicted).map(([name, r]) => {
    const width = 380, height = 320, margin = { left: 68, right: 10, top: 8, bottom: 40 }, all = { values: [...r.computed, ...r.predicted] };
    const x = scaleOf(all, margin.left, width - margin.right), y = scaleOf(all, height - margin.bottom, margin.top), [low, high] = endsOf(all.values);
    return element("figure", {}, element("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": `predicted over computed ${name}` }, ...frame(width, height, x, y, label({ name, unit: r.unit }), "predicted", margin),
      element("line", { class: "middle", x1: x.at(low), x2: x.at(high), y1: y.at(low), y2: y.at(high) }), r.computed.map((v, i) => element("circle", { class: "point", cx: x.at(v).toFixed(1), cy: y.at(r.predicted[i]).toFixed(1), r: 2 }))));
  });
  section("Surrogates", table(["result", "points", "variance explained", "rms error", "indices: first, total"], entries.map(([name, r]) => [label({ name, unit: r.unit }), r.points > r.n ? `${r.n} of ${r.points}` : String(r.n), r.reason || (isNumber(r.q2) ? (r.q2 > 0 ? `${short(100 * r.q2)} %` : "nothing") : "–"), short(r.rmse), r.q2 > 0 ? Object.entries(r.indices || {}).map(([p, i]) => `${p} ${short(i.first)}, ${short(i.total)}`).join("; ") : "–"])),
    element("div", { class: "small" }, ...figures), element("p", { class: "note" }, `${s.kind}; every point is predicted by a surrogate made from the other parts of the points (${s.folds}, or fewer where there are less).`));
}

function showFit() {
  const f = data.fit, parts = [];
  if (!f.measured) parts.push(element("p", {}, "The fit found no values."));
  else {
    parts.push(table(["parameter", "value", "95 % interval", "start"], Object.entries(f.parameters).map(([name, p]) => [label({ name, unit: p.unit }) + (p.at_end_of_range ? ": at the end of its range" : ""), short(p.value), `${short(p.low)} to ${short(p.high)}`, short(p.start)]), ["", "number", "", "number"]),
      element("p", { class: "note" }, `Intervals follow from the derivatives at these values and ${isNumber(f.chi_square_per_freedom) ? `the given noise (chi-square per degree of freedom ${short(f.chi_square_per_freedom)}; about 1 if model and noise are right)` : "what still differs"}; they hold for noise without memory and a model without error.`),
      ...(f.noise_doubt ? [element("p", {}, element("strong", {}, `Warning: ${f.noise_doubt}.`))] : []),
      element("h3", {}, "Measured less computed"), differenceTable(f.measured), ...data.overlay.map(overlay));
    if (f.searches.length > 1) parts.push(element("h3", {}, "Searches"), table(["search", "sum of squares", ...Object.keys(f.parameters)], f.searches.map((s, k) => [String(k), short(s.sum_of_squares), ...Object.keys(f.parameters).map((p) => s.parameters ? short(s.parameters[p]) : "–")])));
    parts.push(element("h3", {}, "Course"), course({ result: "sum of squares", unit: "", units: Object.fromEntries(Object.entries(f.parameters).map(([name, p]) => [name, p.unit])), course: f.course }));
  }
  section("Fit", ...parts);
}

// The sections of one result, which the reader chooses.
function showResults() {
  const chooser = element("select", { id: "result", "aria-label": "result" }, ...data.results.map((r, i) => element("option", { value: i }, r.long_name ? `${r.name}: ${r.long_name}` : r.name)));
  const response = element("div", { class: "small" }), lines = element("div", {}), matter = element("div", {}), worst = element("div", {});
  section("Response", element("div", { class: "choice" }, element("label", {}, "Result: ", chooser)), response,
    element("p", { class: "note" }, "Each point is a drop; orange ones break a limit (dashed). Line and band: median and 5 to 95 % of neighbouring drops. The last figure: share of drops below a value."));
  section("Parallel coordinates", lines);
  section("What matters", matter);
  section("Worst points", worst);

  function show(result) {
    response.replaceChildren(...data.parameters.map((parameter) => scatter(parameter, result)), cumulative(result));
    parallel(result, lines);
    matter.replaceChildren(influences(result));
    const order = worstOf(result);
    worst.replaceChildren(element("p", {}, `${worstWords(result, order.length)} the command makes the full run of one with its report.`),
      table(["point", label(result), ...data.parameters.map(label), "command"], order.map((k) => [String(data.points[k]), short(result.values[k]), ...data.parameters.map((p) => short(p.values[k])), rerunCommand(data.points[k])]), ["number", "number", ...data.parameters.map(() => "number"), "code"]));
  }
  chooser.onchange = () => show(data.results[chooser.value]);
  show(data.results[0]);
}

page.append(element("h1", {}, data.title), element("div", { class: "subtitle" }, data.subtitle), element("nav", {}));
showAnswers();
if (data.minimise) showSearch();
if (data.fit) showFit();
if (data.surrogate) showSurrogates();
if (data.results.length) showResults();
else section("Response", element("p", {}, data.points.length > 1 ? "No result differs between the drops." : "One drop alone has no response to draw."), element("p", {}, "The command makes the full run of a drop with its report:"), element("p", { class: "code" }, rerunCommand(data.points[0])));
if (data.failed.length) section("Failed points", table(["point", ...data.parameters.map(label), "reason"], data.failed.map((f) => [String(f.point), ...f.values.map(short), f.reason]), ["number"]));
section("Provenance", table(["", ""], Object.entries(data.facts), ["", "code"]));

page.dataset.ready = "yes";
