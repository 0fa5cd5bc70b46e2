"use strict";
// What all pages are drawn from and with: the JSON in #data, elements, tables, sections.

const data = JSON.parse(document.getElementById("data").textContent);
const page = document.getElementById("page");
const tip = document.getElementById("tip");
const SVG = "http://www.w3.org/2000/svg";
const DRAWN = new Set(["svg", "g", "path", "line", "circle", "ellipse", "text", "rect", "title", "image", "clipPath", "defs"]);

function element(name, attributes, ...children) {
  const made = DRAWN.has(name) ? document.createElementNS(SVG, name) : document.createElement(name);
  for (const [key, value] of Object.entries(attributes || {})) made.setAttribute(key, value);
  made.append(...children.filter((child) => child !== null));
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
