// Spectra over time as pictures; after figures.js.

// White through orange to dark brown; darker is more, also in grey.
const WARM = [[255, 255, 255], [253, 208, 140], [230, 120, 20], [160, 50, 0], [70, 15, 0]];

// White to dark blue; darker is more, also in grey.
function shade(part, stops = [[255, 255, 255], [86, 180, 233], [0, 114, 178], [0, 32, 64]]) {
  const at = Math.max(0, Math.min(1, part)) * (stops.length - 1), i = Math.min(Math.floor(at), stops.length - 2);
  return stops[i].map((low, c) => Math.round(low + (at - i) * (stops[i + 1][c] - low)));
}

// Frequency to the right, time upwards, colour the logarithm of the amplitude.
function showWaterfall(fall, into) {
  const missing = new Set(fall.missing);
  const { columns, times } = fall, rows = times.length, levels = bytesOf(fall.levels);
  const canvas = element("canvas", { width: columns, height: rows }), pixels = canvas.getContext("2d").createImageData(columns, rows);
  for (let row = 0; row < rows; ++row)
    for (let k = 0; k < columns; ++k) pixels.data.set([...(missing.has(rows - 1 - row) ? [225, 225, 225] : shade(levels[(rows - 1 - row) * columns + k] / 255)), 255], 4 * (row * columns + k));
  canvas.getContext("2d").putImageData(pixels, 0, 0);
  const total = isNarrow() ? 380 : 620, left = isNarrow() ? 62 : 76, top = 10, bar = isNarrow() ? 84 : 80, width = total - left - bar, height = isNarrow() ? 200 : 270, right = left + width + 14;
  const step = rows > 1 ? (times[rows - 1] - times[0]) / (rows - 1) : 1, t0 = times[0] - step / 2, t1 = times[rows - 1] + step / 2;
  const df = columns > 1 ? (fall.high - fall.low) / (columns - 1) : 1, f0 = fall.low - df / 2, f1 = fall.high + df / 2;
  const toX = (f) => left + ((f - f0) / (f1 - f0)) * width, toY = (t) => top + height - ((t - t0) / (t1 - t0)) * height;
  const amplitude = (part) => fall.largest * 10 ** (fall.decades * (part - 1));
  const spin = (side) => fall.spin.map((f, i) => `${i ? "L" : "M"}${toX(side * f).toFixed(1)} ${toY(times[i]).toFixed(1)}`).join("");
  const clip = "clip-" + fall.id;
  const svg = element("svg", { viewBox: `0 0 ${total} ${height + 52}`, role: "img", "aria-label": fall.title },
    element("defs", {}, element("clipPath", { id: clip }, element("rect", { x: left, y: top, width, height }))),
    element("image", { href: canvas.toDataURL(), x: left, y: top, width, height, preserveAspectRatio: "none", style: "image-rendering: pixelated" }),
    element("g", { "clip-path": `url(#${clip})` }, ...(fall.is_two_sided ? [1, -1] : [1]).map((side) => element("path", { class: "spin", d: spin(side) }))),
    ...Array.from({ length: 40 }, (_, i) => element("rect", { x: right, y: top + height * (1 - (i + 1) / 40), width: 12, height: height / 40 + 0.5, fill: `rgb(${shade((i + 0.5) / 40)})` })),
    element("path", { class: "axis", d: `M${left} ${top}h${width}v${height}h${-width}z` }));
  const text = (x, y, anchor, content, more = {}) => svg.append(element("text", { x, y, "text-anchor": anchor, ...more }, content));
  for (const { value, text: label } of ticks(f0, f1, isNarrow() ? 4 : 6)) text(toX(value), top + height + 15, "middle", label);
  for (const { value, text: label } of ticks(t0, t1, 5)) text(left - 6, toY(value) + 4, "end", label);
  for (const { value, text: label } of axisTicks([Math.log10(amplitude(0)), Math.log10(fall.largest)], 4, { log: true }))
    text(right + 16, top + height * (1 - (value - Math.log10(amplitude(0))) / fall.decades) + 4, "start", label);
  text(left + width / 2, height + 44, "middle", `${fall.frequency} [Hz]`, { class: "x-label" });
  svg.append(element("text", { class: "y-label", "text-anchor": "middle", transform: `translate(13 ${top + height / 2}) rotate(-90)` }, "time [ms]"),
    element("text", { class: "bar-label", "text-anchor": "middle", transform: `translate(${total - 6} ${top + height / 2}) rotate(-90)` }, `${fall.quantity} [${unit(fall.unit)}]`));
  svg.onpointermove = (event) => {
    const box = svg.getBoundingClientRect(), zoom = total / box.width, x = (event.clientX - box.left) * zoom, y = (event.clientY - box.top) * zoom;
    const k = Math.floor(((x - left) / width) * columns), row = Math.floor((1 - (y - top) / height) * rows);
    tip.hidden = !(k >= 0 && k < columns && row >= 0 && row < rows);
    if (tip.hidden) return;
    const level = levels[row * columns + k];
    if (missing.has(row)) tip.textContent = `${short(times[row])} ms: left out`;
    else tip.textContent = `${short(fall.low + k * df)} Hz, ${short(times[row])} ms: ` + (level ? `${short(+amplitude(level / 255).toPrecision(3))} ${unit(fall.unit)}` : `below ${short(+amplitude(0).toPrecision(2))} ${unit(fall.unit)}`);
    tip.style.left = Math.min(event.clientX + 16, innerWidth - tip.offsetWidth - 8) + "px";
    tip.style.top = event.clientY + 12 + "px";
  };
  svg.onpointerleave = () => { tip.hidden = true; };
  into.append(element("figure", { class: "map waterfall", id: "figure-" + fall.id }, element("figcaption", {}, fall.title), svg,
    element("p", { class: "note" }, `Each row is ${fall.per_row > 1 ? `the largest of ${fall.per_row} segments` : "a segment"} of ${short(+fall.segment.toPrecision(4))} ms, at ${fall.per_row > 1 ? "their" : "its"} middle;${missing.size ? " grey rows are left out;" : ""} colours are logarithmic over ${fall.decades} decades. Dashed: the rotor's spin frequency${fall.is_two_sided ? ", forward and backward" : ""}.`)));
}
