"""report.html: one self-contained page from validation.json's contents and the figures. No script, no external reference."""

import html
import math
import re

from . import verdicts

SHORT = {verdicts.REPRODUCED: "yes", verdicts.IN_TREND: "trend", verdicts.NOT_DECIDABLE: "open", verdicts.CONTRADICTED: "no"}
#: with each colour a sign, for print and colour blindness
SIGN = {verdicts.REPRODUCED: "&#9679;", verdicts.IN_TREND: "&#9681;", verdicts.NOT_DECIDABLE: "?", verdicts.CONTRADICTED: "&#10005;"}

STYLE = """
:root { --ink: #1c2430; --soft: #5a6675; --line: #d8dee6; --shade: #f5f7fa; }
* { box-sizing: border-box; }
body { font: 15px/1.5 system-ui, "DejaVu Sans", sans-serif; color: var(--ink); margin: 0 auto; padding: 1.5rem 1.5rem 4rem; max-width: 66rem; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: 0.5rem 0; } h2 { font-size: 1.3rem; margin: 2.5rem 0 0.6rem; padding-top: 0.6rem; border-top: 2px solid var(--ink); }
h3 { font-size: 1.05rem; margin: 1.8rem 0 0.4rem; } p, li { max-width: 50rem; } .soft { color: var(--soft); font-size: 0.88rem; }
table { border-collapse: collapse; font-size: 0.85rem; margin: 0.6rem 0 1rem; } th, td { text-align: left; vertical-align: top; padding: 0.25rem 0.6rem 0.25rem 0; border-bottom: 1px solid var(--line); }
th { font-weight: 600; border-bottom: 1px solid var(--ink); } td.n, th.n { text-align: right; font-variant-numeric: tabular-nums; } td.n, td b { white-space: nowrap; } td:first-child { min-width: 7rem; } .wide { overflow-x: auto; }
.v { display: inline-block; border-radius: 3px; padding: 0 0.4rem; font-size: 0.82rem; font-weight: 600; white-space: nowrap; border: 1px solid; }
.v.yes { background: #dcefe8; border-color: #2d7d63; color: #17513e; } .v.trend { background: #e2edf7; border-color: #3a6ea5; color: #1d4470; }
.v.open { background: #f4f0e0; border-color: #9a8433; color: #5d4e14; } .v.no { background: #f8e3da; border-color: #b5532a; color: #7a3010; }
figure { margin: 0.8rem 0 1rem; } figure img { width: 100%; max-width: 56rem; display: block; } figcaption { font-size: 0.85rem; color: var(--soft); }
blockquote { margin: 0.4rem 0; padding: 0.1rem 0 0.1rem 0.9rem; border-left: 3px solid var(--line); } details { margin: 0.4rem 0; } summary { cursor: pointer; color: var(--soft); font-size: 0.88rem; }
pre { font: 12px/1.4 "DejaVu Sans Mono", monospace; background: var(--shade); padding: 0.6rem; overflow-x: auto; } nav { font-size: 0.9rem; } nav a { margin-right: 1rem; white-space: nowrap; } a { color: #1d4470; }
@media print { body { font-size: 10pt; max-width: none; padding: 0; } h2 { break-before: auto; } h2, h3 { break-after: avoid; } figure, tr, blockquote { break-inside: avoid; } nav { display: none; } .wide { overflow: visible; } }
"""


def text(value):
    """Escaped, with micrometres as they are printed."""
    return re.sub(r"\bum\b", "\N{MICRO SIGN}m", html.escape(str(value), quote=False))


def number(value, digits=4):
    if value is None:
        return "&ndash;"
    if isinstance(value, bool):
        return "holds" if value else "fails"
    if isinstance(value, str):
        return text(value)
    if not math.isfinite(value):
        return "&ndash;"
    if value == 0:
        return "0"
    if 1e-3 <= abs(value) < 1e5:
        shown = f"{value:.{digits}g}"
        return shown if "e" not in shown else f"{value:.0f}"
    mantissa, exponent = f"{value:.{min(digits, 3) - 1}e}".split("e")
    return f"{mantissa}&middot;10<sup>{int(exponent)}</sup>"


def with_unit(value, unit, digits=4):
    return number(value, digits) + (f"&nbsp;{text(unit)}" if unit and value is not None else "")


def badge(verdict):
    return f'<span class="v {SHORT[verdict]}">{SIGN[verdict]} {verdict}</span>'


def badges(statement):
    """A figure's claims by verdict: counts, no verdict of its own."""
    return " ".join(f'<span class="v {SHORT[v]}">{SIGN[v]} {n} {v}</span>' for v, n in statement["counts"].items())


def table(head, rows):
    """Cells are HTML; a head that begins with # is of a column of numbers."""
    kind = ['class="n"' if h.startswith("#") else "" for h in head]
    lines = ["<tr>" + "".join(f"<th {k}>{h.lstrip('#')}</th>" for k, h in zip(kind, head)) + "</tr>"]
    lines += ["<tr>" + "".join(f"<td {k}>{cell}</td>" for k, cell in zip(kind, row)) + "</tr>" for row in rows]
    return f'<div class="wide"><table>{"".join(lines)}</table></div>'


def image(name, caption, source):
    return f'<figure id="{name}"><img src="{source}" alt="{text(caption)}"><figcaption>{text(caption)}</figcaption></figure>'


# ---- Statements
def claim_row(claim):
    if claim["rule"] == "value":
        paper = with_unit(claim["paper"], claim["unit"]) + f'<br><span class="soft">&plusmn; {100 * claim["width"]:.3g} %</span>'
        ours = with_unit(claim["ours"], claim["unit"])
        if claim["ours"] is not None:
            ours += f'<br><span class="soft">{number(claim["lowest"])} to {number(claim["highest"])}</span>'
        difference = "&ndash;" if claim["ours"] is None else f'{100 * claim["relative_difference"]:+.3g} %'
    elif claim["rule"] == "bound":
        paper = f'{claim["bound"]} {with_unit(claim["paper"], claim["unit"])}'
        ours = with_unit(claim["ours"], claim["unit"])
        if claim["ours"] is not None:
            ours += f'<br><span class="soft">{number(claim["lowest"])} to {number(claim["highest"])}</span>'
        difference = "&ndash;" if claim["ours"] is None else f'{100 * claim["relative_difference"]:+.3g} %'
    else:
        paper, difference = "states it", "&ndash;"
        ours = "&ndash;" if claim["ours"] is None else number(bool(claim["ours"])) + f'<br><span class="soft">in {sum(bool(r["ours"]) for r in claim["runs"])} of {len(claim["runs"])} runs</span>'
    return [f'{text(claim["says"])}<br><span class="soft">{text(claim["measure"])}</span>', paper, ours, difference, f'{badge(claim["verdict"])}<br><span class="soft">{text(claim["reason"])}</span>']


def unknown_rows(claims):
    unknowns = list(dict.fromkeys(unknown for claim in claims for unknown in claim.get("by_unknown", {})))
    rows = []
    for claim in claims:
        if claim.get("by_unknown"):
            rows.append([text(claim["says"]), number(claim["ours"]) + f' {text(claim["unit"])}', *(" to ".join(number(v, 3) for v in claim["by_unknown"][u]) if u in claim["by_unknown"] else "" for u in unknowns)])
    return ["claim", "#reference", *(f"#{u}" for u in unknowns)], rows


def statement_section(statement, pictures, arguments):
    parts = [f'<h3 id="{statement["id"].replace(" ", "-")}">{text(statement["id"].capitalize())}</h3>', f'<p>{badges(statement)}</p>', f'<blockquote>{text(statement["says"])}</blockquote>']
    if statement["figure"] in pictures:
        caption, source = pictures[statement["figure"]]
        parts.append(image(f"picture-{statement['figure']}", f"Figure {statement['figure']} of the paper, by our runs. {caption}.", source))
    parts.append(table(["claim", "the paper", "this program, and its spread over the unknowns", "#difference", "verdict and reason"], [claim_row(c) for c in statement["claims"]]))
    head, rows = unknown_rows(statement["claims"])
    if rows:
        parts.append(f"<details><summary>Spread by unknown: lowest to highest, reference included</summary>{table(head, rows)}</details>")
    notes = "".join(f'<li>{text(c["says"])}: {text(c["why"])}.' + (f' <b>Chosen or changed after our numbers were seen:</b> {text(c["hindsight"])}.' if c["hindsight"] else "") + "</li>" for c in statement["claims"])
    parts.append(f"<details><summary>Why this tolerance band or bound</summary><ul>{notes}</ul></details>")
    parts.append(f'<p class="soft">Earlier assessment, from trial models (not part of the verdict): {text(statement["earlier_opinion"])}.</p>')
    if statement["figure"] in arguments:
        parts.append(f'<p><b>Argument.</b> {arguments[statement["figure"]]}</p>')
    return "\n".join(parts)


def argument_texts(a):
    """Paragraphs below the figures that they are about; every number is from the runs."""
    ring, ball, spin = a["ring"], a["ball"], a["spin_energy"]
    forces = {row["case"]: row for row in a["forces"]}
    third = forces["table 4, third order, 1 um"]
    side = a["sideways"]
    forces_table = table(["from 0.15 s on, TB2", "#lowest [N]", "#highest [N]", "#highest at [s]", "#frequency of the wave then [Hz]", "#bearing force, lowest [N]", "#highest [N]", "#its swing over the contact force's"],
                         [[text(r["case"]), number(r["contact"]["lowest"]), number(r["contact"]["highest"]), number(r["time"], 3), number(r["frequency"], 3), number(r["bearing"]["lowest"]), number(r["bearing"]["highest"]), number(r["ratio"])] for r in a["forces"]])
    table_19 = table(["case", "#rub heat [J]", "#same, from the spin-up alone [J]", "#difference [J]", "#bearing friction heat [J]", "#ring's rise [K]"],
                     [[text(r["case"]), number(r["rub_heat"], 6), number(r["slip_energy"], 6), number(r["residual"], 2), number(r["internal_heat"]), number(r["rise"], 5)] for r in a["spin_up"]])
    return {
        "11": "The paper's times follow from spin inertias that it does not give: a ring needs about J omega/(mu r W) under the static load W. The spread above is over inertias as far as they could be; 0.2 s is at its end, with the lowest J.",
        "10": f"While the rotor slides on a ring, friction holds it displaced sideways by about atan(mu), 25 µm; it can return to 0 only after the ring has caught up. At the end TB2's ring lags by {100 * side['TB2']['lag']:.2g} % and the mean of z is "
              f"{1e6 * side['TB2']['mean']:.3g} µm; TB1's has caught up late in the run and the mean of its last 50 ms is {1e6 * side['TB1']['mean']:.3g} µm. The paper's z of 0 would follow from a ring that has caught up at 0.2 s.",
        "12": "A wave of order m meets the contact m times a turn, so while the ring gains speed each order sweeps through the resonance of rotor, contact and balls at its own time. The extremes from 0.15 s on are those of the resonance; after it the force of the third order stays "
              f"between {number(a['third_after']['lowest'])} and {number(a['third_after']['highest'])} N (last 50 ms). The paper does not say from when on its 150 to 1000 N hold, so they decide nothing: " + forces_table,
        "13": f"Only the inner ring (0.21 kg) lies between contact force and bearing force. The bearing force swings {number(third['ratio'])} times as much as the contact force with the third order, and between "
              f"{number(min(r['ratio'] for r in a['forces']))} and {number(max(r['ratio'] for r in a['forces']))} times in the six cases. In this model, figure 12 (150 to 1000 N) and figure 13 (smooth) of the third order exclude each other.",
        "16": "The paper's percentages are of the largest heat rate, one instant; here that is where a resonance of figure 12 falls late, at high speed. The mean rate, which warms the bearing, changes less: over the last 50 ms it is "
              + ", ".join(f"{100 * (row['heat_rate_end'] / a['spin_up'][0]['heat_rate_end'] - 1):+.2g} % ({text(row['case']).removeprefix('table 4, ')})" for row in a["spin_up"][1:4]) + " against the ideal surface. It follows speed and mean load.",
        "17": "The figure shows watts, and the verdicts compare watts: highest and mean rub heat rate, with 1 µm waves and without. " + table(["rub heat rate, TB2", "#first impact [W]", "#highest from 0.15 s on [W]", "#mean from 0.15 s on [W]", "#highest, last 50 ms [W]"],
              [[text(r["case"]), number(r["peak"]), number(r["highest"]), number(r["mean"]), number(r["late"])] for r in a["rub_rates"]]) +
              f"Joules are another matter. Heating ends when slip ends, and slip ends when friction has spun the ring up to speed: until 0.3 s the rub heat of the six cases differs by {number(max(r['rub_heat'] for r in a['spin_up']) - min(r['rub_heat'] for r in a['spin_up']), 2)} J of "
              f"{number(a['spin_up'][0]['rub_heat'])} J, in both directions. A higher rate at one time is made up for at another, so that figure 19 does not follow from figure 17.",
        "18": f"To warm the pair's balls ({number(ball['capacity'])} J/K) by {number(ball['paper_rise'])} K takes {number(ball['heat_for_paper_rise'])} J. All bearing friction heat until 0.3 s is {number(ball['internal_heat'])} J; if every joule of it "
              f"stayed in the balls, they would rise by {number(ball['rise_if_all_internal_heat_stayed'], 2)} K; with eq. 24 as printed, by {number(ball['rise_if_all_heat_as_printed_stayed'], 2)} K. Rub heat has to come through the ring and the contacts, and the ring is warm for a fraction of a second only. This program: "
              f"{number(ball['rise'], 2)} K; the highest of all runs is {number(ball['highest_in_any_run'], 2)} K, the one with eq. 24 as printed among them.",
        "19": f"The rub heat of a spin-up does not depend on forces: it follows from the ring's spin equation alone, about J omega&sup2;/2 = {number(spin['half_J_omega2'])} J (J = {number(spin['inertia'])} kg m&sup2;, {number(spin['speed'])} rad/s at 0.3 s) "
              f"plus what friction inside the bearing and the remaining slip add. Waves change the forces, but not this sum: over table 4 the ring's rise changes by {number(ring['largest_change_by_waves'], 2)} K. A rise of {number(ring['paper_rise'])} K of the ring "
              f"({number(ring['capacity'])} J/K) takes {number(ring['heat_for_paper_rise'])} J. In the run with 4 µm, second order, {number(ring['heat_available'])} J enter ring and balls; with the whole rub heat and all internal friction it "
              f"would be {number(ring['all_heat'])} J. Even if all rub heat stayed in the ring it would rise by {number(ring['rise_if_all_rub_heat_stayed'], 3)} K." + table_19,
    }


# ---- Chapters
def rules_section(data):
    return "<h2 id=\"rules\">Rules</h2><p>Every claim is judged by one of two rules, in code, on this program's numbers only. A figure has no verdict of its own: the counts of its claims stand beside it.</p><p>All bands were set when the numbers of the reference case were known. Where a band, bound or span leans on them or was changed later, the claim says so.</p>" + "".join(f"<p>{rule}</p>" for rule in verdicts.RULES.values()) + \
        f'<p>The reference is <code>{text(data["base"])}</code>. Unknowns are changed one at a time, {data["n_variants"]} changes in all; a claim about waves or friction is repeated for those that have runs of all its cases (list of runs). Where the paper does not say ' \
        "which bearing it shows, the pair is taken; the other bearing, with and without each change, counts as one more unknown.</p>"


def summary_rows(data):
    return [[f'<a href="#{s["id"].replace(" ", "-")}">{text(s["id"])}</a>', text(s["says"]), badges(s)] for s in data["statements"]]


def counts(statement):
    """"3 reproduced, 1 contradicted"; "all 4 reproduced" where there is one verdict."""
    found = statement["counts"]
    return ("all " if len(found) == 1 and sum(found.values()) > 1 else "") + ", ".join(f"{n} {v}" for v, n in found.items())


def errata_section(entries):
    parts = ['<h2 id="errata">Errata of the paper, with the effect of each</h2><p>Where the program has a switch for what is printed, it was run; elsewhere the effect is computed from the formulas in Python, apart from the program.</p>']
    rows = []
    for e in entries:
        numbers = "<br>".join(f'{text(n["what"])}: <b>{with_unit(n["value"], n["unit"])}</b>' for n in e["numbers"])
        rows.append([f'<b>{text(e["where"])}</b>', f'{text(e["printed"])}<br><span class="soft">here: {text(e["right"])}</span>', f'{text(e["effect"])}<br><span class="soft">{text(e["how"])}</span>', numbers])
    parts.append(table(["", "printed, and here", "effect", "numbers"], rows))
    return "\n".join(parts)


def milliseconds(value):
    return "never" if value is None else f"{1e3 * value:.4g} ms"


def scaled(value, unit):
    return (number(1e6 * value, 3) + "&nbsp;\N{MICRO SIGN}m") if unit == "m" else with_unit(value, unit, 3)


def models_section(models, pictures):
    parts = ['<h2 id="models">Lumped circuit against finite elements</h2>']
    if "skipped" in models:
        return parts[0] + f"<p>Skipped: {text(models['skipped'])}.</p>"
    parts.append("<p>The reference drop with both thermal models on the same heat. In short:</p><ul>" + "".join(f"<li>{text(line)}</li>" for line in models["in_short"]) + "</ul>")
    for key, (caption, source) in pictures.items():
        parts.append(image(f"picture-models-{key}", caption, source))
    parts.append("<h3>Whose growth is fed back</h3><p>The same drop with the growth of each model fed back, and with none. If a row differs from the next by less than the tolerance of the time integration, the choice does not matter for it.</p>")
    for bearing, rows in models["by_driver"].items():
        quantities = [("peak force [N]", "peak_contact_force", 1, 6), ("impulse of the first impact [N s]", "first_impact_impulse", 1, 5), ("rub heat [J]", "rub_heat", 1, 6), ("air gap at the end [\N{MICRO SIGN}m]", "air_gap", 1e6, 6),
                      ("inner-raceway growth fed back [\N{MICRO SIGN}m]", "inner_race_growth", 1e6, 4), ("inner ring, circuit [K]", "ring_circuit", 1, 6), ("inner ring, finite elements [K]", "ring_fe", 1, 6), ("mean contact force, last 50 ms [N]", "settled_force", 1, 4),
                      ("most loaded ball, mean of the last 50 ms [N]", "most_loaded_ball", 1, 4), ("preload at rest with that growth [N]", "preload", 1, 4)]
        parts.append(table([bearing, *(f"#{text(r['driver'])}" for r in rows)], [[label, *(number(scale * r[key], digits) for r in rows)] for label, key, scale, digits in quantities if key in rows[0]]))
    parts.append('<p class="soft">Preload at rest: Hertz contacts of the pair with rigid rings, computed in Python from the growth at 0.3 s; the program recorded ball loads under the rotor, which contain its weight.</p>')
    parts.append("<h3>Where the circuit can be trusted</h3><p>Difference: finite elements less circuit. Tolerance: 5 % of the rise at the time, but not below the value in the column; 0.1 µm for growth and clearances. &ldquo;One lump in both&rdquo;: the finite elements treat the body as one temperature, too, so agreement proves little.</p>")
    for bearing, rows in models["trust"].items():
        parts.append(table([f"{bearing}", "", "#largest difference", "#at", "#tolerance", "#first beyond it", "trusted"],
                           [[text(r["group"]), text(r["what"].replace("_", " ")) + (" (one lump in both)" if r["one_lump_in_both"] else ""), scaled(r["largest_difference"], r["unit"]), milliseconds(r["largest_difference_time"]), scaled(r["tolerance"], r["unit"]), milliseconds(r["beyond_from"]),
                             "throughout" if r["beyond_from"] is None else "until then" if r["within_from"] is None else f"but from {milliseconds(r['beyond_from'])} to {milliseconds(r['within_from'])}"] for r in rows]))
    parts.append("<h3>By time scale</h3><p>A body heated from one side is uniform to within a tenth after its equalisation time; before that, a single temperature says nothing about its surface. With Bi above 0.1 it does not become uniform while heat flows.</p>")
    for bearing, bodies in models["lumping"].items():
        local = models["local"][bearing]
        parts.append(table([bearing, "#length [mm]", "#Biot", "#equalisation time [s]"], [[text(body.replace("_", " ")), number(1e3 * n["length"]), number(n["biot"], 3), number(n["evening_time"], 3)] for body, n in bodies.items()]))
        parts.append(f'<p class="soft">{bearing}: on the swept arc the bore is locally up to {number(local["largest_local_over_node"]["value"], 3)} K above the circuit\'s ring, at {milliseconds(local["largest_local_over_node"]["time"])} (moving band; order of magnitude). No lumped node shows this.</p>')
    parts.append("<details><summary>Both values at three instants</summary>")
    for bearing, rows in models["instants"].items():
        names = [a["instant"] for a in rows[0]["at"]]
        parts.append(table([bearing, "", *(f"#{text(n)}: circuit" if i % 2 == 0 else "#FE" for n in names for i in range(2))],
                           [[text(r["group"]), text(r["what"].replace("_", " ")), *(scaled(a[k], "m") if r["unit"] == "m" else number(a[k], 7) + "&nbsp;K" for a in r["at"] for k in ("lumped", "fe"))] for r in rows]))
    parts.append("</details><h3>What the reduced model and calibration recover</h3><p>Differences are to the full, windowed model at 0.3 s.</p>")
    parts.append(table(["model", "bearing", "#unknowns or modes", "#ring's rise [K]", "#difference [K]", "#bore, mean, end [K]", "#bore, highest [K]", "#growth of the inner race, difference [nm]", "#CPU [s]"],
                       [[text(r["model"]), r["bearing"], number(r["unknowns"], 6), number(r["ring"], 6), number(r["ring_difference"], 2), number(r["bore"], 5), number(r["bore_highest"], 5), number(1e9 * r["growth_difference"], 2), number(r["cpu_time"], 3)] for r in models["reduction"]]))
    bodies = [k for k in models["calibration"][0]["published"] if k != "air_gap"]
    rows = []
    for r in models["calibration"]:
        for label in ("published", "calibrated"):
            rows.append([r["bearing"], f"circuit as {label}", number(r["rms_before" if label == "published" else "rms_after"], 3), *(number(r[label][b], 3) for b in bodies), number(1e6 * r[label]["air_gap"], 3)])
    parts.append("<p><code>rotordrop calibrate</code> fits factors of the circuit to the finite elements' responses; here the largest differences of the drop (finite elements less circuit) before and after. A circuit that was fitted to the finite elements is no "
                 "independent evidence for them; and it cannot represent the surfaces, for which it has no node.</p>")
    parts.append(table(["bearing", "", "#rms error of responses [%]", *(f"#{b.replace('_', ' ')} [K]" for b in bodies), "#air gap [µm]"], rows))
    return "\n".join(parts)


def verification_section(v):
    parts = ['<h2 id="verification">Verification</h2><p>Whether the program solves its equations; all tables come from tests, runs and scripts of this revision.</p>']
    e = v["energy"]
    reference = f' Reference: {number(e["reference"]["residual"], 2)} J of {number(e["reference"]["dissipated"])} J dissipated.' if e["reference"] else ""
    parts.append(f'<h3>Energy</h3><p>Over all {e["runs"]} runs of the study: largest residual of the mechanical balance {number(e["largest_residual"], 2)} J, of the heat balance {number(e["largest_heat_residual"], 2)} J, of the rub heat against the spin-up {number(e["largest_spin_up"], 2)} of it.{reference}</p>')
    parts.append(table(["largest residuals", "#residual [J]", "#dissipated [J]", "#heat residual [J]"], [[text(r["run"]), number(r["residual"], 3), number(r["dissipated"], 5), number(r["heat_residual"], 3)] for r in e["worst"]]))
    parts.append("<h3>Independent programs</h3>")
    rows = [[text(h["other"]), "skipped: " + text(h["skipped"]), "", ""] if "skipped" in h else [text(h["other"]), "heat conduction by finite elements", number(h["relative_difference"], 2), number(h["tolerance"], 2)] for h in v["heat"]]
    parts.append(table(["program", "", "#largest difference over largest rise", "#allowed"], rows))
    peer = v["peer"]
    if "skipped" in peer:
        parts.append(f"<p>Drop by {text(peer['other'])}: skipped, {text(peer['skipped'])}.</p>")
    else:
        parts.append("<p>The drop itself by <code>validation/peer/drop_peer.py</code>, an implementation that shares no code with the program (Runge-Kutta, 2.5 us). In the &ldquo;table&rdquo; case motion is chaotic after 60 to 100 ms, so quantities of the end differ.</p>")
        for name, rows in peer["cases"].items():
            parts.append(f"<details {'open' if name == 'settling' else ''}><summary>case {text(name)}</summary>" + table(["bearing", "quantity", "#rotordrop", "#peer", "#relative difference"], [[r["bearing"], text(r["quantity"]), number(r["ours"], 7), number(r["theirs"], 7), number(r["relative_difference"], 2)] for r in rows]) + "</details>")
    parts.append("<h3>Convergence</h3>")
    for name, caption in (("steps", "Steps and tolerances against Runge-Kutta with 0.5 us"), ("modes", "Rotor modes"), ("spread", "Effect of chaos: eight runs of the table case, starting nanometres apart")):
        rows = v["convergence"].get(name)
        if rows:
            parts.append(f"<details {'open' if name != 'spread' else ''}><summary>{caption}</summary>" + table([text(rows[0][0]), *(f"#{text(c)}" for c in rows[0][1:])], [[text(c) for c in row] for row in rows[1:]]) + "</details>")
    if "skipped" in v["tests"]:
        parts.append(f"<p>Tests: skipped, {text(v['tests']['skipped'])}.</p>")
        return "\n".join(parts)
    tests = v["tests"]["tests"]
    groups = list(dict.fromkeys(t["group"] for t in tests))
    parts.append("<h3>Tests against closed forms, orders and energy</h3>" + table(["group", "#passed", "#failed", "#skipped", "#seconds"], [[text(g), *(str(sum(t["group"] == g and t["state"] == s for t in tests)) for s in ("passed", "failed", "skipped")), f"{sum(t['seconds'] for t in tests if t['group'] == g):.2f}"] for g in groups]))
    failed = [t["name"] for t in tests if t["state"] == "failed"]
    if failed:
        parts.append(f"<p><b>Failed:</b> {text(', '.join(failed))}</p>")
    parts.append("<p>Test output:</p>" + "".join(f'<details><summary>{text(t["name"])}</summary><pre>{text(t["printed"])}</pre></details>' for t in tests if t["printed"]))
    return "\n".join(parts)


def runs_section(data):
    rows = [[f"<code>{text(r['name'])}</code>", text(r["unknown"]), text(r["says"])] for r in data["runs"]]
    return f'<h2 id="runs">Runs</h2><p>{len(rows)} runs of the program.</p><details><summary>All of them</summary>{table(["run", "unknown", ""], rows)}</details>'


def write(data, pictures, model_pictures):
    argument = argument_texts(data["arguments"]) if data.get("arguments") else {}
    chapters = ['<h2 id="statements">The paper, figure by figure</h2>', table(["", "the paper says", "claims"], summary_rows(data))]
    chapters += [statement_section(s, pictures, argument) for s in data["statements"]]
    chapters.append(rules_section(data))
    if "errata" in data:
        chapters.append(errata_section(data["errata"]))
    if "models" in data:
        chapters.append(models_section(data["models"], model_pictures))
    if "verification" in data:
        chapters.append(verification_section(data["verification"]))
    chapters.append(runs_section(data))
    links = [("statements", "The paper, figure by figure"), ("rules", "Rules"), ("errata", "Errata"), ("models", "Lumped against finite elements"), ("verification", "Verification"), ("runs", "Runs")]
    nav = "".join(f'<a href="#{name}">{title}</a>' for name, title in links if name in ("statements", "rules", "runs") or name in data)
    return f"""<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1"><title>rotordrop: validation</title><style>{STYLE}</style></head><body>
<h1>Validation: the drop of Neisi, Heikkinen &amp; Sopanen (2019)</h1>
<p class="soft">{text(data["program"])} &middot; revision {text(data["revision"])}. The paper: <i>Influence of surface waviness in the heat generation and thermal expansion of the touchdown bearing</i>, European Journal of Mechanics A/Solids 74 (2019) 34&ndash;47. Curves are this program's; black diamonds with bars are the numbers that the paper's text
or figures give, with the bands used here. The paper's curves are not published as data.</p>
<nav>{nav}</nav>
{"".join(chapters)}
</body></html>
"""
