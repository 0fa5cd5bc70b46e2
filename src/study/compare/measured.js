// Draws the page of measured series beside a drop from the JSON in #data.

page.append(element("h1", {}, data.title), element("nav", {}));
section("Measured less computed", differenceTable(data.measured));
section("Figures", ...data.overlay.map(overlay));
page.dataset.ready = "yes";
