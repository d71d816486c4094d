"""Reader of the trade-off of a study, with a finding for each mistake."""

from __future__ import annotations

from rgss.studies.trade_off.document import TradeOffEntry
from rgss.studies.trade_off.elicitation import AnswerReader
from rgss.studies.trade_off.places import SECTION, TradeOffPlaces
from rgss.studies.trade_off.programs import ProgramReader, check_portfolio, read_risks
from rgss.studies.trade_off.sections import TradeOff
from rgss.studies.trade_off.sensitivity import SensitivityChoice, check_sensitivity
from rgss.studies.trade_off.stakeholders import read_stakeholders
from rgss.studies.trade_off.values import ValueReader
from rgss.tradeoff import weighting_of


def read_trade_off(entry: TradeOffEntry, places: TradeOffPlaces) -> TradeOff | None:
    """Read the section.

    Args:
        entry: The section of the file.
        places: Takes the findings.

    Returns:
        The trade-off; None if its weights or its program are wrong. It can be used where nothing was found.
    """
    answers = AnswerReader(places, entry.elicitation, (*SECTION, "elicitation"))
    reader = ValueReader(places, answers)
    nodes = reader.read(entry.values, entry.rank_rule, (*SECTION, "values"))
    orders = reader.orders(entry.weight_order, nodes)
    reader.check_bounds(nodes, orders)
    answers.check_used(reader.names)
    weights = {} if nodes is None else weighting_of(nodes).weights
    deciding = [measure for measure, weight in weights.items() if weight > 0.0]
    stakeholders = read_stakeholders(places, entry.stakeholders, deciding) if deciding else ()
    sensitivity = SensitivityChoice() if entry.sensitivity is None else entry.sensitivity
    range_places = check_sensitivity(places, sensitivity, reader.valued, deciding)
    program = ProgramReader(places, reader.valued, weights).read(entry.decide_by)
    name = entry.decide_by.program
    risks = read_risks(places, entry.chance, entry.tail)
    portfolio = entry.portfolio
    if portfolio is not None:
        check_portfolio(places, portfolio)
    if not 0.0 <= entry.accept_within <= 1.0:
        message = f"accept_within must be from 0 to 1, got {entry.accept_within:g}"
        places.report("stakeholders", message, (*SECTION, "accept_within"), hint="a difference of value, such as 0.05")
    if not 0.0 <= entry.tolerance < 1.0:
        message = f"tolerance must be from 0 to below 1, got {entry.tolerance:g}"
        places.report("tolerance", message, (*SECTION, "tolerance"), hint="a share of each threshold, such as 5 %")
    if entry.practical_margin < 0.0:
        message = f"practical_margin must be at least 0, got {entry.practical_margin:g}"
        places.report("margin", message, (*SECTION, "practical_margin"), hint="a difference of value, such as 0.01")
    if entry.practical_margin and name in ("lexicographic", "epsilon_constraint"):
        message = f"the {name} program compares quantities, not values"
        hint = "give its last measure a tolerance: what lies within it is listed as near"
        places.report("margin", message, (*SECTION, "practical_margin"), hint=hint)
    if portfolio is not None and name != "additive":
        message = f"a portfolio is chosen by weighted value, not by the {name} program"
        places.report("portfolio", message, (*SECTION, "portfolio"), hint="take the program out")
    if nodes is None or program is None:
        return None
    return TradeOff(
        valued=tuple(reader.valued),
        criteria=nodes,
        intervals=tuple(reader.intervals),
        orders=orders,
        program=program,
        risks=risks,
        practical_margin=entry.practical_margin,
        tolerance=entry.tolerance,
        last_of_equals=entry.of_equals == "last",
        choose_levels=entry.choose == "levels",
        shown_feasible=entry.feasible_by == "verdicts",
        portfolio=portfolio,
        elicited=tuple(answers.elicited),
        stakeholders=stakeholders,
        accept_within=entry.accept_within,
        sensitivity=sensitivity,
        range_places=range_places,
    )
