// Figures of the report with hover and zoom.

// Okabe & Ito's palette, told apart by everyone; dashes tell lines apart on paper without colour.
const COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#999999", "#222222"];
const DASHES = ["", "7 4", "2 3", "9 3 2 3"];

const list = (texts) => element("ul", {}, ...texts.map((text) => element("li", {}, text)));
const unit = (text) => text.replace(/(^|[^A-Za-z])u(?=[mJ])/g, "$1µ");
const axisLabel = (axis) => (axis.unit ? `${axis.label} [${unit(axis.unit)}]` : axis.label);

// Five digits and no trailing zeros.
function short(value) {
  if (value === 0) return "0";
  const size = Math.abs(value);
  return size >= 1e6 || size < 1e-4 ? value.toExponential(3) : String(+value.toPrecision(5));
}

// Round numbers between two values, about n of them.
function ticks(low, high, n) {
  const raw = (high - low) / n;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= raw * 0.999);
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  return Array.from({ length: last - first + 1 }, (_, i) => ({ value: (first + i) * step, text: tickText((first + i) * step, step) }));
}

// Ticks of an axis; on a logarithmic one, whose values are decimal logarithms, at 1, 2 and 5 times powers of ten.
function axisTicks(range, n, axis) {
  if (!axis.log) return ticks(range[0], range[1], n);
  const made = [], factors = range[1] - range[0] < 2.2 ? [1, 2, 5] : [1];
  for (let power = Math.floor(range[0]); power <= range[1]; ++power)
    for (const factor of factors) {
      const value = power + Math.log10(factor);
      if (value >= range[0] - 1e-9 && value <= range[1] + 1e-9) made.push({ value, text: Math.abs(power) > 3 ? `${factor}e${power}` : short(factor * 10 ** power) });
    }
  return made;
}
const onAxis = (value, axis) => (axis.log ? 10 ** value : value);

// Numbers as study/report/packed.h writes them.
const bytesOf = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
const floatsOf = (text) => new Float32Array(bytesOf(text).buffer);
function unpacked({ low, high, levels }) {
  return Float64Array.from(new Uint16Array(bytesOf(levels).buffer), (level) => low + ((high - low) * level) / 65535);
}

// Lines with every sample get their lists from the page's data: x, y, and that they are complete.
const axes = (data.axes || []).map(floatsOf);
function unpackLines(charts) {
  for (const chart of charts)
    for (const line of chart.lines) {
      if (line.levels !== undefined) Object.assign(line, { x: axes[line.axis], y: unpacked(line) });
      line.complete = line.span === undefined;
      line.rises = chart.x.label === "time" && !line.y.includes(null);
    }
}

// Samples of a line from one to another value of x, and one beyond on each side. Of many samples the smallest and largest of each of some 500 runs.
function inView(line, from, to) {
  const { x, y } = line, most = 1010;
  if (!line.rises) return { x, y, every: 1 };
  const first = Math.max(0, nearest(x, from) - 1), last = Math.min(x.length, nearest(x, to) + 2);
  const every = Math.ceil((last - first) / (most / 2));
  if (last - first <= most) return { x: x.slice(first, last), y: y.slice(first, last), every: 1 };
  const thin = { x: [], y: [], every };
  const keep = (k) => { thin.x.push(x[k]); thin.y.push(y[k]); };
  for (let k = first; k < last; k += every) {
    let low = k, high = k;
    for (let i = k; i < Math.min(k + every, last); ++i) {
      if (y[i] < y[low]) low = i;
      if (y[i] > y[high]) high = i;
    }
    keep(Math.min(low, high));
    if (low !== high) keep(Math.max(low, high));
  }
  return thin;
}

// Index of the entry of a rising list that is nearest to a value.
function nearest(rising, value) {
  let low = 0, high = rising.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (rising[middle] > value) high = middle; else low = middle;
  }
  return Math.abs(rising[low] - value) <= Math.abs(rising[high] - value) ? low : high;
}

function extent(values, from = -Infinity, to = Infinity, along = values) {
  let low = Infinity, high = -Infinity;
  for (let i = 0; i < values.length; ++i)
    if (values[i] !== null && along[i] >= from && along[i] <= to) {
      low = Math.min(low, values[i]);
      high = Math.max(high, values[i]);
    }
  return [low, high];
}

// Narrow screens get figures of fewer units, whose letters are as large.
const isNarrow = () => Math.min(innerWidth, screen.width || innerWidth) < 560;

// A figure. `chart` as study/report/report_charts.cpp makes it; with `square`, x and y have the same scale (an orbit). Besides lines it may have
// `limits` (levels of y with names), `marks` (values of x with names), `points` (with texts), `bars` (from low to high at x), `second` (another scale of y
// at the right, shifted by its offset), `fixed` (ranges of x and y).
class Figure {
  constructor(chart, into) {
    this.chart = chart;
    this.shown = chart.lines.map(() => true);
    const narrow = isNarrow();
    this.width = narrow ? 380 : 620;
    this.height = chart.square ? (narrow ? 360 : 520) : narrow ? 240 : 280;
    this.margin = { left: narrow ? 62 : 76, right: chart.second ? 62 : 12, top: (chart.marks || []).length ? 24 : 10, bottom: 42 };
    this.inner = { width: this.width - this.margin.left - this.margin.right, height: this.height - this.margin.top - this.margin.bottom };
    this.root = element("figure", { class: "chart", id: "figure-" + chart.id });
    this.svg = element("svg", { viewBox: `0 0 ${this.width} ${this.height}`, role: "img", "aria-label": `${chart.title}: ${axisLabel(chart.y)} over ${axisLabel(chart.x)}` });
    this.reset = element("button", { hidden: "", class: "screen" }, "reset zoom");
    this.reset.onclick = () => this.show(null);
    this.state = element("p", { class: "note screen state-of-zoom", hidden: "" });
    this.beyond = element("p", { class: "note beyond", hidden: "" });
    this.root.append(element("figcaption", {}, chart.title), this.reset, this.svg, this.legend(), this.state, this.beyond);
    if (chart.note) this.root.append(element("p", { class: "note" }, chart.note));
    into.append(this.root);
    this.show(null);
  }

  legend() {
    // Lines of one name are one entry.
    const names = [...new Set(this.chart.lines.map((line) => line.name))];
    const entries = names.map((name) => {
      const own = this.chart.lines.flatMap((line, i) => (line.name === name ? [i] : [])), line = this.chart.lines[own[0]];
      const sample = element("svg", { viewBox: "0 0 30 10" }, element("line", { x1: 0, x2: 30, y1: 5, y2: 5, ...this.stroke(line) }));
      const label = element("label", { title: "show or hide" }, sample, name);
      label.onclick = () => {
        const isShown = !this.shown[own[0]];
        for (const i of own) this.shown[i] = isShown;
        label.classList.toggle("off", !isShown);
        this.draw();
      };
      return label;
    });
    return element("div", { class: "legend" }, ...entries);
  }

  stroke(line) {
    return { stroke: COLOURS[line.colour % COLOURS.length], "stroke-dasharray": DASHES[line.dash % DASHES.length], "stroke-width": 1.5, fill: "none" };
  }

  // range: {x: [low, high], y: [low, high] or undefined}, or null for everything.
  show(range) {
    this.range = range;
    this.reset.hidden = range === null;
    this.draw();
  }

  ranges() {
    if (this.chart.fixed && !this.range) return this.chart.fixed;
    const lines = this.chart.lines.filter((_, i) => this.shown[i]);
    const bands = (this.chart.bands || []).flatMap((band) => [band.low, band.high]);
    const all = lines.length ? lines.concat(bands) : this.chart.lines;
    const union = (pairs) => [Math.min(...pairs.map((p) => p[0])), Math.max(...pairs.map((p) => p[1]))];
    const x = this.range ? this.range.x : union(all.map((line) => extent(line.x)));
    let y = this.range && this.range.y;
    if (!y) {
      y = union(all.map((line) => extent(line.y, x[0], x[1], line.x)));
      if (!isFinite(y[0])) y = [0, 1];
      if (!this.range) y = this.withLimits(y);
      const room = 0.05 * (y[1] - y[0]) || Math.abs(y[0]) * 0.1 || 1;
      y = [y[0] === 0 ? 0 : y[0] - room, y[1] + room];
    }
    if (this.chart.square && !this.range) {
      const reach = this.chart.reach || 1.08 * Math.max(this.chart.circle || 0, ...x.map(Math.abs), ...y.map(Math.abs));
      return this.equal([-reach, reach], [-reach, reach]);
    }
    return this.chart.square ? this.equal(x, y) : { x, y };
  }

  // The range of y with those limits that do not make it more than 3.5 times as long.
  withLimits(y) {
    const length = y[1] - y[0] || Math.abs(y[0]) || 1;
    const named = new Map();  // limits to both sides are one
    for (const { name, value } of this.chart.limits || []) named.set(name, [...(named.get(name) || []), value]);
    return [...named.values()].reduce((range, values) => {
      const wider = [Math.min(range[0], ...values), Math.max(range[1], ...values)];
      return wider[1] - wider[0] <= 3.5 * length ? wider : range;
    }, y);
  }

  // Widens one of two ranges until a unit is as long on both axes.
  equal(x, y) {
    const scale = Math.max((x[1] - x[0]) / this.inner.width, (y[1] - y[0]) / this.inner.height);
    const widened = (range, length) => {
      const middle = (range[0] + range[1]) / 2;
      return [middle - (scale * length) / 2, middle + (scale * length) / 2];
    };
    return { x: widened(x, this.inner.width), y: widened(y, this.inner.height) };
  }

  draw() {
    const { left, top } = this.margin, { width, height } = this.inner;
    const { x, y } = this.ranges();
    this.toX = (v) => left + ((v - x[0]) / (x[1] - x[0])) * width;
    this.toY = (v) => top + height - ((v - y[0]) / (y[1] - y[0])) * height;
    this.fromX = (p) => x[0] + ((p - left) / width) * (x[1] - x[0]);
    this.fromY = (p) => y[0] + ((top + height - p) / height) * (y[1] - y[0]);
    const clip = "clip-" + this.chart.id;
    this.views = this.chart.lines.map((line) => inView(line, x[0], x[1]));
    this.tell(x, y);
    this.svg.replaceChildren(
      element("defs", {}, element("clipPath", { id: clip }, element("rect", { x: left, y: top, width, height }))),
      ...this.axes(x, y), element("g", { "clip-path": `url(#${clip})` }, ...this.marks()), ...this.names(x, y), this.overlay());
  }

  // What a zoomed figure shows of the samples, and limits that are beyond it.
  tell(x, y) {
    const lines = this.chart.lines.filter((_, i) => this.shown[i]), views = this.views.filter((_, i) => this.shown[i]);
    const every = Math.max(1, ...views.map((view) => view.every)), spans = lines.filter((line) => !line.complete).map((line) => line.span);
    const said = [];
    if (spans.length) said.push(`Shown: the smallest and largest sample of each ${short(Math.max(...spans))} ${unit(this.chart.x.unit)}, however far you zoom in; results.h5 has every sample.`);
    else if (every > 1) said.push(`Shown: the smallest and largest of each ${every} samples; zoom in further to see every sample.`);
    else said.push("Shown: every recorded sample.");
    const own = this.chart.lines[0] && this.chart.lines[0].said;
    this.state.hidden = this.range === null || !(own || this.chart.lines.some((line) => line.rises));
    this.state.textContent = own ? `Shown: ${own}.` : said.join(" ");
    const beyond = new Map();
    for (const { name, value } of this.chart.limits || [])
      if (value < y[0] || value > y[1]) beyond.set(name, [...(beyond.get(name) || []), short(value)]);
    this.beyond.hidden = !beyond.size;
    this.beyond.textContent = "Beyond this figure: " + [...beyond].map(([name, values]) => `${name} (${values.join(", ")} ${unit(this.chart.y.unit)})`).join("; ") + ".";
  }

  // Names of limits and marks, each where no other one stands.
  names(x, y) {
    const { left, top } = this.margin, { width } = this.inner, made = [], taken = [], letter = 6.1;
    const named = new Set();
    for (const { name, value, colour } of this.chart.limits || []) {
      if (value < y[0] || value > y[1] || named.has(name + Math.round(this.toY(value) / 40))) continue;
      named.add(name + Math.round(this.toY(value) / 40));
      const length = letter * name.length, at = this.toY(value);
      const places = [1, 0].flatMap((isAbove) => [0, 1, 2, 3].map((k) => ({ right: left + width - 4 - k * (width / 4), y: at + (isAbove ? -4 : 12) })))
        .filter((p) => p.right - length > left && p.y > top + 6 && p.y < top + this.inner.height);
      const free = places.find((p) => taken.every((t) => p.right < t.right - t.length - 4 || p.right - length > t.right + 4 || Math.abs(p.y - t.y) > 12)) || places[0];
      if (!free) continue;
      taken.push({ ...free, length });
      made.push(element("text", { class: "limit", x: free.right, y: free.y, "text-anchor": "end", style: `fill:${COLOURS[(colour ?? 7) % COLOURS.length]}` }, name));
    }
    let end = -Infinity;
    for (const { name, x: value } of [...(this.chart.marks || [])].sort((a, b) => a.x - b.x)) {
      if (value < x[0] || value > x[1]) continue;
      const length = letter * name.length, at = Math.min(Math.max(this.toX(value), left + length / 2), left + width - length / 2);
      if (at - length / 2 < end + 4) continue;
      end = at + length / 2;
      made.push(element("text", { class: "mark", x: at, y: top - 6, "text-anchor": "middle" }, name));
    }
    return made;
  }

  // Where a text of an axis stands so that the figure's edge does not cut it.
  insideX(at, text) { return Math.min(at, this.width - 3.7 * text.length); }

  axes(x, y) {
    const { left, top } = this.margin, { width, height } = this.inner;
    const made = [];
    for (const { value, text } of axisTicks(x, isNarrow() ? 4 : 6, this.chart.x)) {
      const at = this.toX(value);
      made.push(element("line", { class: "grid", x1: at, x2: at, y1: top, y2: top + height }),
        element("text", { x: this.insideX(at, text), y: top + height + 15, "text-anchor": "middle" }, text));
    }
    for (const { value, text } of axisTicks(y, 5, this.chart.y)) {
      const at = this.toY(value);
      made.push(element("line", { class: "grid", x1: left, x2: left + width, y1: at, y2: at }),
        element("text", { x: left - 6, y: at + 4, "text-anchor": "end" }, text));
    }
    const { second } = this.chart;
    if (second) {
      for (const { value, text } of ticks(y[0] + second.offset, y[1] + second.offset, 5)) {
        const at = this.toY(value - second.offset);
        made.push(element("line", { class: "axis", x1: left + width, x2: left + width + 4, y1: at, y2: at }), element("text", { class: "second", x: left + width + 7, y: at + 4 }, text));
      }
      made.push(element("path", { class: "axis", d: `M${left + width} ${top}v${height}` }),
        element("text", { class: "second-label", "text-anchor": "middle", transform: `translate(${this.width - 6} ${top + height / 2}) rotate(-90)` }, axisLabel(second)));
    }
    if (y[0] < 0 && y[1] > 0 && !this.chart.y.log) made.push(element("line", { class: "axis", x1: left, x2: left + width, y1: this.toY(0), y2: this.toY(0), opacity: 0.5 }));
    made.push(element("path", { class: "axis", d: `M${left} ${top}V${top + height}H${left + width}` }),
      element("text", { class: "x-label", x: left + width / 2, y: this.height - 8, "text-anchor": "middle" }, axisLabel(this.chart.x)),
      element("text", { class: "y-label", "text-anchor": "middle", transform: `translate(13 ${top + height / 2}) rotate(-90)` }, axisLabel(this.chart.y)));
    return made;
  }

  path(xs, ys) {
    let d = "", isDown = false;
    for (let i = 0; i < xs.length; ++i) {
      if (ys[i] === null) { isDown = false; continue; }
      d += (isDown ? "L" : "M") + this.toX(xs[i]).toFixed(1) + " " + this.toY(ys[i]).toFixed(1);
      isDown = true;
    }
    return d;
  }

  marks() {
    const made = [];
    for (const band of this.chart.bands || []) {
      const owner = this.chart.lines.findIndex((line) => line.colour === band.colour);
      if (!this.shown[owner]) continue;
      const back = this.path([...band.low.x].reverse(), [...band.low.y].reverse()).replace("M", "L");
      made.push(element("path", { d: this.path(band.high.x, band.high.y) + back + "Z", fill: COLOURS[band.colour], opacity: 0.18 }));
    }
    for (const { x } of this.chart.marks || []) made.push(element("path", { class: "mark", d: `M${this.toX(x)} ${this.margin.top}v${this.inner.height}` }));
    for (const { x, low, high } of this.chart.bars || [])
      made.push(element("path", { class: "bar", d: `M${this.toX(x)} ${this.toY(low).toFixed(1)}V${this.toY(high).toFixed(1)}m-6 0h12M${this.toX(x) - 6} ${this.toY(low).toFixed(1)}h12` }));
    for (const { value, colour } of this.chart.limits || [])
      made.push(element("path", { class: "limit", d: `M${this.margin.left} ${this.toY(value).toFixed(1)}h${this.inner.width}`, stroke: COLOURS[(colour ?? 7) % COLOURS.length] }));
    const centre = this.chart.centre || { x: 0, y: 0 };
    if (this.chart.circle) made.push(element("circle", { class: "gap", cx: this.toX(centre.x), cy: this.toY(centre.y), r: this.toX(this.chart.circle) - this.toX(0), fill: "none", stroke: "#888", "stroke-dasharray": "5 3" }));
    this.chart.lines.forEach((line, i) => {
      if (!this.shown[i]) return;
      const view = this.views[i];
      made.push(element("path", { class: "series", d: this.path(view.x, view.y), ...this.stroke(line), "stroke-linejoin": "round" }));
      if (line.rises && line.complete && view.x.length <= 80)  // far enough zoomed in to see single samples
        view.x.forEach((x, k) => made.push(element("circle", { class: "sample", cx: this.toX(x).toFixed(1), cy: this.toY(view.y[k]).toFixed(1), r: 2.2, fill: COLOURS[line.colour % COLOURS.length] })));
    });
    for (const { x, y } of this.chart.points || []) made.push(element("circle", { class: "point", cx: this.toX(x).toFixed(2), cy: this.toY(y).toFixed(2), r: 4.5 }));
    return made;
  }

  // Catches the pointer: hover shows values, a drag zooms, a double click shows everything again.
  overlay() {
    const { left, top } = this.margin, { width, height } = this.inner;
    const cross = element("path", { class: "cross", d: "" }), select = element("rect", { class: "select", width: 0, height: 0 });
    const plot = element("rect", { class: "plot", x: left, y: top, width, height, fill: "none", "pointer-events": "all" });
    const group = element("g", {}, cross, select, plot);
    const place = (event) => {
      const box = this.svg.getBoundingClientRect(), scale = this.width / box.width;
      const inside = (value, from, length) => Math.max(from, Math.min(from + length, value));
      return { x: inside((event.clientX - box.left) * scale, left, width), y: inside((event.clientY - box.top) * scale, top, height) };
    };
    let start = null;
    plot.onpointerdown = (event) => {
      start = place(event);
      plot.setPointerCapture(event.pointerId);
    };
    plot.onpointermove = (event) => {
      const at = place(event);
      this.hover(at, event, cross);
      if (!start) return;
      const box = this.chart.square ? { y: Math.min(start.y, at.y), height: Math.abs(at.y - start.y) } : { y: top, height };
      for (const [key, value] of Object.entries({ x: Math.min(start.x, at.x), width: Math.abs(at.x - start.x), ...box })) select.setAttribute(key, value);
    };
    plot.onpointerup = (event) => {
      const at = place(event), from = start;
      start = null;
      if (!from || Math.abs(at.x - from.x) < 5) return select.setAttribute("width", 0);
      const sorted = (a, b) => (a < b ? [a, b] : [b, a]);
      this.show({ x: sorted(this.fromX(from.x), this.fromX(at.x)), y: this.chart.square ? sorted(this.fromY(from.y), this.fromY(at.y)) : undefined });
    };
    plot.onpointerleave = () => {
      tip.hidden = true;
      cross.setAttribute("d", "");
    };
    plot.ondblclick = () => this.show(null);
    return group;
  }

  hover(at, event, cross) {
    const { left, top } = this.margin, { width, height } = this.inner;
    const value = this.fromX(at.x);
    const covers = (line) => !this.chart.points || (line.x[0] <= value && value <= line.x[line.x.length - 1]);
    const lines = this.chart.lines.filter((line, i) => this.shown[i] && line.x.length && covers(line));
    if (!lines.length && !this.chart.points) return;
    const rows = [];
    const { x: xAxis, y: yAxis } = this.chart;
    const point = (this.chart.points || []).find((p) => Math.hypot(this.toX(p.x) - at.x, this.toY(p.y) - at.y) < 9);
    if (point) tip.replaceChildren(element("div", {}, point.text));
    else if (this.chart.square) {
      rows.push(`${this.chart.x.label} = ${short(value)} ${unit(this.chart.x.unit)}`, `${this.chart.y.label} = ${short(this.fromY(at.y))} ${unit(this.chart.y.unit)}`);
      cross.setAttribute("d", `M${at.x} ${top}v${height}M${left} ${at.y}h${width}`);
      tip.replaceChildren(...rows.map((row) => element("div", {}, row)));
    } else {
      cross.setAttribute("d", `M${at.x} ${top}v${height}`);
      const { second } = this.chart;
      tip.replaceChildren(element("div", {}, `${xAxis.label} ${short(onAxis(value, xAxis))} ${unit(xAxis.unit)}`),
        ...lines.map((line) => {
          const y = line.y[nearest(line.x, value)];
          const text = y === null ? "–" : `${short(onAxis(y, yAxis))} ${unit(yAxis.unit)}` + (second ? ` (${short(+(y + second.offset).toPrecision(4))} ${second.unit})` : "");
          return element("div", {}, element("i", { style: `background:${COLOURS[line.colour % COLOURS.length]}` }), `${line.name}: ${text}`);
        }));
    }
    tip.hidden = false;
    const box = tip.getBoundingClientRect();
    tip.style.left = (event.clientX + 16 + box.width > innerWidth ? event.clientX - box.width - 12 : event.clientX + 16) + "px";
    tip.style.top = Math.max(4, Math.min(event.clientY + 12, innerHeight - box.height - 4)) + "px";
  }
}

