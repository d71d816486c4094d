"""Each rule of wording: sentences that break it, and sentences like them that do not."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rgss.requirements import NeedKind, Priority, StakeholderNeed, Status
from rgss.trace import RULES
from rgss.trace.rules.rule import SentenceRule
from rgss.trace.sentences.sentences import EarsPattern, read_sentence
from rgss.trace.sentences.terms import TermList

SENTENCE_RULES = {rule.id: (rule, TermList(rule.terms)) for rule in RULES if isinstance(rule, SentenceRule)}

NEED = StakeholderNeed(
    id="STK-1",
    kind=NeedKind.DESIGN,
    text="",
    rationale="",
    source="",
    priority=Priority.LOW,
    status=Status.DRAFT,
    owner="",
)

BREAKING = {
    "wording.R1": [
        "The gripper must close.",
        "If the cup slips the gripper shall close.",
        "When the cup slips the gripper shall close.",
        "There shall be three fingers.",
    ],
    "wording.ears-keyword": [
        "Upon arrival, the gripper shall close.",
        "If the cup slips, the gripper shall close.",
        "For each cup, the gripper shall close.",
    ],
    "wording.R2": [
        "The cup shall be moved to the table.",
        "The cup shall be safely held by the gripper.",
        "When an order arrives, the cup shall be automatically moved to the table.",
        "The record shall be written to the store.",
        "The arm shall be kept clear of the table.",
    ],
    "wording.R18": [
        "The gripper shall open, while the arm shall stay.",
        "The gripper shall open. Fingers are slow.",
    ],
    "wording.R7": [
        "The gripper shall hold many cups.",
        "The gripper shall weigh about 3 kg.",
        "The arm shall stop around 5 mm before the table.",
        "The cell shall have adequate light.",
        "The arm shall move some cups.",
        "The gripper shall hold close to 3 kg.",
        "The arm shall usually stop within 1 s.",
        "The tool shall have a suitable colour.",
        "The panel shall be user friendly.",
        "The panel shall be User-Friendly.",
        "The panel shall be easy to use.",
        "The panel shall be Simple to Learn.",
        "The cell shall use STATE OF THE ART sensors.",
        "The gripper shall hold SEVERAL cups.",
    ],
    "wording.R8": [
        "Where possible, the gripper shall close.",
        "The gripper shall close if necessary.",
        "The gripper shall, to the extent practical, close.",
        "The arm shall stop as appropriate.",
        "The arm shall stop as required.",
        "The gripper shall be as light as possible.",
        "The gripper shall carry as many cups as possible.",
        "The risk shall be as low as reasonably practicable.",
        "Wherever practical, the gripper shall close.",
    ],
    "wording.R9": [
        "The cell shall serve cups, plates, etc.",
        "The cell shall serve cups and so on.",
        "The cell shall serve tableware, including but not limited to cups.",
        "The cell shall serve tableware such as cups.",
        "The cell shall serve tableware, e.g. cups.",
    ],
    "wording.R10": [
        "The gripper shall be able to hold the cup.",
        "The gripper shall be capable of holding the cup.",
        "The arm shall be designed to stop.",
        "The cell shall provide the capability to stop.",
    ],
    "wording.R24": [
        "When a cup stands, the gripper shall hold it.",
        "The arm shall keep its pose.",
        "When fingers close, they shall stop.",
        "The gripper shall hold this.",
        "When this is done, the gripper shall open.",
        "The stroke of one finger shall match that of the next finger.",
        "The arm shall touch nothing.",
    ],
    "wording.R26": [
        "The gripper shall always hold the cup.",
        "The gripper shall never drop the cup.",
        "The arm shall have 100 % availability.",
        "The arm shall reach every waypoint.",
        "The software shall be error-free.",
    ],
    "wording.R32": [
        "The gripper shall hold all cups.",
        "The gripper shall hold any cup.",
        "The gripper shall close both fingers.",
    ],
    "wording.R35": [
        "The arm shall eventually stop.",
        "The arm shall stop immediately.",
        "The arm shall stop after the cup is placed.",
        "The arm shall wait until the cup is placed.",
        "The arm shall stop as soon as possible.",
        "The arm shall stop ASAP.",
        "The arm shall stop in time.",
        "The arm shall stop once the cup is placed.",
        "The arm shall stop a.s.a.p. when told.",
        "The arm shall stop in a timely fashion.",
    ],
    "wording.TBD": [
        "The gripper shall hold TBD kg.",
        "The gripper shall hold a mass to be determined.",
        "The gripper shall hold 3 kg (TBC).",
        "The gripper shall hold tbd kg.",
        "The gripper shall hold T.B.D. kg.",
        "The gripper shall hold a mass yet to be agreed.",
    ],
    "wording.R6": [
        "The gripper shall weigh at most 3.",
        "The gripper shall lift 3.",
        "The arm shall stop within 0.5.",
        "When the load exceeds 3, the arm shall stop.",
        "The table shall have a height of 0.74 for each guest.",
    ],
    "wording.R33": [
        "The gripper shall have a length of 120 mm.",
        "The arm shall move at 1 m/s.",
        "The arm shall stop 2 s after the alarm.",
    ],
    "wording.R34": [
        "The arm shall move quickly.",
        "The arm shall be fast.",
        "The arm shall be Fast.",
        "The cell shall have a maximum uptime.",
        "The cell shall provide maximum uptime.",
        "The arm shall move with minimal noise.",
        "The gripper shall be light weight.",
        "The path shall be Optimised.",
        "The cell shall minimise the cost of a task.",
        "The gripper shall close smoothly.",
        "The planner shall find the optimal path.",
    ],
    "wording.R16": [
        "The gripper shall not drop the cup.",
        "The arm shall touch neither table nor chair.",
        "The gripper shall hold a cup that cannot stand.",
    ],
    "wording.R17": [
        "The gripper shall hold the cup/plate.",
        "The gripper shall open and/or close.",
        "The gripper shall hold the cup / plate.",
    ],
    "wording.R19": [
        "The gripper shall lift and place the cup.",
        "The gripper shall open and close.",
        "The script shall run the trial and record the outcome.",
        "The arm shall stop unless a person confirms.",
        "The arm shall stop, but the gripper stays closed.",
        "The arm shall stop, otherwise a person may be hit.",
        "The gripper shall open or quickly release the cup within 1 s.",
    ],
}

CLEAN = """\
The gripper shall close to a firm grasp.
The gripper shall close around the cup.
The joint shall rotate about the vertical axis.
The cell shall fit on a table of at most 2 × 3 m.
The scene shall be red.
The arm shall be parallel to the table within 0.1 deg.
The RGSS shall have a total cost of at most 43,000 USD.
The gripper shall weigh at most 3 kg.
The gripper shall have 3 fingers.
The gripper shall hold a 0.2 kg cup.
The arm shall accelerate between 3 and 5 m/s^2.
The table shall have a height of 740 mm ± 5 mm.
The table shall have a height of 740 mm with a tolerance of 5 mm.
The arm shall reach station 3 of the line.
The arm shall comply with ISO 10218 part 1.
The cell shall keep the rules of EN 60204-1.
The computer shall have a port of USB 3.0.
The I/O board shall read the sensor.
The computer shall speak TCP/IP.
The arm shall turn joint 6 within 90 deg.
The planner shall sample the path every 10 ms.
The sensor shall deliver at least 100 images per second.
The algorithm shall state a confidence interval of 95 %.
The RGSS shall reach a task success score of at least 0.9.
The contact shall have a friction coefficient of at least 0.5.
The screw shall have a gear ratio of 3 to 1.
The supply shall deliver up to 100 % of the rated load.
The gripper shall record the position and the velocity.
The gripper shall report position and velocity.
The planner shall offer RRT, TRRT and STRIDE.
The record shall list outcome, durations, contacts and forces.
The script shall end the search with the outcome "budget spent, and so on".
The force shall not exceed 40 N.
The arm shall stop not later than 2 s after the alarm.
The arm shall stop within 2 s after the alarm.
The arm shall hold the gripper that carries the cup.
The arm shall hold the cup that is on the table.
The arm shall follow this path.
The arm shall use a finger rather than a hook.
The cell shall use a normally closed valve.
The arm shall stop as required by the stop category 1.
The arm shall use the IT network of the house.
The gripper shall carry a load of 0.5 kg to 2 kg.
The gripper shall limit the slip to at most 10 mm.
The all-terrain base shall carry the arm.
The person shall press the stop button.
The manual shall be in English.
When a cup is ordered, the RGSS shall serve the cup within 25 s.
When the order is not complete, the cell shall show the missing cup.
While the arm moves, when a person enters the zone, the arm shall stop within 0.5 s.
Where a camera is fitted, the cell shall record images at 10 Hz or more.
If the planning time reaches the limit, then the planner shall end the search.
If the cup slips and the force is at the bound, then the arm shall stop.
The brakes shall hold the arm at each pose.
The trial shall end with one of the outcomes in table 4.
The thermal model shall cover 0 to 40 degC.
The vehicle shall display the charge of the battery to the driver.
The pump shall deliver between 2 and 3 litres per minute.
The tower shall withstand a wind speed of at least 50 m/s.
When the door opens, the controller shall cut the power of the heater.
While the aircraft is on the ground, the control unit shall inhibit the thrust reverser lock.
The archive shall store each record for at least 10 years.
The message shall include the maximum number of resets.
The cell shall report once per day.
The cell shall report the counters in Time Services telemetry.
The arm shall have a maximum speed of 2 m/s.
The script shall accept a maximum of 3 studies.
On a stop command, the controller shall enter the SAFE state.
""".splitlines()


def broken_by(text):
    sentence = read_sentence(text)
    return {rule.id: flaw for rule, terms in SENTENCE_RULES.values() for flaw in rule.find(sentence, terms, NEED)}


def test_every_rule_of_sentences_has_examples():
    assert set(BREAKING) == set(SENTENCE_RULES)


@pytest.mark.parametrize(("rule", "text"), [(rule, text) for rule, texts in BREAKING.items() for text in texts])
def test_sentences_that_break_a_rule(rule, text):
    assert rule in broken_by(text)


@pytest.mark.parametrize("text", CLEAN)
def test_sentences_that_break_none(text):
    assert broken_by(text).keys() <= {"wording.ears-keyword"}
    assert isinstance(read_sentence(text).pattern, EarsPattern)


@pytest.mark.parametrize("rule", [rule for rule, (definition, _) in SENTENCE_RULES.items() if definition.terms])
def test_each_term_of_a_rule_counts(rule):
    """A term that no sentence could contain would be in the list in vain."""
    definition, terms = SENTENCE_RULES[rule]
    for term in definition.terms:
        said = term.replace("*", "light")
        assert [match.term for match in terms.find(read_sentence(f"The arm shall {said} 3 go."))], term


@pytest.mark.parametrize(
    ("rule", "text", "message"),
    [
        ("wording.R7", "The cell shall have several adequate lights.", "says 'several', 'adequate', which is vague"),
        ("wording.R18", "The arm shall go, shall stop, shall end.", "says 'shall' 3 times"),
        ("wording.R6", "The arm shall weigh 3 to 5 at most 6.", "has the number '5', '6' without a unit"),
        ("wording.R33", "The arm shall lift 3 kg at 1 m/s.", "asks for '3 kg', '1 m/s' exactly"),
        ("wording.R17", "The arm shall lift a cup/plate.", "has 'cup/plate': both, or either?"),
    ],
)
def test_a_message_says_what_was_found(rule, text, message):
    assert broken_by(text)[rule].message == message


def test_a_pure_number_that_is_the_threshold_needs_no_unit(project):
    project.change("P", unit="1").edit("system.yaml", '"800 g"', "0.8")
    assert project.edit("system.yaml", "0.8 kg", "0.8").rules() == []


def test_a_criterion_is_a_target(project):
    project.edit("system.yaml", "at least 0.8 kg", "the cup quickly")
    assert project.rules() == []


@pytest.mark.parametrize(
    ("text", "rules"),
    [
        ("when a cup is ordered, the system shall serve the cup", ["wording.duplicate"]),
        ("When a cup is ordered: the system shall serve the cup.", ["wording.R1", "wording.duplicate"]),
        ("When a cup is ordered, the system shall serve the mug.", []),
    ],
)
def test_the_same_words_are_the_same_requirement(project, text, rules):
    project.edit("system.yaml", "text: The gripper shall lift at least 0.8 kg.", f'text: "{text}"')
    assert project.rules() == rules


@pytest.mark.parametrize("hostile", ["<script>alert(1)</script>", "[link](javascript:x)", "{{7*7}}", "=1+1", "%s%n"])
def test_markup_in_a_text_is_text(project, hostile):
    project.edit("system.yaml", "text: The", f'text: "{hostile} The').edit("system.yaml", "0.8 kg.", '0.8 kg."')
    for finding in project.findings():
        assert "\n" not in finding
    assert set(project.rules()) <= {"wording.R1", "wording.R6", "wording.R17", "wording.R33"}


@pytest.mark.parametrize(
    "text",
    [
        "a" * 9000,
        "shall " * 1500,
        "When " * 1500,
        ", " * 4000,
        "/" * 9000,
        "1 " * 4000,
        "be " * 3000,
        '"' * 9000,
        "The arm shall " + "a/" * 4000,
        "If " + "a, " * 3000 + "then the arm shall stop.",
        "100 " * 2000 + "%",
    ],
)
def test_no_sentence_keeps_a_rule_for_ever(text):
    """A pattern that goes back in powers of the length would not end within a day."""
    assert isinstance(broken_by(text), dict)


@given(st.text(max_size=300), st.sampled_from(["", "The arm shall ", "When ", "If a, then the arm shall "]))
def test_no_text_makes_a_rule_fail(text, start):
    for flaw in broken_by(start + text).values():
        assert flaw.message
        assert flaw.hint
