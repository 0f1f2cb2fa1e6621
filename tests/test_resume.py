"""A search that is killed and resumed ends as if nothing had been."""

from __future__ import annotations

import json
import os
import random
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

from formation_opt.checkpoint import Checkpoint, CheckpointError, Identity
from formation_opt.cli import main

STUDY = """\
kind: optimize
name: quick
orbit: {altitude_km: 514, inclination_deg: 97.44}
radar: {wavelength_m: 0.031, slant_range_resolution_m: 3, looks: 16, snr_db: 10,
        images: one_transmitter}
scene:
  strip: {look_deg: 23, side: left, duration_s: 10, segments: 3}
errors: {position_m: 0.001, range_m: 0.01}
formation: {satellites: 3, cross_track_sign: either}
constraints: {min_separation_m: 100, unwrapping: {prior_height_std_m: 4}}
search: {population: 20, generations: 30, seed: 1, refinements: 4}
refutation: null
"""


@pytest.fixture
def study(tmp_path):
    path = tmp_path / "quick.yaml"
    path.write_text(STUDY, encoding="utf-8")
    return path


def result(folder):
    document = json.loads((folder / "result.json").read_text(encoding="utf-8"))
    del document["provenance"]["started"], document["provenance"]["wall_s"]
    return document


def run(study, out, *more):
    return main([str(study), "--out", str(out), "--quiet", "--format", "none", *more])


@pytest.fixture
def undisturbed(study, tmp_path):
    assert run(study, tmp_path / "whole") == 0
    return result(tmp_path / "whole")


class _Killed(BaseException):
    """Stands for SIGKILL: nothing in the program catches it."""


@pytest.mark.parametrize(
    ("step", "torn"),
    [
        (1, "before the journal"),
        (1, "between the files"),
        (17, "within it"),
        (17, "between the files"),
        (31, "before the journal"),
        (32, "between the files"),
        (35, "within it"),
    ],
)
def test_killed_at_any_step_the_result_is_the_same(
    step, torn, study, undisturbed, tmp_path, monkeypatch
):
    out, original, kept = tmp_path / "out", Checkpoint.keep, []

    def keep(self, *arguments):
        kept.append(arguments)
        if len(kept) < step:
            return original(self, *arguments)
        if torn == "within it":
            with self._journal.open("ab") as file:
                file.write(b'{"evaluations": 20, "candi')
        if torn == "between the files":
            before = self._snapshot.read_bytes() if self._snapshot.exists() else None
            original(self, *arguments)
            self._snapshot.unlink()
            if before is not None:
                self._snapshot.write_bytes(before)
        raise _Killed

    with monkeypatch.context() as patch:
        patch.setattr(Checkpoint, "keep", keep)
        with pytest.raises(_Killed):
            run(study, out)
    assert run(study, out, "--resume") == 0
    assert result(out) == undisturbed
    assert [path.name for path in out.iterdir() if "checkpoint" in path.name] == []


@pytest.mark.skipif(os.name == "nt", reason="POSIX signals")
def test_sigkill_at_random_moments(study, tmp_path):
    text = STUDY.replace("generations: 30", "generations: 150")
    study.write_text(text, encoding="utf-8")
    out, source, kills = tmp_path / "out", random.Random(3), 0
    command = [sys.executable, "-m", "formation_opt", str(study), "--format", "none", "--quiet"]
    # Each in a process of its own: BLAS here runs with more threads than in the command.
    subprocess.run([*command, "--out", str(tmp_path / "whole")], check=True)
    command += ["--resume", "--out", str(out)]
    for _ in range(4):
        process = subprocess.Popen(command)
        began = time.monotonic()
        while not (out / "checkpoint.json").exists() and process.poll() is None:
            time.sleep(0.01)
            assert time.monotonic() < began + 60
        time.sleep(source.uniform(0.0, 0.6))
        process.send_signal(signal.SIGKILL)
        process.wait()
        kills += process.returncode == -signal.SIGKILL
        if process.returncode == 0:
            break
    assert kills >= 1
    subprocess.run(command, check=True)
    assert result(out) == result(tmp_path / "whole")


def unfinished(study, out, monkeypatch, *more):
    original, kept = Checkpoint.keep, []

    def keep(self, *arguments):
        if len(kept) == 5:
            raise _Killed
        kept.append(arguments)
        original(self, *arguments)

    with monkeypatch.context() as patch:
        patch.setattr(Checkpoint, "keep", keep)
        with pytest.raises(_Killed):
            run(study, out, *more)


def test_a_changed_study_is_refused_with_the_difference(study, tmp_path, monkeypatch, capsys):
    out = tmp_path / "out"
    unfinished(study, out, monkeypatch)
    before = (out / "checkpoint.json").read_bytes()
    study.write_text(STUDY.replace("looks: 16", "looks: 17"), encoding="utf-8")
    assert run(study, out, "--resume") == 2
    message = capsys.readouterr().err
    assert "another study" in message
    assert "-radar.looks: 16" in message
    assert "+radar.looks: 17" in message
    assert (out / "checkpoint.json").read_bytes() == before  # it can still be gone on with
    study.write_text(f"# a remark changes nothing\n{STUDY}", encoding="utf-8")
    assert run(study, out, "--resume", "--seed", "2") == 2
    assert "+seed: 2" in capsys.readouterr().err
    assert run(study, out, "--resume") == 0


def test_a_search_in_compiled_loops_is_not_gone_on_with_in_arrays(
    study, tmp_path, monkeypatch, capsys
):
    pytest.importorskip("numba")
    study.write_text(STUDY.replace("generations: 30", "generations: 100"), encoding="utf-8")
    out = tmp_path / "out"
    unfinished(study, out, monkeypatch)
    with monkeypatch.context() as without:
        without.setitem(sys.modules, "optimize.kernel.score", None)  # its import fails
        without.delattr("optimize.kernel.score")
        assert run(study, out, "--resume") == 2
    message = capsys.readouterr().err
    assert "-formations scored by: compiled loops" in message
    assert "+formations scored by: arrays" in message
    assert run(study, out, "--resume") == 0


def test_without_resume_a_run_starts_anew_and_says_so(
    study, undisturbed, tmp_path, monkeypatch, capsys
):
    out = tmp_path / "out"
    unfinished(study, out, monkeypatch)
    assert main([str(study), "--out", str(out), "--format", "none"]) == 0
    assert "--resume would have gone on" in capsys.readouterr().out
    assert result(out) == undisturbed
    assert main([str(study), "--out", str(out), "--format", "none", "--resume"]) == 0
    assert "holds no unfinished search" in capsys.readouterr().out
    assert result(out) == undisturbed


@pytest.mark.parametrize("damage", [b"", b"{", b"[]", b'{"format": 9}', b'{"format": 1}'])
def test_a_damaged_checkpoint_is_one_message(damage, study, tmp_path, monkeypatch, capsys):
    out = tmp_path / "out"
    unfinished(study, out, monkeypatch)
    (out / "checkpoint.json").write_bytes(damage)
    assert run(study, out, "--resume") == 2
    error = capsys.readouterr().err
    assert "cannot be gone on with" in error
    assert "without --resume" in error


def test_a_journal_that_lost_its_end_is_refused(study, tmp_path, monkeypatch, capsys):
    out = tmp_path / "out"
    unfinished(study, out, monkeypatch)
    journal = (out / "checkpoint.jsonl").read_bytes()
    (out / "checkpoint.jsonl").write_bytes(journal[:-1])
    assert run(study, out, "--resume") == 2
    assert "shorter than it says" in capsys.readouterr().err


def test_other_kinds_have_nothing_to_resume(tmp_path, capsys):
    assert main(["evaluate_example", "--out", str(tmp_path / "o"), "--resume"]) == 2
    assert "kind evaluate has none" in capsys.readouterr().err
    assert not (tmp_path / "o").exists()


@pytest.mark.skipif(os.name == "nt", reason="POSIX signals")
def test_after_ctrl_c_resume_goes_on_to_the_undisturbed_result(study, tmp_path):
    study.write_text(STUDY.replace("generations: 30", "generations: 150"), encoding="utf-8")
    out = tmp_path / "out"
    command = [sys.executable, "-m", "formation_opt", str(study), "--format", "none", "--quiet"]
    subprocess.run([*command, "--out", str(tmp_path / "whole")], check=True)
    command += ["--out", str(out)]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    while not (out / "checkpoint.json").exists():
        time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    _, error = process.communicate(timeout=60)
    assert process.returncode == 130
    assert "--resume goes on" in error
    assert (out / "result.json").exists()
    subprocess.run([*command, "--resume"], check=True)
    assert result(out) == result(tmp_path / "whole")


def test_a_checkpoint_keeps_every_bit(tmp_path):
    identity = Identity({"a": 1}, 1, {}, {}, compiled=False)
    first = Checkpoint(tmp_path, identity, resume=True)
    rng = np.random.default_rng(0)
    values = [*(rng.normal(size=50) * 10.0 ** rng.integers(-300, 300, 50)).tolist(), float("inf")]
    first.keep({"values": values}, {"state": values})
    first.keep({"values": [5e-324, -0.0]}, None)
    steps, state = Checkpoint(tmp_path, identity, resume=True).restore()
    assert [value.hex() for value in steps[0]["values"]] == [value.hex() for value in values]
    assert [value.hex() for value in steps[1]["values"]] == ["0x0.0000000000001p-1022", "-0x0.0p+0"]
    assert state == {"state": values}
    with pytest.raises(CheckpointError, match="version of numpy"):
        Checkpoint(tmp_path, identity._replace(packages={"numpy": "2"}), resume=True)
