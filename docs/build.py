#!/usr/bin/env python3
"""Builds the documents as HTML pages that need no network, with search, for screen and paper.

    python3 docs/build.py [--program build/release/rotordrop] [--output build/html]

The pages are docs/**/*.md and a few others, in the order of PAGES. Two are not written by hand: the reference of all parameters comes from the declarations in
the program (`rotordrop schema`), that of the commands from `rotordrop COMMAND --help`. `cmake --build build/release --target docs` does the same.
Ends with exit code 1 if a link or an anchor leads nowhere, or a document is missing in PAGES.

Needs python3-markdown (Debian).
"""

import argparse
import html
import json
import pathlib
import re
import shutil
import subprocess
import sys

try:
    import markdown
    from markdown.extensions.toc import TocExtension
except ImportError as error:
    sys.exit(f"error: {error}. Install python3-markdown, or try /usr/bin/python3 (this is {sys.executable}).")

ROOT = pathlib.Path(__file__).resolve().parents[1]
# Source (a path from ROOT, or what makes the page), and name of the page.
PAGES = [
    ("Start", [("docs/README.md", "index"), ("README.md", "readme"), ("docs/tutorials/own-machine.md", "own-machine"), ("docs/tutorials/guide.md", "guide"), ("examples/README.md", "examples"), ("examples/notebooks/README.md", "notebooks")]),
    ("How to", [("docs/how-to/parameters.md", "parameters"), ("docs/how-to/report.md", "report"), ("docs/how-to/limits.md", "limits"), ("docs/how-to/second-opinion.md", "second-opinion"), ("docs/how-to/compare.md", "compare"), ("docs/how-to/fields.md", "fields"),
                ("docs/how-to/statics.md", "statics"), ("docs/how-to/critical-speeds.md", "critical-speeds"), ("docs/how-to/supports.md", "supports"), ("docs/how-to/preload.md", "preload"), ("docs/how-to/coast-down.md", "coast-down"), ("docs/how-to/finite-elements.md", "finite-elements"),
                ("docs/how-to/studies.md", "studies"), ("docs/how-to/python.md", "python"), ("docs/how-to/heat.md", "heat"), ("docs/how-to/mesh.md", "mesh"), ("docs/how-to/extending.md", "extending"), ("CONTRIBUTING.md", "contributing")]),
    ("Theory", [("docs/theory/model.md", "model"), ("docs/theory/growth.md", "growth"), ("docs/theory/ring-bending.md", "ring-bending"), ("docs/theory/verification.md", "verification"), ("docs/theory/validation.md", "validation"),
                ("docs/theory/convergence.md", "convergence")]),
    ("Reference", [("COMMANDS", "commands"), ("PARAMETERS", "parameter-reference"), ("PARAMETERS OF HEAT", "heat-parameter-reference"), ("PARAMETERS OF STUDIES", "study-parameter-reference"), ("docs/reference/results.md", "results"), ("docs/reference/warnings.md", "warnings"), ("docs/performance.md", "performance"),
                   ("params/bearings/README.md", "bearings"), ("docs/reference/reliability.md", "reliability"), ("docs/reference/source-layout.md", "source-layout"), ("CHANGELOG.md", "changelog")]),
]


def slug(title, separator="-"):
    """Anchors as code hosts make them from headings."""
    return re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", separator)


# ------------------------------------------------------------------------------------------------------ pages from the program


def call(program, *arguments):
    return subprocess.run([program, *arguments], check=True, capture_output=True, text=True).stdout


def commands(program):
    """Names of the commands with a sentence each, from `rotordrop --help`."""
    lines = call(program, "--help").split("Subcommands:")[1].splitlines()
    found = []
    for line in lines:
        if match := re.match(r"  (\S+)\s+(.*)", line):
            found.append([match[1], match[2]])
        elif found and line.strip():
            found[-1][1] += " " + line.strip()
    return found


def commands_page(program):
    """Every command as the program explains it."""
    made = ["# Commands\n", "The output of `rotordrop COMMAND --help`. Exit codes: 0 success, 1 run failed, 2 bad input (nothing was overwritten), 3 a limit is not met (`run --accept`) or bits differ (`rerun`), 130 interrupted with Ctrl-C 143 by SIGTERM and 129 when its terminal is closed, all with a checkpoint.\n"]
    for name, sentence in commands(program):
        made.append(f"## {name}\n\n{sentence}\n\n```text\n{call(program, name, '--help').strip()}\n```\n")
    return "\n".join(made)


def described(schema):
    """(help, unit and range, source) of a description such as "Help.  [a length, > 0]  Required.  Source: table 3"."""
    text, source = (schema.get("description", "").split("  Source: ") + [""])[:2]
    kind = re.search(r"\s*\[([^\[\]]*(?:\[[^\[\]]*\][^\[\]]*)*)\](  Required\.)?$", text)
    if not kind:
        return text, "", source
    return text[: kind.start()].strip(), kind[1] + ("; required" if kind[2] else ""), source


def value_text(value):
    return json.dumps(value, ensure_ascii=False) if not isinstance(value, str) else value


class Reference:
    """Tables of all keys, section by section, out of the JSON Schema."""

    def __init__(self):
        self.sections = []

    def section(self, path, schema, note="", kind=""):
        rows, below = [], []
        for key, one in schema["properties"].items():
            full = f"{path}.{key}" if path else key
            if one.get("type") == "object" and "properties" in one:
                if isinstance(one.get("additionalProperties"), dict):
                    below.append((self.variants, full, one))
                else:
                    below.append((self.section, full, one))
            elif one.get("type") == "object":
                below.append((self.named, full, one))
            elif one.get("type") == "array" and one.get("items", {}).get("properties"):
                below.append((self.items, full, one))
            else:
                rows.append(self.row(full, key, one))
        self.table(path, schema.get("description", ""), note, rows, kind)
        for make, full, one in below:
            make(full, one)

    def row(self, full, key, one):
        text, kind, source = described(one)
        default = f"<code>{html.escape(value_text(one['default']))}</code>" if "default" in one else ("a word" if one.get("const") else "—")
        if "enum" in one:
            kind = " or ".join(f"“{word}”" for word in one["enum"]) + ("; required" if "required" in kind else "")
        if "const" in one:
            text, default = f"selects this kind of table: “{one['const']}”", ""
        source = f'<div class="source">Source: {html.escape(source)}</div>' if source else ""
        return f'<tr id="{full}"><td><code>{key}</code></td><td>{default}</td><td>{html.escape(kind)}</td><td>{html.escape(text)}{source}</td></tr>'

    def table(self, path, text, note, rows, kind=""):
        head = f"[{path}]{kind}" if path else "At the top of the file"
        body = "<table><thead><tr><th>key</th><th>default</th><th>unit, range</th><th>what it does</th></tr></thead><tbody>" + "".join(rows) + "</tbody></table>" if rows else ""
        self.sections.append((head, f"<p>{html.escape(text)}{' ' + note if note else ''}</p>\n\n{body}\n", path))

    def variants(self, path, schema):
        self.table(path, schema.get("description", ""), "", [])
        for kind in schema["additionalProperties"]["anyOf"]:
            tag, value = next((key, one["const"]) for key, one in kind["properties"].items() if "const" in one)
            self.section(f"{path}.NAME", kind, kind=f" with {tag} = “{value}”")

    def named(self, path, schema):
        inner = schema.get("additionalProperties")
        if isinstance(inner, dict) and "properties" in inner:
            self.table(path, schema.get("description", ""), "Named tables.", [])
            self.section(f"{path}.NAME", inner)
        else:
            self.table(path, schema.get("description", ""), "", [])

    def items(self, path, schema):
        self.section(path, {"description": schema.get("description", ""), "properties": schema["items"]["properties"]}, "A list: one table [[…]] for each.")


KINDS = {
    "": ("Parameter reference", "a case of a drop ([parameters.md](how-to/parameters.md))"),
    " --heat": ("Parameters of a heat-only case", "a heat-only case ([heat.md](how-to/heat.md))"),
    " --study": ("Parameters of studies", "a study file ([studies.md](how-to/studies.md))"),
}


def parameters_page(program, flag):
    reference = Reference()
    title, of = KINDS[flag]
    reference.section("", json.loads(call(program, "schema", *flag.split())))
    made = [f"# {title}\n", f"Every key of {of}, from the declarations in the program; `rotordrop defaults{flag}` prints the same as a commented file. Quantities are texts with a unit, or numbers in SI. A dash: no default.\n"]
    anchors = set()
    for head, body, path in reference.sections:
        body = re.sub(r'<tr id="([^"]+)">', lambda m: m[0] if not (m[1] in anchors or anchors.add(m[1])) else "<tr>", body)  # two kinds of table may share a key
        made.append(f"## {head}\n" + (f'\n<a id="{path}"></a>\n' if path and path not in anchors else "") + f"\n{body}")
        anchors.add(path)
    return "\n".join(made)


# --------------------------------------------------------------------------------------------------------------------- HTML


def prepared(text):
    """What code hosts read and the Markdown library does not: lists and tables right behind a paragraph."""
    lines, made, in_code = text.splitlines(), [], False
    for line in lines:
        if line.lstrip().startswith("```"):
            in_code = not in_code
        starts = re.match(r"([-*]|\d+\.) ", line) or line.startswith("|")
        before = made[-1] if made else ""
        if not in_code and starts and before.strip() and not re.match(r"([-*]|\d+\.|\||  )", before):
            made.append("")
        made.append(line)
    return "\n".join(made)


class Page:
    def __init__(self, group, name, source, text):
        self.group, self.name, self.source = group, name, source
        reader = markdown.Markdown(extensions=["tables", "fenced_code", "sane_lists", TocExtension(slugify=slug, toc_depth="2-3")])
        self.body = reader.convert(prepared(text))
        self.body = re.sub(r"<code>([^<]*)</code>", lambda m: "<code>" + m[1].replace("\\|", "|") + "</code>", self.body)
        self.body = re.sub(r"(<table>.*?</table>)", r'<div class="table">\1</div>', self.body, flags=re.S)
        self.sections = reader.toc_tokens
        self.label = "Read me" if source == "README.md" else None
        self.title = re.sub(r"<[^>]+>", "", re.search(r"<h1[^>]*>(.*?)</h1>", self.body)[1])
        self.anchors = set(re.findall(r'\bid="([^"]+)"', self.body))

    @property
    def folder(self):
        return (ROOT / self.source).parent if self.source else ROOT / "docs"


def linked(page, pages, output, faults):
    """Links to documents become links to pages; pictures are copied; other files of the sources are named, not linked."""
    by_source = {str((ROOT / p.source).resolve()): p for p in pages if p.source}

    def anchor(target, fragment, href):
        if fragment and fragment not in target.anchors:
            faults.append(f"{page.source or page.name}: {href}: no such heading")
        return f'href="{target.name}.html{"#" + fragment if fragment else ""}"'

    def link(match):
        href = html.unescape(match[1])
        path, _, fragment = href.partition("#")
        if not path:
            return anchor(page, fragment, href)
        if re.match(r"[a-z]+:", path):
            return match[0]
        if path.endswith(".html") and any(p.name + ".html" == path for p in pages):
            return anchor(next(p for p in pages if p.name + ".html" == path), fragment, href)
        target = (page.folder / path).resolve()
        if str(target) in by_source:
            return anchor(by_source[str(target)], fragment, href)
        if target.is_file() and target.is_relative_to(ROOT):
            copy = output / "files" / target.relative_to(ROOT)
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(target, copy)
            return f'href="files/{target.relative_to(ROOT)}"'
        faults.append(f"{page.source or page.name}: {href}: no such file")
        return match[0]

    def picture(match):
        target = (page.folder / match[1]).resolve()
        if not target.is_file():
            faults.append(f"{page.source}: {match[1]}: no such picture")
            return match[0]
        (output / "images").mkdir(exist_ok=True)
        shutil.copyfile(target, output / "images" / target.name)
        return f'src="images/{target.name}"'

    return re.sub(r'src="([^"]+)"', picture, re.sub(r'href="([^"]+)"', link, page.body))


def plain(text):
    return html.unescape(re.sub(r"\s+", " ", re.sub(r"<[^>]+>", " ", text))).strip()


def search_index(pages):
    """[page, anchor, heading, text] for each part under a heading, and for each parameter."""
    index = []
    for page in pages:
        for part in re.split(r"(?=<h[123][ >])", page.body):
            head = re.match(r'<h[123](?: id="([^"]*)")?>(.*?)</h[123]>', part, re.S)
            if not head:
                continue
            index.append([page.name, head[1] or "", f"{page.title}" if part.startswith("<h1") else f"{page.title}: {plain(head[2])}", plain(part[head.end():])])
        for row in re.finditer(r'<tr id="([^"]+)">(.*?)</tr>', page.body, re.S):
            index.append([page.name, row[1], row[1], plain(row[2])])
    return index


def navigation(page, pages):
    made = []
    for group, _ in PAGES:
        made.append(f"<h2>{group}</h2><ul>")
        for other in (p for p in pages if p.group == group):
            inside = ""
            if other is page:
                inside = "<ul>" + "".join(f'<li><a href="#{s["id"]}">{s["name"]}</a></li>' for s in page.sections) + "</ul>"
            made.append(f'<li><a href="{other.name}.html"{" class=here" if other is page else ""}>{html.escape(other.label or other.title)}</a>{inside}</li>')
        made.append("</ul>")
    return "".join(made)


def build(program, output):
    makers = {"COMMANDS": lambda: commands_page(program), "PARAMETERS": lambda: parameters_page(program, ""), "PARAMETERS OF HEAT": lambda: parameters_page(program, " --heat"),
              "PARAMETERS OF STUDIES": lambda: parameters_page(program, " --study")}
    pages, faults = [], []
    for group, listed in PAGES:
        for source, name in listed:
            text = makers[source]() if source in makers else (ROOT / source).read_text(encoding="utf-8")
            pages.append(Page(group, name, None if source in makers else source, text))
    known = {page.source for page in pages}
    documents = [file.relative_to(ROOT).as_posix() for file in sorted((ROOT / "docs").rglob("*.md"))]
    faults += [f"{name} is in no group of PAGES" for name in documents if name not in known]
    index = (ROOT / "docs/README.md").read_text(encoding="utf-8")
    faults += [f"docs/README.md has no link to {name}" for name in documents if name != "docs/README.md" and f"]({name.removeprefix('docs/')})" not in index]

    if output.exists():
        shutil.rmtree(output)
    output.mkdir(parents=True)
    version = call(program, "--version").splitlines()[0]
    template = (ROOT / "docs/site/page.html").read_text(encoding="utf-8")
    for page in pages:
        values = {"TITLE": html.escape(page.title), "NAVIGATION": navigation(page, pages), "BODY": linked(page, pages, output, faults), "VERSION": html.escape(version)}
        text = re.sub(r"@([A-Z]+)@", lambda m: values.get(m[1], m[0]), template)
        (output / f"{page.name}.html").write_text(text, encoding="utf-8")
    for name in ("site.css", "site.js"):
        shutil.copyfile(ROOT / "docs/site" / name, output / name)
    index = json.dumps(search_index(pages), ensure_ascii=False, separators=(",", ":"))
    (output / "search.js").write_text(f"window.SEARCH = {index};\n", encoding="utf-8")
    return pages, faults


def main():
    parser = argparse.ArgumentParser(description="Builds the documents as HTML pages.")
    parser.add_argument("--program", default=str(ROOT / "build/release/rotordrop"), help="built program; default build/release/rotordrop")
    parser.add_argument("--output", type=pathlib.Path, default=ROOT / "build/html", help="folder, replaced; default build/html")
    arguments = parser.parse_args()
    if arguments.output.exists() and not (arguments.output / "search.js").exists() and any(arguments.output.iterdir()):
        print(f"error: {arguments.output} holds something else. Choose another folder.", file=sys.stderr)
        return 2
    pages, faults = build(arguments.program, arguments.output)
    for fault in faults:
        print(f"error: {fault}", file=sys.stderr)
    print(f"{len(pages)} pages: {arguments.output}/index.html")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
