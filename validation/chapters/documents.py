"""The tables of verdicts in docs/theory/validation.md and of errata in docs/theory/model.md, from an actual run."""

from . import page

BEGIN, END = "<!-- verdicts: written by validation/run --update-docs -->\n", "<!-- end of verdicts -->"
ERRATA_BEGIN, ERRATA_END = "<!-- errata: written by validation/run --update-docs -->\n", "<!-- end of errata -->"


def shown(claim):
    """The paper's value and this program's, as text for Markdown."""
    def plain(value):
        return f"{value:.4g}" if abs(value) < 1000 else f"{value:.0f}" if abs(value) < 1e5 else f"{value:.3g}"

    if claim["ours"] is None:
        return "", "not defined", ""
    if claim["rule"] == "value":
        unit = f" {claim['unit']}" if claim["unit"] else ""
        return f"{claim['paper']:g}{unit}", f"{plain(claim['ours'])}{unit}", f"{plain(claim['lowest'])} to {plain(claim['highest'])}"
    if claim["rule"] == "bound":
        unit = f" {claim['unit']}" if claim["unit"] else ""
        return f"{claim['bound']} {claim['paper']:g}{unit}", f"{plain(claim['ours'])}{unit}", f"{plain(claim['lowest'])} to {plain(claim['highest'])}"
    holding = sum(bool(run["ours"]) for run in claim["runs"])
    return "states it", "holds" if claim["ours"] else "fails", f"holds in {holding} of {len(claim['runs'])} runs"


def table(data):
    lines = ["| | the paper says | the paper | this program | over the unknowns | verdict |", "|---|---|---|---|---|---|"]
    for statement in data["statements"]:
        lines.append(f"| **{statement['id']}** | | | | | {page.counts(statement)} |")
        lines += ["| " + " | ".join([claim["id"], claim["says"] + (" (*)" if claim.get("hindsight") else ""), *shown(claim), claim["verdict"]]) + " |" for claim in statement["claims"]]
    return "\n".join(lines) + "\n"


def errata(data):
    """The table of errata in docs/theory/model.md: its effects are this run's."""
    def cell(words):
        return words.replace("|", "\\|")

    lines = ["| | the paper | here | effect of what is printed |", "|---|---|---|---|"]
    lines += ["| " + " | ".join(cell(e[key]) for key in ("where", "printed", "right", "brief")) + " |" for e in data["errata"]]
    return "\n".join(lines) + "\n"


def between(text, begin, end, inside, path):
    if begin not in text or end not in text:
        raise ValueError(f"{path} has no markers of the table")
    head, rest = text.split(begin, 1)
    return head + begin + inside + end + rest.split(end, 1)[1]


def update(path, data):
    path.write_text(between(path.read_text(), BEGIN, END, table(data), path))


def update_errata(path, data):
    path.write_text(between(path.read_text(), ERRATA_BEGIN, ERRATA_END, errata(data), path))
