// The drop at an instant: rotor and rings in each bearing, with slider and playback; after figures.js.

// The rotor in one bearing, seen along +x: gap and displacements magnified, radii not.
class Drop {
  constructor(bearing, into) {
    this.bearing = bearing;
    this.scale = 46 / bearing.gap;
    this.bore = 140;
    this.journal = this.bore - this.scale * bearing.gap;
    const rest = Drop.rest(bearing), half = this.reach();
    const trace = bearing.time.map((_, i) => (i ? "L" : "M") + this.x(bearing.z[i]).toFixed(1) + " " + this.y(bearing.y[i]).toFixed(1)).join("");
    const body = { fill: "#dfe5ea", stroke: "#667" }, hole = { fill: "#fff", stroke: "#667" };
    // A bent ring is drawn by its shape, which stands while the ring turns; a rigid one turns as it is.
    this.bent = bearing.shape && { outside: element("path", body), bore: element("path", hole) };
    this.ring = element("g", {}, ...(this.bent ? [] : [element("circle", { r: this.bore + 16, ...body }), element("circle", { r: this.bore, ...hole })]),
      element("line", { x1: 0, x2: 0, y1: -this.bore - 16, y2: -this.bore, stroke: "#222", "stroke-width": 3 }));
    this.rotor = element("g", { class: "rotor" }, element("circle", { r: this.journal, fill: COLOURS[5], "fill-opacity": 0.45, stroke: COLOURS[0], "stroke-width": 1.5 }),
      element("line", { x1: 0, x2: 0, y1: -this.journal, y2: -this.journal + 16, stroke: COLOURS[0], "stroke-width": 4 }));
    this.contact = element("circle", { r: 7, fill: COLOURS[1] });
    this.centre = element("circle", { r: 4, fill: "#222" });
    this.caption = element("p", { class: "note" });
    const svg = element("svg", { viewBox: `${-half} ${-half} ${2 * half} ${2 * half}`, role: "img", "aria-label": `Rotor in ${bearing.name}` }, ...(this.bent ? [this.bent.outside, this.bent.bore] : []), this.ring, this.rotor,
      element("circle", { class: "gap", cx: this.x(rest.z), cy: this.y(rest.y), r: this.scale * bearing.gap, fill: "none", stroke: "#888", "stroke-dasharray": "5 3" }),
      element("path", { class: "series", d: trace, fill: "none", stroke: COLOURS[0], "stroke-width": 0.8, opacity: 0.8 }),
      this.contact, this.centre,
      element("g", { transform: `translate(${175 - half} ${half - 175})` },
        element("path", { class: "axis", d: "M-165 160v-22m-3 6l3 -6l3 6M-165 160h22m-6 -3l6 3l-6 3" }), element("text", { x: -168, y: 133 }, "y"), element("text", { x: -139, y: 163 }, "z")));
    into.append(element("figure", { class: "drop" }, element("figcaption", {}, `${bearing.name}: radial air gap ${short(bearing.gap)} µm, magnified`), svg, this.caption));
  }

  // Where the ring's centre hangs before the drop; the air gap is around it.
  static rest(bearing) { return { y: bearing.ring_y[0] || 0, z: bearing.ring_z[0] || 0 }; }

  // Half the picture's side, so that rotor and ring stay inside over the whole drop.
  reach() {
    const b = this.bearing, farthest = (y, z) => y.reduce((most, v, i) => Math.max(most, Math.hypot(v, z[i])), 0);
    const bent = this.bearing.shape ? this.bearing.shape.coefficients.reduce((sum, row) => sum + row.reduce((most, v) => Math.max(most, Math.abs(v)), 0), 0) : 0;
    return Math.max(175, Math.ceil(8 + Math.max(this.bore + 16 + this.scale * (farthest(b.ring_y, b.ring_z) + bent), this.journal + this.scale * farthest(b.y, b.z))));
  }

  x(z) { return this.scale * z; }
  y(y) { return -this.scale * y; }

  // Radial displacement of a bent ring [um] at an angle from +y towards +z.
  bending(at, angle) {
    return this.bearing.shape.coefficients.reduce((sum, row, k) => sum + row[at] * (k % 2 ? Math.sin : Math.cos)((2 + (k >> 1)) * angle), 0);
  }

  // Outline of a bent ring whose centre is at y, z [um].
  outline(radius, at, y, z) {
    let d = "";
    for (let k = 0; k < 180; ++k) {
      const angle = (k * Math.PI) / 90, r = radius + this.scale * this.bending(at, angle);
      d += `${k ? "L" : "M"}${(this.x(z) + r * Math.sin(angle)).toFixed(1)} ${(this.y(y) - r * Math.cos(angle)).toFixed(1)}`;
    }
    return d + "Z";
  }

  show(time) {
    const b = this.bearing, i = nearest(b.time, time);
    if (this.bent) {
      const at = nearest(b.shape.time, time);
      this.bent.outside.setAttribute("d", this.outline(this.bore + 16, at, b.ring_y[i], b.ring_z[i]));
      this.bent.bore.setAttribute("d", this.outline(this.bore, at, b.ring_y[i], b.ring_z[i]));
    }
    const turned = (y, z, angle) => `translate(${this.x(z).toFixed(2)} ${this.y(y).toFixed(2)}) rotate(${((angle * 180) / Math.PI).toFixed(1)})`;
    this.ring.setAttribute("transform", turned(b.ring_y[i], b.ring_z[i], b.ring_angle[i]));
    this.rotor.setAttribute("transform", turned(b.y[i], b.z[i], b.rotor_angle[i]));
    this.centre.setAttribute("cx", this.x(b.z[i]));
    this.centre.setAttribute("cy", this.y(b.y[i]));
    const y = b.y[i] - b.ring_y[i], z = b.z[i] - b.ring_z[i], r = Math.hypot(y, z) || 1;
    this.contact.setAttribute("visibility", b.penetration[i] > 0 ? "visible" : "hidden");
    this.contact.setAttribute("cx", this.x(b.ring_z[i]) + (this.bore * z) / r);
    this.contact.setAttribute("cy", this.y(b.ring_y[i]) - (this.bore * y) / r);
    this.caption.textContent = `y ${short(b.y[i])} µm, z ${short(b.z[i])} µm, contact force ${short(b.force[i])} kN`;
  }
}

// The rotor in the stationary part around a probe, drawn alike.
function probeDrop(probe, into) {
  const still = probe.time.map(() => 0);
  const drop = new Drop({ ...probe, ring_y: still, ring_z: still, ring_angle: still, penetration: probe.clearance.map((left) => -left), force: still }, into);
  const show = drop.show.bind(drop);
  drop.show = (time) => {
    show(time);
    const i = nearest(probe.time, time);
    drop.caption.textContent = `y ${short(probe.y[i])} µm, z ${short(probe.z[i])} µm, ` + (probe.clearance[i] > 0 ? `clearance left ${short(probe.clearance[i])} µm` : `${short(-probe.clearance[i])} µm beyond the clearance`);
  };
  return drop;
}

function showDrops(animation) {
  const drops = element("div", { class: "drops" });
  const times = animation.bearings[0].time;
  const slider = element("input", { type: "range", id: "time", min: 0, max: times.length - 1, step: 1, "aria-label": "time" });
  const output = element("output", { id: "instant" }), play = element("button", { id: "play" }, "play");
  // Milliseconds of the drop in a second of the reader's.
  const whole = times[times.length - 1] - times[0], paces = [0.3, 1, 3, 10, 30, 100, 300, 1000];
  const usual = paces.reduce((best, p) => (Math.abs(Math.log((p * 30) / whole)) < Math.abs(Math.log((best * 30) / whole)) ? p : best));
  const pace = element("select", { id: "pace", "aria-label": "speed of playback" },
    ...paces.map((p) => element("option", { value: p, ...(p === usual ? { selected: "" } : {}) }, p === 1000 ? "real time" : `1 s shows ${p} ms`)));
  const steps = times.slice(1).map((time, k) => time - times[k]);
  const shortest = steps.reduce((a, b) => Math.min(a, b), Infinity), longest = steps.reduce((a, b) => Math.max(a, b), 0);
  const rhythm = longest > 1.5 * shortest ? `every ${short(shortest)} to ${short(longest)} ms, more often while something changes` : `every ${short(longest)} ms`;
  section("The drop", element("div", { class: "player" }, play, pace, slider, output), drops,
    element("p", { class: "note" }, `Seen along +x, the axes ${data.directions.y} upwards and ${data.directions.z} to the right; positive spin is clockwise. Gap, displacements, penetration and the bending of rings share one magnification; the radii are not to that scale. ` +
      `Dashed: limit of the rotor centre (dot) set by the air gap around the ring's centre before the drop, as in the orbits. Filled dot on the bore: contact. The bars turn with rotor and ring. ${animation.not_drawn.length ? `Not drawn: ${animation.not_drawn.join(", ")}. ` : ""}One frame ${rhythm}; faster motion is not visible here.`));
  const made = animation.bearings.map((bearing) => new Drop(bearing, drops));
  for (const probe of animation.probes || []) made.push(probeDrop(probe, drops));
  if (data.bending) made.push(bendingAt(data.bending, drops));
  const show = () => {
    const time = times[+slider.value];
    output.textContent = `t = ${short(time)} ms`;
    made.forEach((drop) => drop.show(time));
  };
  slider.oninput = show;
  slider.value = nearest(times, animation.start || 0);
  show();
  let playing = null;
  const stop = () => {
    cancelAnimationFrame(playing);
    playing = null;
    play.textContent = "play";
  };
  play.onclick = () => {
    if (playing !== null) return stop();
    if (+slider.value >= times.length - 1) slider.value = 0;
    play.textContent = "stop";
    let at = times[+slider.value], last = null, own = +slider.value;
    const step = (now) => {
      if (+slider.value !== own) at = times[+slider.value];  // the reader has moved it
      at += last === null ? 0 : ((now - last) / 1000) * +pace.value;
      last = now;
      own = nearest(times, at);
      if (own !== +slider.value) {
        slider.value = own;
        show();
      }
      if (at >= times[times.length - 1]) return stop();
      playing = requestAnimationFrame(step);
    };
    playing = requestAnimationFrame(step);
  };
}
