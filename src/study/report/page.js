"use strict";
// What all pages are drawn from and with: the JSON in #data, elements, tables, sections.

const data = JSON.parse(document.getElementById("data").textContent);
const page = document.getElementById("page");
const tip = document.getElementById("tip");
const SVG = "http://www.w3.org/2000/svg";
const DRAWN = new Set(["svg", "g", "path", "line", "circle", "ellipse", "text", "rect", "title", "image", "clipPath", "defs"]);

// A number on an axis, with the digits that tell it from its neighbour a step away.
function tickText(value, step) {
  const places = Math.max(0, Math.min(12, -Math.floor(Math.log10(step) + 1e-9))), size = Math.abs(value);
  if (size < 1e6 && (size >= 0.01 || step >= 1e-4)) return value.toFixed(places);
  return size < step * 1e-6 ? "0" : value.toExponential(Math.max(0, Math.floor(Math.log10(size) + 1e-9) - Math.floor(Math.log10(step) + 1e-9)));
}

function element(name, attributes, ...children) {
  const made = DRAWN.has(name) ? document.createElementNS(SVG, name) : document.createElement(name);
  for (const [key, value] of Object.entries(attributes || {})) made.setAttribute(key, value);
  for (const child of children.flat()) if (child !== null) made.append(child);  // a list of many may be a child: as arguments they would not fit on the stack
  return made;
}

function table(header, rows, classes = []) {
  const cells = (row, name) => element("tr", {}, ...row.map((text, i) => element(name, { class: classes[i] || "" }, ...[text].flat())));
  const body = element("tbody", {}, ...rows.map((row) => cells(row, "td")));
  return element("table", {}, ...(header ? [element("thead", {}, cells(header, "th"))] : []), body);
}

function section(title, ...children) {
  const id = title.toLowerCase().replace(/[^a-z]+/g, "-");
  const made = element("section", { id }, element("h2", {}, title), ...children);
  page.append(made);
  document.querySelector("nav").append(element("a", { href: "#" + id }, title));
  return made;
}
