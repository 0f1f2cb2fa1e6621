"""The house: what imports what, how fast the command answers, what the wheel carries."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
import venv
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
PACKAGES = ("configs", "formation", "formation_opt", "insar", "optimize", "reports")


def python(code: str) -> str:
    """Run code in a fresh interpreter and return what it prints."""
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", code], capture_output=True, text=True, check=True
    )
    return done.stdout


@pytest.mark.parametrize(
    ("module", "absent"),
    [
        (
            "insar",
            [
                "formation",
                "optimize",
                "deap",
                "cvxpy",
                "matplotlib",
                "pandas",
                "pydantic",
                "xarray",
            ],
        ),
        ("formation", ["insar", "optimize", "deap", "scipy", "matplotlib", "pandas"]),
        ("formation_opt.cli", ["numpy", "scipy", "deap", "matplotlib", "pandas", "pydantic"]),
        ("configs", ["deap", "scipy", "optimize", "matplotlib", "pandas"]),
        ("reports", ["matplotlib", "pandas", "typst", "plotly", "deap"]),
    ],
)
def test_importing_one_package_leaves_the_others_out(module, absent):
    loaded = json.loads(
        python(f"import sys, json, {module}; print(json.dumps(sorted(sys.modules)))")
    )
    assert not set(absent) & set(loaded)


@pytest.mark.parametrize("package", PACKAGES)
def test_every_public_name_exists_and_is_documented(package):
    missing = python(
        f"import {package} as p\n"
        "names = getattr(p, '__all__', [])\n"
        "assert p.__doc__\n"
        "print([n for n in names if not getattr(p, n).__doc__])"
    )
    assert missing.strip() == "[]"
    assert (ROOT / package / "py.typed").exists()


def test_help_imports_nothing_slow_and_answers_at_once():
    start = time.perf_counter()
    done = subprocess.run(
        [sys.executable, "-m", "formation_opt", "--help"],
        capture_output=True,
        text=True,
        check=True,
    )
    elapsed = time.perf_counter() - start
    assert "exit codes" in done.stdout
    # 0.05-0.1 s when idle; the bound only catches an eager import (1.6 s) on a busy machine.
    assert elapsed < 1.5


@pytest.fixture(scope="module")
def wheel(tmp_path_factory) -> Path:
    out = tmp_path_factory.mktemp("wheel")
    subprocess.run(
        [sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", out, ROOT],
        check=True,
        capture_output=True,
    )
    return next(out.glob("*.whl"))


def test_wheel_carries_the_packages_and_their_data_and_nothing_else(wheel):
    names = zipfile.ZipFile(wheel).namelist()
    tops = {name.split("/")[0] for name in names}
    assert {top for top in tops if not top.endswith(".dist-info")} == set(PACKAGES)
    for package in PACKAGES:
        assert f"{package}/py.typed" in names
    examples = {path.name for path in (ROOT / "configs").glob("*.yaml")}
    assert {"three_sat.yaml", "li2009_space.yaml"} <= examples
    assert examples == {Path(n).name for n in names if n.startswith("configs/") and ".yaml" in n}
    assert any(name.endswith("result.schema.json") for name in names)
    assert not [name for name in names if "test" in name.lower() or name.endswith(".pyc")]


def test_wheel_works_away_from_the_checkout(wheel, tmp_path):
    """Install the wheel into a new environment that borrows the dependencies of this one."""
    home = tmp_path / "env"
    venv.create(home, with_pip=False)
    binaries = home / ("Scripts" if os.name == "nt" else "bin")
    install = [sys.executable, "-m", "pip", "--python", binaries / "python", "install"]
    subprocess.run(
        [*install, "--no-deps", "--no-index", "--quiet", wheel], check=True, capture_output=True
    )
    site = next(home.rglob("site-packages"))
    # A .pth file adds folders without reading the .pth files in them: no editable checkout.
    borrowed = [entry for entry in sys.path if "site-packages" in entry]
    (site / "borrowed.pth").write_text("\n".join(borrowed), encoding="utf-8")

    def command(*arguments):
        return subprocess.run(
            [binaries / "formation-opt", *arguments],
            cwd=tmp_path,
            env={k: v for k, v in os.environ.items() if k != "PYTHONPATH"},
            capture_output=True,
            text=True,
            check=False,
        )

    listed = command("--list")
    assert listed.returncode == 0, listed.stderr
    assert "three_sat" in listed.stdout
    ran = command("three_sat", "--format", "html", "--quiet")
    assert ran.returncode == 0, ran.stderr
    assert (tmp_path / "out" / "three_sat" / "report.html").stat().st_size > 10_000
