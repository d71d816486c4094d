"""Words of a decision where the usual ones would be false: one feasible variant, other programs, verdicts."""

from __future__ import annotations

import dataclasses

import pytest

from rgss.assessment.measuring import measure_variants
from rgss.decision.robustness.parts import Part, PartComputer
from rgss.decision.study_decision import decide_study
from rgss.reports.decision import decision_lines, decision_section, rule_sentence
from rgss.reports.decision.sentences import certificate_sentence, noise_sentence, reasons
from rgss.reports.decision.text.effects import usable_resamples_sentence
from rgss.reports.decision.words import kept_amount, kept_share
from rgss.tradeoff.decision import InfeasibleAlternative


@pytest.fixture(scope="module")
def made(shipped, filled, record_of):
    store = filled(shipped, lambda spec: record_of(spec, planning_s=0.5 + 0.01 * spec.variant + 0.1 * spec.seed))
    return decide_study(shipped, measure_variants(shipped, store), evidence="evidence.sqlite", analysed=False)


def with_decision(made, **changes):
    return dataclasses.replace(made, decision=dataclasses.replace(made.decision, **changes))


def test_one_feasible_variant_has_no_superlative(made):
    alone = with_decision(made, counts=dataclasses.replace(made.decision.counts, feasible=1))
    chosen = made.decision.chosen
    assert next(reasons(alone)).text == (
        f"Variant {chosen} is the one variant that meets every requirement by the estimates."
    )
    assert "enumeration of the one variant agrees" in certificate_sentence(
        dataclasses.replace(made.decision.certificate, alternatives=1)
    )


def test_a_program_that_does_not_compare_values_speaks_of_preference(made):
    excluded = tuple(InfeasibleAlternative(variant=one, requirements=("R",), value=0.9) for one in (3, 4))
    other = with_decision(
        made,
        program="lexicographic",
        excluded_better=excluded,
        counts=dataclasses.replace(made.decision.counts, excluded_better=2),
    )
    texts = [one.text for one in reasons(other)]
    assert texts[0].startswith(f"Variant {made.decision.chosen} is the choice of the lexicographic program of the ")
    assert "2 variants would be preferred by the program but violate a requirement: 3, 4" in texts
    assert not any("worth more" in text or "value" in text for text in texts)
    none = with_decision(made, program="lexicographic", excluded_better=())
    assert "No requirement excludes a variant that the program would prefer." in [one.text for one in reasons(none)]


def test_limits_of_the_program_are_not_requirements(made):
    other = next(reasons(with_decision(made, program="epsilon_constraint"))).text
    assert "variants that meet every requirement and every limit of the program by the estimates" in other


def test_a_choice_by_verdicts_speaks_of_verdicts(made):
    shown = dataclasses.replace(made, shown_feasible=True)
    assert rule_sentence(shown).startswith("Rule: of the variants that are shown to meet every requirement, the one ")
    assert next(reasons(shown)).text.endswith("meet every requirement by the verdicts.")
    nothing = dataclasses.replace(with_decision(shown, chosen=None, ties=()), comparison=None)
    lines = "\n".join(decision_lines(nothing))
    assert "none meets every requirement by its verdicts" in lines
    assert "by its estimates" not in lines
    assert "meets every requirement by its verdicts" in decision_section(nothing)


def test_an_equal_that_another_surpasses_is_named(made):
    chosen = made.decision.chosen
    equal = with_decision(made, ties=(chosen, 1, 2), surpassed=(2,))
    texts = [one.text for one in reasons(equal)]
    assert texts[1:3] == [
        (
            "Variant 2 has the same value, but another of this value is better in a quantity beyond the end of its "
            "value function, and no worse in any."
        ),
        "Variant 1 has the same value; the smallest id is chosen.",
    ]


def test_quantities_without_noise_are_not_said_to_lack_replicates():
    assert noise_sentence(None) == (
        "Whether a conflict survives noise: no measure of the requirements has two replicates; measures that follow "
        "from the design alone have no noise."
    )


def test_numbers_that_are_too_large_to_square_leave_a_part_out():
    parts = PartComputer()
    assert parts.compute(Part.EFFECTS, lambda: 1e250**2, "nothing") == "nothing"
    assert str(parts.missing[Part.EFFECTS]) == (
        "the quantities of a measure are too large to compute with (give the measure a greater unit)"
    )


@pytest.mark.parametrize(
    ("used", "words"),
    [
        (0.0, ""),
        (1.0, ""),
        (0.95, "Intervals are of the 95 % of resamples that leave every design a success."),
        (
            0.5,
            (
                "No intervals: only 50 % of the resamples of the replicates leave every design a success, too few for "
                "intervals of these (90 %); more replicates give them."
            ),
        ),
    ],
)
def test_resamples_without_a_success_are_counted(used, words):
    assert usable_resamples_sentence(type("Analysis", (), {"used": used})()) == words


@pytest.mark.parametrize(
    ("end", "unit", "is_least", "text"),
    [
        # Three drives of 1,267 USD in place of 450 are one dollar more than the limit allows.
        (450.0 + 2450.0 / 3.0, "USD", False, "1,266 USD"),
        (2993.2, "USD", True, "2,994 USD"),
        (7650.000000000001, "USD", False, "7,650 USD"),
        (1.27256, "kg", False, "1.272 kg"),
        (1.27241, "kg", True, "1.273 kg"),
        (0.0, "USD", True, "0 USD"),
    ],
)
def test_the_end_of_a_range_is_written_so_that_it_is_within(end, unit, is_least, text):
    assert kept_amount(end, unit, is_least=is_least) == text


@pytest.mark.parametrize(
    ("share", "digits", "text"), [(0.0604, 1, "6.0 %"), (0.06999, 1, "6.9 %"), (0.07, 2, "7.00 %"), (0.1, 1, "10.0 %")]
)
def test_a_share_up_to_which_something_holds_is_rounded_down(share, digits, text):
    assert kept_share(share, digits) == text
