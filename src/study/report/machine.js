// The machine from the side, mode shapes beside it, and how the rotor bends in the drop; after figures.js and drop.js.

const MACHINE = { shaft: "#c9d2da", ring: "#8fa3b3", ball: "#fff", mass: COLOURS[4], magnet: COLOURS[1], linear: COLOURS[2], probe: COLOURS[3], unbalance: "#b00020", edge: "#445" };

// Scales of all pictures that lie along the shaft: x and radii in mm to units of the picture.
class SideScale {
  constructor(machine, width) {
    const parts = [...machine.elements.flatMap((e) => [e[0], e[1]]), ...machine.supports.flatMap((s) => [s.x - (s.width || 0) / 2, s.x + (s.width || 0) / 2]), machine.centre_of_gravity];
    this.width = width;
    this.x0 = Math.min(...parts);
    this.x1 = Math.max(...parts);
    this.left = 70;
    this.right = 24;
    this.scale = (width - this.left - this.right) / (this.x1 - this.x0 || 1);
    const supportRadius = machine.supports.map((s) => (s.outer_ring ? s.outer_ring[1] / 2 : 0));
    this.radius = Math.max(1, ...machine.elements.map((e) => e[2] / 2), ...supportRadius, ...machine.masses.map(gyrationDisk));
    // Thin rotors get their radii magnified, so that steps can be seen.
    this.magnified = [1, 2, 5, 10, 20].find((k) => this.radius * this.scale * k >= 45) || 20;
    if (this.radius * this.scale > 230) this.scale = 230 / this.radius;
  }

  x(value) { return this.left + (value - this.x0) * this.scale; }
  r(value) { return value * this.scale * this.magnified; }
}

// Radius [mm] of a disk that has a mass point's mass and polar inertia: Ip = m r^2 / 2.
function gyrationDisk(mass) { return mass.mass > 0 ? 1000 * Math.sqrt((2 * mass.Ip) / mass.mass) : 0; }

// Names above the drawing, in as few rows as keep them apart.
function labelRows(labels, letter = 7) {
  const ends = [];
  for (const label of labels.sort((a, b) => a.x - b.x)) {
    const half = (letter * label.text.length) / 2 + 4;
    let row = ends.findIndex((end) => end < label.x - half);
    if (row < 0) row = ends.push(0) - 1;
    ends[row] = label.x + half;
    label.row = row;
  }
  return ends.length;
}

function drawSupport(support, scale, axis, top) {
  const at = scale.x(support.x), made = [], both = (draw) => [1, -1].forEach((side) => made.push(draw(side)));
  if (support.kind === "touchdown") {
    const half = (support.width * scale.scale) / 2, [, innerTop] = support.inner_ring, [outerLow, outerTop] = support.outer_ring;
    const ring = (low, high, name) => both((side) => element("rect", { class: name, x: at - half, width: 2 * half, y: axis - (side > 0 ? scale.r(high / 2) : -scale.r(low / 2)), height: scale.r((high - low) / 2), fill: MACHINE.ring, stroke: MACHINE.edge, "stroke-width": 0.8 }));
    ring(support.bore_diameter, innerTop, "inner-ring");
    ring(outerLow, outerTop, "outer-ring");
    for (const row of support.rows)
      both((side) => element("ellipse", { class: "ball", cx: at + row * scale.scale, cy: axis - side * scale.r(support.pitch_diameter / 2), rx: (support.ball_diameter * scale.scale) / 2, ry: scale.r(support.ball_diameter / 2), fill: MACHINE.ball, stroke: MACHINE.edge, "stroke-width": 0.8 }));
  } else if (support.kind === "magnet") {
    both((side) => element("path", { class: "magnet", d: `M${at - 9} ${axis - side * (top + 4)}h18v${-side * 15}h-18z`, fill: MACHINE.magnet, "fill-opacity": 0.75, stroke: MACHINE.edge, "stroke-width": 0.8 }));
  } else {  // a spring to the ground
    const y = axis + top + 2;
    made.push(element("path", { class: support.kind, d: `M${at} ${y}v4l6 3l-12 5l12 5l-12 5l6 3v4m-10 0h20m-17 0l-4 5m9 -5l-4 5m9 -5l-4 5m9 -5l-4 5`, fill: "none", stroke: support.kind === "linear" ? MACHINE.linear : MACHINE.edge, "stroke-width": 1.5 }));
  }
  made.forEach((part) => part.append(element("title", {}, supportWords(support))));
  return made;
}

const words = { touchdown: "touchdown bearing", linear: "linear support", magnet: "magnet", other: "support of another kind" };
function supportWords(s) {
  return `${s.name}: ${words[s.kind]} at x = ${short(s.x)} mm (node ${s.node})` +
    (s.kind === "touchdown" ? `; bore ${short(s.bore_diameter)} mm, ${s.rows.length} row${s.rows.length > 1 ? "s" : ""} on ${short(s.pitch_diameter)} mm, outside ${short(s.outer_ring[1])} mm, air gap ${short(s.air_gap)} µm` : "");
}

// Distances between neighbours, with arrows; text where there is room.
function dimensions(places, scale, y, id) {
  const made = [], at = [...new Set(places)].sort((a, b) => a - b);
  for (let i = 0; i + 1 < at.length; ++i) {
    const from = scale.x(at[i]), to = scale.x(at[i + 1]), text = short(+(at[i + 1] - at[i]).toFixed(3));
    made.push(element("path", { class: "dimension", d: `M${from} ${y - 5}v10M${to} ${y - 5}v10M${from} ${y}H${to}` + (to - from > 16 ? `M${from + 6} ${y - 3}l-6 3l6 3M${to - 6} ${y - 3}l6 3l-6 3` : "") }));
    if (to - from > 6.5 * text.length + 4) made.push(element("text", { class: "dimension-text " + id, x: (from + to) / 2, y: y - 4, "text-anchor": "middle" }, text));
  }
  return made;
}

function sideView(machine, scale) {
  const tops = [...machine.supports.map((s) => ({ x: scale.x(s.x), text: s.name, of: s })), ...machine.probes.map((p) => ({ x: scale.x(p.x), text: p.name, of: p }))];
  const labelHeight = 15 * labelRows(tops) + 8, half = scale.r(scale.radius) + (machine.supports.some((s) => s.kind === "magnet") ? 20 : 8);
  const axis = labelHeight + half + 8, shaftRadius = (x) => Math.max(0, ...machine.elements.filter((e) => x >= e[0] - 1e-6 && x <= e[1] + 1e-6).map((e) => e[2] / 2));
  const bottom = axis + half + (machine.supports.some((s) => s.kind === "linear" || s.kind === "other") ? 30 : 0);
  const height = bottom + 92, parts = [];
  machine.elements.forEach(([x1, x2, od, id], i) => {
    const box = { x: scale.x(x1), width: scale.x(x2) - scale.x(x1), fill: MACHINE.shaft, stroke: MACHINE.edge, "stroke-width": 0.8, class: "element", "data-index": i };
    const title = () => element("title", {}, `element ${i + 1}: x ${short(x1)} to ${short(x2)} mm, outside ${short(od)} mm` + (id > 0 ? `, bore ${short(id)} mm` : ""));
    if (id > 0) for (const side of [1, -1]) parts.push(element("rect", { ...box, y: side > 0 ? axis - scale.r(od / 2) : axis + scale.r(id / 2), height: scale.r((od - id) / 2) }, title()));
    else parts.push(element("rect", { ...box, y: axis - scale.r(od / 2), height: 2 * scale.r(od / 2) }, title()));
  });
  for (const mass of machine.masses) {
    const r = gyrationDisk(mass), at = scale.x(mass.x), text = `mass point at x = ${short(mass.x)} mm: ${short(mass.mass)} kg, Ip ${short(mass.Ip)} kg m², Id ${short(mass.Id)} kg m²`;
    parts.push((r > 0 ? element("rect", { class: "mass", x: at - 2.5, width: 5, y: axis - scale.r(r), height: 2 * scale.r(r), fill: MACHINE.mass, "fill-opacity": 0.55, stroke: MACHINE.edge, "stroke-width": 0.6 })
      : element("circle", { class: "mass", cx: at, cy: axis, r: 4, fill: MACHINE.mass })));
    parts[parts.length - 1].append(element("title", {}, text));
  }
  parts.push(element("path", { class: "centre-line", d: `M${scale.left - 12} ${axis}H${scale.x(scale.x1) + 12}` }));
  for (const support of machine.supports) parts.push(...drawSupport(support, scale, axis, scale.r(shaftRadius(support.x))));
  for (const probe of machine.probes) {
    const at = scale.x(probe.x), y = axis - scale.r(probe.radius);
    parts.push(element("path", { class: "probe", d: `M${at} ${y}l-6 -13h12z`, fill: MACHINE.probe, stroke: "#fff" }, element("title", {}, `${probe.name}: probe at x = ${short(probe.x)} mm, clearance ${short(probe.clearance)} µm`)));
  }
  for (const u of machine.unbalances) {
    const y = axis - scale.r(shaftRadius(u.x)) * Math.cos((u.angle * Math.PI) / 180);
    parts.push(element("circle", { class: "unbalance", cx: scale.x(u.x), cy: y, r: 4, fill: MACHINE.unbalance }, element("title", {}, `unbalance at x = ${short(u.x)} mm: ${short(u.me)} g mm at ${short(u.angle)}°`)));
  }
  const cg = scale.x(machine.centre_of_gravity);
  parts.push(element("g", { class: "centre-of-gravity", transform: `translate(${cg} ${axis})` }, element("circle", { r: 7, fill: "#fff", stroke: "#222" }), element("path", { d: "M0 0V-7A7 7 0 0 1 7 0zM0 0V7A7 7 0 0 1 -7 0z", fill: "#222" }),
    element("title", {}, `centre of gravity at x = ${short(machine.centre_of_gravity)} mm`)));
  for (const label of tops) {
    const y = 12 + 15 * label.row, reach = label.of.outer_ring ? scale.r(label.of.outer_ring[1] / 2) : scale.r(shaftRadius(label.of.x)) + 20;
    parts.push(element("path", { class: "leader", d: `M${label.x} ${y + 3}V${axis - reach}` }), element("text", { class: "part-name", x: Math.min(Math.max(label.x, 3.5 * label.text.length), scale.width - 3.5 * label.text.length), y, "text-anchor": "middle" }, label.text));
  }
  const ends = machine.elements.length ? [Math.min(...machine.elements.map((e) => e[0])), Math.max(...machine.elements.map((e) => e[1]))] : [];
  parts.push(...dimensions([...ends, ...machine.supports.map((s) => s.x)], scale, bottom + 16, "chain"), ...dimensions(ends, scale, bottom + 36, "length"));
  for (const { value, text } of ticks(scale.x0, scale.x1, Math.max(3, Math.round(scale.width / 130)))) {
    const at = scale.x(value);
    parts.push(element("path", { class: "axis", d: `M${at} ${bottom + 50}v5` }), element("text", { x: at, y: bottom + 68, "text-anchor": "middle" }, text));
  }
  parts.push(element("path", { class: "axis", d: `M${scale.x(scale.x0)} ${bottom + 50}H${scale.x(scale.x1)}` }), element("text", { class: "x-label", x: scale.x((scale.x0 + scale.x1) / 2), y: height - 8, "text-anchor": "middle" }, "x [mm]"));
  const step = ticks(0, scale.radius, Math.max(1, Math.round(scale.r(scale.radius) / 30)));
  for (const { value, text } of step) for (const side of value ? [1, -1] : [1])
    parts.push(element("path", { class: "axis", d: `M${scale.left - 24} ${axis - side * scale.r(value)}h5` }), element("text", { x: scale.left - 28, y: axis - side * scale.r(value) + 4, "text-anchor": "end" }, text));
  parts.push(element("text", { class: "y-label", "text-anchor": "middle", transform: `translate(13 ${axis}) rotate(-90)` }, "radius [mm]"));
  return element("svg", { viewBox: `0 0 ${scale.width} ${height}`, role: "img", "aria-label": "The machine from the side" }, ...parts);
}

function modeShapes(modes, machine, scale) {
  const each = 78, parts = [], height = each * modes.modes.length + 8;
  for (const s of machine.supports) parts.push(element("path", { class: "leader", d: `M${scale.x(s.x)} 0V${height}` }));
  modes.modes.forEach((mode, k) => {
    const axis = each * k + 48, d = mode.shape.map((v, i) => `${i ? "L" : "M"}${scale.x(modes.x[i]).toFixed(1)} ${(axis - 26 * v).toFixed(1)}`).join("");
    parts.push(element("path", { class: "centre-line", d: `M${scale.x(scale.x0)} ${axis}H${scale.x(scale.x1)}` }),
      element("path", { class: "series mode", d, fill: "none", stroke: COLOURS[{ forward: 0, backward: 1 }[mode.whirl] ?? 6], "stroke-width": 1.8 }),
      element("text", { class: "mode-name", x: scale.left, y: axis - 34 }, `${short(+mode.frequency.toPrecision(5))} Hz, ${mode.whirl}, damping ratio ${short(+(100 * mode.damping_ratio).toPrecision(3))} %`));
  });
  return element("svg", { viewBox: `0 0 ${scale.width} ${height}`, role: "img", "aria-label": "Mode shapes" }, ...parts);
}

function showMachine(machine, modes) {
  const scale = new SideScale(machine, Math.max(340, Math.min(1224, page.clientWidth - 2 * parseFloat(getComputedStyle(page).paddingLeft))));
  const kinds = { "touchdown bearings": machine.supports.some((s) => s.kind === "touchdown"), "magnets (orange)": machine.supports.some((s) => s.kind === "magnet"), "linear supports (springs)": machine.supports.some((s) => s.kind === "linear"),
    "probes (purple)": machine.probes.length, "mass points (yellow, as disks of the same mass and polar inertia)": machine.masses.length, "unbalances (red, where they are at spin angle 0)": machine.unbalances.length };
  const shown = Object.entries(kinds).filter(([, there]) => there).map(([name]) => name);
  const note = `Mass ${short(+machine.mass.toPrecision(5))} kg, Ip ${short(+machine.Ip.toPrecision(4))} kg m², Id ${short(+machine.Id.toPrecision(4))} kg m², centre of gravity at x = ${short(+machine.centre_of_gravity.toFixed(3))} mm. ` +
    `Shown: shaft, ${shown.join(", ")}. Lengths in mm; air gaps are not visible at this scale. ` + (scale.magnified > 1 ? `Radii are magnified ${scale.magnified} times. ` : "") + (machine.is_rigid ? "The rotor is computed as a rigid body." : "");
  const table_of = table(["part", "kind", "x [mm]"], [...machine.supports.map((s) => [s.name, words[s.kind], short(s.x)]), ...machine.probes.map((p) => [p.name, `probe, clearance ${short(p.clearance)} µm`, short(p.x)]),
    ...machine.unbalances.map((u) => ["", `unbalance ${short(u.me)} g mm at ${short(u.angle)}°`, short(u.x)])], ["", "", "number"]);
  section("The machine", element("figure", { class: "machine", id: "figure-machine" }, element("figcaption", {}, "Side view"), sideView(machine, scale), element("p", { class: "note" }, note)),
    ...(modes && modes.modes.length ? [element("figure", { class: "machine", id: "figure-modes" }, element("figcaption", {}, `Mode shapes, ${modes.supports}, at ${short(modes.speed)} rpm`), modeShapes(modes, machine, scale),
      element("p", { class: "note" }, "Deflection at the instant at which it is largest, scaled to 1. Positions along x as in the side view; blue: forward whirl, orange: backward, grey: planar or mixed. Touchdown bearings do not hold a levitated rotor."))] : []),
    element("details", { class: "screen" }, element("summary", {}, "Positions"), table_of));
}

// The centre line at an instant, and its bending alone, beside the drop.
function bendingAt(bending, into) {
  const time = floatsOf(bending.time), planes = { y: bending.y.map(unpacked), z: bending.z.map(unpacked) }, n = bending.x.length;
  const line = (plane, i, first) => Array.from({ length: n }, (_, node) => planes[plane].slice(first).reduce((sum, q, k) => sum + q[i] * bending.shapes[first + k][node], 0));
  const range = (first) => {
    let low = 0, high = 0;
    for (let i = 0; i < time.length; i += Math.max(1, Math.floor(time.length / 600)))
      for (const plane of ["y", "z"]) for (const v of line(plane, i, first)) { low = Math.min(low, v); high = Math.max(high, v); }
    return [low, high];
  };
  const touchdown = data.machine.supports.filter((s) => s.kind === "touchdown"), rest = new Map(data.animation.bearings.map((b) => [b.name, Drop.rest(b)]));
  const chart = (id, title, first, note, bars) => {
    let [low, high] = range(first);
    for (const bar of bars) { low = Math.min(low, bar.low); high = Math.max(high, bar.high); }
    const room = 0.06 * (high - low) || 1, x0 = bending.x[0], x1 = bending.x[n - 1];
    return { id, title, note, x: { label: "x", unit: "mm" }, y: { label: "displacement", unit: "um" }, fixed: { x: [x0, x1], y: [low - room, high + room] }, bars,
      marks: data.machine.supports.map((s) => ({ x: s.x, name: s.name })), lines: ["y", "z"].map((plane, k) => ({ name: data.directions[plane], colour: k, dash: k, x: bending.x, y: line(plane, 0, first), complete: true })) };
  };
  const gaps = touchdown.filter((s) => rest.has(s.name)).map((s) => ({ x: s.x, low: rest.get(s.name).y - s.air_gap, high: rest.get(s.name).y + s.air_gap }));
  const figures = [[0, chart("centre-line", "Centre line of the rotor", 0, "At the instant of the slider, from the axis of the unloaded outer rings. Bars: air gap of touchdown bearings along y, around the ring's centre before the drop.", gaps)],
    [2, chart("bending", "Bending of the rotor", 2, "The same without the rigid motion of the rotor: what its flexible modes add.", [])]].map(([first, c]) => ({ first, figure: new Figure(c, into) }));
  return {
    show(instant) {
      const i = nearest(time, instant);
      for (const { first, figure } of figures) {
        figure.chart.lines.forEach((l, k) => { l.y = line(k ? "z" : "y", i, first); });
        figure.draw();
      }
    },
  };
}
