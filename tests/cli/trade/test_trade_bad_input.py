"""What a trade-off cannot be decided from: one line that says what, where and how to mend it; exit status 2."""

from __future__ import annotations

import shutil
import sqlite3
import zlib

import pytest

STUDY = "studies/pick_place.yaml"
MARGIN = "  practical_margin: 0.01\n"


@pytest.fixture
def copy(with_evidence, tmp_path):
    """A copy of the project with evidence that the test may change."""
    return shutil.copytree(with_evidence, tmp_path / "project")


def edited(folder, lines):
    """Put lines into the trade-off of the study."""
    text = (folder / STUDY).read_text(encoding="utf-8")
    assert MARGIN in text
    (folder / STUDY).write_text(text.replace(MARGIN, f"{lines}\n"), encoding="utf-8")
    return next(
        at for at, line in enumerate((folder / STUDY).read_text(encoding="utf-8").splitlines(), 1) if line == lines
    )


@pytest.mark.parametrize(
    ("lines", "complaint"),
    [
        (
            "  decide_by: {program: lexicographic, order: [{measure: S, absolute: 0.05, relative: 2 %}]}",
            "'S' has two tolerances that contradict each other: 0.05 and 2 % (give an absolute or a relative",
        ),
        (
            "  decide_by: {program: lexicographic, order: [{measure: S, absolute: -0.05}]}",
            "absolute tolerance of 'S' must be at least 0, got -0.05 (give 0 for no tolerance)",
        ),
        (
            "  decide_by: {program: lexicographic, order: [{measure: S}, {measure: S}]}",
            "'S' occurs twice in a lexicographic program (keep the more important place)",
        ),
        ("  weight_order: [{heavier: t_p, lighter: P_max}]", "the weight of 't_p' is 0.1, below that of 'P_max', 0.25"),
        ("  chance: [{requirement: SYS-050, probability: 0.5}]", "unknown system requirement 'SYS-050'"),
        (
            "  tail: [{measure: t_ee, at_most: 3 s, worst_share: 0.5}]",
            "no measure 't_ee' is defined (did you mean 't_e'?)",
        ),
    ],
)
def test_what_contradicts_itself_is_told_at_its_place(rgss, copy, lines, complaint):
    line = edited(copy, lines)
    told = rgss("trade", "--project", copy)

    assert (told.status, told.output) == (2, "")
    assert told.complaint.startswith(f"{STUDY}:{line}:")
    assert f": error: {complaint}" in told.complaint


@pytest.mark.parametrize(
    ("lines", "replicates", "complaint"),
    [
        (
            "  chance: [{requirement: SYS-005, probability: 0.9}]",
            3,
            (
                "chance:SYS-005 needs 10 replicates, variant 1 has 3 "
                "(run at least 10 replicates, or ask for less: P[t_e_simulated <= 25 s] >= 0.9)"
            ),
        ),
        (
            "  tail: [{requirement: SYS-033, worst_share: 50 %}]",
            1,
            (
                "tail:SYS-033 needs 2 replicates, variant 1 has 1 "
                "(run at least 2 replicates, or ask for less: mean of the worst 50 % of t_p <= 15 s)"
            ),
        ),
        (
            "  decide_by: {program: minimax_regret, over: replicates}",
            1,
            (
                "regret over replicates needs 2 replicates of each variant, and there is 1 "
                "(run more replicates, or take the regret over weights)"
            ),
        ),
    ],
)
def test_too_few_replicates(rgss, copy, lines, replicates, complaint):
    edited(copy, lines)
    told = rgss("trade", "--replicates", replicates, "--project", copy)

    assert (told.status, told.output, told.complaint) == (2, "", f"rgss: {complaint}")


def test_evidence_that_is_no_number(rgss, copy):
    """The store refuses to write it; put in behind its back, it is found and nothing is decided."""
    with sqlite3.connect(copy / ".rgss" / "evidence.sqlite") as connection:
        key, record = connection.execute("SELECT key, record FROM trials ORDER BY key LIMIT 1").fetchone()
        text = zlib.decompress(record).decode()
        assert '"motion_time_s":9.' in text
        place = text.index('"motion_time_s":9.') + len('"motion_time_s":')
        end = min(at for at in (text.find(",", place), text.find("}", place)) if at > 0)
        wrong = zlib.compress((text[:place] + "NaN" + text[end:]).encode())
        connection.execute("UPDATE trials SET record = ? WHERE key = ?", (wrong, key))
    told = rgss("trade", "--project", copy)

    assert (told.status, told.output) == (2, "")
    assert key[:12] in told.complaint
    assert "NaN" in told.complaint or "damaged" in told.complaint


@pytest.mark.parametrize(
    ("limit", "message"),
    [
        ("60", "--time-limit: '60' has no unit"),
        ("fast", "--time-limit: 'fast' is not a quantity"),
        ("3 kg", "--time-limit: unit 'kg' does not measure what 's' measures"),
        ("0 s", "--time-limit must be greater than zero, got '0 s'"),
        ("-1 s", "--time-limit must be greater than zero, got '-1 s'"),
    ],
)
def test_a_time_limit_is_a_time_above_zero(rgss, limit, message):
    told = rgss("trade", f"--time-limit={limit}")

    assert (told.status, told.output) == (2, "")
    assert told.errors == f'rgss: {message} (write it as "60 s")\n'
