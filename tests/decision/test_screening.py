"""Screening: what kinematic trials prove, which designs go on, and that nothing unknown eliminates."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.assessment.estimate_bounds import IN_COMMON, bounds_by_measure
from rgss.assessment.measuring import measure_variants, requirements_with_criteria
from rgss.decision.choosing import choose
from rgss.decision.screening import (
    measure_survivors,
    promoted,
    screen,
    screening_specs,
    surviving_specs,
)
from rgss.decision.screening_result import ScreeningOutcome
from rgss.errors import DefinitionError
from rgss.evidence import EvidenceStore, Failure, Fidelity
from rgss.measures import Verdict, judge
from rgss.reports.decision import screening_lines, screening_to_json
from rgss.studies.expansion import trial_specs
from rgss.studies.project import load_project
from rgss.studies.promotion import Promotion, Screening
from rgss.trials.code.piece_versions import versions
from rgss.trials.pieces.input_digests import digests_of
from rgss.trials.pieces.run import Pieces
from tests.fixtures.stored_trials import put_trials

STUDY = "studies/pick_place.yaml"
BOTH = "fidelity: [kinematic, contact]"


@pytest.fixture(scope="module")
def screened(shipped):
    """The shipped project with screening, by a promotion."""

    def make(promotion=None, replicates=3):
        screening = Screening(fidelity=Fidelity.KINEMATIC, promotion=promotion or Promotion())
        return replace(shipped, study=replace(shipped.study, screening=screening, replicates=replicates))

    return make


@pytest.fixture
def kept(tmp_path):
    """Opens a store with the records of some trials."""
    stores = []

    def keep(specs, record_for):
        store = EvidenceStore.open(tmp_path / f"{len(stores)}.sqlite")
        stores.append(store)
        put_trials(store, specs, record_for)
        return store

    yield keep
    for store in stores:
        store.close()


def test_a_study_names_two_fidelities_and_a_promotion(folder, edit):
    edit(STUDY, "fidelity: contact", f"{BOTH}\npromotion: {{requirements: possible, keep: 24, within: 5 %}}")
    study = load_project(folder).study
    assert study.fidelity is Fidelity.CONTACT
    assert study.screening == Screening(fidelity=Fidelity.KINEMATIC, promotion=Promotion(keep=24, within=0.05))
    assert str(study.screening.promotion) == "requirements: possible, keep: 24, within: 0.05"


def test_without_a_promotion_what_is_possible_goes_on(folder, edit):
    edit(STUDY, "fidelity: contact", BOTH)
    project = load_project(folder)
    assert project.study.screening == Screening(fidelity=Fidelity.KINEMATIC, promotion=Promotion())
    assert project.with_fidelity("dynamic").study.screening is None


@pytest.mark.parametrize(
    ("old", "new", "mark", "message"),
    [
        (
            "fidelity: contact",
            "fidelity: contact\npromotion: {keep: 3}",
            "promotion:",
            (
                "there is a promotion, and one fidelity alone (write 'fidelity: [kinematic, contact]', or remove "
                "'promotion') [study.promotion]"
            ),
        ),
        (
            "fidelity: contact",
            f"{BOTH}\npromotion: {{within: 1.5}}",
            "1.5}",
            "within is a share of the value, from 0 to 1 (write a number such as 0.05) [study.promotion]",
        ),
        (
            "fidelity: contact",
            f"{BOTH}\npromotion: {{keep: 0}}",
            "0}",
            "keep: input should be greater than or equal to 1",
        ),
        ("fidelity: contact", f"{BOTH}\npromotion: {{best: 3}}", "best:", "unknown key 'best'"),
        ("fidelity: contact", "fidelity: [contact, kinematic]", "[contact, kin", "nor [kinematic, contact] (write"),
        ("fidelity: contact", "fidelity: [kinematic]", "[kinematic]", "nor [kinematic, contact] (write"),
    ],
)
def test_mistakes_are_found_at_their_place(edit, place_of, problems, old, new, mark, message):
    edit(STUDY, old, new)
    (found,) = problems()
    assert found.startswith(f"{place_of(STUDY, mark)}: error: ")
    assert message in found


def test_a_wall_clock_proves_nothing(edit, place_of, problems):
    edit(STUDY, "fidelity: contact", BOTH)
    edit(STUDY, "clock: counted", "clock: wall")
    assert problems() == [
        (
            f"{place_of(STUDY, 'wall')}: error: by a wall clock one fidelity's planning proves nothing about another's "
            "(write 'clock: counted', or one fidelity) [study.promotion]"
        )
    ]


def test_what_contact_shows_lies_within_the_bounds(screened, kept, record_of):
    """Twins as contact could make them: any of the successful ones may fail, at any phase."""
    project = screened()
    fails = {1: {1}, 2: {1, 2}, 3: {1, 2, 3}}
    variants = [variant for variant in project.designs.expand() if variant.id <= 4]

    def kinematic(spec):
        return record_of(spec, success=spec.seed not in fails.get(spec.variant, ()), planning_s=float(spec.seed))

    low = project.with_fidelity("kinematic")
    store = kept(screening_specs(project, variants=variants), kinematic)
    measured = [entry for entry in measure_variants(low, store) if not entry.missing]
    found = {entry.variant.id: bounds_by_measure(project, entry) for entry in measured}
    for lost in (set(), {1}, {2}, {3}, {1, 2}, {2, 3}):
        twins = kept(
            surviving_specs(project, screen(project, store), variants=variants),
            lambda spec, lost=lost: (
                kinematic(spec)
                if spec.seed not in lost or spec.seed in fails.get(spec.variant, ())
                else replace(
                    record_of(spec, success=False, planning_s=float(spec.seed)),
                    failure=Failure.OBJECT_DROPPED,
                    failure_detail="slipped",
                )
            ),
        )
        for entry in measure_variants(project, twins):
            if entry.missing:
                continue
            for measure, bounds in found[entry.variant.id].items():
                value = entry.estimates[measure].value
                ends = [one.value for one in bounds.estimates]
                if not bounds.bounded or value is None:
                    continue
                assert min(ends) - 1e-12 <= value <= max(ends) + 1e-12, measure
            for requirement in requirements_with_criteria(project):
                criterion, bounds = requirement.criterion, found[entry.variant.id][requirement.criterion.measure]
                if bounds.bounded and bounds.estimates and entry.verdicts[requirement.id] is not Verdict.NOT_MET:
                    assert entry.estimates[criterion.measure].value is None or any(
                        judge(criterion, one) is not Verdict.NOT_MET for one in bounds.estimates
                    )


def test_the_two_fidelities_have_plans_and_timings_in_common(screened):
    project = screened()
    for low, high in zip(screening_specs(project), trial_specs(project), strict=True):
        one, other = digests_of(low, versions()), digests_of(high, versions())
        assert (low.variant, low.seed, one.plan, one.timing) == (high.variant, high.seed, other.plan, other.timing)
        assert one.execution != other.execution


@pytest.mark.engine
@pytest.mark.parametrize("number", [1, 28])
def test_real_twins_lie_within_the_bounds(screened, number):
    project = screened(replicates=1)
    variants = [variant for variant in project.designs.expand() if variant.id == number]
    (low,), (high,) = screening_specs(project, variants=variants), trial_specs(project, variants=variants)
    pieces = Pieces()
    kinematic, contact = pieces.record(low), pieces.record(high)
    assert contact.metrics["phases_completed"] <= kinematic.metrics["phases_completed"]
    for name in ("planning_time_s", "planning_checks", "path_length_m"):
        pairs = zip(kinematic.metrics[name], contact.metrics[name], strict=True)
        assert all(twin in (None, value) for value, twin in pairs)
    if kinematic.failure in IN_COMMON:
        assert contact.failure is not None


def test_nothing_that_kinematic_fidelity_cannot_know_is_bounded(screened, kept, record_of):
    project = screened()
    (variant,) = (one for one in project.designs.expand() if one.id == 5)
    store = kept(screening_specs(project, variants=[variant]), record_of)
    (entry,) = (one for one in measure_variants(project.with_fidelity("kinematic"), store) if not one.missing)
    found = bounds_by_measure(project, entry)
    for measure in project.measures.measures:
        touched = {
            source
            for source in project.measures.sources(measure.id)
            if source.startswith(("trial.grasp", "trial.at_grasp", "trial.contact", "trial.held", "trial.slip"))
            or source in ("trial.motion_time_s", "trial.task_time_s", "trial.bench_payload_kg", "trial.grip_margin_min")
        }
        if touched:
            assert not found[measure.id].bounded, measure.id
    assert [round(one.value, 6) for one in found["S"].estimates] == [0.0, round(1 / 3, 6), round(2 / 3, 6), 1.0]
    assert [one.value for one in found["t_p"].estimates] == [5.0]


def test_what_cannot_meet_a_requirement_is_screened_out_and_told_why(screened, kept, record_of):
    project = screened()
    store = kept(
        screening_specs(project),
        lambda spec: record_of(spec, success=spec.variant != 7, planning_s=9.0 if spec.variant == 9 else 1.0),
    )
    result = screen(project, store)
    fates = {one.variant: one for one in result.variants}
    assert fates[7].outcome is ScreeningOutcome.IMPOSSIBLE
    assert fates[7].reason.startswith("SYS-")
    assert "S is 0" in fates[7].reason
    assert fates[9].outcome is ScreeningOutcome.IMPOSSIBLE
    assert "t_p is 45 s" in fates[9].reason
    by_hand = {
        entry.variant.id
        for entry in measure_variants(project.with_fidelity("kinematic"), store)
        # Of these requirements the design and the planning alone decide; all others are met as S is. Planning
        # is the same at both fidelities, so that its estimate is final.
        if Verdict.NOT_MET in entry.verdicts.values() or (entry.estimates["t_p"].value or 0.0) > 15.0
    }
    assert {one.variant for one in result.screened_out} == by_hand
    assert all(requirement in fates[7].reason for requirement in fates[7].missed)
    assert [spec.variant for spec in surviving_specs(project, result)][::3] == list(result.survivors)
    assert {spec.fidelity for spec in surviving_specs(project, result)} == {Fidelity.CONTACT}


@pytest.mark.parametrize(("tolerance", "survives"), [(0.0, False), (0.06, False), (0.07, True), (0.1, True)])
def test_what_the_choice_tolerates_goes_on(screened, kept, record_of, tolerance, survives):
    # Planning takes 16 s of at most 15 s, in contact too: without screening such a design may be chosen.
    project = screened()
    project = replace(
        project, study=replace(project.study, trade_off=replace(project.study.trade_off, tolerance=tolerance))
    )
    store = kept(
        screening_specs(project), lambda spec: record_of(spec, planning_s=16.0 / 5 if spec.variant == 9 else 1.0)
    )
    every = (*screening_specs(project), *trial_specs(project))
    contact = kept(every, lambda spec: record_of(spec, planning_s=16.0 / 5 if spec.variant == 9 else 1.0))

    fate = next(one for one in screen(project, store).variants if one.variant == 9)
    assert fate.goes_on is survives
    assert (fate.outcome is ScreeningOutcome.IMPOSSIBLE) is not survives
    without = choose(project, measure_variants(project, contact))
    assert (9 in {one.variant for one in without.ranking}) is survives


def test_a_doubtful_success_does_not_eliminate(screened, kept, record_of):
    # 2 of 3 in kinematic trials: the interval reaches above the threshold, so it is not decided yet.
    project = screened()
    store = kept(screening_specs(project), lambda spec: record_of(spec, success=spec.seed != 2))
    every = {one.variant: one for one in screen(project, store).variants}
    criterion = next(one.criterion for one in requirements_with_criteria(project) if one.criterion.measure == "S")
    assert judge(criterion, measure_variants(project.with_fidelity("kinematic"), store)[0].estimates["S"]) is (
        Verdict.INCONCLUSIVE
    )
    assert not any("and S is" in one.reason for one in every.values())


def values_by_hand(project, planning_s):
    """The greatest value of each design, with what is unknown at its best, from the study's linear anchors."""
    found = {}
    for variant in project.designs.expand():
        total = 0.0
        speed = variant.parameters["d7"]
        quantities = {
            "t_p": 5 * planning_s(variant.id),
            "t_e": 5 * planning_s(variant.id) + 0.048 / 0.04 + 5 * 0.5 / speed,
            "S": 1.0,
        }
        for one in project.study.values:
            quantity = quantities.get(one.measure)
            if quantity is not None:
                total += one.weight * min(max((quantity - one.worst) / (one.best - one.worst), 0.0), 1.0)
        found[variant.id] = total
    return found


def test_keep_takes_the_best_and_all_that_equal_the_last(screened, kept, record_of):
    def planning_s(variant):
        return 1.0 + variant // 4 * 0.05

    project = screened(Promotion(keep=5))
    store = kept(screening_specs(project), lambda spec: record_of(spec, planning_s=planning_s(spec.variant)))
    result = screen(project, store)
    design_only = {
        entry.variant.id: sum(
            one.weight * min(max((entry.estimates[one.measure].value - one.worst) / (one.best - one.worst), 0.0), 1.0)
            for one in project.study.values
            if one.measure in ("P_max", "C_total")
        )
        for entry in measure_variants(project, None)
    }
    by_hand = values_by_hand(project, planning_s)
    possible = {one.variant for one in result.variants if one.outcome is not ScreeningOutcome.IMPOSSIBLE}
    expected = {variant: design_only[variant] + by_hand[variant] for variant in possible}
    for one in result.variants:
        if one.variant in possible:
            assert one.best_value == pytest.approx(expected[one.variant], abs=1e-9)
    last = sorted(expected.values(), reverse=True)[4]
    assert set(result.survivors) == {variant for variant, value in expected.items() if value >= last - 1e-9}
    outranked = [one for one in result.variants if one.outcome is ScreeningOutcome.OUTRANKED]
    assert outranked
    assert all("below those of the best 5" in one.reason for one in outranked)


def test_within_takes_what_is_nearly_as_good(screened, kept, record_of):
    project = screened(Promotion(within=0.02))
    store = kept(screening_specs(project), lambda spec: record_of(spec, planning_s=1 + spec.variant / 100))
    result = screen(project, store)
    possible = {
        one.variant: one.best_value for one in result.variants if one.outcome is not ScreeningOutcome.IMPOSSIBLE
    }
    bar = max(possible.values()) - 0.02
    assert set(result.survivors) == {variant for variant, value in possible.items() if value >= bar - 1e-9}
    assert 0 < len(result.survivors) < len(possible)
    assert any("more than 0.02 below the best" in one.reason for one in result.screened_out)


def test_where_no_design_is_possible_all_go_on(screened, kept, record_of):
    project = screened(Promotion(keep=3))
    result = screen(project, kept(screening_specs(project), lambda spec: record_of(spec, success=False)))
    assert {one.outcome for one in result.variants} == {ScreeningOutcome.SPARED}
    assert len(result.survivors) == 72


def test_a_design_without_screening_trials_goes_on(screened, kept, record_of):
    project = screened(Promotion(keep=1))
    variants = [variant for variant in project.designs.expand() if variant.id > 3]
    result = screen(project, kept(screening_specs(project, variants=variants), record_of))
    fates = {one.variant: one for one in result.variants}
    assert [fates[number].outcome for number in (1, 2, 3)] == [ScreeningOutcome.UNSCREENED] * 3
    assert fates[1].reason == "3 of its trials at the screening fidelity have no evidence"
    assert {1, 2, 3} < set(result.survivors)


def test_the_decision_is_between_the_survivors(screened, kept, record_of):
    project = screened(Promotion(keep=4))
    first = kept(screening_specs(project), record_of)
    result = screen(project, first)
    store = kept((*screening_specs(project), *surviving_specs(project, result)), record_of)
    measured, again = measure_survivors(project, store)
    assert again == result
    assert tuple(entry.variant.id for entry in measured) == result.survivors
    assert not any(entry.missing for entry in measured)
    assert choose(project, measured).chosen in result.survivors


def test_without_screening_every_design_is_measured(shipped, kept, record_of):
    store = kept([], record_of)
    measured, result = measure_survivors(shipped, store)
    assert (len(measured), result, screen(shipped, store), screening_specs(shipped)) == (72, None, None, ())
    with pytest.raises(DefinitionError, match=r"has no screening \(write 'fidelity: \[kinematic, contact\]'\)"):
        promoted(shipped, measured)


def test_what_was_screened_out_is_told(screened, kept, record_of):
    project = screened(Promotion(keep=6))
    result = screen(project, kept(screening_specs(project), record_of))
    head, *rest = screening_lines(result)
    assert head == (
        "Screening at kinematic fidelity (requirements: possible, keep: 6): "
        f"{len(result.survivors)} of 72 designs go on"
    )
    told = {int(number) for line in rest for number in line.split(": ")[1].split(", ")}
    assert told == {one.variant for one in result.screened_out}
    document = screening_to_json(result)
    assert document["survivors"] == list(result.survivors)
    assert [one["variant"] for one in document["variants"]] == list(range(1, 73))
