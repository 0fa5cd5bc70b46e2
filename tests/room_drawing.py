"""Draws rooms and their arrows as SVG, in layers: a room stands above those that it includes."""

from xml.sax.saxutils import escape

HEIGHT, GAP, SPACE, MARGIN = 62, 58, 26, 24
STYLE = """
    .paper { fill: #ffffff; }
    .room { fill: #eef5fb; stroke: #3f6689; stroke-width: 1.2; }
    .loaded { fill: #fbf6ea; stroke: #9a7b2f; stroke-dasharray: 5 3; }
    .name { font: bold 15px sans-serif; fill: #16324a; }
    .words { font: 11.5px sans-serif; fill: #33475a; }
    .libraries { font: italic 11px sans-serif; fill: #6d7f90; }
    .arrow { fill: none; stroke: #5b7f9f; stroke-width: 1.3; marker-end: url(#head); }
    .parameters { stroke: #a8743a; stroke-dasharray: 5 4; marker-end: url(#head-of-parameters); }
    .head { fill: #5b7f9f; }
    .head-of-parameters { fill: #a8743a; }
    .key { font: 12px sans-serif; fill: #33475a; }
"""


def reachable(arrows, room):
    found, open_ends = set(), list(arrows[room])
    while open_ends:
        other = open_ends.pop()
        if other not in found:
            found.add(other)
            open_ends.extend(arrows[other])
    return found


def reduced(arrows):
    """The arrows without those that follow from others."""
    return {room: [other for other in arrows if other in others and not any(other in reachable(arrows, via) for via in others)] for room, others in arrows.items()}


def split(rooms):
    """(arrows, arrows to parameters alone) of a table such as ROOMS; both without those that follow from others."""
    full = {room: {other for other in others if ":" not in other} for room, others in rooms.items()}
    arrows = reduced(full)
    wanted = {room: {other.split(":")[0] for other in others if ":" in other} for room, others in rooms.items()}
    parameters = {room: [other for other in rooms if other in wanted[room] and not any(other in wanted[via] for via in reachable(full, room))] for room in rooms}
    return arrows, parameters


def depths(rooms, arrows):
    """Layer of each room: 0 for those that include nobody."""
    known = {}

    def depth(room):
        if room not in known:
            known[room] = 1 + max((depth(other) for other in arrows[room]), default=-1)
        return known[room]

    return {room: depth(room) for room in rooms}


class Layout:
    """Places of rooms, and of the bends of arrows that cross layers."""

    def __init__(self, rooms, widths, arrows):
        self.layer = depths(rooms, arrows)
        self.rows = [[] for _ in range(max(self.layer.values()) + 1)]
        self.width = dict(widths)
        for room in rooms:
            self.rows[self.layer[room]].append(room)
        self.above, self.below = {}, {}

    def route(self, room, other):
        """A chain of places from a room down to another; layers between get a bend."""
        chain = [room]
        for layer in range(self.layer[room] - 1, self.layer[other], -1):
            bend = (room, other, layer)
            self.width[bend] = 8
            self.rows[layer].append(bend)
            chain.append(bend)
        chain.append(other)
        for upper, lower in zip(chain, chain[1:]):
            self.below.setdefault(upper, []).append(lower)
            self.above.setdefault(lower, []).append(upper)
        return chain

    def place(self):
        """Orders each row by the places of its neighbours, then moves everything towards them as far as it fits."""
        best = None
        for sweep in range(24):
            order = {node: i - 0.5 * len(row) for row in self.rows for i, node in enumerate(row)}
            side = self.above if sweep % 2 == 0 else self.below
            for row in self.rows:
                mean = {node: sum(order[n] for n in side[node]) / len(side[node]) if side.get(node) else order[node] for node in row}
                row.sort(key=mean.get)
            self.swap_neighbours()
            if best is None or self.crossings() < best[0]:
                best = self.crossings(), [list(row) for row in self.rows]
        self.rows = best[1]
        self.x = {}
        for row in self.rows:
            at = 0.0
            for node in row:
                self.x[node] = at + 0.5 * self.width[node]
                at += self.width[node] + SPACE
            for node in row:
                self.x[node] -= 0.5 * at
        for _ in range(200):
            for row in self.rows:
                wanted = []
                for node in row:
                    neighbours = self.above.get(node, []) + self.below.get(node, [])
                    wanted.append(sum(self.x[n] for n in neighbours) / len(neighbours) if neighbours else self.x[node])
                self.spread(row, wanted)
        left = min(self.x[node] - 0.5 * self.width[node] for node in self.x)
        for node in self.x:
            self.x[node] += MARGIN - left
        return max(self.x[node] + 0.5 * self.width[node] for node in self.x) + MARGIN

    def crossings(self):
        """Number of crossings of arrows between neighbouring layers."""
        n = 0
        for row, upper in zip(self.rows, self.rows[1:]):
            at = {node: i for i, node in enumerate(row)}
            ends = [(i, at[lower]) for i, node in enumerate(upper) for lower in self.below.get(node, [])]
            n += sum((a - c) * (b - d) < 0 for k, (a, b) in enumerate(ends) for c, d in ends[:k])
        return n

    def swap_neighbours(self):
        """Swaps neighbours in their row as long as that takes away crossings."""
        least, is_better = self.crossings(), True
        while is_better:
            is_better = False
            for row in self.rows:
                for i in range(len(row) - 1):
                    row[i], row[i + 1] = row[i + 1], row[i]
                    if (n := self.crossings()) < least:
                        least, is_better = n, True
                    else:
                        row[i], row[i + 1] = row[i + 1], row[i]

    def spread(self, row, wanted):
        """Places as wanted, pushed apart evenly where they would overlap."""
        distance = [0.5 * (self.width[a] + self.width[b]) + SPACE for a, b in zip(row, row[1:])]
        from_left, from_right = list(wanted), list(wanted)
        for i, d in enumerate(distance):
            from_left[i + 1] = max(from_left[i + 1], from_left[i] + d)
        for i in range(len(distance) - 1, -1, -1):
            from_right[i] = min(from_right[i], from_right[i + 1] - distance[i])
        for node, a, b in zip(row, from_left, from_right):
            self.x[node] = 0.5 * (a + b)

    def top(self, node):
        layer = self.layer[node] if node in self.layer else node[2]
        return MARGIN + (len(self.rows) - 1 - layer) * (HEIGHT + GAP)


def text_width(text, size):
    return 0.56 * size * len(text)


def drawing(rooms, words, libraries):
    """The SVG as text.

    rooms: {room: those it may include, "room:parameters" for headers of parameters alone}
    words, libraries: {room: a line of text}; a room within another's folder is loaded at run time
    """
    arrows, parameters = split(rooms)
    lines = {room: [text for text in (words.get(room, ""), libraries.get(room, "")) if text] for room in rooms}
    widths = {room: max([110, 24 + text_width(room, 15)] + [20 + text_width(line, 11.5) for line in lines[room]]) for room in rooms}
    layout = Layout(rooms, widths, arrows)
    chains = [(layout.route(room, other), "arrow") for room in rooms for other in arrows[room]]
    chains += [(layout.route(room, other), "arrow parameters") for room in rooms for other in parameters[room]]
    width = layout.place()
    height = 2 * MARGIN + len(layout.rows) * HEIGHT + (len(layout.rows) - 1) * GAP + 34

    def port(chain, at, beside):
        """Where an arrow leaves or reaches a room: side by side, in the order of where it goes."""
        room = chain[at]
        fellows = sorted(layout.x[other[at + beside]] for other, _ in chains if other[at] == room)
        # Arrows to the same place may stand in any order.
        position = fellows.index(layout.x[chain[at + beside]])
        return layout.x[room] + (position - 0.5 * (len(fellows) - 1)) * min(22, 0.7 * layout.width[room] / max(1, len(fellows)))

    made = []
    for chain, kind in chains:
        points = [(port(chain, 0, 1), layout.top(chain[0]) + HEIGHT)]
        for bend in chain[1:-1]:
            points += [(layout.x[bend], layout.top(bend)), (layout.x[bend], layout.top(bend) + HEIGHT)]
        points.append((port(chain, -1, -1), layout.top(chain[-1]) - 3))
        d = f"M{points[0][0]:.0f} {points[0][1]:.0f}"
        for i, ((x, y), (x_2, y_2)) in enumerate(zip(points, points[1:])):
            d += f"V{y_2:.0f}" if i % 2 else f"C{x:.0f} {0.5 * (y + y_2):.0f} {x_2:.0f} {0.5 * (y + y_2):.0f} {x_2:.0f} {y_2:.0f}"
        made.append(f'  <path class="{kind}" d="{d}"/>')
    for room in rooms:
        x, y, w = layout.x[room], layout.top(room), layout.width[room]
        kind = "room loaded" if "/" in room else "room"
        made.append(f'  <rect class="{kind}" x="{x - 0.5 * w:.0f}" y="{y:.0f}" width="{w:.0f}" height="{HEIGHT}" rx="6"/>')
        first = y + 0.5 * HEIGHT + 5 - 8 * len(lines[room])
        made.append(f'  <text class="name" x="{x:.0f}" y="{first:.0f}" text-anchor="middle">{escape(room)}</text>')
        for i, line in enumerate(lines[room]):
            kind = "libraries" if line == libraries.get(room) else "words"
            made.append(f'  <text class="{kind}" x="{x:.0f}" y="{first + 17 + 15 * i:.0f}" text-anchor="middle">{escape(line)}</text>')
    y = height - MARGIN
    made += [f'  <path class="arrow" d="M{MARGIN} {y - 4}h34"/>', f'  <text class="key" x="{MARGIN + 46}" y="{y}">may include; arrows that follow from others are left out</text>',
             f'  <path class="arrow parameters" d="M{MARGIN + 390} {y - 4}h34"/>', f'  <text class="key" x="{MARGIN + 436}" y="{y}">may include headers of parameters alone</text>']
    heads = "".join(f'<marker id="{name}" viewBox="0 0 8 8" refX="6" refY="4" markerWidth="7" markerHeight="7" orient="auto"><path class="{name}" d="M0 0.8L7.5 4L0 7.2z"/></marker>'
                    for name in ("head", "head-of-parameters"))
    return "\n".join([f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height}" width="{width:.0f}" height="{height}" role="img" aria-label="Folders of src and whom they may include">',
                      f"  <style>{STYLE}  </style>", f"  <defs>{heads}</defs>", '  <rect class="paper" width="100%" height="100%"/>', *made, "</svg>", ""])
