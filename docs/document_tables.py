"""What the scripts share that put tables into the documents."""

import argparse
import pathlib

ROOT = pathlib.Path(__file__).resolve().parents[1]


def put_between(document, begin, end, text):
    """Replaces what stands between two marks of a document."""
    before, rest = document.read_text(encoding="utf-8").split(begin)
    document.write_text(before + begin + text + end + rest.split(end)[1], encoding="utf-8")


def options(description, output, choices, document):
    """The command line of a script that runs the program for each of some choices."""
    parser = argparse.ArgumentParser(description=description.split("\n")[0])
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/release/rotordrop")
    parser.add_argument("--output", type=pathlib.Path, default=ROOT / output)
    parser.add_argument("--only", nargs="+", choices=list(choices), default=list(choices))
    parser.add_argument("--update", action="store_true", help=f"put the tables into {document.relative_to(ROOT)}")
    return parser.parse_args()
