"""The table of verdicts in docs/validation.md, from an actual run."""

from . import page

BEGIN, END = "<!-- verdicts: written by validation/run --update-docs -->\n", "<!-- end of verdicts -->"


def shown(claim):
    """Paper's value and ours, as text for Markdown."""
    def plain(value):
        return f"{value:.4g}" if abs(value) < 1000 else f"{value:.0f}" if abs(value) < 1e5 else f"{value:.3g}"

    if claim["ours"] is None:
        return "", "not defined", ""
    if claim["rule"] == "value":
        unit = f" {claim['unit']}" if claim["unit"] else ""
        return f"{claim['paper']:g}{unit}", f"{plain(claim['ours'])}{unit}", f"{plain(claim['lowest'])} to {plain(claim['highest'])}"
    holding = sum(bool(run["ours"]) for run in claim["runs"])
    return "states it", "holds" if claim["ours"] else "fails", f"holds in {holding} of {len(claim['runs'])} runs"


def table(data):
    lines = ["| | the paper says | the paper | ours | over the unknowns | verdict |", "|---|---|---|---|---|---|"]
    for statement in data["statements"]:
        lines.append(f"| **{statement['id']}** | | | | {page.counts(statement)} | **{statement['verdict']}** |")
        lines += ["| " + " | ".join([claim["id"], claim["says"], *shown(claim), claim["verdict"]]) + " |" for claim in statement["claims"]]
    return "\n".join(lines) + "\n"


def update(path, data):
    text = path.read_text()
    if BEGIN not in text or END not in text:
        raise ValueError(f"{path} has no markers of the table")
    head, rest = text.split(BEGIN)
    path.write_text(head + BEGIN + table(data) + END + rest.split(END, 1)[1])
