"""Settings under which a decision is confirmed: each differs from the study's in one thing."""

from dataclasses import replace

import pytest

from rgss.confirmation import Aspect, Engine, confirmation_settings
from rgss.errors import DefinitionError
from rgss.evidence import Fidelity
from rgss.physics import least_iterations
from rgss.studies import trial_specs
from rgss.sweep import key_of
from tests.trials.hands.gripper_files import linkage_file


def test_each_setting_differs_from_the_studys_in_one_thing(shipped):
    study, step, iterations, engine = confirmation_settings(shipped)
    assert [one.aspect for one in (study, step, iterations, engine)] == list(Aspect)
    assert step.physics == replace(study.physics, rate_hz=1000.0)
    assert iterations.physics == replace(study.physics, solver_iterations=80, free_iterations=80)
    assert (study.label, step.label) == ("PyBullet 240 Hz, 20 iterations", "PyBullet 1000 Hz, 20 iterations")
    assert engine.label.startswith("MuJoCo 3.")
    assert engine.label.endswith(", 2000 Hz")


def test_engines_are_chosen(shipped):
    only = {engine: confirmation_settings(shipped, engines=[engine]) for engine in Engine}
    assert [one.aspect for one in only[Engine.MUJOCO]] == [Aspect.STUDY, Aspect.ENGINE]
    assert [one.aspect for one in only[Engine.PYBULLET]] == [Aspect.STUDY, Aspect.STEP, Aspect.ITERATIONS]


def test_trials_of_each_setting_have_keys_of_their_own_and_the_studys_keep_theirs(shipped):
    variant = [shipped.designs.variant(28)]
    settings = confirmation_settings(shipped)
    keys = [key_of(trial_specs(one.of(shipped), variants=variant, seeds=[1])[0]) for one in settings]
    assert len(set(keys)) == len(settings)
    assert keys[0] == key_of(trial_specs(shipped, variants=variant, seeds=[1])[0])


def test_another_release_of_the_engine_or_other_code_of_it_is_other_evidence(shipped):
    variant = [shipped.designs.variant(28)]
    engine = confirmation_settings(shipped, engines=[Engine.MUJOCO])[1]
    others = [replace(engine, physics=replace(engine.physics, **{name: "another"})) for name in ("version", "code")]
    keys = {key_of(trial_specs(one.of(shipped), variants=variant, seeds=[1])[0]) for one in (engine, *others)}
    assert len(keys) == 3


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (
            {"rate_hz": 240.0},
            (
                "the finer rate must be above that of the study, 240 Hz, got 240 Hz "
                "(give a higher rate: a coarser step confirms nothing)"
            ),
        ),
        (
            {"rate_hz": 200.0},
            (
                "the finer rate must be above that of the study, 240 Hz, got 200 Hz "
                "(give a higher rate: a coarser step confirms nothing)"
            ),
        ),
        ({"rate_hz": 60.0}, 'the rate must be from 120 to 20000 Hz, got 60 Hz (write "1000 Hz")'),
        ({"rate_hz": float("nan")}, "the rate must be from 120 to 20000 Hz, got nan Hz"),
        (
            {"iterations": 20},
            "the number of solver iterations must be above that of the study, 20, got 20 (give a greater number)",
        ),
        ({"iterations": 0}, "the number of solver iterations must be from 1 to 2000, got 0"),
        ({"iterations": 2001}, "the number of solver iterations must be from 1 to 2000, got 2001"),
        ({"iterations": 5}, "the number of solver iterations must be above that of the study, 20, got 5"),
    ],
)
def test_what_cannot_confirm_is_refused(shipped, options, message):
    with pytest.raises(DefinitionError) as refused:
        confirmation_settings(shipped, **options)
    assert str(refused.value).startswith(message)


@pytest.fixture
def geared(shipped, tmp_path):
    """The study with a gripper whose gears take more iterations than four times the study's."""
    return replace(shipped, grippers={**shipped.grippers, "linkage": linkage_file(tmp_path)})


def test_more_iterations_are_more_than_gears_take_anyway(geared):
    taken = least_iterations(geared.grippers["linkage"].geometry.linkage)
    (more,) = [one for one in confirmation_settings(geared) if one.aspect is Aspect.ITERATIONS]
    assert more.physics.solver_iterations == 2 * taken
    message = (
        f"the number of solver iterations must be above {taken}, which the gears of a hand take anyway, got {taken}"
    )
    with pytest.raises(DefinitionError, match=message):
        confirmation_settings(geared, iterations=taken)


@pytest.mark.parametrize("fidelity", [Fidelity.KINEMATIC, Fidelity.DYNAMIC])
def test_a_study_without_contact_has_nothing_to_confirm(shipped, fidelity):
    with pytest.raises(DefinitionError, match=f"a decision by {fidelity.value} trials has no contact physics"):
        confirmation_settings(shipped.with_fidelity(fidelity.value))


def test_a_missing_engine_is_named_with_the_command_that_installs_it(shipped, monkeypatch):
    monkeypatch.setattr("rgss.engines._is_installed", lambda module: module != "mujoco")
    with pytest.raises(DefinitionError) as refused:
        confirmation_settings(shipped)
    assert str(refused.value) == ("a trial in MuJoCo needs MuJoCo, which is not installed (pip install 'rgss[mujoco]')")
    assert len(confirmation_settings(shipped, engines=[Engine.PYBULLET])) == 3
