#!/usr/bin/env python3
"""Prints the datasets of a result file as a Markdown table, from the file's own attributes.

    python3 docs/list_datasets.py out/neisi2019-settling/results.h5            # prints the table
    python3 docs/list_datasets.py out/neisi2019-settling/results.h5 --update   # puts it into docs/reference/results.md

Bearings are written as NAME, so that the table holds for every case with touchdown bearings. Needs h5py.
"""

import argparse
import pathlib
import re

import document_tables
import h5py

DOCUMENT = document_tables.ROOT / "docs/reference/results.md"
BEGIN, END = "<!-- datasets: made by docs/list_datasets.py -->\n", "<!-- end of datasets -->\n"


def shape_of(dataset):
    """What stands beside time: nothing, named columns, or one column per row or ball."""
    if dataset.ndim == 1 and not len(dataset.attrs.get("columns", [])):
        return ""
    columns = [c.decode() if isinstance(c, bytes) else str(c) for c in dataset.attrs.get("columns", [])]
    if columns and columns[0].startswith("row "):
        return "one per ball" if "ball" in columns[0] else "one per row"
    return ", ".join(columns)


def rows(file):
    """{path: (unit, shape, time axis, meaning)} with bearings called NAME."""
    bearings = sorted(file.get("bearings", {}), key=len, reverse=True)
    found = {}

    def visit(path, item):
        if not isinstance(item, h5py.Dataset) or "units" not in item.attrs:
            return
        parts = path.split("/")
        meaning = item.attrs.get("long_name", "")
        for bearing in bearings:
            parts = ["NAME" + p[len(bearing):] if p == bearing else p for p in parts]
            meaning = re.sub(rf"\b{re.escape(bearing)}\b", "NAME", meaning)
        found["/" + "/".join(parts)] = (item.attrs["units"], shape_of(item), item.attrs.get("time", ""), meaning)

    file.visititems(visit)
    return found


def table(file):
    lines = ["| dataset | unit | columns | meaning |", "|---|---|---|---|"]
    for path, (unit, shape, time, meaning) in rows(file).items():
        if time == "/detail/time":
            meaning += " (at /detail/time)"
        lines.append(f"| `{path}` | {unit} | {shape} | {meaning} |")
    return "\n".join(lines) + "\n"


def documented():
    """The table that stands in the document."""
    return DOCUMENT.read_text(encoding="utf-8").split(BEGIN)[1].split(END)[0]


def main():
    parser = argparse.ArgumentParser(description="Lists the datasets of a result file as a Markdown table.")
    parser.add_argument("file", help="results.h5 of a run")
    parser.add_argument("--update", action="store_true", help="put the table into docs/reference/results.md")
    arguments = parser.parse_args()
    with h5py.File(arguments.file, "r") as file:
        text = table(file)
    if not arguments.update:
        print(text, end="")
        return
    document_tables.put_between(DOCUMENT, BEGIN, END, text)


if __name__ == "__main__":
    main()
