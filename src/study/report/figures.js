// Figures of the report with hover and zoom.

// Okabe & Ito's palette, told apart by everyone; dashes tell lines apart on paper without colour.
const COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#999999", "#222222"];
const DASHES = ["", "7 4", "2 3", "9 3 2 3"];

const list = (texts) => element("ul", {}, ...texts.map((text) => element("li", {}, text)));
const unit = (text) => text.replace(/^u(?=[mJ])/, "µ");
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
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  return Array.from({ length: last - first + 1 }, (_, i) => {
    const value = (first + i) * step;
    return { value, text: step >= 1e6 || step < 1e-4 ? value.toExponential(1) : value.toFixed(Math.min(digits, 6)) };
  });
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

// A figure. `chart` as study/report/report_charts.cpp makes it; with `square`, x and y have the same scale (an orbit).
class Figure {
  constructor(chart, into) {
    this.chart = chart;
    this.shown = chart.lines.map(() => true);
    this.width = 620;
    this.height = chart.square ? 520 : 280;
    this.margin = { left: 76, right: 12, top: 10, bottom: 42 };
    this.inner = { width: this.width - this.margin.left - this.margin.right, height: this.height - this.margin.top - this.margin.bottom };
    this.root = element("figure", { class: "chart", id: "figure-" + chart.id });
    this.svg = element("svg", { viewBox: `0 0 ${this.width} ${this.height}`, role: "img", "aria-label": `${chart.title}: ${axisLabel(chart.y)} over ${axisLabel(chart.x)}` });
    this.reset = element("button", { hidden: "", class: "screen" }, "reset zoom");
    this.reset.onclick = () => this.show(null);
    this.root.append(element("figcaption", {}, chart.title), this.reset, this.svg, this.legend());
    if (chart.note) this.root.append(element("p", { class: "note" }, chart.note));
    into.append(this.root);
    this.show(null);
  }

  legend() {
    const entries = this.chart.lines.map((line, i) => {
      const sample = element("svg", { viewBox: "0 0 30 10" }, element("line", { x1: 0, x2: 30, y1: 5, y2: 5, ...this.stroke(line) }));
      const label = element("label", { title: "show or hide" }, sample, line.name);
      label.onclick = () => {
        this.shown[i] = !this.shown[i];
        label.classList.toggle("off", !this.shown[i]);
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

  limits() {
    const lines = this.chart.lines.filter((_, i) => this.shown[i]);
    const bands = (this.chart.bands || []).flatMap((band) => [band.low, band.high]);
    const all = lines.length ? lines.concat(bands) : this.chart.lines;
    const union = (pairs) => [Math.min(...pairs.map((p) => p[0])), Math.max(...pairs.map((p) => p[1]))];
    const x = this.range ? this.range.x : union(all.map((line) => extent(line.x)));
    let y = this.range && this.range.y;
    if (!y) {
      y = union(all.map((line) => extent(line.y, x[0], x[1], line.x)));
      if (!isFinite(y[0])) y = [0, 1];
      const room = 0.05 * (y[1] - y[0]) || Math.abs(y[0]) * 0.1 || 1;
      y = [y[0] === 0 ? 0 : y[0] - room, y[1] + room];
    }
    if (this.chart.square && !this.range) {
      const reach = 1.08 * Math.max(this.chart.circle || 0, ...x.map(Math.abs), ...y.map(Math.abs));
      return this.equal([-reach, reach], [-reach, reach]);
    }
    return this.chart.square ? this.equal(x, y) : { x, y };
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
    const { x, y } = this.limits();
    this.toX = (v) => left + ((v - x[0]) / (x[1] - x[0])) * width;
    this.toY = (v) => top + height - ((v - y[0]) / (y[1] - y[0])) * height;
    this.fromX = (p) => x[0] + ((p - left) / width) * (x[1] - x[0]);
    this.fromY = (p) => y[0] + ((top + height - p) / height) * (y[1] - y[0]);
    const clip = "clip-" + this.chart.id;
    this.svg.replaceChildren(
      element("defs", {}, element("clipPath", { id: clip }, element("rect", { x: left, y: top, width, height }))),
      ...this.axes(x, y), element("g", { "clip-path": `url(#${clip})` }, ...this.marks()), this.overlay());
  }

  axes(x, y) {
    const { left, top } = this.margin, { width, height } = this.inner;
    const made = [];
    for (const { value, text } of ticks(x[0], x[1], 6)) {
      const at = this.toX(value);
      made.push(element("line", { class: "grid", x1: at, x2: at, y1: top, y2: top + height }),
        element("text", { x: at, y: top + height + 15, "text-anchor": "middle" }, text));
    }
    for (const { value, text } of ticks(y[0], y[1], 5)) {
      const at = this.toY(value);
      made.push(element("line", { class: "grid", x1: left, x2: left + width, y1: at, y2: at }),
        element("text", { x: left - 6, y: at + 4, "text-anchor": "end" }, text));
    }
    if (y[0] < 0 && y[1] > 0) made.push(element("line", { class: "axis", x1: left, x2: left + width, y1: this.toY(0), y2: this.toY(0), opacity: 0.5 }));
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
    if (this.chart.circle) made.push(element("circle", { cx: this.toX(0), cy: this.toY(0), r: this.toX(this.chart.circle) - this.toX(0), fill: "none", stroke: "#888", "stroke-dasharray": "5 3" }));
    this.chart.lines.forEach((line, i) => {
      if (this.shown[i]) made.push(element("path", { class: "series", d: this.path(line.x, line.y), ...this.stroke(line), "stroke-linejoin": "round" }));
    });
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
    const lines = this.chart.lines.filter((line, i) => this.shown[i] && line.x.length);
    if (!lines.length) return;
    const rows = [];
    if (this.chart.square) {
      rows.push(`${this.chart.x.label} = ${short(value)} ${unit(this.chart.x.unit)}`, `${this.chart.y.label} = ${short(this.fromY(at.y))} ${unit(this.chart.y.unit)}`);
      cross.setAttribute("d", `M${at.x} ${top}v${height}M${left} ${at.y}h${width}`);
      tip.replaceChildren(...rows.map((row) => element("div", {}, row)));
    } else {
      cross.setAttribute("d", `M${at.x} ${top}v${height}`);
      tip.replaceChildren(element("div", {}, `${this.chart.x.label} ${short(value)} ${unit(this.chart.x.unit)}`),
        ...lines.map((line) => {
          const y = line.y[nearest(line.x, value)];
          return element("div", {}, element("i", { style: `background:${COLOURS[line.colour % COLOURS.length]}` }), `${line.name}: ${y === null ? "–" : short(y)} ${unit(this.chart.y.unit)}`);
        }));
    }
    tip.hidden = false;
    const box = tip.getBoundingClientRect();
    tip.style.left = (event.clientX + 16 + box.width > innerWidth ? event.clientX - box.width - 12 : event.clientX + 16) + "px";
    tip.style.top = Math.max(4, Math.min(event.clientY + 12, innerHeight - box.height - 4)) + "px";
  }
}

