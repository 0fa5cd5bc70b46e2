"""Reads validation/cases.toml into runs: what the paper varies (conditions) times what it leaves open (variants)."""

import dataclasses
import json
import tomllib

SURFACES = ("inner_race", "outer_race", "bore")  # "waviness in both races" and "in contact of rotor inner race", table 4
REFERENCE = "reference"
KINDS = ("condition", "variant", "other")
KEYS = {"says", "set", "waves", "unknown", "all", "wavy_only", "phases", "wavy_bearings", "standing"}


@dataclasses.dataclass(frozen=True)
class Case:
    """One run. `settings`: parameters by dotted name; `variant` is "reference" where nothing is changed but the condition."""

    name: str
    condition: str
    variant: str
    unknown: str
    says: str
    settings: dict

    def __hash__(self):
        return hash(self.name)


def waves(order, amplitude, phases=None, standing=False):
    """The waves of table 4 as a list for bearings.NAME.waviness."""
    surfaces = ("outer_race", "outer_race", "bore") if standing else SURFACES
    entries = []
    for surface in surfaces:
        entry = {"surface": surface, "order": order, "amplitude": amplitude}
        if phases and surface in phases:
            entry["phase"] = phases[surface]
        entries.append(entry)
    return entries


def settings_of(condition, variant):
    merged = {**condition.get("set", {}), **variant.get("set", {})}
    wave = condition.get("waves") or variant.get("waves")
    if wave:
        for bearing in variant.get("wavy_bearings", ["TB2"]):
            merged[f"bearings.{bearing}.waviness"] = waves(**wave, phases=variant.get("phases"), standing=variant.get("standing", False))
    return merged


class Plan:
    """All cases of a file; `cases` by name."""

    def __init__(self, path):
        tables = tomllib.loads(path.read_text())
        self.path, self.base = path, tables.pop("base")
        for kind, entries in tables.items():
            if kind not in KINDS:
                raise ValueError(f"{path}: unknown table [{kind}]; known: {', '.join(KINDS)}")
            for name, entry in entries.items():
                unknown = set(entry) - KEYS
                if unknown:
                    raise ValueError(f"{path}: unknown key {sorted(unknown)[0]!r} in [{kind}.{name}]; known: {', '.join(sorted(KEYS))}")
        self.conditions, self.variants, self.others = (tables.get(kind, {}) for kind in KINDS)
        if "ideal" not in self.conditions:
            raise ValueError(f"{path}: there is no [condition.ideal]")
        self.cases = {case.name: case for case in self._all()}

    def _all(self):
        for name, condition in self.conditions.items():
            yield Case(name, name, REFERENCE, "", condition["says"], settings_of(condition, {}))
        for variant_name, variant in self.variants.items():
            for name, condition in self.conditions.items():
                if name != "ideal" and not variant.get("all"):
                    continue
                if "waves" not in condition and variant.get("wavy_only"):
                    continue
                says = f"{condition['says']}; {variant['says']}"
                yield Case(f"{name}+{variant_name}", name, variant_name, variant["unknown"], says, settings_of(condition, variant))
        for name, other in self.others.items():
            yield Case(f"other-{name}", "ideal", f"other-{name}", "", other["says"], settings_of(self.conditions["ideal"], other))

    def of_condition(self, condition, variant):
        """Name of the run of a condition with a variant, or None. A variant of waves changes nothing where there are none."""
        if variant == REFERENCE:
            return condition if condition in self.cases else None
        name = f"{condition}+{variant}"
        if name in self.cases:
            return name
        if self.variants.get(variant, {}).get("wavy_only") and "waves" not in self.conditions.get(condition, {}):
            return condition if condition in self.cases else None
        return None


def toml_value(value):
    """A value as TOML, inline."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {toml_value(v)}" for key, v in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(toml_value, value)) + "]"
    return json.dumps(value)


def case_text(base, settings):
    """The parameter file of a run."""
    return "\n".join([f"base = {toml_value(str(base))}", *(f"{key} = {toml_value(value)}" for key, value in sorted(settings.items()))]) + "\n"
