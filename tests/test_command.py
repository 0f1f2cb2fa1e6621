"""The command, as a user meets it: exit codes, messages, files."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from formation_opt import one_place
from formation_opt.cli import main

QUICK = """\
kind: optimize
name: quick
orbit: {altitude_km: 514, inclination_deg: 97.44}
radar: {wavelength_m: 0.031, slant_range_resolution_m: 3, looks: 16, snr_db: 10,
        images: one_transmitter}
scene:
  strip: {look_deg: 23, side: left, duration_s: 10, segments: 3}
errors: {position_m: 0.001, range_m: 0.01}
formation: {satellites: 3}
constraints: {min_separation_m: 100, unwrapping: {prior_height_std_m: 4}}
search: {population: 20, generations: 10, seed: 1, refinements: 2}
"""


@pytest.fixture
def study(tmp_path):
    def write(text=QUICK, name="quick.yaml"):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return str(path)

    return write


def test_a_study_from_end_to_end(study, tmp_path, capsys):
    out = tmp_path / "results"
    assert main([study(), "--out", str(out)]) == 0
    printed = capsys.readouterr()
    assert "height error, total" in printed.out
    assert "report.html, report.pdf" in printed.out.replace("\n", "")
    assert printed.err == ""  # no progress bar where the output is no terminal
    assert sorted(path.name for path in out.iterdir()) == [
        "formation.csv",
        "height_error.csv",
        "report.html",
        "report.pdf",
        "result.json",
    ]
    result = json.loads((out / "result.json").read_text(encoding="utf-8"))
    assert result["study"]["name"] == "quick"
    assert result["best"]["feasible"] is True
    assert result["provenance"]["seed"] == 1


def test_same_seed_same_result_but_for_provenance(study, tmp_path):
    def result(seed, folder):
        arguments = [study(), "--out", str(tmp_path / folder), "--seed", seed, "--quiet"]
        assert main([*arguments, "--format", "none"]) == 0
        document = json.loads((tmp_path / folder / "result.json").read_text(encoding="utf-8"))
        provenance = document.pop("provenance")
        assert provenance["seed"] == int(seed)
        return document

    first, second, other = result("7", "a"), result("7", "b"), result("8", "c")
    assert first == second
    assert first != other


def test_quiet_prints_nothing(study, tmp_path, capsys):
    assert main([study(), "--out", str(tmp_path / "o"), "--quiet", "--format", "none"]) == 0
    assert capsys.readouterr() == ("", "")


def test_default_output_folder_is_named_after_the_study(study, tmp_path, monkeypatch):
    path = study()
    monkeypatch.chdir(tmp_path)
    assert main([path, "--quiet", "--format", "none"]) == 0
    assert (tmp_path / "out" / "quick" / "result.json").exists()


def test_check_only_checks(study, tmp_path, monkeypatch, capsys):
    path = study()
    monkeypatch.chdir(tmp_path)
    assert main([path, "--check"]) == 0
    assert "valid study of kind optimize" in capsys.readouterr().out
    assert not (tmp_path / "out").exists()


def test_no_feasible_design_is_exit_3_with_a_report(study, tmp_path, capsys):
    tight = QUICK.replace("min_separation_m: 100", "min_separation_m: 100, max_radius_m: 40")
    tight = tight.replace(", unwrapping: {prior_height_std_m: 4}", "")
    out = tmp_path / "o"
    assert main([study(tight), "--out", str(out)]) == 3
    printed, error = capsys.readouterr()
    assert "none, proven" in printed  # and no lower bound, as if there were formations above it
    assert "no formation is below" not in printed
    assert "no feasible design was found" in error
    assert "separation of each pair at all times" in error
    assert "against a limit of 100 m" in error
    assert "allow a smaller separation" in error
    assert (out / "report.pdf").exists()
    result = json.loads((out / "result.json").read_text(encoding="utf-8"))
    assert result["best"]["feasible"] is False
    assert "missed by" in result["warnings"][0]


@pytest.mark.parametrize(
    ("change", "fragments"),
    [
        (("altitude_km: 514", "altitude_km: 514000"), ["quick.yaml:3", "orbit.altitude_km"]),
        (("snr_db: 10", "snr_db: .nan"), ["radar.snr_db"]),
        (("snr_db: 10", "snr_bd: 10"), ["radar.snr_bd", "snr_db"]),
        (("looks: 16", "looks: [16]"), ["radar.looks"]),
    ],
)
def test_wrong_input_is_exit_2_with_one_message(change, fragments, study, tmp_path, capsys):
    out = tmp_path / "o"
    assert main([study(QUICK.replace(*change)), "--out", str(out)]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    for fragment in fragments:
        assert fragment in printed.err
    assert "Traceback" not in printed.err
    assert not out.exists()


def test_missing_file_suggests_the_shipped_example(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["configs/three_sat.yaml"]) == 2
    assert "formation-opt three_sat" in capsys.readouterr().err
    assert main(["thre_sat"]) == 2
    assert "three_sat" in capsys.readouterr().err


def test_no_study_is_exit_2(capsys):
    assert main([]) == 2
    assert "give a study" in capsys.readouterr().err


def test_a_file_without_an_ending_is_recognized(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine").write_text(QUICK, encoding="utf-8")
    assert main(["mine", "--check"]) == 2
    assert "write ./mine" in capsys.readouterr().err
    assert main(["./mine", "--check"]) == 0


@pytest.mark.parametrize(
    "option",
    [
        ["--out", ""],
        ["--seed", str(2**32)],
        ["--seed", "-1"],
        ["--seed", "1.5"],
        ["--format", "docx"],
    ],
)
def test_wrong_options_are_exit_2(option, study):
    with pytest.raises(SystemExit) as stop:
        main([study(), *option])
    assert stop.value.code == 2


@pytest.mark.parametrize("place", ["file", "file/below"])
def test_an_output_folder_that_cannot_be_written(place, study, tmp_path, capsys):
    (tmp_path / "file").write_text("in the way")
    assert main([study(), "--out", str(tmp_path / place)]) == 2
    error = capsys.readouterr().err
    assert "cannot be written" in error
    assert "--out" in error
    assert (tmp_path / "file").read_text() == "in the way"


@pytest.mark.skipif(os.name == "nt" or os.geteuid() == 0, reason="root may write everywhere")
def test_a_read_only_output_folder(study, tmp_path, capsys):
    locked = tmp_path / "locked"
    locked.mkdir(mode=0o500)
    assert main([study(), "--out", str(locked)]) == 2
    assert "Permission denied" in capsys.readouterr().err


def test_new_prints_a_study_that_runs(study, tmp_path, capsys):
    assert main(["--new", "evaluate_example"]) == 0
    text = capsys.readouterr().out
    assert main([study(text), "--check"]) == 0
    assert main(["--new", "nothing"]) == 2


def test_list_and_schema(capsys):
    assert main(["--list"]) == 0
    listed = capsys.readouterr().out
    for name in (
        "three_sat",
        "four_sat",
        "li2009_space",
        "li2009_ground_track",
        "evaluate_example",
    ):
        assert name in listed
    assert main(["--schema"]) == 0
    assert json.loads(capsys.readouterr().out)


def test_same_bytes_with_any_number_of_blas_threads(study, tmp_path):
    documents = []
    for threads in ("1", "2"):
        out = tmp_path / threads
        subprocess.run(
            [sys.executable, "-m", "formation_opt", study(), "--out", out, "--format", "none"],
            env={**os.environ, "OPENBLAS_NUM_THREADS": threads, "OMP_NUM_THREADS": threads},
            check=True,
            capture_output=True,
        )
        document = json.loads((out / "result.json").read_text(encoding="utf-8"))
        del document["provenance"]
        documents.append(document)
    assert documents[0] == documents[1]


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs /dev/full")
@pytest.mark.parametrize("arguments", [["--list"], ["--schema"], ["STUDY"]])
@pytest.mark.parametrize("sink", ["full", "closed"])
def test_a_failing_standard_output_changes_no_exit_code(arguments, sink, study, tmp_path):
    arguments = [study() if a == "STUDY" else a for a in arguments]
    command = [sys.executable, "-m", "formation_opt", *arguments, "--format", "none"]
    command += ["--out", str(tmp_path / "o")]
    environment = {**os.environ, "PYTHONIOENCODING": "ascii"}
    if sink == "full":
        with Path("/dev/full").open("w") as full:
            done = subprocess.run(
                command, stdout=full, stderr=subprocess.PIPE, env=environment, check=False
            )
    else:
        reader, writer = os.pipe()
        os.close(reader)
        done = subprocess.run(
            command, stdout=writer, stderr=subprocess.PIPE, env=environment, check=False
        )
        os.close(writer)
    assert done.returncode == 0
    assert b"Traceback" not in done.stderr
    assert (b"standard output cannot be written" in done.stderr) == (sink == "full")


def test_a_report_of_an_earlier_run_does_not_stay_beside_new_results(study, tmp_path):
    out = tmp_path / "o"
    assert main([study(), "--out", str(out), "--quiet"]) == 0
    assert (out / "report.pdf").exists()
    assert main([study(), "--out", str(out), "--quiet", "--format", "html"]) == 0
    assert not (out / "report.pdf").exists()
    assert (out / "report.html").exists()


@pytest.mark.skipif(os.name == "nt", reason="POSIX signals")
def test_interrupt_while_the_report_is_written_loses_nothing(study, tmp_path, monkeypatch):
    import formation_opt.execution as execution

    original = execution.write_report

    def interrupted(*arguments, **options):
        os.kill(os.getpid(), signal.SIGINT)
        return original(*arguments, **options)

    monkeypatch.setattr(execution, "write_report", interrupted)
    out = tmp_path / "o"
    assert main([study(), "--out", str(out), "--quiet"]) == 0
    assert len(list(out.iterdir())) == 5


@pytest.mark.skipif(os.name == "nt", reason="POSIX signals")
def test_interrupt_keeps_the_best_so_far(study, tmp_path):
    long = QUICK.replace("generations: 10", "generations: 100000")
    out = tmp_path / "o"
    process = subprocess.Popen(
        [sys.executable, "-m", "formation_opt", study(long), "--out", str(out)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    deadline = time.monotonic() + 60
    while not out.exists() and time.monotonic() < deadline:
        time.sleep(0.05)
    time.sleep(2.0)
    process.send_signal(signal.SIGINT)
    _, error = process.communicate(timeout=60)
    assert process.returncode == 130, error
    assert "Traceback" not in error
    result = json.loads((out / "result.json").read_text(encoding="utf-8"))
    assert "interrupted" in result["warnings"][0]
    assert (out / "report.html").exists()


def test_a_package_of_the_same_name_is_named(monkeypatch, tmp_path):
    intruder = tmp_path / "configs"
    intruder.mkdir()
    (intruder / "__init__.py").write_text("")
    done = subprocess.run(
        [sys.executable, "-c", "import sys; from formation_opt.cli import main; sys.exit(main())"],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(tmp_path)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2
    assert str(intruder / "__init__.py") in done.stderr
    assert "environment of its own" in done.stderr
    assert one_place.intruder(Path(one_place.__file__).parent.parent) is None
