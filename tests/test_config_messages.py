"""Wrong input: one message with file, line, key, value, limit and remedy."""

from __future__ import annotations

from pathlib import Path

import pytest

from configs import StudyError, example_path, example_text, load_study

THREE_SAT = example_text("three_sat")
EVALUATE = example_text("evaluate_example")
LI2009 = example_text("li2009_space")


def message(tmp_path, monkeypatch, content):
    """What the author of ``my.yaml`` reads."""
    monkeypatch.chdir(tmp_path)
    raw = content if isinstance(content, bytes) else content.encode("utf-8")
    Path("my.yaml").write_bytes(raw)
    with pytest.raises(StudyError) as error:
        load_study(Path("my.yaml"))
    text = str(error.value)
    assert all(line.isprintable() for line in text.splitlines())
    return text


@pytest.fixture
def read(tmp_path, monkeypatch):
    return lambda content: message(tmp_path, monkeypatch, content)


def changed(text, old, new):
    assert text.count(old) == 1, f"{old!r} stands {text.count(old)} times in the example"
    return text.replace(old, new)


def place(text, needle):
    """line:column of the first character of a needle."""
    before = text[: text.index(needle)]
    return f"my.yaml:{before.count(chr(10)) + 1}:{len(before) - before.rfind(chr(10))}:"


# (old, new, where the message points, what it says)
IN_THREE_SAT = {
    "unknown key": (
        "snr_db: 10 ",
        "snr: 10 ",
        "snr: 10",
        "radar.snr is not a known key; did you mean 'snr_db'? the keys of radar are wavelength_m, "
        "slant_range_resolution_m, azimuth_resolution_m, doppler_bandwidth_hz, looks, snr_db, "
        "nesz_db, backscatter_db, beams, other_coherence, images, transmitter",
    ),
    "misspelt key that is required": (
        "wavelength_m",
        "wavelenght_m",
        "wavelenght_m",
        "radar.wavelenght_m is not a known key; did you mean 'wavelength_m'?",
    ),
    "key in another unit": (
        "altitude_km: 514 ",
        "altitude_m: 514000 ",
        "altitude_m: 514000",
        "orbit.altitude_m is not a known key; write altitude_km: 514; the keys of orbit are ",
    ),
    "frequency for wavelength": (
        "wavelength_m: 0.031",
        "frequency_ghz: 9.65",
        "frequency_ghz: 9.65",
        "radar.frequency_ghz is not a known key; write wavelength_m: 0.0310666; the keys of ",
    ),
    "key in the wrong block": (
        "    side: left",
        "    snr_db: 10.",
        "snr_db: 10.",
        "scene.strip.snr_db is not a known key; it belongs under 'radar';",
    ),
    "key in the wrong block, two levels deep": (
        "  looks: 16",
        "  prior_height_std_m: 4",
        "prior_height_std_m: 4",
        "radar.prior_height_std_m is not a known key; it belongs under 'refutation' or "
        "'constraints.unwrapping';",
    ),
    "meters for kilometers": (
        "altitude_km: 514 ",
        "altitude_km: 514000 ",
        "514000",
        "orbit.altitude_km = 514000 must be a number from 150 to 36000 km; "
        "if it is in meters, write 514",
    ),
    "kilometers far off": (
        "altitude_km: 514 ",
        "altitude_km: 514000000 ",
        "514000000",
        "orbit.altitude_km = 514000000 must be a number from 150 to 36000 km; "
        "check the value and its unit",
    ),
    "radians for degrees": (
        "look_deg: 23 ",
        "look_deg: 0.4014 ",
        "0.4014",
        "scene.strip.look_deg = 0.4014 must be a number from 2 to 80 degrees; "
        "if it is in radians, write 22.9985",
    ),
    "hertz for meters": (
        "wavelength_m: 0.031",
        "wavelength_m: 9.65e9",
        "9.65e9",
        "radar.wavelength_m = 9.65e+09 must be a number from 0.002 to 2 m; "
        "if it is in Hz, write 0.0310666",
    ),
    "several units": (
        "wavelength_m: 0.031",
        "wavelength_m: 31",
        "31\n",
        "if it is in millimeters, write 0.031; if in centimeters, write 0.31",
    ),
    "percent": (
        "min_probability: 0.99",
        "min_probability: 99",
        "99 #",
        "constraints.unwrapping.min_probability = 99 must be a number from 0.01 to 0.999999, or "
        "null to switch it off; if it is in percent, write 0.99",
    ),
    "NaN": (
        "snr_db: 10 ",
        "snr_db: .nan ",
        ".nan",
        "radar.snr_db = .nan must be a number from -20 to 40 dB; write a finite number",
    ),
    "infinity": (
        "looks: 16",
        "looks: -.inf",
        "-.inf",
        "radar.looks = -.inf must be a number from 1 to 10000; write a finite number",
    ),
    "list for a number": (
        "snr_db: 10 ",
        "snr_db: [10, 12] ",
        "[10, 12]",
        "radar.snr_db = [10, 12] must be a number from -20 to 40 dB; write one number",
    ),
    "truth value for a number": (
        "snr_db: 10 ",
        "snr_db: true ",
        "true",
        "radar.snr_db = true must be a number from -20 to 40 dB; write one number",
    ),
    "quoted number": (
        "snr_db: 10 ",
        "snr_db: '10' ",
        "'10'",
        "radar.snr_db = '10' must be a number from -20 to 40 dB; "
        "write the number without quotes or separators: 10",
    ),
    "number with its unit": (
        "wavelength_m: 0.031",
        "wavelength_m: 31 mm",
        "31 mm",
        "radar.wavelength_m = '31 mm' must be a number from 0.002 to 2 m; "
        "write the number alone; its unit is in the key",
    ),
    "decimal comma": (
        "wavelength_m: 0.031",
        "wavelength_m: 0,031",
        "0,031",
        "radar.wavelength_m = '0,031' must be a number from 0.002 to 2 m; "
        "use a decimal point: 0.031",
    ),
    "separated digits": ("looks: 16", "looks: 1_600", "1_600", "or separators: 1600"),
    "word for a number": ("looks: 16", "looks: many", "many", "to 10000; write a number"),
    "fraction of a satellite": (
        "satellites: 3 ",
        "satellites: 3.0 ",
        "3.0",
        "formation.satellites = 3.0 must be a whole number from 2 to 20, or a list of 2 to 20 "
        "entries, each text of at most 40 characters on one line; "
        "write it without a decimal point: 3",
    ),
    "too few satellites": (
        "satellites: 3 ",
        "satellites: 1 ",
        "1 ",
        "choose a value within these limits",
    ),
    "numbers for names": (
        "satellites: 3 ",
        "satellites: [A, 2] ",
        "2] ",
        "formation.satellites[#2] = 2 must be text of at most 40 characters on one line; "
        "as a text it needs quotes: '2'",
    ),
    "one name twice": (
        "satellites: 3 ",
        "satellites: [A, B, A] ",
        "A] ",
        "formation.satellites[#3] = 'A' is the name of two satellites; give every satellite a name "
        "of its own",
    ),
    "unknown word": (
        "ground_track_circular ",
        "ground_track ",
        "ground_track ",
        "formation.family = 'ground_track' must be one of ground_track_circular, space_circular; "
        "did you mean 'ground_track_circular'?",
    ),
    "word in capitals": ("side: left", "side: LEFT", "LEFT", "did you mean 'left'?"),
    "unknown kind": (
        "kind: optimize",
        "kind: optimise",
        "optimise",
        "kind = 'optimise' must be one of optimize, evaluate, steering, spotlight, video, "
        "coverage, simulate; did you mean 'optimize'?",
    ),
    "name that is no file name": (
        "name: three_sat ",
        "name: ../etc ",
        "../etc",
        "name = '../etc' must be text of at most 64 characters: letters, digits and '_', with '.' "
        "and '-' between them; correct the text",
    ),
    "list for a name": ("name: three_sat ", "name: [x] ", "[x]", "name = ['x'] must be text"),
    "line of sight that misses the Earth": (
        "look_deg: 23 ",
        "look_deg: 70 ",
        "70 ",
        "scene.strip.look_deg = 70 misses the Earth or grazes it: from 514 km it must be at most "
        "67.71; choose a smaller look angle",
    ),
    "layover": (
        "side: left",
        "slope_deg: 40",
        "40 ",
        "scene.strip.slope_deg = 40 lies in layover or shadow, where no phase is measured: at this "
        "incidence it must be from -64.0 to 24.0; choose a gentler slope",
    ),
    "two ways to give the SNR": (
        "snr_db: 10 ",
        "nesz_db: -22\n  snr_db: 10 ",
        "10 ",
        "radar.snr_db = 10 excludes nesz_db and backscatter_db, which also give the "
        "signal-to-noise ratio; keep snr_db, or the other two",
    ),
    "no SNR": (
        "  snr_db: 10 ",
        "  #",
        "radar:",
        "radar lacks the signal-to-noise ratio; add snr_db (-20 to 40), or both nesz_db and "
        "backscatter_db",
    ),
    "unknown satellite in an image": (
        "images: one_transmitter ",
        "images: [[S1, S1], [S1, S4]] ",
        "S4",
        "radar.images[#2][#2] = 'S4' is no satellite of this study; the satellites are S1, S2, S3",
    ),
    "idle satellite": (
        "images: one_transmitter ",
        "images: [[S1, S1], [S1, S2]] ",
        "[[S1, S1]",
        "leaves out the satellite 'S3'; add an image that it transmits or receives",
    ),
    "image listed twice": (
        "images: one_transmitter ",
        "images: [[S1, S2], [S1, S3], [S1, S2]] ",
        "[S1, S2]] ",
        "radar.images[#3] = ['S1', 'S2'] is listed twice; list each image once",
    ),
    "images without a baseline": (
        "images: one_transmitter ",
        "images: [[S1, S2], [S2, S1]] ",
        "[[S1, S2]",
        "are two images with one phase center, between the same satellites; add an image",
    ),
    "image that is no pair": (
        "images: one_transmitter ",
        "images: [[S1, S1], S2] ",
        "S2] ",
        "radar.images[#2] = 'S2' must be a list of 2 entries",
    ),
    "unknown pattern of images": (
        "images: one_transmitter ",
        "images: monostatik ",
        "monostatik",
        "did you mean 'monostatic'?",
    ),
    "transmitter of monostatic images": (
        "images: one_transmitter ",
        "transmitter: S1\n  images: monostatic ",
        "S1\n",
        "radar.transmitter = 'S1' is only for images: one_transmitter; remove it",
    ),
    "unknown transmitter": (
        "images: one_transmitter ",
        "transmitter: S9 ",
        "S9",
        "radar.transmitter = 'S9' is no satellite of this study; the satellites are S1, S2, S3",
    ),
    "no position error": (
        "  position_m: 0.001 ",
        "  #",
        "errors:",
        "errors lacks position_m, the relative position error per satellite and axis, 0 to 1 m; "
        "add position_m: 0.001 for 1 mm, or 0 to neglect it",
    ),
    "two azimuth errors": (
        "  weighting: joint",
        "  azimuth_deg: 0.0001",
        "0.0001",
        "errors.azimuth_deg = 0.0001 excludes azimuth_on_ground_m, the same error; keep one",
    ),
    "sharing by pair of images": (
        "weighting: joint",
        "azimuth_shared_by: pair",
        "pair",
        "errors.azimuth_shared_by = 'pair' is possible only with weighting: pairs",
    ),
    "noise of a pair with joint weighting": (
        "weighting: joint",
        "phase_std_deg: 12",
        "12",
        "errors.phase_std_deg = 12 is the noise of a pair and possible only with weighting: pairs",
    ),
    "scene given twice": (
        "scene:\n",
        "scene:\n  table: {times_s: [1], slant_range_km: [500], look_deg: [9], azimuth_deg: [9]}\n",
        "scene:",
        "scene needs exactly one of strip, table, observation, spotlight and video; keep one of "
        "them",
    ),
    "start of too few satellites": (
        "satellites: 3 ",
        "initial: [{z0_m: 1, zdot0_m_s: 0}]\n  satellites: 3 ",
        "[{z0",
        "formation.initial = [{z0_m: 1, zdot0_m_s: 0}] lists 1 and the study has 3 satellites; "
        "list S1, S2, S3",
    ),
    "start that names some satellites": (
        "satellites: 3 ",
        "initial: [{z0_m: 1, zdot0_m_s: 0, name: X}, {z0_m: 2, zdot0_m_s: 0}]\n  satellites: 2 ",
        "[{z0",
        "names some of the satellites; name all of them or none",
    ),
    "search without bounds": (
        "max_radius_over_critical_baseline: 0.5 ",
        "max_radius_over_critical_baseline: null ",
        "constraints:",
        "constraints bounds neither the radius nor both z0 and zdot0, so the search has no end; "
        "add max_radius_over_critical_baseline: 0.5, or max_z0_m and max_zdot0_m_s",
    ),
    "more survivors than formations": (
        "seed: 1 ",
        "elite: 60 ",
        "60 ",
        "search.elite = 60 must be below the population, 40; let fewer survive",
    ),
    "nothing where a block belongs": (
        "description: >-",
        "compare: 5\ndescription: >-",
        "5\n",
        "compare = 5 must be a list of 0 to 20 blocks; write a list, as in [a, b]",
    ),
    "key without its value": (
        "looks: 16 ",
        "looks: ",
        "looks",
        "radar.looks = null must be a number from 1 to 10000; give a value, or remove the key",
    ),
    "duplicate key": (
        "snr_db: 10 ",
        "snr_db: 10\n  snr_db : 12 ",
        "snr_db : ",
        "radar.snr_db is given twice, first in line 22; keep one",
    ),
    "tab as indentation": (
        "  altitude_km",
        "\taltitude_km",
        "\talt",
        "a tab stands here, which YAML does not allow: indent with spaces",
    ),
    "tab before a value": ("altitude_km: 514", "altitude_km:\t514", "\t514", "indent with spaces"),
    "wrong indentation": (
        "  snr_db: 10 ",
        "   snr_db: 10 ",
        "snr_db",
        "is not valid YAML: expected <block end>, but found '<block mapping start>'; compare the "
        "indentation with the lines above; close every quote",
    ),
    "colon in a text": (
        "description: >-",
        "description: a: b",
        ": b",
        "text that holds ': ' needs quotes",
    ),
    "tag that runs code": (
        "kind: optimize ",
        "kind: !!python/object/apply:os.system ['ls'] ",
        "!!python",
        "kind has the tag !!python/object/apply:os.system; a study is plain data and runs no code: "
        "remove the tag",
    ),
    "tag of a key": ("kind: optimize ", "!!binary kind: x ", "!!binary", "has the tag !!binary"),
    "tag that does not fit": (
        "looks: 16 ",
        "looks: !!int 1.5 ",
        "!!int",
        "radar.looks = 1.5 is not a int; remove the tag !!int or correct the value",
    ),
    "list for a key": (
        "kind: optimize ",
        "[a, b]: c ",
        "[a, b]",
        "a list or block stands where a key belongs: quote it",
    ),
    "second document": ("kind: optimize ", "a: 1\n---\nkind: x ", "---", "remove the line '---'"),
    "unknown alias": ("looks: 16 ", "looks: *many ", "*many", "starts with * needs quotes"),
    "anchor used twice": (
        "looks: 16 ",
        "looks: &a 1\n  x: &a 2 ",
        "&a 2",
        "give each anchor (&name) a name of its own",
    ),
    "alias to itself": (
        "looks: 16 ",
        "looks: &a [*a] ",
        "&a [*a]",
        "radar.looks[#1]… contains itself; remove the alias (*name)",
    ),
    "escape of half a character": (
        "kind: optimize ",
        'kind: "\\ud800" ',
        '"\\ud800"',
        "kind holds half a character (\\uD800-\\uDFFF); write the character",
    ),
    "escape beyond Unicode": (
        "kind: optimize ",
        'kind: "\\UFFFFFFFF" ',
        "FFFFFFFF",
        "is not valid YAML: an escape or a number is too large",
    ),
    "control character in a name": (
        "satellites: 3 ",
        'satellites: [A, "\\x1b[31m"] ',
        '"\\x1b',
        "formation.satellites[#2] = '\\x1b[31m' holds a control character; remove it",
    ),
    "number without end": (
        "seed: 1 ",
        "seed: " + "9" * 5000 + " ",
        "999",
        "search.seed = .inf must be a whole number from 0 to 4294967295; write a finite number",
    ),
}


@pytest.mark.parametrize("case", IN_THREE_SAT)
def test_a_wrong_value_is_named_with_place_limit_and_remedy(read, case):
    old, new, where, says = IN_THREE_SAT[case]
    text = changed(THREE_SAT, old, new)
    shown = read(text)
    start = text.index(new)
    offset = text.index(where, start) if where in text[start:] else text.index(where)
    before = text[:offset]
    line, column = before.count("\n") + 1, len(before) - before.rfind("\n")
    assert shown.startswith(f"my.yaml:{line}:{column}: "), shown
    assert says in shown
    assert "\n" not in shown


OTHER_EXAMPLES = {
    "columns of different length": (
        LI2009,
        "[559.11, ",
        "[",
        "[558.97",
        "scene.table.slant_range_km has 9 entries and times_s has 10; give every column one entry "
        "a segment",
    ),
    "look along the flight direction": (
        LI2009,
        "[82.16, 82.15",
        "[0.16, 82.15",
        "0.16",
        "scene.table.azimuth_deg[#1] = 0.16 looks along the flight direction, where no baseline "
        "senses height; stay 1 degree or more away from 0 and 180",
    ),
    "incidence below the look angle": (
        LI2009,
        "look_deg:       [23.17",
        "incidence_deg: [9., 24, 24, 24, 24, 24, 24, 24, 24, 24]\n    look_deg:       [23.17",
        "9., ",
        "scene.table.incidence_deg[#1] = 9.0 is below the look angle, 23.17, which no Earth "
        "allows; check that the two columns are not swapped",
    ),
    "joint weighting of the paper's pairs": (
        LI2009,
        "preset: li2009 ",
        "weighting: joint\n  preset: li2009 ",
        "joint",
        "errors.weighting = 'joint' contradicts the preset li2009, which weighs pairs; remove it",
    ),
    "satellite missing in a comparison": (
        LI2009,
        "      - {z0_m:  500.8, zdot0_m_s:  1.8946}\n",
        "",
        "- {z0_m: -560.1",
        "compare[#1].satellites lists 2 and the study has 3 satellites; list S1, S2, S3",
    ),
    "misspelt key in a comparison": (
        LI2009,
        "zdot0_m_s:  1.8946",
        "zdot_m_s:  1.8946",
        "zdot_m_s",
        "compare[#1].satellites[#2].zdot_m_s is not a known key; did you mean 'zdot0_m_s'?",
    ),
    "drift": (
        EVALUATE,
        "[0, -1.32410, 0]",
        "[0, -1.3, 0]",
        "[0, -1.3",
        "formation.satellites[#3].velocity_rtn_m_s = [0, -1.3, 0] drifts 412 m per orbit along "
        "track against satellite 1, and 1 m is the limit; the T component of a drift-free velocity "
        "is -2 n R, here -1.324095",
    ),
    "satellite given in two ways": (
        EVALUATE,
        "{name: Near, z0_m: 141, ",
        "{name: Near, position_rtn_m: [0, 0, 0], ",
        "{name: Near",
        "formation.satellites[#2] needs either z0_m and zdot0_m_s, or position_rtn_m and "
        "velocity_rtn_m_s; give both keys of one pair and none of the other",
    ),
    "satellite of one name": (
        EVALUATE,
        "name: Near",
        "name: Chief",
        "{name: Chief, z0_m: 141",
        "formation.satellites[#2] is the name of two satellites",
    ),
    "position with a component too few": (
        EVALUATE,
        "[600, 0, 1200]",
        "[600, 1200]",
        "[600, 1200]",
        "must be a list of 3 entries, each a number from -40000 to 40000 m; add or remove entries",
    ),
}


@pytest.mark.parametrize("case", OTHER_EXAMPLES)
def test_a_wrong_scene_or_formation_is_named_with_place_limit_and_remedy(read, case):
    base, old, new, where, says = OTHER_EXAMPLES[case]
    text = changed(base, old, new)
    shown = read(text)
    assert shown.startswith(place(text, where)), shown
    assert says in shown
    assert "\n" not in shown


# --- several at once -----------------------------------------------------------------------------


def test_several_mistakes_are_listed_in_the_order_of_the_file(read):
    text = changed(THREE_SAT, "altitude_km: 514 ", "altitude_km: high ")
    text = changed(text, "looks: 16", "looks: 0")
    text = changed(text, "side: left", "sides: left")
    lines = read(text).splitlines()
    assert lines[0] == "my.yaml has 3 errors:"
    assert [line.split(" = ")[0].split(": ")[-1] for line in lines[1:3]] == [
        "orbit.altitude_km",
        "radar.looks",
    ]
    assert "scene.strip.sides is not a known key; did you mean 'side'?" in lines[3]
    assert len(lines) == 4


def test_after_five_mistakes_the_others_are_counted(read):
    lines = read("".join(f"k{number}: 1\n" for number in range(40))).splitlines()
    assert lines[0] == "my.yaml has 45 errors:"  # 40 unknown keys, 5 missing blocks
    assert len(lines) == 7
    assert lines[-1] == "  and 40 more"


def test_a_missing_block_says_where_to_find_one(read):
    text = THREE_SAT[: THREE_SAT.index("errors:")] + "formation: {satellites: 3}\n"
    shown = read(text)
    assert "errors is missing (The error budget); add this block as in the example" in shown
    assert "formation-opt --new three_sat" in shown


def test_a_missing_key_says_what_belongs_there(read):
    text = changed(THREE_SAT, "  altitude_km: 514 ", "  #")
    shown = read(text)
    assert shown == (
        place(text, "orbit:") + " orbit.altitude_km is missing; add a number from 150 to 36000 km "
        "(Height above the equatorial radius of the Earth, 6378.137 km)"
    )


def test_a_study_that_no_memory_holds_is_refused(read):
    text = changed(THREE_SAT, "segments: 10 ", "segments: 1000 ")
    text = changed(text, "population: 40", "population: 10000")
    shown = read(text)
    assert shown.startswith(place(text, "scene:"))
    assert "has 1000 segments, which with 3 images and 10000 formations at a time is too" in shown
    assert "may reach 5e+07; take fewer segments, or a smaller search.population" in shown
    islands = changed(text, "population: 10000", "population: 100\n  islands: 100")
    assert "and 10000 formations at a time is too" in read(islands)


def test_settings_of_another_algorithm_are_refused(read):
    text = changed(THREE_SAT, "method: genetic ", "method: cma_es\n  mutation_eta: 7 #")
    assert (
        "search.mutation_eta = 7 is a setting of the genetic algorithm, and method is cma_es; "
        "remove this key, or set method: genetic"
    ) in read(text)
    text = changed(THREE_SAT, "method: genetic ", "method: differential_evolution #")
    assert "must be at least 5 for differential_evolution" in read(
        changed(text, "population: 40", "population: 4")
    )
    assert "did you mean" in read(changed(THREE_SAT, "method: genetic ", "method: genetik #"))


def test_two_compared_formations_of_one_label_are_refused(read):
    start = LI2009.index("  - label")
    shown = read(LI2009 + LI2009[start:])
    assert "compare[#2].label = 'Published optimum' is used twice; choose another label" in shown


# --- files ---------------------------------------------------------------------------------------


def refused(path):
    with pytest.raises(StudyError) as error:
        load_study(Path(path))
    return str(error.value)


def test_a_missing_file_suggests_the_shipped_example(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert refused("configs/three_sat.yaml") == (
        "configs/three_sat.yaml: does not exist; did you mean the shipped example? "
        "formation-opt three_sat"
    )
    assert refused("configs/tree_sat.yaml").endswith("formation-opt three_sat")
    assert refused("xyz.yaml").endswith("take an example (formation-opt --list)")


def test_an_unknown_example_suggests_the_closest():
    with pytest.raises(StudyError) as error:
        example_path("foursat")
    assert str(error.value).startswith(
        "'foursat' is not a shipped example; did you mean 'four_sat'? the examples are "
    )


def test_a_folder_is_no_study(tmp_path):
    assert refused(tmp_path).endswith(": is a folder; name a YAML file in it")


def test_a_file_that_may_not_be_read_says_so(tmp_path, monkeypatch):
    def forbidden(*_args, **_kwargs):
        raise PermissionError(13, "Permission denied")

    path = tmp_path / "secret.yaml"
    path.write_text(THREE_SAT, encoding="utf-8")
    monkeypatch.setattr(Path, "open", forbidden)
    assert "cannot be read (Permission denied); check its name and its permissions" in refused(path)


@pytest.mark.parametrize("name", ["a\0b.yaml", "x" * 400 + ".yaml"])
def test_an_impossible_file_name_is_one_message(tmp_path, name):
    shown = refused(tmp_path / name)
    assert "cannot be read (" in shown
    assert shown.isprintable()


@pytest.mark.parametrize("content", ["", "\n\n", "# a comment only\n", "---\n", "\ufeff"])
def test_an_empty_file_points_to_an_example(read, content):
    assert "is empty; start from an example: formation-opt --new three_sat" in read(content) or (
        "the study is null" in read(content)
    )


@pytest.mark.parametrize("content", ["- a\n- b\n", "hello", "3.5", "[1, 2]"])
def test_a_study_is_a_block_of_keys(read, content):
    shown = read(content)
    assert shown.startswith("my.yaml:1:1: the study is ")
    assert "not a block of keys such as 'orbit:' and 'radar:'" in shown


def test_two_megabytes_of_nonsense_are_refused_at_once(read):
    assert read(b"\x8f\x00nonsense" * 200_000) == (
        "my.yaml: is larger than 1000 kB, the limit for a study; is it another file?"
    )


@pytest.mark.parametrize(
    ("content", "says"),
    [
        (b"name: a\n\x00", "my.yaml:2:1: character U+0000 does not belong in text; is it a binary"),
        (b"name: a\x07", "my.yaml:1:8: character U+0007 does not belong in text"),
        (b"name: caf\xe9", "my.yaml:1:10: byte 0xe9 is not UTF-8 text; save the file as UTF-8"),
        ("name: a".encode("utf-16"), "my.yaml: is UTF-16 text; save it as UTF-8"),
    ],
)
def test_what_is_not_text_is_refused_with_its_place(read, content, says):
    assert read(content).startswith(says)


@pytest.mark.parametrize(
    ("content", "says"),
    [
        ("[" * 900_000, "my.yaml:1:51: is nested more than 50 deep, where a study needs 5"),
        ("a: " + "{a: " * 60, "is nested more than 50 deep"),
        ("[" + "1," * 400_000 + "1]", "holds more than 20000 values"),
        ("".join(f"k{i}: {i}\n" for i in range(70_000)), "holds more than 20000 values"),
        (
            "a: &a [x,x,x,x,x,x,x,x,x]\n"
            + "".join(
                f"{chr(98 + i)}: &{chr(98 + i)} [{','.join(['*' + chr(97 + i)] * 9)}]\n"
                for i in range(9)
            ),
            "holds more than 20000 values, counting what aliases (*name) stand for; shorten it",
        ),
    ],
)
def test_input_that_unfolds_without_end_is_refused(read, content, says):
    assert says in read(content)
