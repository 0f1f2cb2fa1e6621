"""The documentation: generated tables are fresh, links resolve, examples run, keys are listed."""

from __future__ import annotations

import importlib.util
import json
import re
import subprocess
import sys
from datetime import UTC, datetime
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
import yaml

from configs import example_text, json_schema, load_study
from formation import KeplerianOrbit
from formation_opt import __version__

ROOT = Path(__file__).parent.parent
PAGES = [ROOT / "README.md", ROOT / "CHANGELOG.md", *sorted((ROOT / "docs").glob("*.md"))]
EXAMPLES = sorted((ROOT / "examples").glob("*.py"))
GENERATED = [
    "coverage.md",
    "dem_quality.md",
    "error_model.md",
    "han2016.md",
    "li2009.md",
    "liang2018.md",
    "meng2003.md",
    "missions.md",
    "orbits.md",
    "phase_statistics.md",
    "simulation.md",
    "steering.md",
    "validation.md",
    "zhao2019.md",
]


# -- generated tables ----------------------------------------------------------------------------


@pytest.fixture(scope="module")
def generator() -> ModuleType:
    spec = importlib.util.spec_from_file_location("docs_generate", ROOT / "docs" / "generate.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


NUMBER = re.compile(r"\d+(?:\.(\d+))?(?:e(-?\d+))?")


def first_difference(committed: str, fresh: str) -> str | None:
    """Where two pages differ by more than one unit of a number's last digit.

    Searches and rounding differ in the last digit between platforms; words must not.
    """
    for line, other in zip(committed.splitlines(), fresh.splitlines(), strict=False):
        if NUMBER.sub("#", line) != NUMBER.sub("#", other):
            return f"{line!r} became {other!r}"
        for one, two in zip(NUMBER.finditer(line), NUMBER.finditer(other), strict=True):
            unit = 10.0 ** (int(one[2] or 0) - len(one[1] or ""))
            if abs(float(one[0]) - float(two[0])) > 1.001 * unit:
                return f"{line!r} became {other!r}"
    lengths = len(committed.splitlines()), len(fresh.splitlines())
    return None if lengths[0] == lengths[1] else f"{lengths[0]} lines became {lengths[1]}"


def test_pages_with_tables_are_known_and_every_table_has_a_place(generator):
    assert [page.name for page in generator.pages()] == GENERATED
    text = "".join((ROOT / "docs" / name).read_text("utf-8") for name in GENERATED)
    assert sorted(re.findall(r"<!-- generated: (\w+) -->", text)) == sorted(generator.TABLES)


@pytest.mark.parametrize("name", GENERATED)
def test_tables_are_what_the_code_gives(name, generator):
    committed = (ROOT / "docs" / name).read_text("utf-8")
    difference = first_difference(committed, generator.regenerate(committed))
    assert difference is None, f"{difference}; run: python docs/generate.py"


def test_comparison_of_pages_allows_one_unit_of_the_last_digit():
    assert first_difference("a 1.23 m, -4.0e-3", "a 1.24 m, -4.1e-3") is None
    assert first_difference("a 1.23 m", "a 1.25 m") is not None
    assert first_difference("a 1.23 m", "b 1.23 m") is not None
    assert first_difference("4.0e-3", "4.2e-3") is not None
    assert first_difference("a\nb", "a") is not None


# -- links ---------------------------------------------------------------------------------------


def anchors(page: Path) -> set[str]:
    """Anchors of a page's headings, as GitHub makes them."""
    prose = re.sub(r"^```.*?^```", "", page.read_text("utf-8"), flags=re.DOTALL | re.MULTILINE)
    titles = re.findall(r"^#+ (.+)$", prose, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_relative_links_resolve(page):
    broken = []
    for target in re.findall(r"\]\(([^)\s]+)\)", page.read_text("utf-8")):
        if re.match(r"[a-z]+:", target):
            continue
        path, _, anchor = target.partition("#")
        file = (page.parent / path).resolve() if path else page
        if not file.exists() or (anchor and anchor not in anchors(file)):
            broken.append(target)
    assert not broken


# -- parts of studies ----------------------------------------------------------------------------


def snippets(page: Path) -> list[str]:
    return re.findall(r"^```yaml\n(.*?)^```", page.read_text("utf-8"), re.DOTALL | re.MULTILINE)


@pytest.mark.parametrize("name", ["observing.md", "orbits.md"])
def test_parts_of_studies_are_what_a_study_may_say(name, tmp_path):
    """Each replaces its block in an example; files that are not shipped are beside the study."""
    example = yaml.safe_load(example_text("three_sat_real"))
    inline = yaml.safe_load(snippets(ROOT / "docs" / "orbits.md")[1])
    (tmp_path / "satellite.tle").write_text(inline["orbit"]["tle"], "utf-8")
    (tmp_path / "satellite.oem").write_text(oem(), "utf-8")
    parts = snippets(ROOT / "docs" / name)
    assert len(parts) == 4
    for part in parts:
        study = tmp_path / "part.yaml"
        study.write_text(yaml.safe_dump(example | yaml.safe_load(part)), "utf-8")
        assert load_study(study).study.name == "three_sat_real"


def oem() -> str:
    """An ephemeris of 20 minutes."""
    orbit = KeplerianOrbit.circular(
        altitude=514e3, inclination=1.7, epoch=datetime(2026, 3, 1, tzinfo=UTC)
    )
    times = 60.0 * np.arange(20)
    header = {
        "OBJECT_NAME": "X",
        "OBJECT_ID": "2026-001A",
        "CENTER_NAME": "EARTH",
        "REF_FRAME": "GCRF",
        "TIME_SYSTEM": "UTC",
        "START_TIME": "2026-03-01T00:00:00",
        "STOP_TIME": "2026-03-01T00:19:00",
    }
    keys = "".join(f"{key} = {value}\n" for key, value in header.items())
    lines = "".join(
        f"2026-03-01T00:{minute:02}:00 {' '.join(f'{value:.9f}' for value in row)}\n"
        for minute, row in enumerate(np.hstack(orbit.inertial(times)) / 1e3)
    )
    return f"CCSDS_OEM_VERS = 2.0\nMETA_START\n{keys}META_STOP\n{lines}"


# -- examples ------------------------------------------------------------------------------------


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda example: example.name)
def test_example_runs(example, tmp_path):
    done = subprocess.run(
        [sys.executable, "-W", "error", example],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip()
    assert not list(tmp_path.iterdir())
    # Short enough to read at one go.
    assert len(example.read_text("utf-8").splitlines()) < 60


def test_example_finds_the_two_optima_of_two_images():
    """Closed form 2/3 with spectral filtering; 0.42 without, at 10 dB."""
    script = ROOT / "examples" / "two_image_optimum.py"
    done = subprocess.run([sys.executable, script], capture_output=True, text=True, check=True)
    best = [float(value) for value in re.findall(r"best at ([\d.]+)", done.stdout)]
    assert best == pytest.approx([2 / 3, 0.42], abs=2e-3)  # the grid's step is 0.001


# -- notation ------------------------------------------------------------------------------------


def is_number(schema: dict[str, Any], definitions: dict[str, Any]) -> bool:
    """Whether a value of this schema is a number or holds numbers."""
    if "$ref" in schema:
        name = schema["$ref"].rsplit("/", 1)[1]
        own = definitions[name]
        return own.get("type") != "object" and is_number(own, definitions)
    kinds = schema.get("type", [])
    if {"number", "integer"} & {kinds if isinstance(kinds, str) else None, *kinds}:
        return True
    inner = [schema[key] for key in ("items", "additionalProperties") if key in schema]
    inner += [s for key in ("anyOf", "oneOf", "allOf", "prefixItems") for s in schema.get(key, [])]
    return any(isinstance(s, dict) and is_number(s, definitions) for s in inner)


def numeric_keys(schema: Any, definitions: dict[str, Any]) -> set[str]:
    """Names of all properties of a schema that hold numbers."""
    if isinstance(schema, list):
        return set().union(*(numeric_keys(item, definitions) for item in schema), set())
    if not isinstance(schema, dict):
        return set()
    found = {
        key
        for key, value in schema.get("properties", {}).items()
        if isinstance(value, dict) and is_number(value, definitions)
    }
    return found.union(*(numeric_keys(value, definitions) for value in schema.values()))


def result_schema() -> dict[str, Any]:
    text = (ROOT / "reports" / "result.schema.json").read_text("utf-8")
    return json.loads(text)


@pytest.mark.parametrize("schema", [json_schema, result_schema])
def test_every_numeric_key_has_its_unit_or_is_listed(schema):
    notation = (ROOT / "docs" / "notation.md").read_text("utf-8")
    keys = notation[notation.index("## Keys of studies") :]
    listed = set(re.findall(r"`(\w+)`", keys))
    suffixes = tuple(name for name in listed if name.startswith("_"))
    data = schema()
    numeric = numeric_keys(data, data["$defs"])
    assert len(numeric) > 20
    assert not {key for key in numeric if not key.endswith(suffixes) and key not in listed}


# -- citation ------------------------------------------------------------------------------------


def test_citation_is_of_this_version():
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text("utf-8"))
    assert citation["cff-version"] == "1.2.0"
    assert citation["version"] == __version__
    changes = (ROOT / "CHANGELOG.md").read_text("utf-8")
    assert f"## [{__version__}] - {citation['date-released']}" in changes
