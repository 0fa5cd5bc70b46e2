"use strict";
// Search over window.SEARCH, entries of [page, anchor, heading, text]: all words must occur; those in a heading count more.
const field = document.getElementById("search"), found = document.getElementById("found");
const entries = window.SEARCH.map(([page, anchor, head, text]) => ({ page, anchor, head, text, low: (head + " " + text).toLowerCase(), lowHead: head.toLowerCase() }));

function excerpt(text, word) {
  const at = Math.max(0, text.toLowerCase().indexOf(word) - 40);
  return (at ? "…" : "") + text.slice(at, at + 130) + (text.length > at + 130 ? "…" : "");
}

function search() {
  const words = field.value.toLowerCase().split(/\s+/).filter((w) => w);
  found.hidden = !words.length;
  if (!words.length) return;
  const score = (e) => words.reduce((sum, w) => sum + (e.lowHead === w || e.lowHead.endsWith("." + w) ? 20 : e.lowHead.includes(w) ? 8 : 1), 0) - e.low.length * 1e-5;
  const hits = entries.filter((e) => words.every((w) => e.low.includes(w))).sort((a, b) => score(b) - score(a));
  found.replaceChildren(...hits.slice(0, 15).map((e) => {
    const item = document.createElement("li"), link = document.createElement("a"), note = document.createElement("small");
    link.href = `${e.page}.html${e.anchor ? "#" + e.anchor : ""}`;
    link.textContent = e.head;
    note.textContent = excerpt(e.text, words[0]);
    item.append(link, note);
    return item;
  }));
  if (!hits.length) found.textContent = "nothing found";
}

field.oninput = search;
field.onkeydown = (event) => {
  if (event.key === "Escape") { field.value = ""; search(); }
  if (event.key === "Enter" && found.querySelector("a")) found.querySelector("a").click();
};
