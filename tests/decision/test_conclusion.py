"""What the evidence shows of designs: feasible, infeasible or open, and the sentences on it."""

from __future__ import annotations

import dataclasses

import pytest

from rgss.assessment.measuring import measure_variants
from rgss.decision.choosing import trade_problem
from rgss.decision.robustness import robustness
from rgss.decision.study_decision import Conclusion, DesignStanding, Feasibility, decide_study
from rgss.decision.study_decision.conclusion import conclusion_of
from rgss.reports.decision import decision_lines, decision_part, decision_section, trade_document
from rgss.reports.decision.conclusion import (
    headline,
    rule_sentence,
    share_of_draws,
    standing_sentence,
    uncertainty_sentences,
)
from rgss.trace.evidence import FailedVerifications
from rgss.tradeoff.robustness import Rival

NOT_RUN = "1 not run by trials, as no measure decides it (SYS-1)"


@pytest.fixture(scope="module")
def measured(shipped, filled, record_of):
    store = filled(shipped, lambda spec: record_of(spec, planning_s=0.5 + 0.01 * spec.variant + 0.1 * spec.seed))
    return measure_variants(shipped, store)


@pytest.fixture(scope="module")
def made(shipped, measured):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(robustness, "ITERATIONS", 200)
        return decide_study(shipped, measured, evidence="evidence.sqlite")


def standing(variant: int, **ids: tuple[str, ...]) -> DesignStanding:
    empty = dict.fromkeys(("met", "open", "missed", "not_run", "undecided"), ())
    return DesignStanding(variant=variant, **{**empty, **ids})


def concluded(made, *standings: DesignStanding):
    chosen = next((one for one in standings if one.variant == made.decision.chosen), None)
    return dataclasses.replace(made, conclusion=Conclusion(standings=standings, chosen=chosen, unmeasured=("SYS-1",)))


@pytest.mark.parametrize(
    ("ids", "feasibility"),
    [
        ({"met": ("A",)}, Feasibility.FEASIBLE),
        ({"met": ("A",), "not_run": ("SYS-1",)}, Feasibility.FEASIBLE),
        ({"met": ("A",), "open": ("B",), "undecided": ("B",)}, Feasibility.OPEN),
        ({"not_run": ("B",), "undecided": ("B",)}, Feasibility.OPEN),
        ({"open": ("B",), "missed": ("A",), "undecided": ("B",)}, Feasibility.INFEASIBLE),
    ],
)
def test_a_design_is_feasible_only_where_every_verdict_is_met(ids, feasibility):
    assert standing(1, **ids).feasibility is feasibility


@pytest.mark.verifies("SYS-037")
def test_three_replicates_leave_the_choice_open(made, measured):
    """All succeed; neither a share of 0.9 nor a mean of times is shown by three trials."""
    found = made.conclusion
    assert found.chosen.open == ("SYS-005", "SYS-009", "SYS-024", "SYS-040", "SYS-033")
    assert set(found.chosen.met) == {"SYS-004", "SYS-012"}
    assert found.chosen.feasibility is Feasibility.OPEN
    assert sum(found.count(kind) for kind in Feasibility) == len(measured)
    assert found.count(Feasibility.FEASIBLE) == 0
    by_verdict = {
        entry.variant.id: any(verdict.value == "not_met" for verdict in entry.verdicts.values()) for entry in measured
    }
    for one in found.standings:
        assert (one.feasibility is Feasibility.INFEASIBLE) is by_verdict[one.variant]


def test_every_page_says_what_is_open(made):
    sentence = headline(made)
    assert "which do not show yet that it meets every requirement: 0 of 72 are shown" in sentence
    assert "are open (by SYS-005, SYS-009, SYS-024, SYS-033, SYS-040)" in sentence
    assert sentence in list(decision_lines(made))
    assert sentence in decision_section(made)
    assert decision_part(made)["headline"] == sentence
    document = trade_document(made)["conclusion"]
    assert document["headline"] == sentence
    assert document["counts"]["open"] == made.conclusion.count(Feasibility.OPEN)
    assert document["chosen"]["open"] == ["SYS-005", "SYS-009", "SYS-024", "SYS-040", "SYS-033"]
    shares = [one["best"] for one in document["uncertainty"]["variants"]]
    assert document["uncertainty"]["best_and_feasible"] == max(shares)


def test_the_headline_of_a_choice_that_is_shown_feasible(made):
    chosen = made.decision.chosen
    other = concluded(made, standing(chosen, met=("A",)), standing(9999, missed=("B",)))
    assert headline(other) == (
        f"Variant {chosen} is chosen and shown to meet every requirement that a measure decides: 1 of 2 is shown to "
        "meet them all; 0 are open, 1 infeasible."
    )
    whole = dataclasses.replace(other, conclusion=dataclasses.replace(other.conclusion, unmeasured=()))
    assert headline(whole).startswith(f"Variant {chosen} is chosen and shown to meet every requirement: 1 of 2 is")


def test_a_failed_test_is_told_beside_the_choice(made):
    other = concluded(made, standing(made.decision.chosen, met=("A",)))
    other = dataclasses.replace(
        other, conclusion=dataclasses.replace(other.conclusion, failed=FailedVerifications(tests=("SYS-1", "A")))
    )
    assert headline(other).endswith("0 infeasible. Tests of SYS-1, A failed: no design meets them.")
    assert trade_document(other)["conclusion"]["failed_tests"] == ["SYS-1", "A"]


@pytest.mark.parametrize(
    ("failed", "deciding", "told"),
    [
        (
            FailedVerifications(records=("A",)),
            "a measure or a record",
            "The verification record of A says not met: no design meets it.",
        ),
        (
            FailedVerifications(tests=("A",), records=("A", "B")),
            "a measure, a test or a record",
            "failed: no design meets it. The verification records of A, B say not met: no design meets them.",
        ),
    ],
)
def test_what_a_verification_record_says_is_not_met_is_told_beside_the_choice(made, failed, deciding, told):
    other = concluded(made, standing(made.decision.chosen, missed=("A",)))
    other = dataclasses.replace(other, conclusion=dataclasses.replace(other.conclusion, failed=failed))
    assert f"every requirement that {deciding} decides" in headline(other)
    assert headline(other).endswith(told)
    assert trade_document(other)["conclusion"]["failed_records"] == list(failed.records)


def test_a_requirement_whose_test_failed_is_missed_by_every_design(shipped, measured):
    """One with a criterion, which all designs meet by it, and one without."""
    assert conclusion_of(shipped, measured, None).failed == FailedVerifications()
    failed = FailedVerifications(tests=("SYS-004",), records=("SYS-003", "SYS-004"))
    found = conclusion_of(shipped, measured, measured[0].variant.id, failed)
    assert (found.failed, failed.requirements) == (failed, ("SYS-004", "SYS-003"))
    for one in found.standings:
        assert {"SYS-004", "SYS-003"} <= set(one.missed)
        assert not {"SYS-004", "SYS-003"} & {*one.met, *one.open, *one.not_run, *one.undecided}
        assert one.feasibility is Feasibility.INFEASIBLE


def test_the_headline_of_a_choice_that_is_shown_to_miss(made):
    chosen = made.decision.chosen
    other = concluded(made, standing(chosen, missed=("A",)), standing(9999, open=("B",), undecided=("B",)))
    assert headline(other) == (
        f"Variant {chosen} is chosen by its estimates, but shown to miss a requirement: 0 of 2 are shown to meet every "
        "requirement that a measure decides; 1 is open (by B), 1 infeasible."
    )
    assert standing_sentence(other) == (f"Requirements of variant {chosen}: 0 met; 0 open; 1 missed (A); {NOT_RUN}.")


def test_a_requirement_without_valid_evidence_is_open_in_every_sentence(made):
    chosen = made.decision.chosen
    verdicts = standing(chosen, met=("C",), open=("B",), not_run=("A",), undecided=("B", "A"))
    other = concluded(made, verdicts)
    assert "1 is open (by A, B), 0 infeasible" in headline(other)
    assert standing_sentence(other) == (
        f"Requirements of variant {chosen}: 1 met (C); 2 open (B, A without valid evidence); 0 missed; {NOT_RUN}."
    )


def test_the_requirements_of_each_verdict_are_named_the_same_on_every_page(made):
    chosen = made.decision.chosen
    names = tuple(f"R-{number}" for number in range(1, 12))
    verdicts = standing(chosen, met=names[:8], open=("B",), missed=("SYS-2",), undecided=("B",))
    found = concluded(made, verdicts).conclusion
    other = dataclasses.replace(made, conclusion=dataclasses.replace(found, unmeasured=("SYS-2", *names)))
    sentence = (
        f"Requirements of variant {chosen}: 8 met (R-1, R-2, R-3, R-4, R-5, R-6, R-7, R-8); 1 open (B); 1 missed "
        "(SYS-2); 11 not run by trials, as no measure decides them (R-1, R-2, R-3, R-4, R-5, R-6, R-7, R-8 and 3 more)."
    )
    assert standing_sentence(other) == sentence
    assert sentence in list(decision_lines(other))
    assert f"- {sentence}\n" in decision_section(other)
    assert trade_document(other)["conclusion"]["requirements"] == sentence
    assert decision_part(other)["standing"][0] == sentence


def test_without_a_choice_there_is_no_standing(made):
    nothing = dataclasses.replace(
        concluded(made, standing(9999, missed=("A",))), decision=dataclasses.replace(made.decision, chosen=None)
    )
    assert headline(nothing).startswith("No variant is chosen: none meets every requirement by its estimates; 0 of 1")
    assert standing_sentence(nothing) == ""


def with_rivals(made, *rivals: Rival):
    weighting = made.robustness.analysis.weighting
    uncertainty = dataclasses.replace(weighting.uncertainty, rivals=rivals)
    analysis = dataclasses.replace(
        made.robustness.analysis, weighting=dataclasses.replace(weighting, uncertainty=uncertainty)
    )
    return dataclasses.replace(made, robustness=dataclasses.replace(made.robustness, analysis=analysis))


def test_rare_great_values_are_said_beside_the_probability(made):
    other = with_rivals(made)
    weighting = other.robustness.analysis.weighting
    assert weighting.uncertainty.heavy_tailed == ()
    uncertainty = dataclasses.replace(weighting.uncertainty, heavy_tailed=("t_e",))
    analysis = dataclasses.replace(
        other.robustness.analysis, weighting=dataclasses.replace(weighting, uncertainty=uncertainty)
    )
    tailed = dataclasses.replace(other, robustness=dataclasses.replace(other.robustness, analysis=analysis))
    probability, caution, *_ = uncertainty_sentences(tailed)
    assert probability.startswith("Probability that variant")
    assert caution.startswith("t_e has rare great values, which fewer than 30 replicates of the choice")
    assert trade_document(tailed)["conclusion"]["uncertainty"]["heavy_tailed"] == ["t_e"]
    assert caution in decision_part(tailed)["standing"]


def test_the_document_of_a_report_lists_the_same_ties(made):
    def rival(row, probability):
        return Rival(row=row, probability=probability, within_margin=True, replicates=None, measure=None)

    variants = made.robustness.analysis.variants
    part = decision_part(with_rivals(made, rival(6, 0.4), rival(2, 0.1), rival(3, 0.028)))
    assert part["rivals"] == [variants[6], variants[2]]
    # The page says of these that they are as good with a probability of 5 % or more.
    assert part["rivals_by_margin"] == [variants[3]]
    assert decision_part(with_rivals(made))["rivals"] == []


@pytest.mark.parametrize(
    ("replicates", "measure", "words"),
    [
        (None, None, "no estimate differs, so that only a measure in which they differ breaks the tie."),
        (None, "t_e", "they differ most in t_e, and no affordable number of replicates separates them."),
        (65, "t_e", "they differ most in t_e; about 65 replicates would separate them."),
    ],
)
def test_a_tie_says_what_could_break_it(made, replicates, measure, words):
    row = int(made.robustness.analysis.feasible.argmax())
    rival = Rival(row=row, probability=0.25, within_margin=True, replicates=replicates, measure=measure)
    sentences = list(uncertainty_sentences(with_rivals(made, rival)))
    name = made.robustness.analysis.variants[row]
    assert sentences[1] == (
        f"Tied: variant {name} (within the practical margin, as good with a probability of 25 %); {words}"
    )


def test_a_tie_by_the_margin_alone_names_no_replicates(made):
    row = int(made.robustness.analysis.feasible.argmax())
    rival = Rival(row=row, probability=0.028, within_margin=True, replicates=None, measure="t_e", separated=True)
    assert list(uncertainty_sentences(with_rivals(made, rival)))[1].endswith(
        "as good with a probability of 2.8 %); the replicates separate them, most by t_e: no more of them, but a "
        "smaller margin, breaks the tie."
    )


def test_a_tie_of_different_quantities_says_that_they_are_beyond_an_end(made):
    row = int(made.robustness.analysis.feasible.argmax())
    rival = Rival(row=row, probability=1.0, within_margin=True, replicates=None, measure=None, clipped=("t_e", "t_p"))
    assert list(uncertainty_sentences(with_rivals(made, rival)))[1].endswith(
        "; their estimates differ in t_e, t_p, but beyond an end of the value function, where no difference is worth "
        "anything; another worst or best breaks the tie."
    )


def test_a_difference_that_no_replicate_changes_is_said_to_be_fixed(made):
    row = int(made.robustness.analysis.feasible.argmax())
    rival = Rival(row=row, probability=0.3, within_margin=True, replicates=28, measure="C_total", fixed=True)
    assert list(uncertainty_sentences(with_rivals(made, rival)))[1].endswith(
        "; they differ most in C_total, which no replicate changes; about 28 replicates would show whether what varies "
        "from trial to trial outweighs it."
    )
    apart = list(uncertainty_sentences(with_rivals(made, dataclasses.replace(rival, separated=True))))[1]
    assert apart.endswith("most by C_total, which no replicate changes: a smaller margin breaks the tie.")


def test_the_gain_of_a_study_that_decides_by_verdicts_says_what_it_leaves_out(made):
    *_, gain = uncertainty_sentences(made)
    *_, by_verdicts = uncertainty_sentences(dataclasses.replace(made, shown_feasible=True))
    assert by_verdicts == f"{gain} More replicates also narrow the intervals that verdicts need, which is not counted."


def test_a_tie_by_feasibility_names_no_number_of_replicates(made):
    row = int(made.robustness.analysis.feasible.argmax())
    rival = Rival(row=row, probability=0.25, within_margin=False, replicates=None, measure="t_e", by_feasibility=True)
    tie = list(uncertainty_sentences(with_rivals(made, rival)))[1]
    assert tie.endswith(
        "by value alone it would not be tied, being as good with the choice feasible in less than 5 %: replicates that "
        "settle the open verdicts break the tie."
    )
    assert "would separate them" not in tie
    two = with_rivals(made, rival, dataclasses.replace(rival, row=row + 1))
    assert "by value alone they would not be tied" in list(uncertainty_sentences(two))[1]


def test_probabilities_from_few_trials_have_a_caution(made):
    weighting = made.robustness.analysis.weighting
    uncertainty = dataclasses.replace(weighting.uncertainty, scarce=("SYS-024",))
    analysis = dataclasses.replace(
        made.robustness.analysis, weighting=dataclasses.replace(weighting, uncertainty=uncertainty)
    )
    few = dataclasses.replace(made, trials=6, robustness=dataclasses.replace(made.robustness, analysis=analysis))
    (caution,) = [one for one in uncertainty_sentences(few) if one.startswith("At the threshold of SYS-024, 6 trials")]
    assert "so few that these probabilities follow the assumed population of designs. In emulated studies" in caution
    assert caution.endswith(
        "from 0.2 too low to 0.4 too high, and 0.8 too high where all designs were just below the limit."
    )
    assert trade_document(few)["conclusion"]["uncertainty"]["scarce"] == ["SYS-024"]
    assert not any("At the threshold of" in one for one in uncertainty_sentences(made))


def test_a_choice_without_ties_says_so(made):
    assert list(uncertainty_sentences(with_rivals(made)))[1] == "No other variant is tied with it."


def test_the_gain_by_more_replicates_grows_up_to_perfect_knowledge(made):
    gains = made.robustness.analysis.weighting.uncertainty.gains
    (_, once), (_, ten_times) = gains.of_more
    assert 0.0 <= once <= ten_times <= gains.perfect


def test_a_study_may_ask_that_feasibility_is_shown(shipped, measured):
    trade_off = dataclasses.replace(shipped.study.trade_off, shown_feasible=True)
    strict = dataclasses.replace(shipped, study=dataclasses.replace(shipped.study, trade_off=trade_off))
    problem = trade_problem(strict, measured)
    assert {"S.low", "t_e_simulated.high", "t_p.high", "P_max_simulated"} <= {one.measure for one in problem.thresholds}
    assert not problem.feasible_alternatives(at_most=100)


def test_every_page_states_the_rule_of_the_choice(made):
    ruled = dataclasses.replace(made, tolerance=0.05, last_of_equals=True)
    sentence = (
        "Rule: of the variants whose estimates miss no threshold on what varies from trial to trial by more than 5 % "
        "of it, and no other threshold, the one of the highest value is chosen; of equals one that no other surpasses "
        "in the quantities of the valued measures, then the largest id."
    )
    assert sentence in list(decision_lines(ruled))
    assert sentence in decision_section(ruled)
    assert sentence in decision_part(ruled)["standing"]
    rule = trade_document(ruled)["conclusion"]["rule"]
    margin = made.practical_margin
    assert rule == {"sentence": sentence, "practical_margin": margin, "tolerance": 0.05, "of_equals": "last"}
    assert "quantities of the valued measures with a weight above 0, then" in rule_sentence(
        dataclasses.replace(made, unweighted=("t_p",))
    )
    assert rule_sentence(dataclasses.replace(made, tolerance=0.0)) == (
        "Rule: of the variants whose estimates meet every requirement, the one of the highest value is chosen; of "
        "equals one that no other surpasses in the quantities of the valued measures, then the smallest id."
    )


def test_the_probability_that_is_stated_is_that_of_being_within_the_margin(made):
    weighting = made.robustness.analysis.weighting
    one = dataclasses.replace(weighting.uncertainty, good=0.75, as_required=0.68)
    weighting = dataclasses.replace(weighting, uncertainty=one)
    analysis = dataclasses.replace(made.robustness.analysis, weighting=weighting)
    stated = dataclasses.replace(
        made, robustness=dataclasses.replace(made.robustness, analysis=analysis), practical_margin=0.05, tolerance=0.1
    )
    first, second = list(uncertainty_sentences(stated))[:2]
    chosen = made.decision.chosen
    assert first.startswith(
        f"Probability that variant {chosen} is feasible and the best, or worth less than it by at most the practical "
        "margin of 0.05: 75 %; that it is feasible: "
    )
    assert second == (
        "Feasible is here what misses no threshold on what varies from trial to trial by more than 10 % of it, the "
        f"tolerance of the choice; verdicts have none. Probability that variant {chosen} meets every requirement "
        "without it: 68 %."
    )
    assert next(uncertainty_sentences(dataclasses.replace(stated, practical_margin=0.0))).startswith(
        f"Probability that variant {chosen} is feasible and best: 75 %"
    )


def test_draws_that_all_agree_are_no_certainty(made):
    # exp(-3) is 0.05: of 1,000 draws none is seen of what has a probability of 0.3 % in one of twenty cases.
    texts = [share_of_draws(share, 1_000) for share in (1.0, 0.0, 0.999, 0.001, 0.25)]
    assert texts == ["> 99.7 %", "< 0.3 %", "99.9 %", "0.1 %", "25 %"]
    assert [share_of_draws(share, 20_000) for share in (1.0, 0.0)] == ["> 99.985 %", "< 0.015 %"]
    weighting = made.robustness.analysis.weighting
    one = dataclasses.replace(weighting.uncertainty, good=1.0, none_feasible=0.0)
    weighting = dataclasses.replace(weighting, uncertainty=one)
    analysis = dataclasses.replace(made.robustness.analysis, weighting=weighting, draws=1_000)
    certain = dataclasses.replace(made, robustness=dataclasses.replace(made.robustness, analysis=analysis))
    first = next(uncertainty_sentences(certain))
    assert ": > 99.7 %; that it is feasible: " in first
    assert first.endswith("that no variant is feasible: < 0.3 %.")


def test_without_noise_a_report_has_no_probability_of_being_feasible(made):
    for with_noise in (True, False):
        weighting = dataclasses.replace(made.robustness.analysis.weighting, with_noise=with_noise)
        analysis = dataclasses.replace(made.robustness.analysis, weighting=weighting)
        other = dataclasses.replace(made, robustness=dataclasses.replace(made.robustness, analysis=analysis))
        rows = decision_part(other)["acceptability"]["variants"]
        assert [one["feasible"] is not None for one in rows] == [with_noise] * len(rows)
