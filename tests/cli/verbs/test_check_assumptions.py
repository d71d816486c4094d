"""``rgss check`` on what a study questions: alternatives of assumptions, and inputs of ranges."""

from __future__ import annotations

STUDY = "studies/pick_place.yaml"
ABOUT = "  - about: planning.charge_per_check\n"


def test_an_alternative_that_is_none_is_found_at_its_place(rgss, folder, edit, place_of):
    edit(STUDY, ABOUT, f"{ABOUT}    alternatives: [0.5 ms, 3 kg]\n")
    told = rgss("check", "--project", folder)

    assert told.status == 1
    wrong = f"{place_of(STUDY, '3 kg')}: error: planning.charge_per_check: unit 'kg' does not measure"
    assert wrong in told.output
    assert told.output.count("[study.assumption]") == 1


def test_alternatives_of_what_cannot_be_supposed_are_found(rgss, folder, edit):
    edit(STUDY, ABOUT, "  - about: planning.charge\n    alternatives: [0.5 ms]\n")
    told = rgss("check", "--project", folder)

    assert told.status == 1
    assert "unknown input 'planning.charge' (did you mean planning." in told.output


def test_right_alternatives_are_no_finding(rgss, folder, edit):
    edit(STUDY, ABOUT, f"{ABOUT}    alternatives: [0.5 ms, 0.125 ms]\n")
    assert "study.assumption" not in rgss("check", "--project", folder).output


def test_a_range_of_an_input_that_is_not_there_is_found_at_its_place(rgss, folder, edit, place_of):
    ranges = ", ".join(
        f"{{input: {name}, low: 0.1, high: 0.3, rationale: r}}" for name in ("weight.P_maxx", "weight.P_max")
    )
    edit(STUDY, "trade_off:\n", f"trade_off:\n  sensitivity: {{ranges: [{ranges}]}}\n")
    told = rgss("check", "--project", folder)

    assert told.status == 1
    place = place_of(STUDY, "weight.P_maxx")
    assert f"{place}: error: unknown input 'weight.P_maxx' of the decision (did you mean weight.P_max" in told.output
    assert told.output.count("unknown input") == 1
